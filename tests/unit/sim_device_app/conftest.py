"""The unit of these tests."""

import pytest

from tests.fakes.bench_unit import BenchUnit


@pytest.fixture
def unit() -> BenchUnit:
    """A unit as its factory leaves it, after HELLO. A file that needs another has its own."""
    unit = BenchUnit()
    unit.hello()
    return unit
