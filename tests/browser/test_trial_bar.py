"""Goal: a mechanic tries a change, and keeps it or gets back what the unit had, on every page.

The clock that matters is the unit's: what the unit has is read from the API, not from the page.
"""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.browser.test_tune_page import CELL, open_tune, review
from tests.fakes.server import SpindleServer

BAR = "[data-testid=trial-bar]"
OVER = "[data-testid=trial-over]"
LONG_S = 250
SHORT_S = 10


def first_rule(server: SpindleServer, device: str) -> str:
    """The label of the first rule that is active in the unit."""
    rules = server.get(f"/devices/{device}/config")["parameters"]["fuzzy_rules"]
    return str(rules[0][0])


def try_first_rule(page: Page, seconds: int, reason: str = "softer start") -> None:
    """Sets the first rule to NB and writes it on trial."""
    page.focus(CELL)
    page.keyboard.press("1")
    review(page)
    page.click("dialog >> text=On trial")
    page.get_by_role("dialog").locator("span.number-field > input").fill(str(seconds))
    page.fill("dialog .reason input", reason)
    page.click(f"dialog >> text=Try for {seconds} s")
    expect(page.locator(BAR)).to_be_visible()
    # The unit tells of the trial before the page has read back what it wrote.
    expect(page.locator("dialog")).to_have_count(0)


def test_a_change_on_trial_is_shown_on_every_page_and_kept(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = open_tune(desk)
    try_first_rule(page, LONG_S)
    bar = page.locator(BAR)
    expect(bar).to_contain_text("Rules")
    expect(bar).to_contain_text("softer start")
    desk.picture("trial-bar")

    page.click("nav >> text=Rides")
    expect(bar).to_be_visible()
    page.reload()
    expect(bar).to_contain_text("Rules")
    expect(bar.locator("[role=timer]")).to_contain_text("goes back by itself in")
    assert server.get(f"/devices/{standing}/config")["parameters"]["fuzzy_rules"][0][0] == "NB"
    page.click(f"{BAR} >> text=Keep")

    expect(page.locator("[role=status]", has_text="Kept")).to_be_visible()
    expect(bar).to_have_count(0)
    assert server.get(f"/devices/{standing}")["config"]["state"] == "committed"
    assert first_rule(server, standing) == "NB"


def test_a_change_on_trial_is_reverted_and_the_table_follows(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = open_tune(desk)
    try_first_rule(page, LONG_S)
    expect(page.locator(f"{CELL} .label")).to_have_text("NB")

    page.click(f"{BAR} >> text=Revert")

    expect(page.locator(OVER)).to_contain_text("Reverted as requested")
    assert first_rule(server, standing) == "ZO"
    expect(page.locator(f"{CELL} .label")).to_have_text("ZO")
    expect(page.locator("[data-testid=draft-bar]")).to_contain_text("Same as in the unit")
    page.click(f"{OVER} >> text=Dismiss")
    expect(page.locator(OVER)).to_have_count(0)


def test_a_trial_nobody_keeps_runs_out_and_the_page_says_so(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    before = server.get(f"/devices/{standing}/config")
    page = open_tune(desk)
    try_first_rule(page, SHORT_S)

    server.simulate(standing, clock="virtual")
    server.advance(standing, SHORT_S)

    expect(page.locator(OVER)).to_contain_text("ran out")
    desk.picture("trial-over")
    after = server.get(f"/devices/{standing}/config")
    assert after["parameters"] == before["parameters"]
    expect(page.locator(f"{CELL} .label")).to_have_text("ZO")


def test_nothing_else_is_written_while_a_trial_runs(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = open_tune(desk)
    try_first_rule(page, LONG_S)
    page.focus("[data-cell='4,4']")
    page.keyboard.press("1")
    review(page)

    expect(page.locator("dialog")).to_contain_text("A change is on trial in this unit")
    expect(page.locator("dialog >> text=Write to the unit")).to_be_disabled()


@pytest.mark.parametrize("language", ["en-GB", "zh-CN"])
def test_the_bar_fits_a_phone_and_a_screen_reader(
    open_desk: OpenDesk, server: SpindleServer, standing: str, axe: str, language: str
) -> None:
    parameters = {"torque_filter_s": 0.3}
    body = {"parameters": parameters, "reason": "湿滑坡道", "confirm_s": LONG_S}
    server.ask("PATCH", f"/devices/{standing}/config", json=body)
    desk = open_desk(width=360, height=740, language=language)
    page = desk.open("/service")

    expect(page.locator(BAR)).to_contain_text("湿滑坡道")
    desk.picture(f"trial-phone-{language}")
    assert sideways(page) == 0
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
