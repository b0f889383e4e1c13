"""Goal: a ride is looked at by map, brush, chips, axis, cursor and keys, and a link holds the view.

Method: a file of a ride on paper, an hour along a square with a gap in its positions, a pause of
the recorder and a channel that only its maker knows; what is drawn is compared with the paper.
"""

from __future__ import annotations

import re
from urllib.parse import parse_qs

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.test_rides_page import TRACES, drop_file, long_ride
from tests.fakes.fit_file import START_S, Record, fit_file
from tests.fakes.server import SpindleServer, eventually

SIDE_S = 600
SPEED_KMH = 18.0
STEP_DEG = 4.5e-5  # 5 m a second of latitude, SPEED_KMH


def square(start_s: int) -> bytes:
    """Four sides of 3 km; no positions on the middle of the second, the third begins 60 s late."""
    rows: list[Record] = []
    north = east = 0
    for second in range(4 * SIDE_S):
        side = second // SIDE_S
        north += (1, 0, -1, 0)[side]
        east += (0, 1, 0, -1)[side]
        known = not SIDE_S + 200 <= second < SIDE_S + 400
        late_s = 60 if side >= 2 else 0
        rows.append(
            {
                "timestamp": start_s + second + late_s,
                "position_lat": north * STEP_DEG if known else None,
                "position_long": 11.0 + east * STEP_DEG if known else None,
                "speed": SPEED_KMH / 3.6,
                "heart_rate": 100 + side,
                "enhanced_altitude": 500.0 + 20.0 * (side == 1),
            }
        )
    return fit_file(rows)


def open_square(desk: Desk, number: int) -> Page:
    page = desk.open("/rides")
    drop_file(page, f"square {number}.fit", square(START_S + 100_000 * number))
    page.click("text=Open the ride")
    page.wait_for_selector(f"{TRACES}[data-draws]")
    page.wait_for_selector("[data-testid=track-map] path.segment")
    return page


def asked_for(page: Page) -> dict[str, str]:
    # Of the page itself: Playwright hears of a change that comes later only when it is asked.
    query = str(page.evaluate("location.search"))[1:]
    return {name: values[0] for name, values in parse_qs(query).items()}


def press(desk: Desk, t_s: float) -> None:
    """On the traces, where that second is drawn."""
    left = desk.plot(f"gd._fullLayout.xaxis._offset + gd._fullLayout.xaxis.l2p({t_s})")
    desk.page.locator(TRACES).click(position={"x": left, "y": 60})


def test_the_map_is_open_where_there_was_no_position(desk: Desk) -> None:
    page = open_square(desk, 1)
    track = page.get_by_test_id("track-map")

    # 12 km in all: a mark every 2 km, without the two that lie in gaps or at the end.
    expect(track.get_by_test_id("km-mark").first).to_contain_text("2")
    expect(track.locator("path.segment")).to_have_count(3)
    ends = track.locator("path.segment").evaluate_all(
        "paths => paths.map((p) => [p.getPointAtLength(0),"
        " p.getPointAtLength(p.getTotalLength())].map(({x, y}) => [x, y]))"
    )
    (_, before), (after, _) = ends[0], ends[1]
    assert after[0] - before[0] > 30  # 1 km east of a square of 3 km on 240 pixels
    assert after[1] == pytest.approx(before[1], abs=1.5)
    desk.picture("ride-map", full=True)


def test_a_press_reads_every_channel_on_traces_map_and_list(desk: Desk) -> None:
    page = open_square(desk, 2)

    press(desk, SIDE_S + 100)

    expect(page.get_by_test_id("cursor-at")).to_contain_text("11:4")
    expect(page.locator(".reading").first).to_have_text("18.0 km/h")
    expect(page.get_by_test_id("track-cursor")).to_contain_text("18.0 km/h")
    page.get_by_test_id("read-out").locator("summary").click()
    expect(page.locator("[data-channel=heart_rate_bpm] dd")).to_have_text("101\u00a0bpm")
    expect(page.locator("[data-channel=altitude_m] dd")).to_have_text("520\u00a0m")


def test_keys_move_cursor_and_window(desk: Desk) -> None:
    page = open_square(desk, 3)
    press(desk, 300)
    at_s = float(eventually(lambda: asked_for(page).get("t_s"), bool))

    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowRight")
    eventually(lambda: float(asked_for(page)["t_s"]), lambda t_s: abs(t_s - at_s - 61) < 0.02)
    page.keyboard.press("+")
    eventually(lambda: asked_for(page), lambda asked: "from_s" in asked)
    page.keyboard.press("w")
    eventually(lambda: asked_for(page), lambda asked: "from_s" not in asked)


