"""Goal: If-Match compares as RFC 9110, 13.1.1 says: strongly, in lists, with `*` for any."""

from __future__ import annotations

import pytest

from backend.device.configuration import ConfigImage
from backend.errors import ConfigConflict
from backend.services.tuning.config_view import check_base, etag

CONFIG = ConfigImage(7, 0xABCD, {})
TAG = etag(7, 0xABCD)


@pytest.mark.parametrize(
    "if_match",
    [None, "*", " * ", TAG, TAG.strip('"'), f'"6-00000000", {TAG}', f'W/{TAG}, {TAG} ,"a,b"'],
)
def test_a_change_for_this_configuration_goes_on(if_match: str | None) -> None:
    check_base(CONFIG, if_match)


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
    ],
)
def test_a_change_for_another_one_or_a_weak_tag_is_refused(if_match: str) -> None:
    with pytest.raises(ConfigConflict):
        check_base(CONFIG, if_match)
