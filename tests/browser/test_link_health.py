"""Goal: whoever looks at the link sees in one line whether everything arrived, and if not, where it
was lost. Built = received + lost on the link + dropped by the unit.

The real server tells of a clean line; counters of poor lines are put in between, on the way to the
page.
"""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from playwright.sync_api import Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways

HEALTH = "[data-testid=link-health]"


def poor_line(desk: Desk, **counters: int) -> None:
    """The unit's link counters as the page sees them from now on."""

    def answer(route: Route) -> None:
        body: dict[str, Any] = route.fetch().json()
        for item in body["items"]:
            item["link"].update(counters)
        route.fulfill(body=json.dumps(body), content_type="application/json")

    desk.page.route("**/api/v1/devices", answer)


@pytest.mark.parametrize("path", ["/", "/service"])
def test_a_clean_line_is_healthy_and_its_account_adds_up(
    desk: Desk, riding: str, path: str
) -> None:
    page = desk.open(path)

    expect(page.locator(HEALTH)).to_have_attribute("data-healthy", "true")
    expect(page.locator(HEALTH)).to_contain_text("every frame the unit built has arrived")
    text = page.inner_text(f"{HEALTH} .sum").replace(",", "")
    built, received, lost, dropped = (int(n) for n in re.findall(r"\d+", text))
    assert built == received + lost + dropped > 0


@pytest.mark.parametrize(
    ("lost", "dropped", "words"),
    [
        (12, 0, "12 frames were lost on the link"),
        (0, 12, "12 frames were dropped by the unit"),
        (7, 5, "7 frames were lost on the link, 5 dropped by the unit"),
    ],
)
def test_a_poor_line_says_which_part_lost_how_many(
    desk: Desk, standing: str, lost: int, dropped: int, words: str
) -> None:
    built = 1000 + lost + dropped
    poor_line(
        desk,
        balance_built=built,
        balance_received=1000,
        balance_lost=lost,
        balance_dropped=dropped,
    )
    page = desk.open("/service")

    expect(page.locator(HEALTH)).to_contain_text(words)
    expect(page.locator(f"{HEALTH} .sum")).to_contain_text(f"Built {built:,} =")
    desk.picture(f"link-health-{lost}-{dropped}")


def test_a_poor_line_in_chinese_on_a_phone(open_desk: OpenDesk, standing: str) -> None:
    desk = open_desk(width=360, height=740, language="zh-CN")
    poor_line(desk, balance_built=1009, balance_received=1000, balance_lost=7, balance_dropped=2)
    page = desk.open("/service")

    expect(page.locator(HEALTH)).to_contain_text("7 帧在链路上丢失")
    assert sideways(page) == 0
    page.locator(HEALTH).scroll_into_view_if_needed()
    desk.picture("link-health-phone-zh")
