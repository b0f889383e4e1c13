"""Goal: a block of rules is chosen and worked on by keyboard, by mouse and by touch alike, and each
thing done to it is one step of undo.

Expected labels are worked out by hand from the peaks 0.1 to 0.5 and the thesis's rules.
"""

from __future__ import annotations

from playwright.sync_api import Locator, Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.browser.test_by_touch import box
from tests.browser.test_tune_page import BAR, open_tune
from tests.fakes.server import eventually

TOOLS = "[data-testid=block-tools]"
SAID = "[data-testid=chosen-rules]"
SAME = "Same as in the unit"


def cell(page: Page, row: int, column: int) -> Locator:
    return page.locator(f"[data-cell='{row},{column}']")


def labels(page: Page, row: int) -> list[str]:
    return page.locator(f"[data-cell^='{row},'] .label").all_inner_texts()


def test_by_keyboard_a_block_is_levelled_interpolated_scaled_and_smoothed(
    desk: Desk, standing: str
) -> None:
    page = open_tune(desk)
    cell(page, 2, 0).focus()
    page.keyboard.press("1")
    page.keyboard.press("End")
    page.keyboard.press("5")
    page.keyboard.press("Home")
    page.keyboard.press("Shift+End")

    page.keyboard.press("/")

    expect(page.locator(SAID)).to_have_text("1 of 5 rules moved to the nearest label.")
    assert labels(page, 2) == ["NB", "NS", "ZO", "PS", "PB"]
    page.keyboard.press("=")
    assert labels(page, 2) == ["ZO"] * 5  # a mean of 0.3
    page.keyboard.press("*")
    page.get_by_role("dialog").get_by_role("textbox").fill("110")
    expect(page.get_by_test_id("would-move")).to_have_text("0 of 5 rules would move.")
    page.get_by_role("dialog").get_by_role("textbox").fill("134")
    page.keyboard.press("Enter")
    expect(page.get_by_role("dialog")).to_have_count(0)
    assert labels(page, 2) == ["PS"] * 5  # 0.402
    for before in (["ZO"] * 5, ["NB", "NS", "ZO", "PS", "PB"], ["NB", "ZO", "ZO", "PS", "PB"]):
        page.keyboard.press("Control+z")
        assert labels(page, 2) == before

    # A spike of 0.5 among 0.1: (4 x 0.5 + 12 x 0.1) / 16 = 0.2.
    page.keyboard.press("Control+a")
    page.keyboard.press("1")
    cell(page, 2, 2).focus()
    page.keyboard.press("5")
    page.keyboard.press("s")
    expect(cell(page, 2, 2).locator(".label")).to_have_text("NS")
    page.keyboard.press("?")
    expect(page.get_by_role("dialog")).to_contain_text("/ interpolates")


def test_by_mouse_a_block_is_drawn_copied_and_pasted(desk: Desk, standing: str) -> None:
    page = open_tune(desk)
    start, end = box(cell(page, 0, 3)), box(cell(page, 1, 4))
    page.mouse.move(start["x"] + 20, start["y"] + 20)
    page.mouse.down()
    page.mouse.move(end["x"] + 10, end["y"] + 10, steps=4)
    page.mouse.up()
    expect(page.locator("td[aria-selected=true]")).to_have_count(4)

    tools = page.locator(TOOLS)
    tools.get_by_role("button", name="Copy").click()
    cell(page, 3, 0).click()
    tools.get_by_role("button", name="Paste").click()

    expect(cell(page, 3, 0).locator(".label")).to_have_text("PB")
    assert (labels(page, 3)[:2], labels(page, 4)[:2]) == (["PB", "PB"], ["PS", "PB"])
    page.locator(BAR).get_by_role("button", name="Undo").click()
    expect(page.locator(BAR)).to_contain_text(SAME)


def test_by_touch_a_block_is_chosen_by_its_corners(open_desk: OpenDesk, standing: str) -> None:
    page = open_tune(open_desk(width=390, height=844, touch=True))
    tools = page.locator(TOOLS)
    cell(page, 0, 0).tap()
    tools.get_by_role("button", name="Up to…").tap()
    expect(page.locator(SAID)).to_have_text("Now press the other corner of the block.")
    cell(page, 1, 4).tap()
    expect(page.locator("td[aria-selected=true]")).to_have_count(10)

    # Gains of 0.3 0.3 0.4 0.5 0.5 and 0.3 0.3 0.4 0.4 0.5: a mean of 0.39.
    tools.get_by_role("button", name="Level").tap()

    expect(page.locator(SAID)).to_have_text("7 of 10 rules moved to the nearest label.")
    assert labels(page, 0) == labels(page, 1) == ["PS"] * 5
    page.locator(BAR).get_by_role("button", name="Undo").tap()
    expect(page.locator(BAR)).to_contain_text(SAME)
    sizes = [box(button) for button in tools.get_by_role("button").all()]
    assert [size for size in sizes if min(size["width"], size["height"]) < 44] == []


def test_a_rule_tells_what_a_push_comes_to_and_how_strongly_it_fires(
    desk: Desk, riding: str
) -> None:
    page = open_tune(desk)
    feel = page.get_by_test_id("rule-feel")
    cell(page, 0, 0).focus()
    # Sport gives once the push and its gain: 30 x 1.3.
    expect(feel).to_have_text(
        "At 30.0 Nm from you: 39.0 Nm requested, 39.0 Nm delivered at the crank."
    )
    page.keyboard.press("5")
    # The centroid of the last set is 0.4 + 2/3 of 0.1; 250 W at one turn a second are 39.8 Nm.
    expect(feel).to_have_text(
        "At 30.0 Nm from you: 44.0 Nm requested, 39.8 Nm delivered at the crank. "
        "In the unit 39.0 Nm are requested."
    )
    expect(cell(page, 0, 0)).to_contain_text("ZO →")

    bars = "[...document.querySelectorAll('.cell .fires')]"
    weights = f"{bars}.map((bar) => parseFloat(bar.style.width))"
    eventually(lambda: sum(page.evaluate(weights)), lambda sum_pct: sum_pct > 50)
    assert sum(weight > 0 for weight in page.evaluate(weights)) <= 4
    covered = """() => [...document.querySelectorAll('.cell .label')].filter((label) =>
        [...document.querySelectorAll('.overlay .now')].some((mark) => {
            const [a, b] = [label.getBoundingClientRect(), mark.getBoundingClientRect()]
            return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom
        })).length"""
    assert page.evaluate(covered) == 0