def test_a_key_that_is_held_changes_the_address_seldom_and_ends_there(desk: Desk) -> None:
    page = open_square(desk, 6)
    press(desk, 300)
    page.evaluate(
        """() => {
            window.written = 0
            const replace = history.replaceState.bind(history)
            history.replaceState = (...told) => { window.written++; replace(...told) }
        }"""
    )

    # As a key repeats, for two seconds.
    page.evaluate(
        """async () => {
            for (let i = 0; i < 60; i++) {
                document.body.dispatchEvent(
                    new KeyboardEvent('keydown', { key: 'ArrowRight', bubbles: true }))
                await new Promise((done) => setTimeout(done, 33))
            }
        }"""
    )

    eventually(lambda: float(asked_for(page)["t_s"]), lambda t_s: abs(t_s - 360) < 5)
    # Safari's bound is one each 300 ms.
    assert page.evaluate("window.written") <= 8
    expect(page.get_by_test_id("cursor-at")).to_contain_text("6:0")


def test_a_channel_is_chosen_and_remembered(desk: Desk) -> None:
    page = open_square(desk, 4)
    chips = page.get_by_test_id("chips")

    chips.get_by_role("button", name="Latitude").click()
    chips.get_by_role("button", name="Heart rate").click()

    eventually(lambda: desk.plot("gd.data.map((d) => d.name)"), lambda names: len(names) == 3)
    eventually(
        lambda: asked_for(page).get("show"), lambda show: show == "speed,altitude,latitude_deg"
    )
    page.goto(str(page.evaluate("location.origin + location.pathname")))
    expect(chips.get_by_role("button", name="Latitude")).to_have_attribute("aria-pressed", "true")
    expect(chips.get_by_role("button", name="Heart rate")).to_have_attribute(
        "aria-pressed", "false"
    )


def test_the_way_as_axis_leaves_the_pause_out(desk: Desk) -> None:
    page = open_square(desk, 5)

    page.get_by_label("Axis").select_option("distance")

    eventually(
        lambda: desk.plot("gd._fullLayout.xaxis.range"),
        lambda span: span[0] == 0 and span[1] == pytest.approx(12_000, rel=0.01),
    )
    assert "km" in desk.plot("gd._fullLayout.xaxis.ticktext[1]")
    page.get_by_label("Axis").select_option("moving")
    eventually(
        lambda: desk.plot("gd._fullLayout.xaxis.range[1]"),
        lambda end_s: end_s == pytest.approx(4 * SIDE_S, abs=2),
    )


def test_a_link_shows_what_its_sender_saw(desk: Desk, server: SpindleServer) -> None:
    query = "?from_s=600.00&to_s=900.00&axis=distance&show=speed,cadence&t_s=700.00"
    page = desk.open(f"/rides/{long_ride(server)}{query}")
    page.wait_for_selector(f"{TRACES}[data-draws]")

    eventually(lambda: desk.plot("gd.data.map((d) => d.name)"), lambda n: n == ["Speed", "Cadence"])
    expect(page.get_by_label("Axis")).to_have_value("distance")
    expect(page.get_by_test_id("points")).to_contain_text("10:00 – 15:00")
    expect(page.get_by_test_id("cursor-at")).to_contain_text("11:40")
    assert page.evaluate("location.search") == query


def test_the_brush_chooses_a_window_by_hand_and_by_keys(desk: Desk, server: SpindleServer) -> None:
    page = desk.open(f"/rides/{long_ride(server)}")
    page.wait_for_selector(f"{TRACES}[data-draws]")
    field = page.get_by_test_id("overview").get_by_role("group")
    box = field.bounding_box()
    assert box is not None

    page.mouse.move(box["x"] + box["width"] / 4, box["y"] + 20)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 20, steps=5)
    page.mouse.up()

    # A quarter to a half of two hours.
    eventually(
        lambda: [float(asked_for(page).get(name, 0)) for name in ("from_s", "to_s")],
        lambda window: window == pytest.approx([1800, 3600], abs=30),
    )
    begins = page.get_by_role("slider", name="Window begins")
    begins.press("ArrowLeft")
    # A fiftieth of the ride.
    eventually(
        lambda: float(asked_for(page)["from_s"]),
        lambda from_s: from_s == pytest.approx(1800 - 144, abs=30),
    )


@pytest.mark.parametrize("language", ["en-GB", "zh-CN"])
def test_a_phone_shows_the_first_curve_on_its_first_screen(
    open_desk: OpenDesk, server: SpindleServer, language: str
) -> None:
    desk = open_desk(width=390, height=844, language=language, touch=True)
    page = desk.open(f"/rides/{long_ride(server)}")
    page.wait_for_selector(f"{TRACES}[data-draws]")

    lowest = desk.plot("gd.getBoundingClientRect().top + gd._fullLayout.yaxis._offset"
                       " + gd._fullLayout.yaxis._length")  # fmt: skip
    bar = page.get_by_test_id("ride-bar").bounding_box()
    assert bar is not None
    assert lowest < bar["y"]
    assert sideways(page) == 0
    # A finger draws the cursor along.
    box = page.locator(TRACES).bounding_box()
    assert box is not None
    page.touchscreen.tap(box["x"] + 200, box["y"] + 60)
    expect(page.get_by_test_id("cursor-at")).to_contain_text(re.compile(r"\d:\d\d"))
    desk.picture(f"ride-phone-{language}")
