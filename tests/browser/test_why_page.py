"""Goal: Why follows a rider without moving under his eyes, and says where nothing can be told.

Method: the unit's own law explains a ride while it is recorded; a ride written into the store
without a configuration is one that nobody can explain. A moment of a recorded ride: test_try_page.
"""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.browser.judged import moved
from tests.browser.test_rides_page import long_ride
from tests.fakes.server import SpindleServer, eventually

SENTENCE = "[data-testid=why-sentence]"
# Enough for one at which the table is asked, and one at which it is not.
MOMENTS = 4


def test_an_answer_that_follows_the_rider_moves_nothing(open_desk: OpenDesk, riding: str) -> None:
    desk = open_desk(width=390, height=844, theme="dark", language="zh-CN", touch=True)
    page = desk.open("/tune/why?now")
    page.wait_for_selector("[data-testid=why-answer]")

    told = {page.inner_text(f"{SENTENCE} + p")}

    # His torque rises and falls, so that the table is asked at some moments and not at others.
    eventually(lambda: told.add(page.inner_text(f"{SENTENCE} + p")), lambda _: len(told) >= MOMENTS)
    assert moved(page) == []
    expect(page.locator("#why-gain")).to_be_visible()


def test_a_ride_whose_configuration_nobody_kept_is_not_explained(
    desk: Desk, server: SpindleServer
) -> None:
    page = desk.open(f"/tune/why?ride={long_ride(server)}")

    expect(page.locator(SENTENCE)).to_contain_text("was not stored")
    expect(page.get_by_test_id("why-answer")).to_have_count(0)
    page.get_by_role("link", name="Choose another ride").click()
    expect(page.get_by_test_id("ride-table")).to_be_visible()
