"""Goal: a latched fault is hard to miss and cleared by a click; while clearing does not help, the
page says why and what would.

The faults are real: what is broken is broken in the simulated unit, whose firmware sets, keeps and
ends them. Only what no simulator can do (a newer firmware, a lost unit) is answered in its place.
"""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.fakes.server import SpindleServer, eventually

PILL = "[data-testid=device-pill]"
BOX = "[data-testid=fault-box]"
SERVICE = "nav [href='service']"
SOUND = {"torque_sensor": "sound", "speed_sensor": "sound", "link_lost": False}


def active(server: SpindleServer, device: str) -> list[str]:
    """The faults that the unit has now."""
    return list(server.get(f"/devices/{device}")["faults_active"])


def break_torque_sensor(server: SpindleServer, device: str) -> None:
    """An open arm of the bridge; the unit latches its fault."""
    server.simulate(device, faults={"torque_sensor": "open_high"})
    eventually(lambda: active(server, device), lambda names: names == ["torque_sensor"])


def listed(desk: Desk, server: SpindleServer, device: str, **change: Any) -> None:
    """The list of units says this of the unit, whatever it is."""
    unit = server.get(f"/devices/{device}") | change
    desk.page.route(
        "**/api/v1/devices", lambda route: route.fulfill(json={"items": [unit], "next": None})
    )


def clear(page: Page) -> None:
    with page.expect_response("**/faults/clear*"):
        page.get_by_role("button", name="Clear the fault").click()


def test_a_latched_fault_whose_cause_is_gone_is_cleared_by_a_click(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    break_torque_sensor(server, standing)
    page = desk.open("/")
    lamp = page.locator("[data-lamp=torque]")
    expect(lamp).to_contain_text("no reading")
    page = desk.open("/service")
    checks = page.get_by_test_id("checks")
    expect(checks.get_by_role("row", name="Torque sensor, no foot")).to_contain_text("failed")
    expect(checks.get_by_role("row", name="Torque sensor, no foot")).to_contain_text("no reading")
    clear(page)
    told = page.get_by_test_id("clear-result")
    expect(told).to_contain_text("Not cleared")
    expect(told).to_contain_text("cause is still there")
    assert active(server, standing) == ["torque_sensor"]
    desk.picture("fault-not-cleared")

    server.simulate(standing, faults=SOUND)

    def cleared() -> bool:
        if active(server, standing):
            clear(page)
        return active(server, standing) == []

    eventually(cleared)
    expect(page.get_by_test_id("faults")).to_contain_text("No active faults")
    expect(page.locator(PILL)).to_contain_text("Connected")


@pytest.mark.parametrize(("width", "theme"), [(1280, "light"), (390, "dark")])
def test_a_fault_is_seen_on_every_page_with_word_and_icon(
    open_desk: OpenDesk, server: SpindleServer, standing: str, axe: str, width: int, theme: str
) -> None:
    break_torque_sensor(server, standing)
    desk = open_desk(width=width, height=844, theme=theme)

    page = desk.open("/rides")

    expect(page.locator(PILL)).to_contain_text("1 fault")
    expect(page.locator(f"{PILL} svg").first).to_be_visible()
    badge = page.locator("nav .toggle .badge" if width < 760 else f"{SERVICE} .badge")
    expect(badge).to_be_visible()
    expect(badge).to_contain_text("1")
    expect(page.locator(SERVICE)).to_have_text(re.compile("Service.*1 fault", re.S))
    page.locator(PILL).get_by_role("link").click()
    expect(page).to_have_url(re.compile("/service$"))
    expect(page.locator("[data-fault=torque_sensor]")).to_be_visible()
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    assert sideways(page) == 0


def test_live_says_why_nothing_helps_and_what_ends_it(
    desk: Desk, server: SpindleServer, standing: str, axe: str
) -> None:
    break_torque_sensor(server, standing)

    page = desk.open("/live")

    box = page.locator(BOX)
    expect(box).to_contain_text("Torque sensor")
    expect(box).to_contain_text("No assist: the pedal sensor is faulty.")
    expect(box).to_contain_text("until it is cleared at standstill")
    expect(box.get_by_role("link", name="What to check")).to_have_attribute("href", "service")
    expect(page.get_by_test_id("stream-status")).to_contain_text("no assist")
    desk.picture("live-fault")
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []


def test_while_the_bike_moves_the_page_says_so_and_stops_a_simulated_rider(
    desk: Desk, server: SpindleServer, riding: str
) -> None:
    break_torque_sensor(server, riding)
    server.simulate(riding, faults=SOUND)
    page = desk.open("/live")
    box = page.locator(BOX)
    expect(box).to_contain_text("The bike moves")

    clear(page)

    expect(page.get_by_test_id("clear-result")).to_contain_text("the bike moves")
    box.get_by_role("button", name="Stop the simulated rider").click()
    expect(page.locator(BOX)).to_have_count(0)
    assert active(server, riding) == []


def test_a_fault_that_comes_is_told_once_and_one_that_goes_by_itself_too(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = desk.open("/settings")
    expect(page.locator(PILL)).to_contain_text("Connected")
    page.evaluate(
        """() => {
        window.told = []
        new MutationObserver(() => {
            for (const node of document.querySelectorAll('[data-testid=fault-announced]')) {
                if (window.told.at(-1) !== node.textContent) window.told.push(node.textContent)
            }
        }).observe(document.body, { subtree: true, childList: true, characterData: true })
    }"""
    )

    def looked(times: int) -> None:
        for _ in range(times):
            with page.expect_response(lambda answer: answer.url.endswith("/devices")):
                pass

    server.simulate(standing, faults={"link_lost": True})
    expect(page.get_by_role("alert")).to_contain_text("Torque signal interrupted")
    looked(3)
    server.simulate(standing, faults=SOUND)
    expect(page.locator(PILL)).to_contain_text("Connected")
    looked(2)

    told = page.evaluate("window.told")
    assert [words for words in told if "interrupted" in words] == told
    assert len(told) == 2
    assert told[1].startswith("Over")
    expect(page.get_by_role("alert")).to_have_count(0)


def test_a_fault_of_a_newer_firmware_is_shown_and_can_be_cleared(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    listed(desk, server, standing, faults_active=["fault_29", "torque_sensor"])

    page = desk.open("/live")

    expect(page.locator(PILL)).to_contain_text("2 faults")
    newer = page.locator(f"{BOX} [data-fault=fault_29]")
    expect(newer).to_contain_text("firmware is newer")
    expect(page.get_by_role("button", name="Clear the faults")).to_be_enabled()


def test_a_lost_unit_s_fault_is_told_as_old_and_not_cleared(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    listed(desk, server, standing, faults_active=["torque_sensor"], state="lost", reason="Silent.")

    page = desk.open("/live")

    expect(page.locator(PILL)).to_contain_text("Last seen")
    expect(page.locator(f"{SERVICE} .badge")).to_contain_text("1")
    expect(page.locator(BOX)).to_contain_text("when the unit was last seen")
    expect(page.get_by_role("button", name="Clear the fault")).to_be_disabled()
