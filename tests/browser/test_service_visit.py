"""Goal: a dealer takes a bike in and gives it back: what was wrong, found, changed and built in is
kept as it is typed, closed, and its owner agrees to it on a phone or by a signature.

Method: a server with the workshop's people and a simulated unit with a fault, a dealer at a screen
and the bike's owner with a phone, each in a real browser; axe-core; a page in print.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Page, Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.recorded_ride import record_ride
from tests.browser.workshop_desk import check, sign_in
from tests.fakes.workshop import Workshop, open_workshop

OPEN = "**/api/v1/bikes/*/visits"


@pytest.fixture
def workshop(tmp_path: Path) -> Iterator[Workshop]:
    with open_workshop(tmp_path) as opened:
        # What is asked without a name is Anna's.
        opened.server.client = opened.clients["Anna"]
        yield opened


@pytest.fixture
def unit(workshop: Workshop) -> tuple[str, int]:
    """A unit at rest, and its bike, which is Rita's."""
    device = workshop.server.add_unit("sim:one?seed=1&clock=real")
    bike = workshop.ask("Ben", "GET", f"/devices/{device}")["bike_id"]
    workshop.ask("Ben", "PATCH", f"/bikes/{bike}", json={"name": "City 7"})
    workshop.pair(bike, "Rita")
    return device, bike


def photo(width: int = 1200, height: int = 900) -> bytes:
    picture = io.BytesIO()
    Image.new("RGB", (width, height), "sienna").save(picture, "JPEG")
    return picture.getvalue()


def sign(page: Page) -> None:
    """Draws something in the field for a signature."""
    box = page.get_by_role("img", name=re.compile("^Signature")).bounding_box()
    assert box is not None
    x, y = box["x"], box["y"]
    page.mouse.move(x + 20, y + 40)
    page.mouse.down()
    for step in range(1, 12):
        page.mouse.move(x + 20 + 15 * step, y + 40 + 20 * (step % 2))
    page.mouse.up()


def test_a_bike_is_taken_in_and_given_back(
    open_desk: OpenDesk, workshop: Workshop, unit: tuple[str, int], axe: str
) -> None:
    device, bike = unit
    workshop.server.simulate(device, faults={"torque_sensor": "open_high"})
    desk = open_desk(1440, 1000, address=workshop.server.url)
    dealer = sign_in(desk, workshop, "Ben")
    desk.open("/service")
    sheet = dealer.get_by_test_id("job-sheet")
    expect(sheet).to_contain_text("No visit is open")
    expect(dealer.get_by_test_id("faults")).to_contain_text("Torque sensor")
    sheet.get_by_label("Job").fill("0815")
    sheet.get_by_label("Complaint").fill("No help since this afternoon")
    expect(sheet).to_contain_text("kept as you type")
    expect(sheet).to_contain_text(re.compile(r"Before the work: read .*active faults: 1"))

    workshop.server.simulate(device, faults={"torque_sensor": "sound"})
    body = {"parameters": {"pedal_stop_ms": 210.0}, "reason": "stops late"}
    workshop.ask("Ben", "PATCH", f"/devices/{device}/config", json=body)
    sheet.get_by_role("button", name="Add a part").click()
    sheet.get_by_label("Part", exact=True).fill("Spindle plug")
    sheet.get_by_label("Done").fill("Plug dried, pin 3 bent back")
    sheet.locator("input[type=file]").set_input_files(
        {"name": "plug.jpg", "mimeType": "image/jpeg", "buffer": photo()}
    )
    expect(sheet.get_by_role("img", name="plug.jpg")).to_be_visible()
    check(dealer, axe)
    desk.picture("service-visit", full=True)
    dealer.reload()
    expect(sheet.get_by_label("Done")).to_have_value("Plug dried, pin 3 bent back")
    expect(sheet.get_by_label("Part", exact=True)).to_have_value("Spindle plug")
    sheet.get_by_role("button", name="Close the visit").click()
    dealer.wait_for_url(re.compile(r"/visits/\d+$"))
    visit = dealer.get_by_test_id("visit")
    expect(visit).to_contain_text("No help since this afternoon")
    expect(dealer.get_by_test_id("changed")).to_contain_text("210 ms")
    expect(dealer.get_by_test_id("changed")).to_contain_text("stops late")
    expect(dealer.get_by_test_id("visit-faults")).to_contain_text("Torque sensor")
    expect(dealer.get_by_test_id("visit-checks")).to_contain_text("Battery voltage")
    check(dealer, axe)
    desk.picture("visit", full=True)
    place = dealer.url.removeprefix(workshop.server.url)

    phone = open_desk(390, 844, "dark", address=workshop.server.url, touch=True)
    rider = sign_in(phone, workshop, "Rita")
    phone.open(f"/fleet/{bike}")
    rider.get_by_test_id("visits").get_by_role("link").first.click()
    expect(rider.get_by_test_id("visit")).to_contain_text("pin 3 bent back")
    rider.get_by_role("button", name="I agree with what was done").click()
    expect(rider.get_by_test_id("consent")).to_contain_text("Rita consented")
    check(rider, axe)
    phone.picture("visit-phone", full=True)

    desk.open(place)
    expect(dealer.get_by_test_id("consent")).to_contain_text("Rita consented")


