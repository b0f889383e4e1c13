"""Goal: a ride's page tells energy, effort and the bike's health, and its rider's threshold makes
zones of bands.

Method: the two-hour ride with a spike and a hole, and a file of a head unit, in Chromium.
"""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.browser.test_rides_page import long_ride
from tests.fakes.server import SpindleServer


def test_a_ride_tells_its_energy_effort_and_health(
    desk: Desk, server: SpindleServer, axe: str
) -> None:
    ride = long_ride(server)
    told = server.get(f"/rides/{ride}/energy")["total"]
    page = desk.open(f"/rides/{ride}")

    energy = page.get_by_test_id("energy")
    expect(energy).to_contain_text(f"{told['motor_per_rider']:.2f} Wh for each Wh of yours")
    health = page.get_by_test_id("health")
    expect(health).to_contain_text("Rows were lost while the bike moved: 1 ×, 300 s")
    health.get_by_role("button").first.click()
    page.wait_for_url("**from_s=2120**")
    effort = page.get_by_test_id("effort")
    expect(effort).to_contain_text("your threshold power is not set")
    desk.picture("ride-insight", full=True)
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []

    page.goto(f"{server.url}/settings")
    page.get_by_label("Threshold power").fill("160")
    page.get_by_label("Threshold power").blur()
    page.goto(f"{server.url}/rides/{ride}")
    expect(page.get_by_test_id("effort")).to_contain_text("threshold 160 W")
    page.get_by_test_id("ride-bar").get_by_role("button", name="Export…").click()
    link = page.get_by_role("link", name="Report (HTML)")
    assert "threshold_power_w=160" in (link.get_attribute("href") or "")
    with page.expect_download() as saved:
        link.click()
    assert saved.value.suggested_filename == f"spindle-ride-{ride}.html"
    page.set_viewport_size({"width": 390, "height": 844})
    assert not sideways(page)
