"""Goal: who has no ride gets a first one; many files are one summary that can be paused; a
table that does not say its units is asked about once.

Method: a server of its own that begins without a ride; files are written here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Page, Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.test_rides_page import TRACES, drop_file
from tests.fakes.fit_file import START_S, fit_ride
from tests.fakes.server import ServerHere, SpindleServer, eventually

FILES = 40
AT_ONCE = 3
BEFORE_PAUSE = 5
DAY_S = 86_400
ROWS_S = 60


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    with ServerHere(tmp_path_factory.mktemp("fresh"), ["sim:fresh?scenario=none"]) as running:
        running.all_ready(1)
        yield running


def table(start: str) -> bytes:
    """A ride of a minute at 5 m a second, whose header says neither unit nor zone."""
    hour = int(start[-2:])
    rows = [f"{start[:-2]}{hour:02}:{s // 60:02}:{s % 60:02},5.0,80" for s in range(120)]
    return "\n".join(["time,speed,cadence", *rows, ""]).encode()


def test_who_has_no_ride_looks_round_with_a_sample_and_deletes_it(
    open_desk: OpenDesk, fresh: SpindleServer
) -> None:
    page = open_desk(address=fresh.url).open("/rides")
    expect(page.locator("#import")).to_have_text("No rides yet")
    expect(page.get_by_test_id("rider-totals")).to_have_count(0)

    page.get_by_role("button", name="Open the sample ride").click()

    page.wait_for_selector(f"{TRACES}[data-draws]")
    expect(page.locator("h1")).to_have_text("Sample ride, simulated")
    expect(page.locator("main")).to_contain_text("nobody rode it")
    page.once("dialog", lambda question: question.accept())
    page.get_by_test_id("ride-bar").get_by_role("button", name="Delete").click()
    expect(page.locator("#import")).to_have_text("No rides yet")
    assert fresh.get("/rides")["items"] == []


def test_a_table_that_does_not_say_its_units_is_asked_about_once(
    open_desk: OpenDesk, fresh: SpindleServer
) -> None:
    page = open_desk(address=fresh.url).open("/rides")
    drop_file(page, "first.csv", table("2026-05-01 10"))
    page.get_by_role("button", name="Answer questions about first.csv").click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_test_id("table-columns")).to_contain_text("5.0 · 5.0 · 5.0")
    reading = dialog.get_by_role("button", name="Read the file")
    expect(reading).to_be_disabled()

    dialog.get_by_label("Unit of speed").select_option("m/s")
    dialog.get_by_label("Time zone of its times").fill("Europe/Dublin")
    reading.click()

    row = page.get_by_test_id("import-list").locator("li")
    expect(row).to_have_attribute("data-state", "complete")
    expect(page.get_by_test_id("ride-table")).to_contain_text("18.0")
    drop_file(page, "second.csv", table("2026-05-02 10"))
    expect(row.filter(has_text="second.csv")).to_have_attribute("data-state", "complete")
    rides = fresh.get("/rides")["items"]
    # Ten in the morning in Dublin's summer; 119 s at 5 m/s.
    assert {ride["started_at"][:16] for ride in rides} == {"2026-05-01T09:00", "2026-05-02T09:00"}
    assert [ride["summary"]["distance_km"] for ride in rides] == [pytest.approx(0.6, 0.02)] * 2
    page.goto(f"{fresh.url}/settings")
    known = page.get_by_test_id("answered-tables")
    expect(known).to_contain_text("speed: m/s · Europe/Dublin")
    known.get_by_role("button", name="Forget what was said of time, speed, cadence").click()
    expect(known).to_have_count(0)
    assert fresh.get("/tables")["items"] == []


def test_whose_a_power_is_what_a_column_is_and_how_a_date_is_read_are_asked(
    open_desk: OpenDesk, fresh: SpindleServer
) -> None:
    rows = [f"9/5/2025 5:{s // 60:02}:{s % 60:02} PM,13.42,36,1{s},n/a" for s in range(120)]
    data = "\n".join(["time,speed (mph),pack,power,cadence", *rows, "9/5/2025 5:30 PM,9,36,99,70"])
    page = open_desk(address=fresh.url).open("/rides")
    drop_file(page, "logger.csv", data.encode())
    page.get_by_role("button", name="Answer questions about logger.csv").click()
    dialog = page.get_by_role("dialog")
    reading = dialog.get_by_role("button", name="Read the file")
    dialog.get_by_label("Time zone of its times").fill("Europe/Berlin")

    unread = dialog.locator("label", has_text="120 cells of “cadence” cannot be read")
    expect(unread.locator(".code")).to_have_text("n/a")
    unread.locator("select").select_option("None of these: kept under its own name")
    dialog.get_by_label("What “pack” is").select_option("battery_voltage_v")
    dates = dialog.get_by_role("group", name="A date such as 9/5/2025 is")
    expect(dates.get_by_role("button")).to_have_text(["9 May 2025", "5 September 2025"])
    expect(reading).to_be_disabled()
    dates.get_by_role("button", name="5 September 2025").click()
    reading.click()

    # Beside a voltage the power may be anybody's.
    expect(dialog).to_contain_text("One more question follows from what you said.")
    expect(reading).to_be_disabled()
    dialog.get_by_label("Whose power is in “power”?").select_option("battery_power_w")
    reading.click()
    row = page.get_by_test_id("import-list").locator("li")
    expect(row).to_have_attribute("data-state", "complete")
    (ride,) = [one for one in fresh.get("/rides")["items"] if one["name"] == "logger"]
    assert ride["started_at"][:19] == "2025-09-05T15:00:00"

    page.goto(f"{fresh.url}/rides/{ride['id']}")
    from_file = page.get_by_test_id("from-file")
    expect(from_file).to_contain_text("power is Battery power")
    from_file.get_by_role("button", name="Say what its columns are").click()
    dialog.get_by_label("What “power” is").select_option("motor_power_w")
    dialog.get_by_role("button", name="Read the file again").click()

    expect(dialog).to_have_count(0)
    expect(from_file).to_contain_text("power is Motor power")
    names = {channel["name"] for channel in fresh.get(f"/rides/{ride['id']}")["channels"]}
    assert names & {"motor_power_w", "battery_power_w"} == {"motor_power_w"}
    page.goto(f"{fresh.url}/settings")
    known = page.get_by_test_id("answered-tables")
    expect(known).to_contain_text("cadence: kept under its own name · pack: Battery voltage")
    expect(known).to_contain_text("power: Motor power · month before day · Europe/Berlin")
    known.get_by_role("button", name="Forget").click()
    fresh.ask("DELETE", f"/rides/{ride['id']}")


def done_of(page: Page) -> int:
    found = re.match(r"(\d+) of", page.get_by_test_id("batch-progress").inner_text())
    return int(found[1]) if found else 0


def test_many_files_pause_go_on_and_end_in_one_summary(
    open_desk: OpenDesk, fresh: SpindleServer
) -> None:
    before = fresh.get("/rides")["total"]
    files: list[Any] = [
        {"name": f"ride {day}.fit", "mimeType": "", "buffer": ride_of_day(day)}
        for day in range(FILES)
    ]
    files[7]["buffer"] = files[7]["buffer"][: len(files[7]["buffer"]) * 2 // 3]
    page = open_desk(address=fresh.url).open("/rides")
    # Those that begin after the first few are held until it pauses.
    held: list[Route] = []
    begun: list[str] = []

    def begin(route: Route) -> None:
        begun.append(route.request.url)
        if len(begun) > BEFORE_PAUSE:
            held.append(route)
        else:
            route.continue_()

    page.route("**/api/v1/uploads", begin)
    page.get_by_label("Choose files…").set_input_files(files)
    eventually(lambda: (done_of(page), len(held)), lambda seen: seen == (BEFORE_PAUSE, AT_ONCE))

    page.get_by_role("button", name="Pause").click()

    expect(page.get_by_role("button", name="Go on")).to_be_visible()
    for route in held:
        with page.expect_response("**/api/v1/uploads"):
            route.continue_()
    page.unroute_all()
    assert (done_of(page), len(begun)) == (BEFORE_PAUSE, BEFORE_PAUSE + AT_ONCE)
    assert fresh.get("/rides")["total"] == before + BEFORE_PAUSE
    page.get_by_role("button", name="Go on").click()
    expect(page.locator("h2", has_text=f"{FILES} files are in")).to_be_visible()
    expect(page.get_by_test_id("batch-complete")).to_contain_text(f"{FILES - 1} read completely")
    damaged = page.get_by_test_id("batch-partial")
    damaged.locator("summary").click()
    expect(damaged).to_contain_text("ride 7.fit")
    assert fresh.get("/rides")["total"] == before + FILES


def ride_of_day(day: int) -> bytes:
    start_s = START_S + DAY_S * (day + 1)
    return fit_ride(start_s, [18.0] * ROWS_S, [80] * ROWS_S, [150] * ROWS_S)
