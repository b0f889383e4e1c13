"""Goal: raw counts and torque side by side, and a zero that is proposed, reviewed and written."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.browser.desk import Desk
from tests.fakes.server import SpindleServer, eventually

RAW = "[data-channel=rider_torque_raw] strong"
TORQUE = "[data-channel=rider_torque_nm] strong"


def test_a_zero_is_proposed_from_the_reading_and_written(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    # The sensor at rest reads nothing within its noise, so a wrong zero is what can be mended.
    body = {"parameters": {"sensor_offset_counts": -400.0}}
    server.ask("PATCH", f"/devices/{standing}/config", json=body)
    page = desk.open("/sensor")
    # Quoted: "not steady yet" has the word in it as well.
    page.wait_for_selector('text="steady"')

    page.click("text=Zero from current reading")
    offset = page.locator("input[aria-label='Sensor offset']")
    expect(offset).not_to_have_value("-400")
    proposed = float(offset.input_value())
    page.click("text=Review and write")
    expect(page.locator("dialog")).to_contain_text("Sensor offset")
    expect(page.locator("dialog")).to_contain_text("-30000 … 30000 counts")
    page.click("dialog >> text=Write to the unit")

    expect(page.locator("[role=status]", has_text="verified")).to_be_visible()
    written = server.get(f"/devices/{standing}/config")["parameters"]["sensor_offset_counts"]
    assert written == pytest.approx(proposed, abs=0.05)
    desk.picture("sensor")


def test_torque_is_the_reading_times_the_gain_that_was_written(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    body = {"parameters": {"sensor_offset_counts": -500.0, "sensor_gain_nm_per_count": 0.011}}
    server.ask("PATCH", f"/devices/{standing}/config", json=body)

    page = desk.open("/sensor")

    # (reading + 500) x 0.011 with a reading of about nothing.
    eventually(lambda: desk.number(TORQUE), lambda torque: abs(torque - 5.5) < 0.5)
    assert page.inner_text(RAW) != "—"


def test_zero_is_not_taken_from_turning_cranks(desk: Desk, riding: str) -> None:
    page = desk.open("/sensor")

    page.wait_for_selector("text=the cranks turn")

    expect(page.locator("text=Zero from current reading")).to_be_disabled()
