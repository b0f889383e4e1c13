"""Goal: what a unit cannot do is not offered, and a page about it says so in one sentence.

The list of units is answered in its place, with a unit that lacks something; all else is the real
server, which would answer for what the page must not ask.
"""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import Page, Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.fakes.server import SpindleServer


def lacking(desk: Desk, server: SpindleServer, *missing: str) -> list[str]:
    """The unit lists everything but this from now on; what the page asks of it comes back."""
    asked: list[str] = []

    def answer(route: Route) -> None:
        found: dict[str, Any] = server.get("/devices")
        for unit in found["items"]:
            unit["capabilities"] = [name for name in unit["capabilities"] if name not in missing]
        route.fulfill(json=found)

    desk.page.route("**/api/v1/devices", answer)
    desk.page.on("request", lambda request: asked.append(request.url))
    desk.page.on("websocket", lambda socket: asked.append(socket.url))
    return asked


def pages_offered(page: Page) -> list[str]:
    """The names in the navigation."""
    return page.locator("nav ul a span:not(.hidden)").all_inner_texts()


def test_a_unit_without_live_values_has_no_page_of_them(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    asked = lacking(desk, server, "stream", "unit_trial", "logs")

    page = desk.open("/live")

    expect(page.get_by_test_id("not-offered")).to_contain_text("sends no live values")
    assert pages_offered(page) == ["Bike", "Tune", "Service", "Rides", "Fleet", "Settings"]
    assert not [url for url in asked if url.endswith("/snapshot") or "/live?" in url]


def test_a_unit_without_logs_is_not_asked_for_them(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    asked = lacking(desk, server, "stream", "unit_trial", "logs")

    page = desk.open("/rides")

    expect(page.get_by_test_id("no-logs")).to_have_text("No rides can be fetched from this unit.")
    expect(page.get_by_test_id("unit-logs")).to_have_count(0)
    assert not [url for url in asked if url.endswith("/logs")]


def test_a_unit_without_trials_is_written_for_good_only(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    lacking(desk, server, "stream", "unit_trial", "logs")
    page = desk.open("/tune/modes")
    page.get_by_label("Cut-off speed", exact=True).fill("24")

    page.get_by_role("button", name="Review").click()

    expect(page.get_by_test_id("no-trial")).to_contain_text("nothing on trial")
    expect(page.get_by_role("radio")).to_have_count(1)


def test_a_unit_without_tables_shows_all_its_settings(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    lacking(desk, server, "fuzzy_table", "stream")

    page = desk.open("/tune")

    expect(page.get_by_test_id("no-table")).to_be_visible()
    for name in ("fuzzy_falling_torque", "sensor_offset_counts", "assist_cutoff_kmh"):
        expect(page.locator(f"[data-parameter={name}]")).to_be_visible()


def test_settings_that_only_can_be_read_cannot_be_edited(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    lacking(desk, server, "fuzzy_table", "write_config")

    page = desk.open("/tune")

    expect(page.get_by_label("Cut-off speed", exact=True)).to_be_disabled()
    expect(page.get_by_test_id("draft-bar")).to_have_count(0)
    expect(page.get_by_role("main")).to_contain_text("read here, not changed")


@pytest.mark.parametrize("path", ["/", "/live", "/tune", "/rides"])
def test_such_pages_are_for_everyone(
    open_desk: OpenDesk, server: SpindleServer, standing: str, axe: str, path: str
) -> None:
    desk = open_desk(width=390, height=844, language="zh-CN", theme="dark")
    lacking(desk, server, "stream", "unit_trial", "logs", "fuzzy_table")
    page = desk.open(path)
    desk.settle()

    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    for width in (390, 1440):
        page.set_viewport_size({"width": width, "height": 844})
        assert sideways(page) == 0
    page.emulate_media(color_scheme="light")
    assert page.evaluate(JUDGE) == []
    desk.picture(f"lacking{path.replace('/', '-')}", full=True)