CALIBRATION = {
    **{"id": 3, "closed_at": "2026-11-22T14:50:00Z", "author": "Ben", "sha256": "c" * 64},
    **{"verdict": "pass", "linearity_pct": 0.25, "hysteresis_pct": 0.13, "expanded_nm": 0.76},
}


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_sheet_is_a_page_of_paper_with_the_ride_after_the_work(
    open_desk: OpenDesk, workshop: Workshop, unit: tuple[str, int], theme: str
) -> None:
    device, bike = unit
    server = workshop.server
    words = {"job": "0815", "complaint": "It bucks", "done": "Plug dried", "device_id": device}
    visit = workshop.ask("Ben", "POST", f"/bikes/{bike}/visits", json=words)["id"]
    body = {"parameters": {"pedal_stop_ms": 210.0}, "reason": "stops late"}
    workshop.ask("Ben", "PATCH", f"/devices/{device}/config", json=body)
    server.simulate(device, clock="virtual")
    # A ride begins two seconds before the bike moves.
    server.advance(device, 3.0)
    record_ride(server, device)
    server.simulate(device, clock="real")
    ridden_at = datetime.now(UTC).isoformat()
    desk = open_desk(1440, 900, theme, address=server.url)
    dealer = sign_in(desk, workshop, "Ben")

    def later(route: Route) -> None:
        """By the wall's clock, which stood while it was ridden, it began before the change."""
        rides = route.fetch(url=re.sub(r"&(from|to)=[^&]*", "", route.request.url)).json()
        for ride in rides["items"]:
            ride["started_at"] = ridden_at
        route.fulfill(json=rides)

    def calibrated(route: Route) -> None:
        """As with a calibration meanwhile, which takes a bench and a quarter of an hour."""
        found = route.fetch().json()
        found["content"]["calibrations"] = [CALIBRATION]
        route.fulfill(json=found)

    dealer.route("**/api/v1/rides?*", later)
    dealer.route(f"**/api/v1/visits/{visit}", calibrated)
    desk.open("/service")
    dealer.get_by_role("button", name="Service sheet").click()
    dealer.wait_for_url(re.compile(rf"/visits/{visit}$"))
    after = dealer.get_by_test_id("after-work")
    expect(after).to_contain_text(re.compile(r"Ride after the work, \d+:\d\d"))
    expect(after.get_by_role("img")).to_have_count(2)
    expect(after).to_contain_text(re.compile(r"speed, 0 to [12]\d\skm/h"))
    expect(after).to_contain_text(re.compile(r"motor power, 0 to \d+\sW"))
    expect(after).to_contain_text("Held back by")
    desk.picture(f"visit-sheet-screen-{theme}", full=True)

    dealer.emulate_media(media="print")

    sheet = dealer.get_by_test_id("visit")
    serial = server.get(f"/devices/{device}")["identity"]["serial_number"]
    for text in ("job 0815", "It bucks", "Plug dried", serial, "210 ms", "Battery voltage"):
        expect(sheet).to_contain_text(text)
    expect(sheet.get_by_test_id("calibrated")).to_contain_text("0.76")
    expect(dealer.get_by_text("Technician, date")).to_be_visible()
    expect(dealer.locator("nav").first).to_be_hidden()
    expect(dealer.get_by_role("button").locator("visible=true")).to_have_count(0)
    assert dealer.evaluate("getComputedStyle(document.documentElement).color") == "rgb(0, 0, 0)"
    pages = dealer.pdf(format="A4", print_background=True)
    assert len(re.findall(rb"/Type\s*/Page[^s]", pages)) == 1
    desk.picture(f"visit-sheet-{theme}", full=True)


def test_a_visit_is_signed_in_the_workshop_and_its_history_goes_on(
    open_desk: OpenDesk, workshop: Workshop, unit: tuple[str, int], axe: str, tmp_path: Path
) -> None:
    _, bike = unit
    desk = open_desk(1024, 800, address=workshop.server.url)
    dealer = sign_in(desk, workshop, "Ben")
    body = {"done": "Chain oiled", "customer": "Grandma"}
    visit = workshop.ask("Ben", "POST", f"/bikes/{bike}/visits", json=body)["id"]
    workshop.ask("Ben", "POST", f"/visits/{visit}/close")

    desk.open(f"/visits/{visit}")
    dealer.get_by_role("button", name="Sign…").click()
    dialog = dealer.get_by_role("dialog")
    expect(dialog.get_by_label("Name of the owner")).to_have_value("Grandma")
    take = dialog.get_by_role("button", name="This is my signature")
    expect(take).to_be_disabled()
    sign(dealer)
    check(dealer, axe)
    take.click()
    expect(dealer.get_by_test_id("consent")).to_contain_text("Grandma signed in the workshop")

    desk.open(f"/fleet/{bike}")
    with dealer.expect_download() as history:
        dealer.get_by_role("link", name="Save as a file").click()
    saved = tmp_path / "history.zip"
    history.value.save_as(saved)
    panel = dealer.get_by_test_id("visits")
    panel.locator("input[type=file]").set_input_files(saved)
    expect(dealer.get_by_text("0 visits added, 1 were here already.")).to_be_visible()
    check(dealer, axe)


def test_what_is_typed_survives_a_server_that_is_away(
    open_desk: OpenDesk, workshop: Workshop, unit: tuple[str, int]
) -> None:
    _, bike = unit
    desk = open_desk(1440, 900, address=workshop.server.url)
    desk.allowed.append(re.compile("Failed to load resource: net::ERR_FAILED"))
    dealer = sign_in(desk, workshop, "Ben")
    desk.open("/service")
    sheet = dealer.get_by_test_id("job-sheet")
    expect(sheet).to_contain_text("No visit is open")
    dealer.route(OPEN, lambda route: route.abort())
    sheet.get_by_label("Complaint").fill("It whistles")
    expect(sheet.get_by_role("status")).not_to_contain_text("No visit is open")
    dealer.unroute(OPEN)

    dealer.reload()

    expect(sheet.get_by_label("Complaint")).to_have_value("It whistles")
    expect(sheet).to_contain_text("kept as you type")
    [visit] = workshop.ask("Ben", "GET", f"/bikes/{bike}/visits")["items"]
    assert visit["content"]["complaint"] == "It whistles"
