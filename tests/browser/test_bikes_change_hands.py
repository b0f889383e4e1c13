"""Goal: a workshop takes a bike in and hands it over by a code; its new owner sees their bike and
their rides on a phone, and nothing else.

Method: a server with the workshop's people, a dealer at a screen, a stranger with a phone in the
dark and a rider who speaks Chinese, each in a real browser; axe-core; a page in print.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import REFUSED
from tests.browser.workshop_desk import check, sign_in
from tests.fakes.house import PASSWORD
from tests.fakes.track_files import gpx_file, gpx_track
from tests.fakes.workshop import Workshop, open_workshop

OWN_BIKE = re.compile(r"/fleet/\d+$")


@pytest.fixture
def workshop(tmp_path: Path) -> Iterator[Workshop]:
    with open_workshop(tmp_path) as opened:
        yield opened


def test_a_bike_is_taken_in_and_handed_over_by_a_code(
    open_desk: OpenDesk, workshop: Workshop, axe: str, tmp_path: Path
) -> None:
    url = workshop.server.url
    desk = open_desk(1440, 1000, address=url)
    dealer = sign_in(desk, workshop, "Ben")
    desk.open("/fleet")
    dealer.get_by_role("button", name="Add a bike").click()
    form = dealer.get_by_role("dialog")
    form.get_by_label("Name").fill("City 7")
    form.get_by_label("Model").fill("Commuter 400")
    form.get_by_role("button", name="Add a bike").click()
    dealer.wait_for_url(OWN_BIKE)
    dealer.get_by_role("button", name="Hand over").click()
    dealer.get_by_role("button", name="Make a code").click()
    slip = dealer.get_by_test_id("pairing")
    expect(slip.get_by_role("img")).to_be_visible()
    code = re.search(r"[0-9A-Z]{4}-[0-9A-Z]{4}", slip.inner_text())
    assert code is not None
    dealer.emulate_media(media="print")
    expect(dealer.get_by_text("Scan the square")).to_be_visible()
    expect(dealer.get_by_role("navigation")).to_be_hidden()
    dealer.emulate_media(media="screen")
    check(dealer, axe)

    phone = open_desk(390, 844, "dark", address=url, touch=True)
    phone.allowed.append(REFUSED)
    rider = phone.page
    rider.goto(f"{url}/pair")
    rider.get_by_label("Code").fill("zzzz zzzz")
    rider.get_by_role("button", name="Continue").click()
    expect(rider.get_by_role("alert")).not_to_be_empty()
    rider.goto("about:blank")
    rider.goto(f"{url}/pair#{code[0].lower().replace('-', '')}")
    expect(rider.get_by_text("Commuter 400")).to_be_visible()
    check(rider, axe)
    rider.get_by_label("Name").fill("Nora")
    rider.get_by_label("Password").fill(PASSWORD)
    rider.get_by_role("button", name="Make the account").click()
    rider.wait_for_url(OWN_BIKE)
    expect(rider.get_by_role("heading", name="City 7")).to_be_visible()
    # A picture of the address, or going back, must not show the code.
    assert code[0] not in rider.evaluate("location.href + document.referrer")

    (tmp_path / "home.gpx").write_bytes(gpx_file(gpx_track((20_000, 20_600))))
    rider.goto(f"{url}/rides")
    rider.locator("input[type=file]").first.set_input_files(tmp_path / "home.gpx")
    table = rider.get_by_test_id("ride-table")
    expect(table.get_by_role("link", name="home")).to_be_visible()
    assert "Rita" not in rider.locator("body").inner_text()
    check(rider, axe)
    table.get_by_role("link", name="home").click()
    rider.get_by_test_id("traces").or_(rider.locator("main canvas").first).first.wait_for()
    check(rider, axe)

    dealer.reload()
    expect(dealer.get_by_text("Nora").first).to_be_visible()


def test_a_rider_has_pages_for_what_is_theirs_and_no_other(
    open_desk: OpenDesk, workshop: Workshop, axe: str
) -> None:
    desk = open_desk(390, 844, address=workshop.server.url, touch=True)
    page = sign_in(desk, workshop, "Rita")
    forbidden: list[str] = []
    page.on("response", lambda one: forbidden.append(one.url) if one.status == 403 else None)

    desk.open("/")
    expect(page.get_by_test_id("ride-table").get_by_role("link", name="Rita")).to_be_visible()
    places = page.get_by_role("navigation").get_by_role("link")
    names = [name for name in places.all_inner_texts() if name.strip()]
    assert {"Rides", "My bikes"} <= set(names)
    assert not {"Live", "Tune", "Service"} & set(names)
    check(page, axe)
    page.goto(f"{workshop.server.url}/fleet")
    expect(page.get_by_role("link", name="Rita's bike")).to_be_visible()
    assert "Olaf" not in page.locator("body").inner_text()
    check(page, axe)
    for path in ("/settings", f"/rides/{workshop.rides['Rita']}", "/tune", "/service"):
        page.goto(workshop.server.url + path)
        page.locator("main :is(section, p)").first.wait_for()
        desk.settle()
        check(page, axe)
    assert forbidden == []


def test_a_bike_that_is_lost_is_marked_where_it_comes_back(
    open_desk: OpenDesk, workshop: Workshop, axe: str
) -> None:
    url = workshop.server.url
    device = workshop.ask("Ben", "POST", "/devices", json={"url": "sim:found?scenario=none"})
    desk = open_desk(1024, 768, "dark", "zh-CN", address=url)
    rita = sign_in(open_desk(390, 844, address=url, touch=True), workshop, "Rita")
    dealer = sign_in(desk, workshop, "Ben")
    desk.open(f"/?device={device['id']}")
    page_of_unit = dealer.locator("main")
    expect(page_of_unit).to_contain_text("found")
    bike_id = next(
        one["bike_id"] for one in workshop.ask("Ben", "GET", "/devices")["items"] if one["bike_id"]
    )
    workshop.pair(bike_id, "Rita")

    rita.goto(f"{url}/fleet/{bike_id}")
    rita.once("dialog", lambda dialog: dialog.accept())
    rita.get_by_role("button", name="Report as lost").click()
    expect(rita.get_by_role("button", name="Found again")).to_be_visible()
    dealer.reload()

    expect(dealer.get_by_text("Rita")).to_be_visible()
    expect(dealer.get_by_text(re.compile("丢失|被盗")).first).to_be_visible()
    check(dealer, axe)
