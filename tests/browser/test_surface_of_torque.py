"""Goal: the surface tells what a table comes to at the crank, as motor, battery and market leave
it: as a map, as slices and on a phone.

Expected: 250 W is what the European rating allows for long (EN 15194, scope), whatever is asked.
"""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import sideways
from tests.browser.judged import JUDGE
from tests.browser.test_tune_page import open_tune, reading
from tests.fakes.server import eventually


@pytest.mark.parametrize(("width", "theme"), [(1440, "dark"), (390, "light")])
def test_what_arrives_ends_at_the_rating_and_what_was_taken_is_hatched_and_named(
    open_desk: OpenDesk, standing: str, axe: str, width: int, theme: str
) -> None:
    desk = open_desk(width=width, height=900, theme=theme, touch=width < 760)
    page = open_tune(desk)
    surface = page.get_by_role("region", name="Gain surface")
    shown = surface.get_by_role("combobox", name="Show")

    shown.select_option("Requested, power")
    surface.get_by_role("textbox", name="Your push").fill("60")
    page.keyboard.press("Tab")
    eventually(lambda: reading(page, 0.95, 0.05), lambda watts: watts > 500)
    expect(page.get_by_test_id("taken")).to_have_count(0)
    shown.select_option("Arrives, power")

    most = pytest.approx(250.0, rel=0.01)
    eventually(lambda: reading(page, 0.95, 0.05), lambda watts: watts == most)
    expect(page.get_by_test_id("reading")).to_contain_text("market limit")
    expect(page.get_by_test_id("taken").first).to_be_attached()
    expect(page.get_by_test_id("surface-summary")).to_contain_text("taken by market limit")
    page.locator("[data-cell='2,2']").click()
    surface.get_by_role("button", name="Slices").click()
    slice_at = surface.get_by_role("img", name="Arrives, power (W) at 15 km/h")
    expect(slice_at).to_have_accessible_name("Arrives, power (W) at 15 km/h 250 W to 250 W. "
                                             "Dashed: requested, up to 525 W; hatched: taken by a "
                                             "limit.")  # fmt: skip
    assert sideways(page) == 0
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    desk.picture(f"tune-slices-{width}-{theme}", full=width < 760)
