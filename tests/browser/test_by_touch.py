"""Goal: a rule is edited without a keyboard, by touch and by mouse, in both tables, and what the
page says afterwards never lies over the buttons that come next.
"""

from __future__ import annotations

import pytest
from playwright.sync_api import FloatRect, Locator, Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.browser.test_tune_page import open_tune

CELL = "[data-cell='2,3']"
STRIP = "[data-testid=label-strip]"
BAR = "[data-testid=draft-bar]"
TOAST = "[data-testid=toasts] > *"
SIZES = [(1440, 900), (1024, 768), (390, 844)]
TARGET_PX = 44  # WCAG 2.2, 2.5.5


def box(place: Locator) -> FloatRect:
    found = place.bounding_box()
    assert found is not None
    return found


def at_hand(button: Locator) -> bool:
    """Whether a click into the middle of a button would reach it."""
    return bool(
        button.evaluate(
            """(node) => {
        const { left, top, width, height } = node.getBoundingClientRect()
        return node.contains(document.elementFromPoint(left + width / 2, top + height / 2))
    }"""
        )
    )


def fail_to_paste(page: Page) -> None:
    """Something that cannot be pasted: the page says so and goes on saying it."""
    page.evaluate("navigator.clipboard.writeText('nonsense')")
    page.focus(CELL)
    page.keyboard.press("Control+v")
    expect(page.locator(TOAST)).to_contain_text("Nothing pasted")


@pytest.mark.parametrize("table", ["first", "second"])
def test_a_rule_is_set_by_touch_and_undone(open_desk: OpenDesk, standing: str, table: str) -> None:
    desk = open_desk(width=390, height=844, touch=True)
    page = desk.open(f"/tune?table={table}")
    cell = page.locator(CELL)
    old = cell.locator(".label").inner_text()
    strip = page.locator(STRIP)
    cell.tap()

    strip.get_by_role("button", name="NB").tap()

    expect(cell.locator(".label")).to_have_text("NB")
    expect(page.get_by_test_id("chosen-rules")).to_contain_text(f"in the unit {old}")
    expect(strip.get_by_role("button", name="One label down")).to_be_disabled()
    strip.get_by_role("button", name="One label up").tap()
    expect(cell.locator(".label")).to_have_text("NS")
    page.locator(BAR).get_by_role("button", name="Undo").tap()
    page.locator(BAR).get_by_role("button", name="Undo").tap()
    expect(cell.locator(".label")).to_have_text(old)
    expect(page.locator(BAR)).to_contain_text("Same as in the unit")


def test_a_phone_on_its_side_leaves_most_of_itself_to_the_page(
    open_desk: OpenDesk, standing: str
) -> None:
    page = open_tune(open_desk(width=667, height=375, touch=True))
    cell, bar = page.locator("[data-cell='4,4']"), page.locator(BAR)
    top = page.locator("header.top")

    cell.scroll_into_view_if_needed()
    cell.tap()

    assert box(top)["y"] + box(top)["height"] <= 0, "scrolled away with the page"
    assert box(bar)["y"] > 0.7 * 375
    expect(cell).to_be_focused()


def test_a_rule_is_set_by_mouse_and_goes_back_to_what_the_unit_has(
    desk: Desk, standing: str
) -> None:
    page = open_tune(desk)
    page.click(CELL)
    page.locator(STRIP).get_by_role("button", name="PB").click()
    expect(page.locator(f"{CELL} .label")).to_have_text("PB")
    expect(page.locator(STRIP).get_by_role("button", name="PB")).to_have_attribute(
        "aria-pressed", "true"
    )

    page.locator(STRIP).get_by_role("button", name="As in the unit").click()

    expect(page.locator(BAR)).to_contain_text("Same as in the unit")


def test_what_is_tapped_is_as_large_as_a_finger(open_desk: OpenDesk, standing: str) -> None:
    page = open_tune(open_desk(touch=True))
    targets = [*page.locator(f"{STRIP} button").all(), page.locator(CELL)]

    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        sizes = [(box(target)["width"], box(target)["height"]) for target in targets]
        assert [size for size in sizes if min(size) < TARGET_PX] == []


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_a_message_never_lies_over_the_action_bar(
    open_desk: OpenDesk, standing: str, width: int, height: int
) -> None:
    desk = open_desk(width=width, height=height)
    page = open_tune(desk)
    page.focus(CELL)
    page.keyboard.press("1")

    fail_to_paste(page)

    bar = page.locator(BAR)
    message, buttons = box(page.locator(TOAST)), bar.get_by_role("button", disabled=False)
    assert message["y"] + message["height"] <= box(bar)["y"] + 1
    assert box(bar)["y"] + box(bar)["height"] <= height
    for button in [*buttons.all(), *page.locator(TOAST).get_by_role("button").all()]:
        assert at_hand(button), button.inner_text()
    desk.picture(f"message-{width}")
    for place in ("main.scrollTo(0, 1e6)", "main.scrollTo(0, 0)"):
        page.evaluate(place)
        assert at_hand(page.get_by_role("button", name="Review and write…"))


def test_the_last_control_of_a_page_is_reached_under_a_message(
    open_desk: OpenDesk, standing: str
) -> None:
    page = open_tune(open_desk(width=390, height=844))
    fail_to_paste(page)
    last = page.locator("main :is(input, select)").last

    last.focus()

    assert at_hand(last)
