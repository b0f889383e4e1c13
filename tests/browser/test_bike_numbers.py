"""Goal: on the Sensor page the wheel is measured, what it does to the legal cut-off is told, and it
is written like every other value; a climb says whether it agrees with the calibration.

Method: a real unit and a tape that is typed in; the climb's answer is worked out here by the
server's own code, because nobody rides one for a browser.
"""

from __future__ import annotations

import dataclasses
import json
import re
from typing import Any

import pytest
from playwright.sync_api import Page, Route, expect

from backend.calibration.bike.balance import Climb, balance
from backend.calibration.bike.coast_down import ClimbInputs, resistance
from tests.browser.desk import TWO_FRAMES, Desk, sideways
from tests.browser.judged import JUDGE
from tests.fakes.server import SpindleServer

KEPT = "wheel_circumference_m"
KNOWN = ClimbInputs(mass_kg=100.0, mass_limit_kg=0.5, gravity_ms2=9.807, rise_limit_m=0.5)


def climbed(told_share: float) -> dict[str, Any]:
    """200 s at 3.5 m/s up 35 m, by a sensor that tells this share of the legs' torque."""
    road = resistance([], KNOWN)
    speed_ms, seconds = 3.5, 200
    needed_w = (100 * 9.807 * 35 / seconds) + road.rolling_n * speed_ms
    needed_w += road.air_ns2_m2 * speed_ms**3
    torque_nm = needed_w / 0.97 / (70 * 2 * 3.141592653589793 / 60)
    flat = [1.0] * (seconds + 1)
    ride = Climb(
        [float(second) for second in range(seconds + 1)],
        [speed_ms * one for one in flat],
        [told_share * torque_nm * one for one in flat],
        [70.0 * one for one in flat],
        35.0,
    )
    found = balance(ride, road, KNOWN, 0.0)
    calibrated = {"source": "unknown", "expanded_share": 0.0, "certificate": None}
    told = {"unit_key": None, "rise_m": 35.0, "duration_s": 200.0, "calibrated": calibrated}
    return {
        **told,
        "resistance": dataclasses.asdict(road),
        "balance": dataclasses.asdict(found),
    }


def typed(page: Page, label: str, value: str) -> None:
    page.get_by_test_id("bike-numbers").get_by_label(label, exact=True).fill(value)


def test_a_rolled_wheel_is_told_beside_the_unit_s_and_written(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    stored_m = server.get(f"/devices/{standing}/config")["parameters"][KEPT]
    page = desk.open("/sensor")
    panel = page.get_by_test_id("bike-numbers")

    typed(page, "Turns a roll", "1")
    for number, error_m in ((1, -0.001), (2, 0.001)):
        typed(page, f"Roll {number}", f"{1.02 * stored_m + error_m:.4f}")
    panel.get_by_role("button", name="Measure").click()

    found = page.get_by_test_id("wheel-result")
    expect(found.locator("[data-agrees=false]")).to_contain_text(
        re.compile(r"shows 25\.0.km/h .* the bike goes 25\.5\d.km/h")
    )
    found.get_by_role("button", name="Propose").click()
    page.click("text=Review and write")
    expect(page.locator("dialog")).to_contain_text("Wheel circumference")
    page.click("dialog >> text=Write to the unit")
    expect(page.locator("[role=status]", has_text="verified")).to_be_visible()
    written = server.get(f"/devices/{standing}/config")["parameters"][KEPT]
    assert written == pytest.approx(1.02 * stored_m, abs=1e-4)
    server.ask("PATCH", f"/devices/{standing}/config", json={"parameters": {KEPT: stored_m}})


def test_a_climb_says_whether_it_agrees_and_where_its_energy_went(
    desk: Desk, standing: str, axe: str
) -> None:
    asked: list[dict[str, Any]] = []

    def answer(route: Route) -> None:
        asked.append(json.loads(route.request.post_data or "{}"))
        route.fulfill(json=climbed(1.0 if len(asked) == 1 else 0.7))

    desk.page.route("**/calibration/climb", answer)
    # The question is asked before the rides are there.
    late: list[Route] = []
    desk.page.route("**/api/v1/rides?*", lambda route: late.append(route))
    page = desk.open("/sensor")
    panel = page.get_by_test_id("bike-numbers")
    panel.get_by_role("button", name="Climb", exact=True).click()
    page.evaluate(TWO_FRAMES)
    page.unroute("**/api/v1/rides?*")
    for route in late:
        route.continue_()
    panel.get_by_role("button", name="This part is the climb").click()
    expect(panel).to_contain_text("No coast-down")
    expect(panel.get_by_role("button", name="Compare")).to_be_disabled()
    typed(page, "By a map or a survey", "35")
    panel.get_by_role("button", name="Compare").click()

    told = page.get_by_test_id("balance")
    expect(told.locator("[data-agrees=true]")).to_contain_text("agrees with the calibration")
    assert asked[0]["climb"]["rise_m"] == 35
    assert asked[0]["coast_downs"] == []
    legs = told.locator(".legs").locator("xpath=../following-sibling::*[1]")
    expect(legs).to_contain_text("Wh")
    # What nobody measured is a dash.
    motor = told.locator(".motor").locator("xpath=../following-sibling::*[1]")
    expect(motor).to_have_text("—")
    panel.get_by_role("button", name="Compare").click()
    expect(told.locator("[data-agrees=false]")).to_contain_text("does not agree")
    assert sideways(page) == 0
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    desk.picture("bike-climb", full=True)
