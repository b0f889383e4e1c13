"""Goal: one number field everywhere, and none that drops or turns a part of what is typed.

Method: of every page that has some, every number field (`make test`: one in eleven) goes through
the same table of inputs. What a text means is as people speak it; a field takes that number or says
that it does not, with the text still in it.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
from playwright.sync_api import Locator, Page, expect

from tests import counts
from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.browser.recorded_ride import record_ride
from tests.fakes.server import SpindleServer

pytestmark = [pytest.mark.slow, pytest.mark.large_count]

FIELDS = "span.number-field > input"
# As typed, and the only numbers that may stand for it in the field: rounded as the unit is.
MEANT = {
    "2,5": "2.5",
    "2.5": "2.5",
    " 2,50 ": "2.5",
    "1 234,5": "1234.5",
    "1.234,5": "1234.5",
    "２．５": "2.5",
}
NONSENSE = ["2,5,5", "12 stone", "0x10", "1e", "--3"]


def said_wrong(field: Locator) -> bool:
    return field.get_attribute("aria-invalid") == "true"


def take(desk: Desk, field: Locator, text: str, pasted: bool) -> None:
    """Types or pastes over what is there, and goes on; what the page asks then is answered."""
    page = desk.page
    field.focus()
    page.keyboard.press("Control+A")
    if pasted:
        page.evaluate("text => navigator.clipboard.writeText(text)", text)
        page.keyboard.press("Control+V")
    else:
        page.keyboard.insert_text(text)
    field.blur()
    desk.settle()


def put_through_the_table(desk: Desk, field: Locator) -> list[str]:
    """What a field does wrong, a line each; it has its first value afterwards."""
    name = field.get_attribute("aria-label")
    faults = []
    for i, (text, meant) in enumerate({**MEANT, **dict.fromkeys(NONSENSE, "")}.items()):
        take(desk, field, text, pasted=i % 2 == 1)
        shown = field.input_value()
        if shown != meant and not (said_wrong(field) and shown == text):
            faults.append(f"{name}: {text!r} became {shown!r}")
        if meant == "" and not said_wrong(field):
            faults.append(f"{name}: takes {text!r}")
    return faults


def wheel_and_keys(page: Page, field: Locator) -> list[str]:
    """The wheel leaves it alone, an arrow moves it, Escape takes back."""
    name = field.get_attribute("aria-label")
    faults = []
    first = field.input_value()
    field.focus()
    field.hover()
    page.mouse.wheel(0, -400)
    if field.input_value() != first:
        faults.append(f"{name}: the wheel turned {first} into {field.input_value()}")
    page.keyboard.press("ArrowUp")
    page.keyboard.press("ArrowDown")
    moved = field.input_value()
    if first and abs(float(moved) - float(first)) > 0.1 * abs(float(first)) + 1.0:
        faults.append(f"{name}: arrows turned {first} into {moved}")
    page.keyboard.type("7x")
    page.keyboard.press("Escape")
    if field.input_value() != first:
        faults.append(f"{name}: Escape left {field.input_value()}")
    return faults


def faults_of_fields(desk: Desk, least: int) -> list[str]:
    """What the number fields of a page do wrong; there are so many at least."""
    in_page = desk.page.locator("main").locator(FIELDS)
    expect(in_page.nth(least - 1)).to_be_visible()
    fields = [one for one in in_page.all() if one.is_enabled()]
    return [
        fault
        for field in counts.some(fields)
        for fault in [*wheel_and_keys(desk.page, field), *put_through_the_table(desk, field)]
    ]


def tune(desk: Desk, ride: int) -> Page:
    page = desk.open("/tune")
    page.get_by_role("region", name="Gain surface").get_by_role("combobox").first.select_option(
        "Requested, power"
    )
    return page


def calibrate(desk: Desk, ride: int) -> Page:
    page = desk.open("/sensor")
    page.get_by_role("button", name="Begin a calibration").click()
    page.get_by_test_id("calibration-setup").locator("details summary").click()
    expect(page.get_by_test_id("workbench").locator(FIELDS)).to_have_count(3)
    return page


def try_again(desk: Desk, ride: int) -> Page:
    return desk.open(f"/tune/try?ride={ride}&with=ride")


def settings(desk: Desk, ride: int) -> Page:
    return desk.open("/settings")


def modes(desk: Desk, ride: int) -> Page:
    return desk.open("/tune/modes")


@pytest.mark.parametrize(
    ("way", "least"), [(tune, 16), (modes, 12), (calibrate, 15), (try_again, 2), (settings, 2)]
)
def test_every_number_field_reads_what_is_meant_or_says_that_it_does_not(
    open_desk: OpenDesk,
    server: SpindleServer,
    standing: str,
    way: Callable[[Desk, int], Page],
    least: int,
) -> None:
    desk = open_desk(width=1440, height=900)
    server.simulate(standing, clock="virtual")
    ride = record_ride(server, standing) if way is try_again else 0
    server.simulate(standing, clock="real")

    way(desk, ride)

    assert faults_of_fields(desk, least) == []
