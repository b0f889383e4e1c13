"""What became of a change, told with every NoAnswer that a caller gets."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from backend.device.driver import NEVER_ASKED
from backend.errors import NoAnswer, Outcome


@contextmanager
def telling(outcome: Outcome) -> Iterator[None]:
    """Let a NoAnswer from in here say what became of the change, unless it does by itself."""
    try:
        yield
    except NoAnswer as error:
        if error.outcome is None:
            error.outcome = "unchanged" if error.code in NEVER_ASKED else outcome
        raise
