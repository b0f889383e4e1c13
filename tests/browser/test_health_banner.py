"""Goal: what the server cannot save is told on every page, with what to do, as long as it lasts.

The server's health is answered in its place: what makes it degraded is tested where that is found.
"""

from __future__ import annotations

from typing import Any

from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.fakes.server import SpindleServer

BANNER = "[data-testid=health-banner]"
PLACES_MIN = 6
FULL = "The database cannot be written: no space is left on its disk. Free some."


def degraded(server: SpindleServer, rows_lost: int = 0) -> dict[str, Any]:
    """The health of a server whose disk is full."""
    health: dict[str, Any] = server.get("/health")
    reason = {"code": "disk_full", "message": FULL, "part": "database"}
    recorder = {"rows_saved": 1200, "rows_lost": rows_lost, "rows_waiting": 50, "rows_missing": 0}
    devices = [one | {"recorder": recorder} for one in health["devices"]]
    return health | {"status": "degraded", "reasons": [reason], "devices": devices}


def answered(desk: Desk, health: dict[str, Any]) -> dict[str, Any]:
    """What `/health` says from now on; the test may change it."""
    desk.page.route("**/api/v1/health", lambda route: route.fulfill(json=health))
    return health


def test_every_page_says_that_the_disk_is_full_until_all_is_saved_again(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    health = answered(desk, degraded(server))
    # Health is asked for every few seconds, by the clock that the test turns on.
    desk.page.clock.install()
    page = desk.open("/")
    expect(page.locator(BANNER)).to_contain_text(FULL)

    places = page.locator("nav li a")
    assert places.count() > PLACES_MIN
    for place in places.all():
        place.click()
        expect(place).to_have_attribute("aria-current", "page")
        expect(page.locator(BANNER)).to_contain_text(FULL)
    health |= server.get("/health")
    page.clock.run_for(10_000)

    expect(page.locator(BANNER)).to_have_count(0)


def test_live_counts_what_the_recorder_saved_and_lost(
    open_desk: OpenDesk, server: SpindleServer, standing: str, axe: str
) -> None:
    desk = open_desk(width=390, height=844, language="zh-CN", theme="dark")
    answered(desk, degraded(server, rows_lost=7))

    page = desk.open("/live")

    expect(page.get_by_test_id("recorder")).to_contain_text("已保存 1,200 行，丢失 7 行")
    expect(page.locator(BANNER)).to_contain_text("磁盘已满")
    assert sideways(page) == 0
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    desk.picture("degraded-phone-zh-dark")


def test_a_healthy_server_says_nothing(desk: Desk, standing: str) -> None:
    with desk.page.expect_response("**/api/v1/health"):
        page = desk.open("/live")

    expect(page.get_by_test_id("recorder")).to_contain_text("0 lost")
    expect(page.locator(BANNER)).to_have_count(0)
