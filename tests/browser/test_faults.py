"""Goal: a mechanic sees which faults are there and which were, what the bike did then, and clears
those that are over.
"""

from __future__ import annotations

import json
from typing import Any

from playwright.sync_api import Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.fakes.server import SpindleServer

FROZEN = {"t_us": 61_000_000, "channels": {"speed_kmh": 12.5, "battery_voltage_v": 36.1}}
ACTIVE = {
    "name": "torque_sensor",
    "description": "Check the cable.",
    "active": True,
    "count": 2,
    "frozen": FROZEN,
    "severity": "latched",
    "mechanic_text": "Measure the bridge.",
}
OVER = {**ACTIVE, "name": "battery_low", "active": False, "count": 1, "frozen": None}


def with_faults(desk: Desk) -> list[str]:
    """The unit has one fault and had another; what is asked to be cleared is noted."""
    asked: list[str] = []

    def answer(route: Route) -> None:
        cleared = route.request.url.endswith("/clear")
        if cleared:
            asked.append(route.request.method)
        items: list[dict[str, Any]] = [ACTIVE] if cleared else [ACTIVE, OVER]
        body = json.dumps({"items": items, "next": None})
        route.fulfill(body=body, content_type="application/json")

    desk.page.route("**/faults", answer)
    desk.page.route("**/faults/clear", answer)
    return asked


def test_a_fault_shows_what_the_bike_did_and_what_is_over_is_cleared(
    desk: Desk, standing: str
) -> None:
    asked = with_faults(desk)
    page = desk.open("/service")
    fault = page.locator("[data-fault=torque_sensor]")
    expect(fault).to_contain_text("active now")
    expect(fault).to_contain_text("Measure the bridge.")
    expect(fault).to_contain_text("The rider reads: “Check the cable.”")
    expect(page.locator("[data-fault=battery_low]")).to_contain_text("over")

    fault.locator("summary").click()
    expect(fault).to_contain_text("1:01 after switch-on")
    expect(fault.locator("dl")).to_contain_text("12.50 km/h")
    desk.picture("faults")
    page.click("text=Clear the faults that are over")

    expect(page.locator("[data-fault=battery_low]")).to_have_count(0)
    expect(fault).to_be_visible()
    assert asked == ["POST"]


def test_faults_in_chinese_on_a_phone(open_desk: OpenDesk, standing: str) -> None:
    desk = open_desk(width=360, height=740, language="zh-CN")
    with_faults(desk)
    page = desk.open("/service")

    expect(page.locator("[data-fault=torque_sensor]")).to_contain_text("检查传感器插头与电桥")
    assert sideways(page) == 0
    desk.picture("faults-phone-zh")


def test_a_rider_is_told_what_to_do_in_plain_words(
    open_desk: OpenDesk, server: SpindleServer, standing: str
) -> None:
    unit = server.get(f"/devices/{standing}") | {"faults_active": ["battery_cut"]}
    desk = open_desk(width=390, height=844, language="zh-CN")
    desk.page.route(
        "**/api/v1/devices", lambda route: route.fulfill(json={"items": [unit], "next": None})
    )

    page = desk.open("/")

    told = page.locator("[data-fault=battery_cut]")
    expect(told).to_contain_text("请停稳后重新打开电池")
    expect(told).not_to_contain_text("电池管理系统")
    desk.picture("fault-rider-zh", full=True)


def test_what_was_changed_is_told_while_the_unit_is_silent(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    desk.allow("status of 504")
    silent = {"status": 504, "code": "no_answer", "detail": "Silent.", "title": "", "type": ""}
    desk.page.route(
        "**/parameters",
        lambda route: route.fulfill(
            status=504, body=json.dumps(silent), content_type="application/problem+json"
        ),
    )
    known = server.get(f"/devices/{standing}/config/revisions")["items"]

    page = desk.open("/service")

    changes = page.get_by_role("region", name="Changes of the configuration").first
    expect(changes.locator("tbody tr")).to_have_count(len(known))

    # The rides since are the server's to tell as well.
    changes.get_by_role("button", name="Rides since").first.click()
    since = page.get_by_test_id("since-change")
    expect(since.locator("[data-verdict=too_few]")).to_be_visible()
    expect(since.locator("[data-since=motor_wh_per_km] td")).to_have_count(2)
    expect(since).to_contain_text("Other roads, another wind")
