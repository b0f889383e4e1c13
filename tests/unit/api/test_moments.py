"""Goal: a moment in a question is a date and a time (RFC 3339); a bare number is none.

A number could be seconds or milliseconds, of one epoch or another: nobody said which.
"""

from __future__ import annotations

import pytest
from pydantic import TypeAdapter, ValidationError

from backend.rides.api import Moment

MOMENT: TypeAdapter[object] = TypeAdapter(Moment)


@pytest.mark.parametrize("text", ["2026-05-01T12:00:00Z", "2026-05-01T12:00:00+02:00"])
def test_a_moment_is_read(text: str) -> None:
    assert MOMENT.validate_python(text) is not None


@pytest.mark.parametrize("text", ["0", "2.348082654482456e-173", "1777636800", "-1e3", "", "noon"])
def test_a_number_or_a_word_is_no_moment(text: str) -> None:
    with pytest.raises(ValidationError, match="moment"):
        MOMENT.validate_python(text)
