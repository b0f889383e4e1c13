"""The workshop, one for a file of tests."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.fakes.workshop import Workshop, open_workshop


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Workshop]:
    with open_workshop(tmp_path_factory.mktemp("workshop")) as opened:
        yield opened
