"""Goal: whoever edits for one bike sees at once that another one is on the cable, cannot write to
it what was meant for the first, and finds the edits when the first is back.

Method: two simulated units, factory-fresh, one after the other behind one address.
"""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import sideways
from tests.browser.test_trial_bar import BAR as TRIAL_BAR
from tests.browser.test_trial_bar import LONG_S, first_rule, try_first_rule
from tests.browser.test_tune_page import BAR, CELL, WRITE, open_tune, review
from tests.fakes.cable import A, B, Cable

pytestmark = pytest.mark.slow

REPLACED = "[data-testid=replaced]"
ON_THE_WAY = "status of 50[34]|WebSocket|ERR_CONNECTION"


def test_edits_for_a_are_not_written_to_b_and_wait_for_a(open_desk: OpenDesk, cable: Cable) -> None:
    a = cable.key[-6:]
    of_factory = first_rule(cable.server, cable.device)
    desk = open_desk(address=cable.server.url)
    desk.allow(ON_THE_WAY)
    page = open_tune(desk)
    page.focus(CELL)
    page.keyboard.press("1")
    review(page)
    expect(page.locator("dialog")).to_contain_text(f"writing to Simulated {a}")

    cable.plug(B)
    expect(page.locator(REPLACED)).to_contain_text(f"another bike: Simulated {cable.key[-6:]}")
    expect(page.locator(REPLACED)).to_contain_text(f"edited for Simulated {a} (1) is kept")
    expect(page.locator("dialog")).to_have_count(0)
    expect(page.locator(BAR)).to_contain_text("Same as in the unit")
    expect(page.locator(f"{CELL} .label")).to_have_text(of_factory)
    assert sideways(page) <= 0
    desk.picture("another-bike")

    cable.plug(A)
    expect(page.locator(REPLACED)).to_have_count(0)
    expect(page.locator(f"{CELL} .label")).to_have_text("NB")
    review(page)
    page.click(WRITE)
    undo = page.get_by_test_id("toasts").get_by_role("button", name="Undo")
    undo.focus()  # A message stays while somebody is at it.
    expect(page.locator("dialog")).to_have_count(0)
    assert first_rule(cable.server, cable.device) == "NB"

    cable.plug(B)
    expect(page.locator(REPLACED)).to_be_visible()
    undo.click()
    expect(page.get_by_text("Not undone")).to_contain_text("nothing was changed")
    assert first_rule(cable.server, cable.device) == of_factory
    page.context.close()


def test_the_trial_of_a_is_no_business_of_b(open_desk: OpenDesk, cable: Cable) -> None:
    desk = open_desk(address=cable.server.url)
    desk.allow(ON_THE_WAY)
    page = open_tune(desk)
    try_first_rule(page, LONG_S)

    cable.plug(B)

    expect(page.locator(REPLACED)).to_be_visible()
    expect(page.locator(TRIAL_BAR)).to_have_count(0)
    expect(page.get_by_test_id("trial-over")).to_have_count(0)
    page.context.close()
