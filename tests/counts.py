"""How much of a large count a run does: a tenth of it, or with `pytest --prove` all of it.

A test that asks here is marked `large_count`. `make test` runs it with a tenth, `make prove` runs
the marked tests alone with all (tests/architecture/test_large_counts.py).
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TypeVar

PROVE_VARIABLE = "SPINDLE_PROVE"
# Eleven, not ten: no divisor of a byte, a word or a block, so that every place in one is met.
STRIDE = 11

Item = TypeVar("Item")


def proving() -> bool:
    """Whether this run does all of it."""
    return os.environ.get(PROVE_VARIABLE) == "1"


def of(full: int, least: int = 1, share: int = 10) -> int:
    """How many of `full` this run does: all, or one in `share` and not less than `least`."""
    return full if proving() else max(least, full // share)


def stride() -> int:
    """From one tried place to the next, where every place is tried in the full run."""
    return 1 if proving() else STRIDE


def some(items: Sequence[Item]) -> Sequence[Item]:
    """All, or every eleventh and the last."""
    return items if proving() else [*items[:-1:STRIDE], *items[-1:]]
