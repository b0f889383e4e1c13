"""Goal: two rides are ticked, laid side by side over the way, read by keys and in numbers, and a
link holds all of it.

Method: one road on paper, ridden at 18 and at 27 km/h, so that every difference is known.
"""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.desk import Desk
from tests.browser.test_rides_page import TRACES
from tests.fakes.fit_file import START_S, Record, fit_file
from tests.fakes.server import SpindleServer

ROAD_M = 3000.0
SPEEDS_KMH = {"slow road": 18.0, "quick road": 27.0}
DEG_PER_M = 1.0 / 111_195.0


def road(speed_kmh: float, start_s: int) -> bytes:
    """Straight north from the equator, a row a second."""
    speed_ms = speed_kmh / 3.6
    rows: list[Record] = [
        {
            "timestamp": start_s + second,
            "position_lat": second * speed_ms * DEG_PER_M,
            "position_long": 11.0,
            "distance": second * speed_ms,
            "speed": speed_ms,
            "power": 100,
        }
        for second in range(round(ROAD_M / speed_ms) + 1)
    ]
    return fit_file(rows)


@pytest.fixture(scope="module")
def rides(server: SpindleServer) -> dict[str, int]:
    found = {}
    for number, (name, speed_kmh) in enumerate(SPEEDS_KMH.items()):
        content = road(speed_kmh, START_S + 5_000_000 + 100_000 * number)
        told = server.ask(
            "POST",
            "/rides/import",
            params={"name": f"{name}.fit"},
            content=content,
            headers={"content-type": "application/octet-stream"},
        )
        found[name] = told["ride_ids"][0]
    return found


def figure(page: Page, name: str) -> list[str]:
    cells = page.locator(f"[data-figure={name}] td")
    return [text.strip() for text in cells.all_inner_texts()]


def test_two_ticked_rides_are_compared_over_their_way(desk: Desk, rides: dict[str, int]) -> None:
    page = desk.open("/rides")
    page.fill("input[type=search]", "road")
    for name in SPEEDS_KMH:
        page.get_by_role("checkbox", name=f"Choose {name}").check()
    page.get_by_test_id("many-rides").get_by_role("link", name="Compare").click()
    page.wait_for_selector(f"{TRACES}[data-draws]")

    assert figure(page, "speed_kmh_mean") == ["18.0", "27.0", "+9.0"]
    assert figure(page, "distance_km") == ["3.00", "3.00", "0.00"]
    assert figure(page, "duration_s") == ["10:00", "6:40", "−3:20"]
    assert figure(page, "motor_wh")[0].startswith("—")
    expect(page.get_by_test_id("route-overlap")).to_contain_text("100 % of A")

    page.get_by_role("button", name="Distance", exact=True).first.click()
    expect(page).to_have_url(re.compile("by=distance"))
    page.wait_for_selector(f"{TRACES}[data-draws]")
    page.locator(TRACES).click(position={"x": 300, "y": 60})
    expect(page.get_by_test_id("compare-cursor")).to_contain_text("A 18.0 · B 27.0 km/h; +9.0")
    expect(page).to_have_url(re.compile(r"x=\d"))
    pressed = page.url
    page.keyboard.press("ArrowRight")
    # The address follows a moving hand at its own pace.
    expect(page).not_to_have_url(pressed)
    before = page.get_by_test_id("compare-cursor").inner_text()

    page.reload()
    page.wait_for_selector(f"{TRACES}[data-draws]")
    expect(page.get_by_test_id("compare-cursor")).to_have_text(before)
    page.get_by_role("button", name="Data table").click()
    row = page.get_by_test_id("bin-table").locator("tbody tr").nth(5)
    expect(row).to_contain_text("18.0")
    expect(row).to_contain_text("9.0")


def test_two_windows_of_a_ride_are_typed_and_what_is_not_told_says_so(
    desk: Desk, rides: dict[str, int]
) -> None:
    one = rides["slow road"]
    page = desk.open(f"/rides/{one}")
    page.wait_for_selector(f"{TRACES}[data-draws]")
    page.get_by_role("link", name="Compare with…").click()
    page.get_by_label("Ride B").last.select_option(str(one))
    begin = page.get_by_label("B begins at")
    begin.fill("8:20")
    begin.press("Enter")

    expect(page.locator("[data-figure=duration_s] td").nth(1)).to_have_text("1:40")
    expect(page).to_have_url(re.compile("b_from_s=500"))
    expect(page.get_by_test_id("compared-settings")).to_contain_text("came from a file")
    page.get_by_role("button", name="Crank angle").click()
    expect(page.get_by_text("B has no angle of the crank.")).to_be_visible()
