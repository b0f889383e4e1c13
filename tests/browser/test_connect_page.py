"""Goal: the way to a unit is found, what was asked and found is told, and what works with it.

Method: a server with one simulated unit. Where a machine has no such port, or no such unit, the
server's own answer is altered in one place on its way to the page.
"""

from __future__ import annotations

from typing import Any

from playwright.sync_api import Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.fakes.server import SpindleServer

PILL = "[data-testid=device-pill]"


def port(url: str, **more: Any) -> dict[str, Any]:
    """A serial port as the server lists one."""
    plain = {"in_use": False, "hint": None, "hint_code": None, "usb_serial_number": None}
    return {"url": url, "kind": "serial", "description": "CP2102", "manufacturer": None} | (
        plain | more
    )


def test_a_port_is_refused_a_unit_found_and_both_are_let_go(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    desk.allow("the server responded with a status of 50[34]")
    page = desk.open("/")
    page.locator(f"{PILL} a").click()
    expect(page.locator("h1")).to_have_text("Connect a unit")
    probing, connections = page.get_by_test_id("probing"), page.get_by_test_id("connections")
    known = server.get(f"/devices/{standing}")["identity"]
    expect(page.get_by_test_id("probe-identity")).to_contain_text(known["serial_number"])

    address = page.get_by_label("Address", exact=True)
    address.fill("socket://127.0.0.1")
    expect(page.get_by_role("button", name="Connect", exact=True)).to_be_disabled()
    expect(page.locator("#address-check")).to_contain_text("port from 1 to 65535")
    address.fill("/dev/null")
    address.press("Enter")
    expect(probing.get_by_role("alert")).to_contain_text("no serial port")
    address.fill("socket://127.0.0.1:9")
    address.press("Enter")
    expect(probing).to_contain_text("Nothing to connect to is there")
    expect(probing).to_contain_text("nothing listens there")
    expect(probing.get_by_role("alert")).to_have_count(0)

    page.get_by_role("button", name="Add a simulated unit").click()
    expect(probing).to_contain_text("A unit is connected")
    made = next(one for one in server.get("/devices")["items"] if one["url"] == "sim:bench-1")
    expect(page.get_by_test_id("probe-identity")).to_contain_text(made["identity"]["serial_number"])
    expect(page.locator(f"{PILL} select option")).to_have_count(3)

    for name in (made["identity"]["serial_number"][-6:], "127.0.0.1:9"):
        row = connections.get_by_role("listitem").filter(has_text=name)
        row.get_by_role("button", name="Disconnect").click()
        expect(row).to_have_count(0)
    assert [one["id"] for one in server.get("/devices")["items"]] == [standing]
    expect(page.locator(PILL)).to_contain_text("Connected")


def test_a_port_that_may_not_be_opened_says_how_to_mend_it_in_both_languages(
    open_desk: OpenDesk, server: SpindleServer, standing: str
) -> None:
    desk = open_desk(width=390, height=844, language="zh-CN", theme="dark")
    hint = "You may not open this port. Add yourself to the group that owns it."
    barred = port("/dev/ttyUSB3", hint=hint, hint_code="port_permission")
    held = port("/dev/ttyUSB4", hint="Open.", hint_code="port_busy", in_use=True)
    listed = {"items": [barred, held, *server.get("/ports")["items"]], "next": None}
    desk.page.route("**/api/v1/ports", lambda route: route.fulfill(json=listed))
    page = desk.open("/connect")

    row = page.locator("[data-port='/dev/ttyUSB3']")
    expect(row).to_contain_text("无权打开")
    row.locator("summary").click()
    expect(row).to_contain_text("usermod -aG dialout")
    expect(page.locator("[data-port='/dev/ttyUSB4']")).to_contain_text("被其他程序占用")
    desk.picture("connect-forbidden-zh-dark", full=True)


def test_a_unit_of_another_firmware_is_read_and_says_what_does_not_work(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    why = "The unit's description is not the one of this Spindle."

    def older(route: Route) -> None:
        found: dict[str, Any] = server.get("/devices")
        unit = found["items"][0]
        unit |= {"state": "read_only", "reason": why, "reason_code": "read_only"}
        unit["capabilities"] = ["stream", "rider_torque", "read_config"]
        route.fulfill(json=found)

    desk.page.route("**/api/v1/devices", older)
    page = desk.open("/connect")

    expect(page.get_by_test_id("probing")).to_contain_text("it is read, not changed")
    expect(page.get_by_test_id("probing")).to_contain_text(why)
    works = page.get_by_test_id("what-works")
    expect(works.locator("[data-capability=stream] dd")).to_have_text("yes")
    expect(works.locator("[data-capability=write_config] dd")).to_contain_text("only read")


def test_without_a_unit_every_page_shows_the_way(desk: Desk) -> None:
    nothing: dict[str, object] = {"items": [], "next": None}
    desk.page.route("**/api/v1/devices", lambda route: route.fulfill(json=nothing))
    page = desk.open("/live")

    page.get_by_test_id("no-unit").get_by_role("link", name="Connect a unit").click()

    expect(page.get_by_test_id("what-works")).to_contain_text("Connect a unit to see")
    expect(page.get_by_role("button", name="Add a simulated unit")).to_be_enabled()
    page.goto(f"{desk.address}/")
    expect(page.get_by_test_id("no-unit")).to_be_visible()
    desk.picture("no-unit")
