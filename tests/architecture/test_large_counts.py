"""Goal: a count that is a tenth in `make test` is whole in `make prove`, which runs marked tests.

Method: a test file that asks `tests.counts` has the mark `large_count`, and one that has the mark
asks.
"""

from __future__ import annotations

from pathlib import Path

import pytest

TESTS = Path(__file__).resolve().parents[1]
FILES = [path for path in sorted(TESTS.rglob("test_*.py")) if path != Path(__file__)]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(TESTS).as_posix())
def test_who_does_a_tenth_is_proved_in_full(path: Path) -> None:
    text = path.read_text(encoding="utf-8")

    assert ("counts." in text and "import counts" in text) == ("mark.large_count" in text)
