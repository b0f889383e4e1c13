"""Goal: every page works for all: small screens, dark rooms, Chinese, keyboard, screen readers.

Accessibility is judged by axe-core with the WCAG 2.2 A and AA rules.
"""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.browser.judged import JUDGE


def test_the_pages_of_tune_are_tabs_and_the_places_are_in_groups(desk: Desk, standing: str) -> None:
    page = desk.open("/tune")
    places = page.get_by_role("navigation", name="Pages")
    expect(places.get_by_role("list", name="This bike").get_by_role("link")).to_have_text(
        ["Bike", "Live", "Tune", "Calibrate", "Service"]
    )
    for width, column in ((1440, 165), (1024, 75)):
        page.set_viewport_size({"width": width, "height": 800})
        assert (places.bounding_box() or {})["width"] == column

    tabs = page.get_by_role("navigation", name="Tune")
    tabs.get_by_role("link", name="Try on a ride").click()

    expect(page.locator("h1")).to_have_text("Tune")
    expect(tabs.get_by_role("link", name="Try on a ride")).to_have_attribute("aria-current", "page")
    expect(places.get_by_role("link", name="Tune")).to_have_attribute("aria-current", "page")


def test_language_theme_and_units_are_chosen_and_kept(desk: Desk, riding: str) -> None:
    page = desk.open("/settings")

    page.check("input[value=dark]")
    page.check("input[value=imperial]")
    page.check("input[value=zh]")
    expect(page.locator("h1")).to_have_text("设置")
    page.reload()

    expect(page.locator("h1")).to_have_text("设置")
    assert page.get_attribute("html", "data-theme") == "dark"
    page.click("nav >> text=实时")
    expect(page.locator("[data-channel=speed_kmh]")).to_contain_text("mph")


def test_an_unknown_address_says_so_and_the_first_tab_skips_to_the_page(desk: Desk) -> None:
    page = desk.open("/nonsense")
    expect(page.locator("main")).to_contain_text("no page at this address")

    page.keyboard.press("Tab")
    page.keyboard.press("Enter")

    assert page.evaluate("document.activeElement.id") == "main"


def test_a_question_mark_lists_the_keys_and_two_letters_go_to_a_page(
    desk: Desk, standing: str
) -> None:
    page = desk.open("/settings")

    page.keyboard.press("?")
    keys = page.get_by_role("dialog", name="Help").get_by_role("region", name="Keyboard")
    expect(keys).to_contain_text("then b Bike")
    expect(keys).to_be_in_viewport()
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    page.keyboard.press("g")
    page.keyboard.press("c")

    expect(page.locator("h1")).to_have_text("Calibrate")


def test_a_word_of_the_field_is_explained_where_it_stands_and_by_touch(
    open_desk: OpenDesk, standing: str, axe: str
) -> None:
    page = open_desk(width=390, height=844, touch=True).open("/tune/modes")

    page.get_by_role("button", name="Taper").tap()

    explained = page.get_by_role("dialog", name="Help")
    expect(explained.locator(".topic")).to_contain_text("ratio falls with speed")
    expect(explained.locator(".topic")).to_be_in_viewport()
    explained.get_by_role("searchbox").fill("back-emf")
    expect(explained.get_by_role("region", name="Words").locator("dt")).to_have_text(["Back-EMF"])
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    explained.get_by_role("button", name="Dismiss").tap()
    page.locator("nav .toggle").tap()
    page.locator("nav .menu").get_by_role("button", name="Help").tap()
    expect(explained).to_contain_text("not zero")


def test_who_is_new_is_led_through_the_pages_once(desk: Desk, standing: str) -> None:
    page = desk.open("/")
    steps = page.get_by_role("region", name="First steps")
    expect(steps.locator("li")).to_have_count(5)
    expect(steps.locator("li.done")).to_contain_text("Connect a unit")

    steps.get_by_role("link", name="Watch it live").click()
    page.wait_for_selector("[data-draws]")
    page.goto(f"{desk.address}/")

    expect(steps.locator("li.done")).to_have_count(2)
    steps.get_by_role("button", name="Put away").click()
    page.reload()
    expect(page.get_by_test_id("headline")).to_be_visible()
    expect(steps).to_have_count(0)
    page.keyboard.press("?")
    page.get_by_role("button", name="Show the first steps on Bike").click()
    expect(steps.locator("li.done")).to_have_count(1)
