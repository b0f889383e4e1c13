"""Goal: a ride has a name that a reader can see and click, or none."""

from __future__ import annotations

import pytest

from backend.core.ride import readable_name


@pytest.mark.parametrize(
    "name", ["", " ", "\u200b", "\u200b\u2060\ufeff", "\u3164", "\u2800 \u202e"]
)
def test_a_name_of_which_nothing_is_seen_is_none(name: str) -> None:
    assert readable_name(name) == ""


@pytest.mark.parametrize("name", ["lunch", "\u200bhill", "雨中骑行", "👨\u200d👩\u200d👧", "."])
def test_any_other_name_stays_as_it_was_given(name: str) -> None:
    assert readable_name(name) == name
