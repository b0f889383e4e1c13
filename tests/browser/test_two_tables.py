"""Goal: a mechanic sees which of the unit's two tables is which, edits either, and loses neither.

What is written is read back over the API. The market's findings are those of Japan's law: 24 km/h,
under a setting of 25.
"""

from __future__ import annotations

import json
import re
from typing import Any

from playwright.sync_api import Page, Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.test_tune_page import BAR, CELL, open_tune, reading
from tests.fakes.server import SpindleServer, eventually


def in_japan(page: Page) -> None:
    """What the unit would say if its maker had set it to Japan."""

    def answer(route: Route, change: dict[str, Any], within: str | None) -> None:
        if route.request.method != "GET":
            return route.continue_()
        response = route.fetch()
        body = response.json()
        (body[within] if within else body).update(change)
        return route.fulfill(response=response, body=json.dumps(body))

    ends = {"market": "japan", "effective_assist_cutoff_kmh": 24.0}
    page.route("**/limits", lambda route: answer(route, ends, None))
    page.route("**/config", lambda route: answer(route, {"market": "japan"}, "parameters"))


def test_each_table_is_edited_for_itself_and_both_are_written_together(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    modes = {"parameters": {"mode_tables": [0, 0, 0, 0, 1]}, "reason": "boost by the second"}
    server.ask("PATCH", f"/devices/{standing}/config", json=modes)
    page = open_tune(desk)
    first = page.get_by_role("tab", name="First table")
    second = page.get_by_role("tab", name="Second table")
    corner = page.locator(f"{CELL} .label")
    expect(first).to_contain_text("Used by sport")
    expect(second).to_contain_text("Used by boost")

    page.focus(CELL)
    page.keyboard.press("1")
    first.focus()
    page.keyboard.press("ArrowRight")
    expect(second).to_be_focused()
    expect(second).to_have_attribute("aria-selected", "true")
    expect(page.get_by_role("tabpanel")).to_have_accessible_name(re.compile("^Second table"))
    expect(corner).to_have_text("ZO")
    page.focus(CELL)
    page.keyboard.press("Control+a")
    page.keyboard.press("5")

    # The weighted average of one label everywhere is that label's peak.
    eventually(lambda: reading(page, 0.02, 0.02), lambda z: z == 0.5)
    expect(page.locator("[data-testid=lint] [data-code=equal_neighbours]").first).to_be_visible()
    first.click()
    expect(corner).to_have_text("NB")
    expect(page.locator("[data-testid=lint] [data-code=label_step]").first).to_be_visible()
    expect(page.locator("[data-testid=lint] [data-code=equal_neighbours]")).to_have_count(0)
    expect(page.locator(BAR)).to_contain_text("23 changed")
    page.click("text=Review and write")
    dialog = page.locator("dialog")
    expect(dialog).to_contain_text("Second table: rule at 15 km/h, torque rate 0.45")
    desk.picture("tune-two-tables-review")
    page.click("dialog >> text=Write to the unit")

    expect(page.locator("[role=status]", has_text="verified")).to_be_visible()
    config = server.get(f"/devices/{standing}/config")["parameters"]
    assert config["second_rules"] == [["PB"] * 5] * 5
    assert config["fuzzy_rules"][0] == ["NB", "ZO", "PS", "PB", "PB"]


def test_undo_shows_the_table_it_changes(desk: Desk, standing: str) -> None:
    page = open_tune(desk, "/tune?table=second")
    second = page.get_by_role("tab", name="Second table")
    expect(second).to_have_attribute("aria-selected", "true")
    page.focus(CELL)
    page.keyboard.press("1")
    expect(second).to_contain_text("changed, not yet in the unit")
    page.get_by_role("tab", name="First table").click()
    expect(page.locator(f"{CELL} .label")).to_have_text("ZO")

    page.keyboard.press("Control+z")

    expect(second).to_have_attribute("aria-selected", "true")
    expect(page.locator(f"{CELL} .label")).to_have_text("ZO")
    expect(page.locator(BAR)).to_contain_text("Same as in the unit")


def test_a_slower_market_is_told_beside_the_setting_and_in_the_checks(
    open_desk: OpenDesk, standing: str
) -> None:
    desk = open_desk(width=390, height=844, theme="dark", language="zh-CN")
    in_japan(desk.page)
    page = open_tune(desk)

    lint = page.get_by_test_id("lint")
    for code in ("cutoff_above_market", "ratio_above_market", "peak_above_market"):
        expect(lint.locator(f"[data-code={code}]").first).to_contain_text("日本")
    expect(lint.locator("[data-code=cutoff_above_market]")).to_contain_text("24 km/h")
    page.get_by_role("link", name="模式").click()
    expect(page.get_by_test_id("assist-ends")).to_contain_text("24 km/h")
    desk.picture("tune-two-tables-phone", full=True)
    assert sideways(page) == 0
    page.unroute_all(behavior="ignoreErrors")
