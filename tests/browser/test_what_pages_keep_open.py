"""Goal: what somebody has open on a page is there again after a reload, another unit on the cable,
an update of the server and a session that ended elsewhere.

Method: every page of the list of pages (app/pages.ts) is either here, with what is opened on it and
where it shows, or among those that keep nothing but the line that is being typed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.test_edits_are_kept import NEW_VERSION, updated
from tests.browser.test_signing_in import OWN, PASSWORD, Workshop, fill_in, workshop_in
from tests.fakes.cable import A, B, Cable

pytestmark = pytest.mark.slow

LIST_OF_PAGES = Path(__file__).parents[2] / "frontend/src/app/pages.ts"
ON_THE_WAY = "status of 50[34]|status of 40[14]|WebSocket|ERR_CONNECTION|dynamically imported|MIME"


@dataclass(frozen=True)
class Open:
    """path: of the page. work: what is opened or typed. field: where it shows. value: what."""

    path: str
    work: Callable[[Page], None]
    field: Callable[[Page], Locator]
    value: str


def crank(page: Page) -> Locator:
    return page.get_by_label("Crank length").first


def plan_a_calibration(page: Page) -> None:
    page.get_by_role("button", name="Begin a calibration").click()
    crank(page).fill("165")
    crank(page).blur()


OPEN = {
    "modes": Open(
        "/tune/modes",
        lambda page: page.get_by_label("Assist ratio, mode 1 eco").fill("0.8"),
        lambda page: page.get_by_label("Assist ratio, mode 1 eco"),
        "0.8",
    ),
    "sensor": Open("/sensor", plan_a_calibration, crank, "165"),
    "service": Open(
        "/service",
        lambda page: page.get_by_label("Complaint").fill("cuts out on climbs"),
        lambda page: page.get_by_label("Complaint"),
        "cuts out on climbs",
    ),
}
# Its edits, and the reason that was being typed: test_edits_are_kept.py and
# test_another_bike_on_the_cable.py.
ELSEWHERE = {"tune"}
# What is asked of these is in their address, what is set is set at once, and a line that is being
# typed goes with Enter.
NOTHING_OPEN = {"bike", "compare", "connect", "live", "try", "why", "library", "rides", "ride"} | {
    "audit",
    "fleet",
    "fleet_bike",
    "settings",
    "unknown",
    "visit",
}


def shows(page: Page, kept: Open, is_there: bool = True) -> None:
    """Whether a page shows what was opened on it."""
    field = kept.field(page).first
    if is_there:
        expect(field).to_have_value(kept.value)
    elif kept.path == "/sensor":
        expect(page.get_by_role("button", name="Begin a calibration")).to_be_visible()
    else:
        expect(field).not_to_have_value(kept.value)


def test_every_page_is_asked() -> None:
    names = set(re.findall(r"^ {2}(\w+): screen", LIST_OF_PAGES.read_text("utf-8"), re.MULTILINE))
    assert names == set(OPEN) | ELSEWHERE | NOTHING_OPEN


@pytest.fixture(scope="module")
def cable(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cable]:
    with Cable(tmp_path_factory.mktemp("cable")) as made:
        yield made


@pytest.mark.parametrize("name", OPEN)
def test_a_reload_another_unit_and_an_update_leave_what_is_open(
    open_desk: OpenDesk, cable: Cable, name: str
) -> None:
    kept = OPEN[name]
    desk = open_desk(address=cable.server.url)
    desk.allow(ON_THE_WAY)
    page = desk.open(kept.path)
    kept.work(page)
    shows(page, kept)

    page.reload()
    shows(page, kept)

    cable.plug(B)
    page.goto(f"{desk.address}{kept.path}")
    shows(page, kept, is_there=False)
    cable.plug(A)
    page.goto(f"{desk.address}{kept.path}")
    shows(page, kept)

    updated(page)
    page.get_by_role("link", name="Rides", exact=True).first.click()
    expect(page.locator(NEW_VERSION)).to_be_visible()
    page.unroute_all(behavior="wait")
    page.locator(NEW_VERSION).get_by_role("button", name="Load").click()
    expect(page.locator(NEW_VERSION)).to_have_count(0)
    page.goto(f"{desk.address}{kept.path}")
    shows(page, kept)
    page.context.close()


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Workshop]:
    with workshop_in(tmp_path_factory.mktemp("workshop"), OWN) as opened:
        yield opened


@pytest.fixture(scope="module")
def signed_up(workshop: Workshop) -> Workshop:
    """With its first administrator."""
    assert workshop.server.services.people is not None
    workshop.server.services.people.accounts.make_first(workshop.token, "Anna", PASSWORD)
    return workshop


@pytest.mark.parametrize("name", OPEN)
def test_a_session_that_ended_elsewhere_leaves_what_is_open(
    open_desk: OpenDesk, signed_up: Workshop, name: str
) -> None:
    kept = OPEN[name]
    desk = open_desk(address=signed_up.address)
    desk.allow(ON_THE_WAY)
    page = desk.page
    page.goto(f"{signed_up.address}/sign-in")
    fill_in(page, "Anna")
    page.get_by_test_id("person-menu").wait_for()
    page.goto(f"{signed_up.address}{kept.path}")
    kept.work(page)
    shows(page, kept)

    page.context.clear_cookies()
    page.wait_for_url("**/sign-in?back=*")
    fill_in(page, "Anna")

    page.wait_for_url(f"**{kept.path}")
    shows(page, kept)
    page.context.close()
