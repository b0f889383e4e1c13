"""Goal: the Calibrate page says how the zero drifts and when to calibrate, in words, in a picture
and in numbers.

Method: rides of eight months with a planted drift and a calibration between, told by the server's
own code to a page that asks for them; nobody rides for eight months.
"""

from __future__ import annotations

import re
import time
from dataclasses import asdict
from typing import Any

import numpy as np
from playwright.sync_api import Route, expect

from backend.core.revision import Revision
from backend.core.ride_zero import RideZero, ZeroOfRide
from backend.rides.diagnosis.sensor_drift import SensorDriftService
from backend.visits.checks import drift
from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.fakes.server import SpindleServer

DAY_US = 86_400_000_000
RIDES = 30


class Rides:
    """The zeros of one unit, as a store has them."""

    def __init__(self, now_us: int) -> None:
        self.now_us = now_us
        random = np.random.default_rng(1)
        self.zeros = self
        self.rides = []
        for number, back in enumerate(np.linspace(1.0, 240.0, RIDES)):
            degc = round(random.normal(12.0, 7.0))
            since = 240.0 - back if back > 100.0 else 100.0 - back
            zero_nm = 0.006 * since + 0.02 * (degc - 12) + random.normal(0.0, 0.05)
            zero = RideZero(zero_nm, 0.03, 100.0 * zero_nm, degc, 6)
            self.rides.append(ZeroOfRide(RIDES - number, now_us - round(back * DAY_US), zero))
        nothing = RideZero(reason="no_coasting")
        self.rides.insert(0, ZeroOfRide(RIDES + 1, now_us - DAY_US // 2, nothing))

    def of_unit(self, key: str, limit: int) -> list[ZeroOfRide]:
        return self.rides

    def history(self, device_id: str) -> list[Revision]:
        def given(seq: int, days_ago: float, offset: float) -> Revision:
            at_us = self.now_us - round(days_ago * DAY_US)
            scale = {"sensor_offset_counts": offset}
            return Revision(seq, at_us, "Ada", "service", "verified", seq, seq, (), scale, "ebl:1")

        return [given(2, 100.0, 84.0), given(1, 300.0, 0.0)]


def told() -> dict[str, Any]:
    rides = Rides(time.time_ns() // 1000)
    store: Any = rides
    watch = SensorDriftService(store, lambda device_id: "ebl:1", rides.history)
    answer = watch("dev1")
    for one in answer["calibrations"]:
        one["created_at"] = one["created_at"].isoformat()
    return answer


def test_the_drift_is_told_in_words_a_picture_and_numbers(
    desk: Desk, server: SpindleServer, standing: str, axe: str
) -> None:
    answer = told()
    desk.page.route("**/sensor-drift*", lambda route: route.fulfill(json=answer))
    page = desk.open("/sensor")
    panel = page.get_by_test_id("sensor-drift")

    forecast = panel.locator("[data-forecast=expected]")
    year = answer["trend"]["crossings"]["act"]["at"][:4]
    expect(forecast).to_contain_text(re.compile(rf"reaches 3.Nm about .*{year}"))
    expect(panel.locator("circle")).to_have_count(RIDES)
    expect(panel.locator("line.calibration")).to_have_count(1)
    panel.locator("summary").click()
    expect(panel.locator("tbody tr")).to_have_count(RIDES + 1)
    expect(panel.locator("tbody tr").first).to_contain_text("no five seconds of coasting")
    expect(panel.locator("li")).to_contain_text("Calibrated as configuration 2")
    assert sideways(page) == 0
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    desk.picture("sensor-drift", full=True)


def test_the_bike_s_lamp_and_the_sheet_s_check_tell_the_zero(
    desk: Desk, server: SpindleServer, standing: str, axe: str
) -> None:
    answer = told()
    answer |= {"level": "watch", "latest": answer["rides"][1] | {"zero_nm": 1.42}}
    desk.page.route("**/sensor-drift*", lambda route: route.fulfill(json=answer))
    page = desk.open("/")

    lamp = page.locator("[data-lamp=torque]")
    expect(lamp).to_contain_text(re.compile(r"1\.42.Nm"))
    expect(lamp).to_contain_text("watch it")
    expect(lamp).to_have_class(re.compile("warn"))
    assert sideways(page) == 0
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    desk.picture("bike-zero-moved", full=True)

    def checked(route: Route) -> None:
        body = route.fetch().json()
        body["checks"][1] = asdict(drift(answer))
        route.fulfill(json=body)

    desk.page.route("**/checks", checked)
    desk.open("/service")
    row = page.get_by_test_id("checks").get_by_role("row", name="while coasting")
    expect(row).to_contain_text(re.compile(rf"1\.42.Nm, .*; of {RIDES} rides"))
    expect(row).to_contain_text("passed")
    desk.picture("service-zero-moved", full=True)


def test_a_unit_that_never_coasted_says_what_to_do(desk: Desk, standing: str) -> None:
    page = desk.open("/sensor")

    panel = page.get_by_test_id("sensor-drift")
    expect(panel.locator("[data-level=none]")).to_contain_text("Coast for some seconds")
    expect(panel.locator("svg")).to_have_count(0)
