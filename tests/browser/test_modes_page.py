"""Goal: what differs between the modes is seen at once and edited from the keyboard, and what the
motor would do for a steady push is the answer of the unit's own law.

Method: the matrix on the real server. The torque expected of the fixed law is its ratio times the
push; that none is given above the cut-off is EN 15194.
"""

from __future__ import annotations

import re

from playwright.sync_api import Locator, Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.fakes.server import SpindleServer

BAR = "[data-testid=draft-bar]"
MATRIX = "[data-testid=modes]"


def setting(page: Page, name: str, mode: str) -> Locator:
    return page.locator(MATRIX).get_by_label(f"{name}, mode {mode}", exact=True)


def test_a_mode_s_torque_is_its_ratio_times_the_push_and_follows_an_edit(
    desk: Desk, standing: str
) -> None:
    page = desk.open("/tune/modes")
    curves = page.locator(MATRIX).get_by_role("img")
    expect(curves).to_have_count(5)
    expect(curves.nth(1)).to_have_accessible_name("Mode 1 eco: 15 Nm at 15 km/h, at most 15 Nm")
    expect(curves.nth(0)).to_have_accessible_name("Mode 0 off: 0 Nm at 15 km/h, at most 0 Nm")

    setting(page, "Assist ratio", "1 eco").fill("0.8")

    expect(curves.nth(1)).to_have_accessible_name("Mode 1 eco: 24 Nm at 15 km/h, at most 24 Nm")
    expect(page.locator(BAR)).to_contain_text("1 changed")
    # A mode shows what its law has, in words.
    expect(setting(page, "Taper", "1 eco").locator("option:checked")).to_have_text("15 to 24 km/h")
    expect(setting(page, "Taper", "3 sport")).to_have_count(0)
    assert not re.search(r"[a-z]+_[a-z]+", page.inner_text(MATRIX))
    # 2 Nm at the shaft are 80.7 Nm at the crank, by 40.34 motor turns: 27 Nm of the rider times 3.
    setting(page, "Assist ratio", "1 eco").fill("3")
    checks = page.get_by_role("region", name="Checks of modes and limits")
    expect(checks.locator("li", has_text="mode 1")).to_contain_text("above 27 Nm")


def test_a_setting_is_edited_copied_to_the_right_and_undone_from_the_keyboard(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = desk.open("/tune/modes")
    share = [setting(page, "Torque share", mode) for mode in ("1 eco", "2 tour", "3 sport")]
    page.locator(f"{MATRIX} [data-cell='0,1']").focus()
    for _ in range(20):
        page.keyboard.press("ArrowDown")

    page.keyboard.press("Enter")
    page.keyboard.type("70")
    page.keyboard.press("Escape")
    expect(share[0]).to_have_value("100")
    page.keyboard.press("Enter")
    page.keyboard.type("60")
    page.keyboard.press("Enter")
    page.keyboard.press("Control+d")
    page.keyboard.press("Control+d")

    for one in share:
        expect(one).to_have_value("60")
    expect(page.locator(BAR)).to_contain_text("3 changed")
    page.keyboard.press("Control+z")
    expect(share[2]).to_have_value("100")
    page.get_by_role("button", name="Review and write").click()
    page.click("dialog >> text=Write to the unit")
    expect(page.locator("[role=status]", has_text="verified")).to_be_visible()
    written = server.get(f"/devices/{standing}/config")["parameters"]
    assert written["mode_torque_pct"] == [100, 60, 60, 100, 100]


def test_the_mode_that_is_ridden_is_marked_and_a_phone_shows_one_mode(
    open_desk: OpenDesk, riding: str
) -> None:
    desk = open_desk(width=390, height=844, touch=True)
    page = desk.open("/tune/modes")
    expect(page.locator(MATRIX)).to_contain_text("ridden now")
    expect(setting(page, "Assist ratio", "3 sport")).to_be_visible()
    expect(setting(page, "Assist ratio", "1 eco")).to_be_hidden()

    page.get_by_role("group", name="Which mode is shown").get_by_role("button", name="eco").tap()

    expect(setting(page, "Assist ratio", "1 eco")).to_be_visible()
    expect(setting(page, "Assist ratio", "3 sport")).to_be_hidden()
    desk.picture("modes-phone", full=True)
