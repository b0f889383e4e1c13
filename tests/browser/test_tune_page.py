"""Goal: a mechanic edits the table by keyboard, sees what it does, and writes it into the unit.

Expected gains come from the geometry of the sets, not from our code: with every rule PB the
centroid is that of the right-hand half triangle from 0.4 to 0.5, which is 0.4 + 2/3 of 0.1.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.fakes.server import SpindleServer, eventually

CELL = "[data-cell='0,0']"
WRITE = "dialog >> text=Write to the unit"
SURFACE = "[data-testid=surface]"
BAR = "[data-testid=draft-bar]"
GAIN_ALL_PB = 0.4 + 0.1 * 2 / 3


def open_tune(desk: Desk, address: str = "/tune") -> Page:
    page = desk.open(address)
    page.wait_for_selector(CELL)
    page.wait_for_selector(f"{SURFACE}[data-draws]")
    return page


def reading(page: Page, across: float, down: float) -> float:
    """The value that the surface's picture tells at a place of it, each share 0 to 1."""
    box = page.locator(f"{SURFACE} canvas").bounding_box() or {}
    place = {"x": across * box["width"], "y": down * box["height"]}
    page.locator(f"{SURFACE} canvas").hover(position=place)
    told = page.get_by_test_id("reading").locator("span").nth(2).inner_text()
    return float(told.split()[-1])


def pixels(page: Page) -> str:
    return str(page.evaluate("document.querySelector('[data-testid=surface] canvas').toDataURL()"))


def all_rules_to(page: Page, key: str) -> None:
    page.focus(CELL)
    page.keyboard.press("Control+a")
    page.keyboard.press(key)


def review(page: Page) -> None:
    page.click("text=Review and write")


