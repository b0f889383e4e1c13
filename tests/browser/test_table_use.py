"""Goal: whoever edits the rules sees which of them the bike's rides reach, and that the right-hand
columns hardly act; nothing moves when that comes.

Method: a unit with two rides whose every sample stands on a point of the table, so that the shares
are known: 96, 3, 0.6, 0.2 and 0.2 % of 100 s in the columns, 99 s of them at 10 km/h.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Route, expect

from backend.store import open_store
from tests.browser.conftest import OpenDesk
from tests.browser.desk import sideways
from tests.browser.judged import JUDGE
from tests.browser.test_tune_page import open_tune
from tests.fakes.kept_rides import recorded_ride
from tests.fakes.server import ServerHere, SpindleServer

UNIT = ["sim:ridden?seed=5&scenario=none"]
STARTED_US = 1_760_000_000_000_000
# Rows of 10 ms at one place of the table: speed, torque rate, how many.
RIDES = (
    ((10.0, 0.0, 9600), (10.0, 0.225, 300)),
    ((5.0, 0.45, 60), (5.0, 0.675, 20), (5.0, 0.9, 20)),
)
STEADY = {
    "assist_mode": 3.0,
    "cadence_rpm": 60.0,
    "motor_torque_nm": 0.9,
    "motor_torque_demanded_nm": 1.0,
    "motor_speed_rpm": 2400.0,
    "fuzzy_gain": 0.3,
}
"""Sport, which runs by the first table; 0.9 Nm at 2400 r/min are 226.2 W."""
NAMES = ("speed_kmh", "torque_rate", *STEADY)
SHARES = "[data-testid=column-share]"
USE = "[data-testid=table-use]"
HERE = "[data-testid=ridden-here]"
ASKED = "**/rides/table-use"


def write_rides(data: Path, unit_key: str) -> None:
    """Puts the rides on the shelf of a server that is not running."""
    with open_store(f"sqlite:///{data}/spindle.db", (data / "objects").as_uri()) as store:
        for number, places in enumerate(RIDES):
            parts = [
                np.tile([speed_kmh, rate, *STEADY.values()], (rows, 1))
                for speed_kmh, rate, rows in places
            ]
            columns = dict(zip(NAMES, np.concatenate(parts).T, strict=True))
            started_us = STARTED_US + number * 3_600_000_000
            recorded_ride(store, columns, 10_000, started_us, unit_key=unit_key)


@pytest.fixture(scope="module")
def shop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """A server whose unit has ridden."""
    data = tmp_path_factory.mktemp("ridden")
    with ServerHere(data, UNIT) as before:
        before.ready_device()
        unit_key = before.get("/devices")["items"][0]["unit_key"]
    write_rides(data, unit_key)
    with ServerHere(data, UNIT) as running:
        running.ready_device()
        yield running


def test_the_grid_tells_how_much_of_the_time_each_column_acted(
    open_desk: OpenDesk, shop: SpindleServer
) -> None:
    desk = open_desk(width=1440, height=900, address=shop.url)
    page = open_tune(desk)

    expect(page.locator(SHARES)).to_have_text(["96 %", "3.0 %", "0.6 %", "0.2 %", "0.2 %"])
    expect(page.locator(USE)).to_contain_text(
        "Columns right of 0.225 acted 1.0 % of the assisted time in your last 2 rides: changes "
        "there are hardly felt."
    )
    expect(page.get_by_role("columnheader", name="0.225 3.0 %")).to_be_visible()
    desk.picture("tune-table-use")


def test_a_cell_tells_its_time_and_energy_and_one_never_reached_is_hatched(
    open_desk: OpenDesk, shop: SpindleServer
) -> None:
    page = open_tune(open_desk(address=shop.url))
    ridden, never = page.locator("[data-cell='1,0']"), page.locator("[data-cell='4,4']")

    # 96 s at 226.2 W are 6.03 Wh.
    ridden.click()
    expect(page.locator(HERE)).to_contain_text("96 % of the assisted time, 1:36, 6.03\u00a0Wh")
    expect(ridden).to_have_accessible_name(re.compile("96 % of the assisted time$"))
    expect(ridden).not_to_have_css("background-image", re.compile("gradient"))
    never.click()
    expect(page.locator(HERE)).to_have_text("Never reached in your last 2 rides.")
    expect(never).to_have_accessible_name(re.compile("never reached$"))
    expect(never).to_have_css("background-image", re.compile("gradient"))
    expect(page.locator(USE)).to_contain_text("Hatched: never reached.")


def test_a_point_that_is_moved_moves_the_shares(open_desk: OpenDesk, shop: SpindleServer) -> None:
    page = open_tune(open_desk(address=shop.url))
    expect(page.locator(SHARES).nth(1)).to_have_text("3.0 %")

    page.fill("input[aria-label='Torque rate 2']", "0.1")

    # 0.225 is now 0.125/0.35 of the way to the next point, which gets so much of the 3 s.
    expect(page.locator(SHARES).nth(1)).to_have_text("1.9 %")
    expect(page.locator(SHARES).nth(2)).to_have_text("1.7 %")


def test_no_table_is_asked_about_twice(open_desk: OpenDesk, shop: SpindleServer) -> None:
    desk = open_desk(address=shop.url)
    asked: list[Any] = []
    desk.page.on(
        "request",
        lambda request: (
            asked.append(request.post_data_json) if request.url.endswith("/table-use") else None
        ),
    )
    page = open_tune(desk)
    expect(page.locator(SHARES).first).to_have_text("96 %")
    page.locator("[role=slider][aria-label='Torque rate 2']").focus()

    for _ in range(5):
        page.keyboard.press("ArrowLeft")
    expect(page.locator(SHARES).nth(1)).not_to_have_text("3.0 %")
    page.get_by_role("tab", name="Second table").click()
    expect(page.locator(USE)).to_contain_text("Nothing in your last 2 rides")

    points = [(one["table"], one["torque_rate_points"][1]) for one in asked]
    # On the way a slow machine may ask about points between; never about the same again.
    assert points[0] == ("first", 0.225)
    assert points[-2:] == [("first", 0.2), ("second", 0.2)]
    assert len(set(points)) == len(points)


def test_a_table_that_nobody_rode_says_so(open_desk: OpenDesk, shop: SpindleServer) -> None:
    page = open_tune(open_desk(address=shop.url), "/tune?table=second")

    expect(page.locator(USE)).to_have_text(
        "Nothing in your last 2 rides was assisted by this table: ride in a mode that uses it."
    )
    expect(page.locator(SHARES)).to_have_text(["—"] * 5)
    expect(page.locator(HERE)).to_have_text("Ridden here: —")


@pytest.mark.parametrize("width", [1440, 1024, 390])
def test_nothing_moves_when_the_rides_are_looked_through(
    open_desk: OpenDesk, shop: SpindleServer, width: int
) -> None:
    desk = open_desk(width=width, height=900, address=shop.url)
    held: list[Route] = []
    desk.page.route(ASKED, lambda route: held.append(route))
    page = open_tune(desk)
    places = [
        page.locator("[data-cell='4,4']"),
        page.get_by_test_id("label-strip"),
        page.locator("section[aria-labelledby=rules]"),
        page.locator("section[aria-labelledby=sets]"),
    ]
    expect(page.locator(USE)).to_have_text("Looking through your rides…")
    before = [place.bounding_box() for place in places]

    held[-1].continue_()

    expect(page.locator(SHARES).first).to_have_text("96 %")
    assert [place.bounding_box() for place in places] == before
    assert sideways(page) == 0


def test_that_the_rides_cannot_be_looked_through_is_told(
    open_desk: OpenDesk, shop: SpindleServer
) -> None:
    desk = open_desk(address=shop.url)
    problem = '{"status": 409, "code": "conflict", "detail": "The rides are being moved."}'
    desk.page.route(
        ASKED,
        lambda route: route.fulfill(
            status=409, content_type="application/problem+json", body=problem
        ),
    )
    page = open_tune(desk)

    expect(page.locator(USE)).to_contain_text("The rides are being moved.")
    expect(page.locator(SHARES)).to_have_text(["—"] * 5)


def test_points_that_the_rides_use_are_shown_before_they_are_taken_and_undone(
    open_desk: OpenDesk, shop: SpindleServer
) -> None:
    desk = open_desk(address=shop.url)
    rescale = desk.page.get_by_role("button", name="Rescale the torque-rate points")
    open_tune(desk)
    # These rides' torque rose for 4 s: too little to propose anything.
    expect(desk.page.locator(SHARES).first).to_have_text("96 %")
    expect(rescale).to_be_disabled()

    def proposing(route: Route) -> None:
        answer = route.fetch()
        points = [0.0, 0.05, 0.1, 0.2, 0.4]
        route.fulfill(
            response=answer, json={**answer.json(), "torque_rate_points_proposed": points}
        )

    desk.page.route(ASKED, proposing)
    page = open_tune(desk)
    rescale.click()
    dialog = page.get_by_role("dialog", name="Torque-rate points that your rides use")
    rows = dialog.get_by_test_id("rescale").get_by_role("row")
    expect(rows.nth(1)).to_have_accessible_name("Now 0 0.225 0.45 0.675 0.9")
    expect(rows.nth(3)).to_have_accessible_name("Proposed 0 0.05 0.1 0.2 0.4")
    # 0.225 lies an eighth of the way from 0.2 to 0.4: of its 3 s the fourth set has 2.6 s.
    expect(rows.nth(4)).to_have_accessible_name("Time 96 % 0 % 0 % 2.6 % 1.4 %")
    expect(dialog.get_by_test_id("rescale-lint")).to_be_visible()
    dialog.get_by_role("button", name="Take it into the draft").click()

    third = page.get_by_role("textbox", name="Torque rate 3")
    expect(third).to_have_value("0.1")
    page.get_by_test_id("draft-bar").get_by_role("button", name="Undo").click()
    expect(third).to_have_value("0.45")
    expect(page.get_by_test_id("draft-bar")).to_contain_text("Same as in the unit")


@pytest.mark.parametrize(
    ("width", "theme", "language"),
    [(1440, "dark", "en-GB"), (390, "light", "en-GB"), (390, "dark", "zh-CN")],
)
def test_shares_and_hatching_are_for_everyone(
    open_desk: OpenDesk, shop: SpindleServer, axe: str, width: int, theme: Any, language: str
) -> None:
    desk = open_desk(width=width, height=844, theme=theme, language=language, address=shop.url)
    page = open_tune(desk)
    expect(page.locator(SHARES).first).to_have_text("96 %")

    page.evaluate(axe)

    assert page.evaluate(JUDGE) == []
    desk.picture(f"tune-table-use-{width}-{theme}", full=width < 800)
