"""Goal: who may finds out who changed what, from what to what and why, at a desk and on a phone, in
both languages; nobody sees more than is their affair.

Method: the workshop's server with a simulated unit whose configuration was changed; each person in
a real browser; axe-core.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.workshop_desk import check, sign_in
from tests.fakes.server import eventually
from tests.fakes.workshop import Workshop, open_workshop

UNIT = "sim:audit?seed=5&clock=virtual&scenario=none"
BIKE = "Commuter 400 of the Alpine Cycling Club's second workshop"


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Workshop]:
    with open_workshop(tmp_path_factory.mktemp("audit")) as opened:
        server = opened.server
        server.client = opened.clients["Anna"]
        device = server.add_unit(UNIT)
        unit_key = server.get(f"/devices/{device}")["unit_key"]
        eventually(lambda: server.get(f"/devices/{device}/config/revisions")["items"])
        bike = opened.ask("Ben", "POST", "/bikes", json={"name": BIKE})["bike"]["id"]
        opened.ask("Ben", "PATCH", f"/bikes/{bike}", json={"unit_key": unit_key})
        opened.bikes["Ben"] = bike
        change = {"motor_torque_nm_max": 1.5, "torque_filter_s": 0.25}
        for reason, parameters in (("it bucked on the climb", change), ("", {"gear_ratio": 40.0})):
            server.until_writable(device)
            body = {"parameters": parameters, "reason": reason}
            opened.clients["Ben"].patch(f"/devices/{device}/config", json=body)
        table = opened.ask("Ben", "GET", f"/devices/{device}/parts/fuzzy_table")
        table["rules"][0] = table["rules"][1]
        server.until_writable(device)
        opened.ask("Ben", "PUT", f"/devices/{device}/parts/fuzzy_table", json=table)
        yield opened


def test_a_dealer_finds_a_change_and_what_it_changed(
    open_desk: OpenDesk, workshop: Workshop, axe: str
) -> None:
    desk = open_desk(1440, 900, address=workshop.server.url)
    page = sign_in(desk, workshop, "Ben")
    desk.open("/settings")
    page.get_by_role("link", name="See the changes").click()
    events = page.get_by_test_id("audit").get_by_role("listitem")
    expect(events.filter(has_text="Ben wrote configuration").first).to_be_visible()
    expect(page.get_by_label("About").get_by_role("option", name="Accounts")).to_have_count(0)
    expect(events.filter(has_text="signed in")).to_have_count(0)

    page.get_by_label("About").select_option(label="Configurations")
    change = events.filter(has_text="it bucked on the climb")
    expect(change).to_contain_text("Largest motor torque (shaft): 2 Nm → 1.5 Nm, and 1 more")
    change.locator("summary").click()
    row = change.get_by_role("row", name="Largest motor torque")
    expect(row.get_by_role("cell")).to_have_text(["Largest motor torque (shaft)", "2 Nm", "1.5 Nm"])
    expect(change.get_by_role("link", name=BIKE)).to_be_visible()
    check(page, axe)
    desk.picture("audit-open")

    page.get_by_label("Who").fill("nobody at all")
    expect(page.get_by_text("No event is of this kind.")).to_be_visible()
    assert page.url.endswith("/audit?who=nobody+at+all&kind=configuration")
    page.reload()
    expect(page.get_by_label("Who")).to_have_value("nobody at all")
    page.get_by_role("button", name="Show all").click()
    expect(events.filter(has_text="Olaf took Olaf's bike over")).to_have_count(1)
    with page.expect_download() as begun:
        page.get_by_role("link", name="With hashes").click()
    assert begun.value.suggested_filename.endswith(".jsonl")


def test_a_bike_s_page_leads_to_what_was_done_to_it(
    open_desk: OpenDesk, workshop: Workshop
) -> None:
    desk = open_desk(1024, 800, "dark", address=workshop.server.url)
    page = sign_in(desk, workshop, "Anna")
    desk.open(f"/fleet/{workshop.bikes['Olaf']}")
    page.get_by_role("main").get_by_role("link", name="Who changed what").click()

    events = page.get_by_test_id("audit").get_by_role("listitem")
    expect(events).to_have_count(3)
    expect(events.last).to_contain_text("Ben added the bike Olaf's bike")
    page.get_by_role("combobox", name="Bike", exact=True).select_option(label="All bikes")
    expect(events.filter(has_text="Anna signed in")).to_have_count(1)
    page.get_by_label("About").select_option(label="Accounts")
    expect(events.filter(has_text="Ben added the bike")).to_have_count(0)
    desk.picture("audit-1024-dark")


@pytest.mark.parametrize(("theme", "language"), [("dark", "zh-CN"), ("light", "en-GB")])
def test_on_a_phone_it_is_read_in_one_column(
    open_desk: OpenDesk, workshop: Workshop, axe: str, theme: str, language: str
) -> None:
    desk = open_desk(390, 844, theme, language, address=workshop.server.url, touch=True)
    page = sign_in(desk, workshop, "Ben")
    desk.open("/audit?kind=configuration")
    change = page.get_by_test_id("audit").get_by_role("listitem").filter(has_text="it bucked")
    change.locator("summary").tap()
    expect(change.get_by_role("table")).to_be_visible()
    check(page, axe)
    desk.picture(f"audit-390-{theme}-{language}", full=True)


def test_a_rider_has_no_such_page(open_desk: OpenDesk, workshop: Workshop) -> None:
    desk = open_desk(390, 844, address=workshop.server.url, touch=True)
    page = sign_in(desk, workshop, "Rita")
    desk.open("/audit")

    expect(page.get_by_text("There is no page for you at this address.")).to_be_visible()
    desk.open("/settings")
    expect(page.get_by_role("link", name="See the changes")).to_have_count(0)
