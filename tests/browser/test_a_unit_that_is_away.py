"""Goal: what was known of a unit is there without it, with its time, read-only: while it is away,
after the page was loaded anew, and after the server started anew; and it all lives again with it.
What was on trial goes back by itself.

Method: a simulated unit behind a socket of its own, so that its cable can be pulled.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.test_trial_bar import BAR, OVER, SHORT_S, first_rule, try_first_rule
from tests.browser.test_tune_page import CELL
from tests.fakes.relay import Relay
from tests.fakes.server import ServerHere
from tests.fakes.simulated_unit import UnitOnPort

pytestmark = pytest.mark.slow

PILL = "[data-testid=device-pill]"
WORDS = ("--seed", "7", "--scenario", "none")
SEEN = re.compile(r"Last seen \d\d:\d\d")


def is_known_and_read_only(page: Page, address: str) -> None:
    """Every page tells what was known, when that was, and offers no write."""
    page.goto(f"{address}/tune")
    expect(page.locator(PILL)).to_contain_text(SEEN)
    expect(page.locator(PILL)).to_contain_text("read-only")
    expect(page.get_by_test_id("draft-bar")).to_contain_text(SEEN)
    rules = page.get_by_role("gridcell", name=re.compile(r"\bNB\b"))
    expect(rules.first).to_be_visible()
    rules.first.click()
    page.keyboard.press("5")
    page.get_by_role("button", name="Review and write").click()
    dialog = page.get_by_role("dialog")
    expect(dialog).to_contain_text("not connected")
    expect(dialog.locator("button.primary")).to_be_disabled()
    page.goto(f"{address}/tune/modes")
    share = page.get_by_role("textbox", name="Torque share, mode 4 boost")
    expect(share).to_have_value("100")
    page.goto(f"{address}/")
    expect(page.get_by_test_id("headline")).to_contain_text("was last seen at")
    expect(page.locator("main")).to_contain_text("thesis 4-2")
    page.goto(f"{address}/live")
    expect(page.locator("[data-channel=speed_kmh]")).to_contain_text("— no data")
    page.goto(f"{address}/service")
    expect(page.locator("main")).to_contain_text("found when the unit was connected")


def test_what_was_known_is_there_without_the_unit(open_desk: OpenDesk, tmp_path: Path) -> None:
    unit = UnitOnPort(*WORDS)
    server = ServerHere(tmp_path, [unit.url]).start()
    server.ready_device()
    desk = open_desk(address=server.url)
    desk.allow("status of 50[34]|WebSocket|ERR_CONNECTION")
    page = desk.open("/tune")
    expect(page.get_by_test_id("draft-bar")).to_contain_text("Same as in the unit")

    unit.unplug()
    expect(page.locator(PILL)).to_contain_text(SEEN)
    page.reload()
    expect(page.get_by_test_id("draft-bar")).to_contain_text(SEEN)
    server.stop()
    server = ServerHere(tmp_path, [unit.url]).start()
    is_known_and_read_only(page, server.url)

    page.goto(f"{server.url}/tune")
    expect(page.get_by_test_id("draft-bar")).to_contain_text(SEEN)
    unit = UnitOnPort(*WORDS, port=unit.port)
    expect(page.locator(PILL)).to_contain_text("Connected")
    # What was edited without the unit waited for it.
    expect(page.get_by_test_id("draft-bar")).to_contain_text("1 changed, not yet in the unit")
    expect(page.get_by_role("button", name="Review and write")).to_be_enabled()
    page.context.close()
    server.stop()
    unit.unplug()


def test_a_trial_goes_back_by_itself_while_the_link_is_cut(
    open_desk: OpenDesk, tmp_path: Path
) -> None:
    unit = UnitOnPort(*WORDS)
    cable = Relay(unit.port)
    server = ServerHere(tmp_path, [f"socket://127.0.0.1:{cable.port}"]).start()
    device = server.ready_device()
    before = first_rule(server, device)
    desk = open_desk(address=server.url)
    desk.allow("status of 50[34]|WebSocket|ERR_CONNECTION")
    page = desk.open("/tune")
    expect(page.get_by_test_id("draft-bar")).to_contain_text("Same as in the unit")
    try_first_rule(page, SHORT_S)
    assert first_rule(server, device) == "NB" != before

    cable.cut()

    expect(page.locator(PILL)).to_contain_text(SEEN)
    expect(page.locator(BAR).get_by_role("button", name="Keep")).to_be_disabled()
    expect(page.locator(BAR)).to_contain_text("goes back")
    # By the unit's own clock, which nobody hears.
    unit.let_pass(SHORT_S)
    cable.mend()
    expect(page.locator(PILL)).to_contain_text("Connected")
    expect(page.locator(OVER)).to_contain_text("ran out")
    expect(page.locator(f"{CELL} .label")).to_have_text(before)
    assert first_rule(server, device) == before
    page.context.close()
    server.stop()
    cable.cut()
    unit.unplug()
