"""Goal: a ride that only the unit recorded is fetched in the browser, told in words on the way, and
opened here as a ride.
"""

from __future__ import annotations

import json

from playwright.sync_api import Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.browser.recorded_ride import record_ride
from tests.fakes.server import SpindleServer

LOGS = "[data-testid=unit-logs]"
# The unit closes its log when the bike has stood for this long.
LOG_REST_S = 60.0


def ride_and_rest(server: SpindleServer, device: str) -> int:
    """A short ride, then rest until the unit has closed its log; its number."""
    server.simulate(device, clock="virtual")
    record_ride(server, device)
    server.advance(device, LOG_REST_S)
    logs = server.get(f"/devices/{device}/logs")["items"]
    server.simulate(device, clock="real")
    (number,) = [log["log_id"] for log in logs if log["state"] == "closed"]
    return int(number)


def test_a_ride_in_the_unit_is_fetched_freed_there_and_opened(
    desk: Desk, open_desk: OpenDesk, server: SpindleServer, standing: str, axe: str
) -> None:
    number = ride_and_rest(server, standing)
    page = desk.open("/rides")
    log = page.locator(f"{LOGS} [data-log='{number}']")
    expect(log).to_contain_text("Only in the unit")
    desk.picture("unit-logs")

    log.locator("button").click()

    expect(log).to_have_attribute("data-state", "done")
    desk.picture("unit-logs-done")
    page.reload()
    expect(log).to_have_attribute("data-state", "done")
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    phone = open_desk(width=360, height=740, language="zh-CN")
    expect(phone.open("/rides").locator(LOGS)).to_contain_text("单元中的骑行")
    phone.picture("unit-logs-phone-zh")
    assert sideways(phone.page) == 0
    ride = f"/{log.locator('a').get_attribute('href')}"
    page.once("dialog", lambda question: question.accept())
    log.get_by_role("button", name="Delete from the unit").click()
    expect(log).to_have_count(0)
    assert number not in [log["log_id"] for log in server.get(f"/devices/{standing}/logs")["items"]]
    desk.open(ride)
    page.wait_for_selector("[data-testid=traces][data-draws]")


def test_a_download_that_broke_off_says_why_and_can_go_on(desk: Desk, standing: str) -> None:
    download = {
        "state": "failed",
        "received": 4096,
        "length": 16384,
        "bytes_per_s": None,
        "detail": "The unit on the bench does not answer.",
        "upload_id": None,
        "ride_id": None,
        "duplicate_of": None,
        "confirmed": False,
    }
    log = {
        "log_id": 7,
        "generation": 1,
        "state": "cut_off",
        "started_at": None,
        "duration_s": 61.0,
        "length": 16384,
        "confirmed": False,
        "download": download,
    }
    asked: list[str] = []

    def answer(route: Route) -> None:
        if route.request.method == "POST":
            asked.append(route.request.url)
            download.update(state="fetching", detail=None)
        body = download if route.request.method == "POST" else {"items": [log], "overwritten": 2}
        route.fulfill(body=json.dumps(body), content_type="application/json")

    desk.page.route("**/api/v1/devices/*/logs**", answer)
    desk.page.route("**/api/v1/devices/*/logs/*/download", answer)
    page = desk.open("/rides")

    row = page.locator(f"{LOGS} [data-log='7']")
    expect(row).to_contain_text("The unit on the bench does not answer.")
    expect(row).to_contain_text("cut off when the unit lost power")
    expect(page.locator(LOGS)).to_contain_text("overwritten 2 rides")
    desk.picture("unit-logs-failed")
    row.locator("text=Go on").click()

    expect(row).to_contain_text("Being fetched: 25 %")
    expect(row.locator("progress")).to_have_attribute("value", "0.25")
    assert asked[0].endswith("/logs/7/download")
