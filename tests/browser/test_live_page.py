"""Goal: what the unit measures is on screen at once, and what is old never looks alive.

Real server, real protocol, the unit's own firmware; a rider pedals in the simulation.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import moved
from tests.fakes.server import ServerHere, SpindleServer, eventually
from tests.fakes.simulated_unit import UnitOnPort

LIVE = "[data-testid=live]"
TORQUE = "[data-channel=rider_torque_filtered_nm] strong"
SPEED = "[data-channel=speed_kmh] strong"


@pytest.fixture
def own_unit(server: SpindleServer) -> Iterator[UnitOnPort]:
    """A ridden unit that can be silenced."""
    with UnitOnPort("--scenario", "commute") as unit:
        device = server.add_unit(unit.url)
        yield unit
        unit.speak()
        server.ask("DELETE", f"/devices/{device}")


def test_numbers_move_and_strips_are_drawn(desk: Desk, riding: str) -> None:
    page = desk.open("/live")

    eventually(lambda: desk.number(SPEED), lambda speed: speed > 5)
    before = page.inner_text(SPEED)
    eventually(lambda: page.inner_text(SPEED), lambda text: text != before)
    desk.until(f"Number(document.querySelector('{LIVE}').dataset.fps) > 0")
    strips = page.locator("[data-draws]")
    expect(strips).to_have_count(6)
    drawn = [int(str(one.get_attribute("data-draws"))) for one in strips.all()]
    eventually(
        lambda: [int(str(one.get_attribute("data-draws"))) for one in strips.all()],
        lambda now: all(one > was for one, was in zip(now, drawn, strict=True)),
    )
    expect(page.get_by_test_id("gaps")).to_contain_text(re.compile(r"\d"))
    desk.picture("live")


def test_four_figures_then_eight_and_the_powers_apart(open_desk: OpenDesk, riding: str) -> None:
    desk = open_desk(width=390, height=844)
    page = desk.open("/live")
    figures = page.get_by_test_id("figures")

    expect(figures.locator(".large dt")).to_have_text(
        ["Speed", "Your power", "Motor power", "Cadence"]
    )
    expect(figures.locator(".small dt")).to_have_text(
        [
            "Rider torque",
            "Motor torque",
            "Gain",
            "Assist ratio",
            "Motor",
            "Battery",
            "Distance",
            "Range",
        ]
    )
    expect(figures.locator("[data-value=rider_power_w]")).to_contain_text("W")
    expect(figures.locator("[data-value=motor_power_w]")).to_contain_text("W")
    expect(figures.locator("[data-channel=motor_torque_nm]")).to_contain_text("at the crank")
    expect(figures.locator("[data-channel=battery_soc_pct]")).to_contain_text("%")
    expect(page.get_by_test_id("strips")).to_contain_text("at the crank (motor × 40.34)")
    assert sideways(page) == 0
    desk.picture("live-390", full=True)


def test_the_crank_and_the_rules_follow_the_rider(desk: Desk, riding: str) -> None:
    page = desk.open("/live")

    # The simulated legs are alike: half of the work is done with each of them.
    crank = page.get_by_test_id("crank")
    expect(crank).to_contain_text(re.compile(r"left (49|50|51)\s%"))
    rules = page.get_by_test_id("rules-firing")
    fired = rules.locator(".fired").first
    expect(fired).to_contain_text(re.compile(r"(NB|NS|ZO|PS|PB)\s*[01]\.\d\d"))
    expect(rules.get_by_role("link", name="why")).to_have_attribute("href", "tune/why?state")


def ride_of(server: SpindleServer, device: str) -> dict[str, Any]:
    """The ride that this unit is on."""
    rides = server.get("/rides")["items"]
    return next(ride for ride in rides if ride["device"]["device_id"] == device)


def test_a_moment_is_marked_with_a_key_and_is_in_the_ride(
    desk: Desk, server: SpindleServer, riding: str
) -> None:
    page = desk.open("/live")
    page.wait_for_selector(f"{LIVE}[data-stale=false]")
    eventually(lambda: ride_of(server, riding)["state"], lambda state: state == "live")

    page.keyboard.press("m")
    expect(page.get_by_text(re.compile(r"Mark \d+ at [\d:]+\.\d of this ride"))).to_be_visible()
    page.get_by_role("button", name="Mark this moment").click()

    def marks() -> list[dict[str, Any]]:
        events = ride_of(server, riding)["events"]
        return [event for event in events if event["kind"] == "mark"]

    first, second = eventually(marks, lambda found: len(found) >= 2)[-2:]
    assert second["value"] == first["value"] + 1
    assert second["t_s"] >= first["t_s"]


def test_pausing_holds_the_strips_and_not_the_numbers(desk: Desk, riding: str) -> None:
    page = desk.open("/live")
    desk.until("Number(document.querySelector('[data-draws]')?.dataset.draws) > 99")

    page.keyboard.press("Space")
    page.wait_for_selector("text=The strips stand still")
    draws = page.get_attribute("[data-draws]", "data-draws")
    before = page.inner_text(TORQUE)
    eventually(lambda: page.inner_text(TORQUE), lambda text: text != before)

    assert page.get_attribute("[data-draws]", "data-draws") == draws

    page.keyboard.press("Shift+ArrowLeft")
    page.keyboard.press("ArrowLeft")
    expect(page.get_by_test_id("strips")).to_contain_text("cursor -1.1\u00a0s")
    speed = page.get_by_test_id("strips").get_by_role("img", name="Speed: Speed")
    expect(speed).to_have_attribute("aria-label", re.compile(r"Speed \d+\.\d"))


def test_what_held_the_motor_back_is_shaded_and_named_a_while(
    desk: Desk, server: SpindleServer, riding: str
) -> None:
    page = desk.open("/live")
    held = page.get_by_test_id("motor-limits")
    desk.until("Number(document.querySelector('[data-draws]')?.dataset.draws) > 10")

    # Under way, so that braking lasts: what is over at once is not listed.
    eventually(lambda: desk.number(SPEED), lambda speed: speed > 8)
    server.simulate(riding, brake=True)
    expect(held.locator(".warn")).to_contain_text("brake")
    eventually(lambda: desk.number(SPEED), lambda speed: speed < 3)
    server.simulate(riding, brake=False)

    expect(held).to_contain_text(re.compile(r"brake, \d+\u00a0s ago for \d+\.\d\u00a0s"))
    assert moved(page) == []


def test_a_silent_unit_is_shown_as_old_and_comes_back(desk: Desk, own_unit: UnitOnPort) -> None:
    # Its configuration is asked for while it is silent.
    desk.allow("status of 50[34]")
    page = desk.open("/live")
    page.wait_for_selector(f"{LIVE}[data-stale=false]")

    own_unit.silence()
    page.wait_for_selector(f"{LIVE}[data-stale=true]")
    page.wait_for_selector("text=the values below are old")
    expect(page.locator("[data-channel=speed_kmh]")).to_contain_text("— no data")
    expect(page.get_by_test_id("strips")).to_contain_text("before the data stopped")
    page.wait_for_selector("[data-testid=banner]")
    desk.picture("live-stale")

    own_unit.speak()
    page.wait_for_selector(f"{LIVE}[data-stale=false]")
    page.wait_for_selector("[data-testid=banner]", state="detached")


def test_a_server_that_is_gone_is_said_to_be_gone(open_desk: OpenDesk, tmp_path: Path) -> None:
    mortal = ServerHere(tmp_path, ["sim"]).start()
    mortal.ready_device()
    desk = open_desk(address=mortal.url)
    desk.allow("ERR_CONNECTION|WebSocket|Failed to load resource")
    page = desk.open("/live")
    page.wait_for_selector(f"{LIVE}[data-stale=false]")

    mortal.stop()

    page.wait_for_selector("text=server does not answer")
    page.wait_for_selector(f"{LIVE}[data-stale=true]")
    assert "Offline" in page.inner_text("[data-testid=device-pill]")
