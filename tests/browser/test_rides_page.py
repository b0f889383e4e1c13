"""Goal: two hours of a ride are looked through without losing a sample, and files become rides."""

from __future__ import annotations

import base64
import re
import zipfile

import pytest
from playwright.sync_api import Page, expect

from tests.browser.desk import Desk
from tests.browser.long_ride import NAME, SPIKE_NM, SPIKE_ROW
from tests.fakes.fit_file import fit_ride
from tests.fakes.server import SpindleServer, eventually

TRACES = "[data-testid=traces]"
GREATEST = "Math.max(...gd.data.find((d) => d.name === 'Rider torque').y.filter((v) => !isNaN(v)))"
WIDTH_S = "gd._fullLayout.xaxis.range[1] - gd._fullLayout.xaxis.range[0]"


def long_ride(server: SpindleServer) -> int:
    rides = server.get("/rides")["items"]
    return next(int(ride["id"]) for ride in rides if ride["name"] == NAME)


def open_ride(desk: Desk, server: SpindleServer, query: str = "") -> Page:
    page = desk.open(f"/rides/{long_ride(server)}{query}")
    page.wait_for_selector(f"{TRACES}[data-draws]")
    return page


def drop_file(page: Page, name: str, content: bytes) -> None:
    """What a file manager does when a file is let go over the page."""
    page.evaluate(
        """([name, text]) => {
            const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0))
            const transfer = new DataTransfer()
            transfer.items.add(new File([bytes], name))
            const event = { dataTransfer: transfer, bubbles: true, cancelable: true }
            document.body.dispatchEvent(new DragEvent('dragover', event))
            document.body.dispatchEvent(new DragEvent('drop', event))
        }""",
        [name, base64.b64encode(content).decode()],
    )


def steady_ride(minutes: int) -> bytes:
    seconds = 60 * minutes
    return fit_ride(
        1_700_000_000 + minutes * 86_400, [18.0] * seconds, [80] * seconds, [180] * seconds
    )


def test_the_whole_ride_shows_its_one_spike(desk: Desk, server: SpindleServer) -> None:
    page = open_ride(desk, server)

    assert desk.plot(GREATEST) == SPIKE_NM
    points = page.inner_text("[data-testid=points]")
    shown, rows = re.findall(r"[\d,]+ of [\d,]+", points)[0].split(" of ")
    assert 400 < int(shown.replace(",", "")) <= 4000
    assert int(rows.replace(",", "")) == 720_000
    desk.picture("ride", full=True)


def test_zooming_keeps_the_spike_until_every_sample_is_drawn(
    desk: Desk, server: SpindleServer
) -> None:
    page = open_ride(desk, server)
    spike_s = SPIKE_ROW / 100
    for half_s in (600, 60, 2):
        left, right = (
            desk.plot(f"gd._fullLayout.xaxis._offset + gd._fullLayout.xaxis.l2p({t})")
            for t in (spike_s - half_s, spike_s + half_s)
        )
        box = page.locator(TRACES).bounding_box()
        assert box is not None
        before = page.inner_text("[data-testid=points]")
        page.mouse.move(box["x"] + left, box["y"] + 60)
        page.mouse.down()
        page.mouse.move(box["x"] + right, box["y"] + 62, steps=4)
        page.mouse.up()

        points = page.locator("[data-testid=points]")
        expect(points).not_to_have_text(before)
        drawn_s = pytest.approx(2 * half_s, rel=0.05)
        eventually(lambda: desk.plot(WIDTH_S), lambda width_s, want=drawn_s: width_s == want)
        eventually(lambda: desk.plot(GREATEST), lambda most: most == SPIKE_NM)
    expect(page.locator("[data-testid=points]")).to_contain_text("all")
    desk.picture("ride-zoomed", full=True)


def test_the_zoom_is_in_the_address(desk: Desk, server: SpindleServer) -> None:
    page = open_ride(desk, server, "?from_s=4300&to_s=4330")

    expect(page.locator("[data-testid=points]")).to_contain_text("1:11:40 – 1:12:10")
    page.click("text=Whole ride")
    expect(page.locator("[data-testid=points]")).to_contain_text("0:00 – 2:00:00")
    eventually(lambda: page.evaluate("location.search"), lambda query: "from_s" not in query)


def test_no_line_is_drawn_across_the_hole(desk: Desk, server: SpindleServer) -> None:
    page = open_ride(desk, server)

    inside = desk.plot("[...gd.data[0].y].filter((_, i) => gd.data[0].x[i] > 2010"
                       " && gd.data[0].x[i] < 2290).every(Number.isNaN)")  # fmt: skip
    assert inside is True
    assert desk.plot("gd.data.every((d) => d.connectgaps === false)") is True
    assert desk.plot("gd.layout.shapes.length") == 1
    expect(page.locator("text=gaps without samples (1)")).to_be_visible()


def test_what_came_from_the_unit_s_own_log_is_tinted_and_said(
    desk: Desk, server: SpindleServer
) -> None:
    ride = server.get(f"/rides/{long_ride(server)}")
    span = {"from_s": 600.0, "to_s": 900.0, "rows_lost": 30000, "rows_filled": 3000}
    ride["filled"] = [span | {"period_us": 100_000, "source": "unit_log"}]
    desk.page.route(f"**/api/v1/rides/{ride['id']}", lambda route: route.fulfill(json=ride))

    page = open_ride(desk, server)

    expect(page.locator("text=stretches from the unit's own log (1)")).to_be_visible()
    assert desk.plot("gd.layout.shapes.map((s) => s.x0)")[-1] == 600


