"""Goal: faults and modes of a ride are marked above its traces and listed by their moments."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.browser.test_rides_page import TRACES, long_ride
from tests.fakes.server import SpindleServer

FAULT_S = 4312.3
BATTERY_LOW = 1 << 2
EVENTS = [
    {"t_s": 0.0, "kind": "assist_mode", "value": 3},
    {"t_s": FAULT_S, "kind": "fault_set", "value": BATTERY_LOW},
    {"t_s": FAULT_S + 20, "kind": "fault_cleared", "value": BATTERY_LOW},
    {"t_s": FAULT_S + 60, "kind": "assist_mode", "value": 1},
]


def open_eventful_ride(desk: Desk, server: SpindleServer) -> Page:
    """The long ride, as if its battery had run low in it."""
    ride = server.get(f"/rides/{long_ride(server)}")
    ride["events"] = EVENTS
    desk.page.route(f"**/api/v1/rides/{ride['id']}", lambda route: route.fulfill(json=ride))
    page = desk.open(f"/rides/{ride['id']}")
    page.wait_for_selector(f"{TRACES}[data-draws]")
    return page


def test_a_mark_stands_where_the_event_was(desk: Desk, server: SpindleServer) -> None:
    open_eventful_ride(desk, server)

    marks = desk.plot(
        "Object.fromEntries(gd.data.filter((d) => d.mode === 'markers').map((d) => [d.name, d.x]))"
    )

    assert marks == {
        "Faults": [FAULT_S],
        "Faults over": [FAULT_S + 20],
        "Assist modes": [0.0, FAULT_S + 60],
    }
    texts = desk.plot("gd.data.find((d) => d.name === 'Faults').text")
    assert texts == ["Fault: Battery low<br>1:11:52"]
    lines = desk.plot("gd.layout.shapes.filter((s) => s.type === 'line').map((s) => s.x0)")
    assert sorted(lines) == [event["t_s"] for event in EVENTS]
    desk.picture("ride-events", full=True)


def test_the_list_tells_the_events_and_leads_to_their_moment(
    desk: Desk, server: SpindleServer, axe: str
) -> None:
    page = open_eventful_ride(desk, server)
    told = page.get_by_test_id("ride-events").get_by_role("listitem")
    expect(told).to_have_count(len(EVENTS))
    fault = told.filter(has_text="Fault: Battery low")

    fault.get_by_role("button", name="1:11:52").click()

    # Half a minute to each side of the fault.
    expect(page.get_by_test_id("points")).to_contain_text("1:11:22 – 1:12:22")
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []


@pytest.mark.parametrize(("language", "words"), [("zh-CN", "故障：电池电量低"), ("en-GB", "Fault")])
def test_a_phone_shows_them_too(
    open_desk: OpenDesk, server: SpindleServer, language: str, words: str
) -> None:
    desk = open_desk(width=390, height=844, theme="dark", language=language)

    page = open_eventful_ride(desk, server)

    expect(page.get_by_test_id("ride-events")).to_contain_text(words)
    assert sideways(page) == 0
    desk.picture(f"ride-events-phone-{language}", full=True)