def test_an_edit_by_keyboard_is_reviewed_written_verified_and_felt(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = open_tune(desk)

    all_rules_to(page, "5")
    review(page)
    dialog = page.locator("dialog")
    expect(dialog).to_contain_text("Rule at 15 km/h, torque rate 0.45")
    proof = dialog.get_by_test_id("proof")
    expect(proof).to_contain_text("no ride with these settings breaks the law")
    proof.locator("summary").click()
    expect(proof.locator("[data-code=cutoff]")).to_contain_text("25.0 km/h")
    desk.picture("tune-review")
    page.click(WRITE)

    expect(page.locator("[role=status]", has_text="verified")).to_be_visible()
    config = server.get(f"/devices/{standing}/config")
    assert config["parameters"]["fuzzy_rules"] == [["PB"] * 5] * 5
    server.simulate(standing, brake=False, rider={"kind": "constant", "torque_nm": 20.0})
    eventually(lambda: desk.number("[data-testid=live-gain]"),
               lambda gain: abs(gain - GAIN_ALL_PB) < 0.002)  # fmt: skip
    desk.picture("tune-written")


def test_a_written_change_can_be_taken_back_from_its_message(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    before = server.get(f"/devices/{standing}/config")["parameters"]
    page = open_tune(desk)
    page.focus(CELL)
    page.keyboard.press("1")
    review(page)
    page.click(WRITE)

    page.click("[role=status] >> text=Undo")

    expect(page.locator("[role=status]", has_text="the old values are back")).to_be_visible()
    assert server.get(f"/devices/{standing}/config")["parameters"] == before


def test_a_value_out_of_range_is_named_and_cannot_be_written(desk: Desk, standing: str) -> None:
    page = open_tune(desk)

    page.fill("input[aria-label='Gain PB']", "0.9")

    expect(page.locator("text=above the greatest allowed value, 0.5")).to_be_visible()
    review(page)
    expect(page.locator("dialog tr.wrong")).to_contain_text("Gain peak 5")
    expect(page.locator(WRITE)).to_be_disabled()


def test_what_the_unit_refuses_is_named_and_the_edit_stays(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    before = server.get(f"/devices/{standing}/config")
    page = desk.open("/tune/modes")

    # Each value is allowed; that the taper would end before it starts only the unit knows.
    page.fill("input[aria-label='Fixed law: taper starts at']", "24")
    page.fill("input[aria-label='Fixed law: taper ends at']", "10")
    review(page)
    page.click(WRITE)

    refusal = page.locator("dialog [role=alert]")
    expect(refusal).to_contain_text("Nothing was written")
    expect(refusal).to_contain_text("Fixed law: taper")
    desk.picture("tune-refused")
    assert server.get(f"/devices/{standing}/config") == before
    page.keyboard.press("Escape")
    expect(page.locator(BAR)).to_contain_text("2 changed")


def test_a_moving_bike_is_explained_and_its_simulated_rider_can_be_stopped(
    desk: Desk, server: SpindleServer, riding: str
) -> None:
    eventually(lambda: server.get(f"/devices/{riding}/snapshot")["channels"]["speed_kmh"],
               lambda speed: speed > 2)  # fmt: skip
    page = open_tune(desk)
    page.focus(CELL)
    page.keyboard.press("1")
    review(page)

    page.click(WRITE)
    expect(page.locator("dialog [role=alert]")).to_contain_text("the wheel or the motor turns")
    desk.picture("tune-moving")
    page.click("text=Stop the simulated rider, write")

    expect(page.locator("[role=status]", has_text="verified")).to_be_visible(timeout=60_000)
    rules = server.get(f"/devices/{riding}/config")["parameters"]["fuzzy_rules"]
    assert rules[0][0] == "NB"
    eventually(lambda: server.get(f"/devices/{riding}/simulation")["rider"]["kind"],
               lambda kind: kind == "legs")  # fmt: skip


def test_somebody_elses_change_is_not_overwritten(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = open_tune(desk)
    page.focus(CELL)
    page.keyboard.press("1")
    review(page)
    # The page may see the new configuration before it writes; then there is nothing to refuse.
    page.route("**/config", lambda route: route.continue_(headers={
        **route.request.headers, "if-match": '"1-00000000"'
    }) if route.request.method == "PATCH" else route.continue_())  # fmt: skip

    page.click(WRITE)

    expect(page.locator("dialog [role=alert]")).to_contain_text("somebody else changed the unit")
    config = server.get(f"/devices/{standing}/config")["parameters"]
    assert config["fuzzy_rules"][0][0] == "ZO"


def test_edits_survive_a_look_at_another_page(desk: Desk, standing: str) -> None:
    page = open_tune(desk)
    page.focus("[data-cell='2,2']")
    page.keyboard.press("+")

    page.click("nav a >> text=Bike")
    page.wait_for_selector("text=Last ride")
    page.click("nav >> text=Tune")

    expect(page.locator("[data-cell='2,2'] .label")).to_have_text("PS")
    expect(page.locator(BAR)).to_contain_text("1 changed")


def test_the_grid_is_worked_by_keyboard_alone(desk: Desk, standing: str) -> None:
    page = open_tune(desk)
    page.focus(CELL)

    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("4")
    labels = page.locator("[data-cell='1,1'] .label, [data-cell='1,2'] .label")
    assert labels.all_inner_texts() == ["PS", "PS"]
    page.keyboard.press("Control+c")
    page.focus("[data-cell='4,3']")
    page.keyboard.press("Control+v")
    pasted = page.locator("[data-cell='4,3'] .label, [data-cell='4,4'] .label")
    expect(pasted.first).to_have_text("PS")
    assert pasted.all_inner_texts() == ["PS", "PS"]

    page.keyboard.press("Control+z")
    expect(pasted.first).to_have_text("NS")
    page.keyboard.press("Control+z")
    expect(labels.first).to_have_text("ZO")
    expect(page.locator(BAR)).to_contain_text("Same as in the unit")


def test_a_paste_that_does_not_fit_changes_nothing(desk: Desk, standing: str) -> None:
    page = open_tune(desk)
    page.evaluate("navigator.clipboard.writeText('NB\\tNB\\tNB')")

    page.focus("[data-cell='4,4']")
    page.keyboard.press("Control+v")

    expect(page.locator("[role=alert]")).to_contain_text("Nothing pasted")
    expect(page.locator(BAR)).to_contain_text("Same as in the unit")


def test_the_surface_follows_the_table(desk: Desk, standing: str) -> None:
    page = open_tune(desk)
    eventually(lambda: reading(page, 0.015, 0.015), lambda z: abs(z - 0.3) < 0.0005)
    before = pixels(page)

    all_rules_to(page, "5")

    # Between two points of the table the centroid lies lower: only the corners are told by hand.
    for corner in (0.015, 0.985):
        eventually(lambda at=corner: reading(page, at, at), lambda z: abs(z - GAIN_ALL_PB) < 0.0005)
    assert pixels(page) != before


def test_a_peak_is_moved_by_keys_and_keeps_its_order(desk: Desk, standing: str) -> None:
    page = open_tune(desk)
    handle = page.locator("[role=slider][aria-label='Speed 2']")
    handle.focus()

    for _ in range(12):
        page.keyboard.press("Shift+ArrowRight")

    expect(handle).to_have_attribute("aria-valuenow", "14.9")
    expect(page.locator("input[aria-label='Speed 2']")).to_have_value("14.9")


def test_a_peak_is_dragged(desk: Desk, standing: str) -> None:
    page = open_tune(desk)
    handle = page.locator("[role=slider][aria-label='Gain ZO'] circle")
    handle.scroll_into_view_if_needed()
    box = handle.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 20, y)
    page.mouse.move(x + 40, y)
    page.mouse.up()

    value = float(page.input_value("input[aria-label='Gain ZO']"))
    assert 0.3 < value < 0.4
    page.keyboard.press("Control+z")
    expect(page.locator("input[aria-label='Gain ZO']")).to_have_value("0.3")


def test_the_surface_turns_in_three_dimensions_without_a_graphics_card(
    launch: Callable[..., Browser], open_desk: OpenDesk, standing: str
) -> None:
    flat = launch("--disable-3d-apis")
    desk = open_desk(within=flat)
    page = open_tune(desk)

    page.click("button >> text=3D")

    solid = page.locator(f"{SURFACE}[data-kind='3d'][data-draws]")
    expect(solid.get_by_text("Torque rate")).to_be_attached()
    assert 0.1 <= reading(page, 0.5, 0.5) <= 0.5
    desk.picture("tune-3d")
    first = pixels(page)
    solid.press("ArrowLeft")
    by_key = pixels(page)
    box = solid.bounding_box() or {}
    page.mouse.move(box["x"] + 300, box["y"] + 200)
    page.mouse.down()
    page.mouse.move(box["x"] + 350, box["y"] + 230)
    page.mouse.up()
    dragged = pixels(page)
    assert len({first, by_key, dragged}) == 3
    solid.dblclick()
    assert pixels(page) == first
    flat.close()


def test_the_last_seconds_lie_on_the_map_and_on_the_solid(desk: Desk, riding: str) -> None:
    page = open_tune(desk)

    for view in ("Map", "3D"):
        page.get_by_role("button", name=view).click()
        trail = page.get_by_test_id("trail")
        expect(trail).to_be_attached()
        expect(page.get_by_test_id("now")).to_be_attached()
        field, way = (where.bounding_box() or {} for where in (page.locator(SURFACE), trail))
        assert field["x"] <= way["x"] <= way["x"] + way["width"] <= field["x"] + field["width"]
        assert field["y"] <= way["y"] <= way["y"] + way["height"] <= field["y"] + field["height"]


def test_rules_and_surface_stand_side_by_side_and_stay_so_while_a_peak_is_dragged(
    open_desk: OpenDesk, standing: str
) -> None:
    page = open_tune(open_desk(width=1440, height=900))
    page.wait_for_selector("[data-testid=surface][data-draws]")
    page.wait_for_selector("[data-testid=lint] li")
    panels = [page.get_by_role("region", name=name) for name in ("Rules", "Gain surface")]
    rules, surface = (panel.bounding_box() or {} for panel in panels)
    sides = [surface[side] for side in ("y", "height")]
    assert sides == pytest.approx([rules[side] for side in ("y", "height")], abs=1)
    drawn = page.get_by_test_id("surface").bounding_box() or {}
    assert (drawn["width"] >= 600, drawn["height"] >= 480) == (True, True)

    page.get_by_role("slider", name="Gain PB").focus()
    page.evaluate("main.scrollTo(0, 1e6)")

    seen = panels[1].bounding_box() or {}
    assert seen["y"] >= 0
    assert seen["y"] + seen["height"] <= 900
    page.focus(CELL)
    page.keyboard.press("5")
    shown = page.get_by_role("group", name="Colour the rules by")
    shown.get_by_role("button", name="Change").click()
    # From ZO, a gain of 0.3, to PB, 0.5; all others are as they were.
    expect(page.locator(CELL)).to_contain_text("+0.2")
    expect(page.locator("[data-cell='1,1']")).to_contain_text("=")