def test_rider_and_motor_are_told_apart(desk: Desk, server: SpindleServer) -> None:
    page = open_ride(desk, server)

    summary = page.locator("[data-testid=summary]")
    expect(summary).to_contain_text("Your energy")
    expect(summary).to_contain_text("Motor energy")
    assert desk.plot("gd.data.map((d) => d.name)") == [
        "Speed", "Rider torque", "Motor torque requested, at the crank",
        "Motor torque at the crank", "rider", "motor", "Gain", "Cadence",
    ]  # fmt: skip


def test_the_same_window_is_a_table_for_those_who_see_no_curves(
    desk: Desk, server: SpindleServer
) -> None:
    page = open_ride(desk, server)

    page.click("button >> text=Data table")

    table = page.locator("section[aria-labelledby=traces] table")
    expect(table).to_contain_text("95.0")
    page.get_by_test_id("chips").get_by_role("button", name="Rider torque").click()
    expect(table).not_to_contain_text("95.0")
    assert 20 <= page.locator("section[aria-labelledby=traces] table tbody tr").count() <= 40


def test_no_button_sends_a_chart_away(desk: Desk, server: SpindleServer) -> None:
    page = open_ride(desk, server)

    assert desk.plot("gd._context.showSendToCloud") is False
    assert desk.plot("gd._context.plotlyServerURL") == ""
    page.hover(TRACES)
    assert page.locator("[data-title*=Share], [data-title*=cloud], .plotlyjsicon").count() == 0


def test_a_dropped_fit_file_becomes_a_ride(desk: Desk, server: SpindleServer) -> None:
    page = desk.open("/rides")

    drop_file(page, "morning loop.fit", steady_ride(10))

    row = page.locator("[data-testid=import-list] li")
    expect(row).to_have_attribute("data-state", "complete")
    row.locator("text=Open the ride").click()
    page.wait_for_selector(f"{TRACES}[data-draws]")
    # 599 s at 18 km/h and 180 W.
    expect(page.locator("[data-testid=summary]")).to_contain_text("3.00 km")
    expect(page.locator("[data-testid=summary]")).to_contain_text("—")
    expect(page.locator("text=Not recorded in this ride")).to_contain_text("Gain")
    desk.picture("ride-imported")


def test_a_damaged_file_says_why_and_what_was_saved(desk: Desk, server: SpindleServer) -> None:
    page = desk.open("/rides")

    drop_file(page, "cut short.fit", steady_ride(9)[:-1500])
    drop_file(page, "holiday.fit", b"not a ride at all")

    partial = page.locator("[data-testid=import-list] li", has_text="cut short")
    expect(partial).to_have_attribute("data-state", "partial")
    expect(partial.locator("small")).not_to_be_empty()
    rejected = page.locator("[data-testid=import-list] li", has_text="holiday")
    expect(rejected).to_have_attribute("data-state", "rejected")
    expect(rejected.locator("small")).not_to_be_empty()
    desk.picture("rides-intake")


def test_a_ride_is_renamed(desk: Desk, server: SpindleServer) -> None:
    page = desk.open("/rides")
    drop_file(page, "to rename.fit", steady_ride(4))
    page.click("text=Open the ride")

    page.get_by_role("button", name="Rename", exact=True).click()
    page.fill("input[name=name]", "Along the river")
    page.get_by_role("button", name="Keep", exact=True).click()

    expect(page.get_by_role("heading", name="Along the river", level=1)).to_be_visible()
    assert "Along the river" in [ride["name"] for ride in server.get("/rides")["items"]]


def test_rides_are_found_tagged_and_deleted_many_at_once(desk: Desk, server: SpindleServer) -> None:
    for number in (1, 2, 3):
        rows = 600 + number
        began = 1_500_000_000 + 9_000 * number
        body = fit_ride(began, [18.0] * rows, [80] * rows, [180] * rows)
        name = {"name": f"Delta {number}.fit"}
        sent = {"content-type": "application/octet-stream"}
        server.ask("POST", "/rides/import", params=name, content=body, headers=sent)
    page = desk.open("/rides")
    listed = page.locator("[data-testid=ride-table] tbody tr")
    expect(page.locator("[data-testid=rider-totals] tbody tr")).to_have_count(12)

    page.fill("input[type=search]", "delta")
    expect(listed).to_have_count(3)
    expect(page.locator("text=3 of 3 shown")).to_be_visible()
    page.get_by_label("Choose all that are shown").check()
    page.click("[data-testid=many-rides] >> text=Tag…")
    page.fill("#new-tag", "flat")
    page.click("dialog >> text=Add")
    page.click("dialog >> text=Done")
    expect(listed.first).to_contain_text("flat")
    page.click("[data-testid=many-rides] >> text=Export…")
    page.get_by_label("CSV").check()
    with page.expect_download() as saved:
        page.click("dialog >> text=Save the ZIP")
    with zipfile.ZipFile(saved.value.path()) as zipped:
        assert len(zipped.namelist()) == 7
    page.click("dialog >> text=Done")
    page.get_by_label("Choose Delta 1").uncheck()
    page.click("[data-testid=many-rides] >> text=Delete…")
    page.click("dialog >> text=Delete (2)")

    expect(listed).to_have_count(1)
    expect(listed.first).to_contain_text("Delta 1")
    page.click("button >> text=#flat")
    expect(listed).to_have_count(1)
    desk.picture("rides", full=True)
