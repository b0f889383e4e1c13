"""Goal: If-Match compares as RFC 9110, 13.1.1 says: strongly, in lists, with `*` for any;
and a tag names its unit, so that what was read of one bike is never written into another."""

from __future__ import annotations

import pytest

from backend.device.configuration import ConfigImage
from backend.errors import ConfigConflict, OtherUnit
from backend.tuning.types import check_base, etag

CONFIG = ConfigImage(7, 0xABCD, {})
UNIT, OTHER = "ebl:SPD-000011", "ebl:SPD-000022"
TAG = etag(UNIT, 7, 0xABCD)
EARLIER = etag(UNIT, 6, 0xABCD)
OF_OTHER = etag(OTHER, 7, 0xABCD)


@pytest.mark.parametrize(
    "if_match",
    [None, "*", " * ", TAG, TAG.strip('"'), f'"6-00000000", {TAG}', f'W/{TAG}, {TAG} ,"a,b"'],
)
def test_a_change_for_this_configuration_goes_on(if_match: str | None) -> None:
    check_base(UNIT, CONFIG, if_match)


@pytest.mark.parametrize(
    "if_match",
    [
        "",
        '"6-0000abcd"',
        f"W/{TAG}",
        f'W/{TAG}, "x"',
        f"w/{TAG}",
        '"*"',
        '"a, 7-0000abcd"',
        '"x7-0000abcd"',
        EARLIER,
        f"{EARLIER}, {OF_OTHER}",
    ],
)
def test_a_change_for_another_one_or_a_weak_tag_is_refused(if_match: str) -> None:
    with pytest.raises(ConfigConflict):
        check_base(UNIT, CONFIG, if_match)


def test_factory_fresh_units_have_tags_of_their_own() -> None:
    assert TAG != OF_OTHER


@pytest.mark.parametrize("if_match", [OF_OTHER, f"W/{OF_OTHER}", f'{OF_OTHER}, "x"'])
def test_a_change_for_another_unit_is_refused_as_such(if_match: str) -> None:
    with pytest.raises(OtherUnit, match=UNIT):
        check_base(UNIT, CONFIG, if_match)
