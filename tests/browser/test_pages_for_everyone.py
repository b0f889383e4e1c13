"""Goal: every page works for all: small screens, dark rooms, Chinese, keyboard, screen readers.

Accessibility is judged by axe-core with the WCAG 2.2 A and AA rules.
"""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.test_rides_page import long_ride
from tests.fakes.server import SpindleServer

WHY = "/tune/why?now"
PAGES = ["/", "/connect", "/live", "/tune", "/tune/modes", WHY, "/rides", "/sensor", "/service"]
PAGES += ["/settings"]
READY = {
    "/": "[data-testid=link-health]",
    "/connect": "[data-testid=what-works] dd",
    "/live": "[data-draws]",
    "/tune": "[data-testid=surface][data-draws]",
    "/tune/modes": "[data-testid=modes] .ridden svg",
    WHY: "[data-testid=why-answer]",
    "/rides": "[data-testid=ride-table]",
    "/sensor": "[data-parameter=sensor_offset_counts]",
    "/service": "section",
    "/settings": "fieldset",
}
JUDGE = """async () => {
    const only = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa']
    const found = await axe.run(document, { runOnly: only })
    return found.violations.map((v) => v.id + ': ' + v.nodes.map((n) =>
        n.target.join(' ') + ' ' + n.any.map((a) => a.message).join('; ')).join(' | '))
}"""
# The rows of the window that lie over another one.
COVERED = """() => {
    const rows = [...document.querySelectorAll('.shell > *')].map((row) =>
        [row.className || row.tagName, row.getBoundingClientRect()])
    return rows.flatMap(([name, a], i) => rows.slice(i + 1).flatMap(([other, b]) =>
        Math.min(a.right, b.right) - Math.max(a.left, b.left) > 0.5 &&
        Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 0.5 ? [[name, other]] : []))
}"""
# How much moved by itself while the page loaded, as browsers sum it up.
SHIFT = """() => new Promise((told) => {
    let sum = 0
    new PerformanceObserver((list) => {
        for (const { value, hadRecentInput } of list.getEntries()) sum += hadRecentInput ? 0 : value
    }).observe({ type: 'layout-shift', buffered: true })
    setTimeout(() => told(sum), 100)
})"""
# What is pressed and is smaller than a finger: WCAG 2.2, 2.5.5. A link in a sentence may be, and
# what belongs to a label is as large as that.
SMALL_TARGETS = """() => [...document.querySelectorAll('button, select, summary, .button, nav a')]
    .filter((node) => node.checkVisibility())
    .map((node) => [node.innerText || node.ariaLabel, node.getBoundingClientRect()])
    .filter(([, box]) => box.width && Math.min(box.width, box.height) < 43.5)
    .map(([name, box]) => [name, box.width, box.height])"""


@pytest.mark.parametrize("path", PAGES)
def test_a_small_phone_scrolls_the_page_alone_and_never_sideways(
    open_desk: OpenDesk, riding: str, path: str
) -> None:
    desk = open_desk(width=360, height=740, touch=True)
    page = desk.open(path)
    page.wait_for_selector(READY[path].replace("[data-testid=link-health]", "text=Serial number"))

    assert sideways(page) == 0
    assert page.evaluate("document.documentElement.scrollHeight") == 740
    assert page.evaluate(COVERED) == []
    assert page.evaluate(SMALL_TARGETS) == []
    assert page.evaluate(SHIFT) < 0.02


@pytest.mark.parametrize("width", [1440, 1024])
def test_the_pages_of_tune_are_tabs_and_the_places_are_in_groups(
    open_desk: OpenDesk, standing: str, width: int
) -> None:
    page = open_desk(width=width, height=800).open("/tune")
    places = page.get_by_role("navigation", name="Pages")
    expect(places.get_by_role("list", name="This bike").get_by_role("link")).to_have_text(
        ["Bike", "Live", "Tune", "Calibrate", "Service"]
    )
    assert (places.bounding_box() or {})["width"] == (165 if width > 1180 else 75)

    tabs = page.get_by_role("navigation", name="Tune")
    tabs.get_by_role("link", name="Try on a ride").click()

    expect(page.locator("h1")).to_have_text("Tune")
    expect(tabs.get_by_role("link", name="Try on a ride")).to_have_attribute("aria-current", "page")
    expect(places.get_by_role("link", name="Tune")).to_have_attribute("aria-current", "page")
    assert page.evaluate(COVERED) == []


def test_a_ride_fits_a_small_phone(open_desk: OpenDesk, server: SpindleServer) -> None:
    desk = open_desk(width=360, height=740)
    page = desk.open(f"/rides/{long_ride(server)}")
    page.wait_for_selector("[data-testid=traces][data-draws]")

    assert sideways(page) == 0
    desk.picture("ride-phone", full=True)


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


def test_the_first_tab_skips_to_the_page(desk: Desk, device: str) -> None:
    page = desk.open("/rides")

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
    expect(explained.locator(".asked")).to_contain_text("ratio falls with speed")
    expect(explained.locator(".asked")).to_be_in_viewport()
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


def test_an_unknown_address_says_so(desk: Desk, device: str) -> None:
    page = desk.open("/nonsense")

    expect(page.locator("main")).to_contain_text("no page at this address")
