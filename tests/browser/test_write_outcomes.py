"""Goal: what a page says about a write is what is known of it, asked of the unit once, and its
buttons can be read.
"""

from __future__ import annotations

import json

import pytest
from playwright.sync_api import Locator, Page, Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk


def changed_table(desk: Desk) -> Page:
    """The tune page with one rule changed."""
    page = desk.open("/tune")
    page.locator("[data-cell='0,0']").focus()
    page.keyboard.press("5")
    expect(page.get_by_role("button", name="Review and write…")).to_be_enabled()
    return page


def answer_writes(
    desk: Desk, status: int, code: str, detail: str, outcome: str | None = None
) -> None:
    """Every write is answered like this and none reaches the unit."""

    def answer(route: Route) -> None:
        if route.request.method != "PATCH":
            return route.fallback()
        problem = {"status": status, "code": code, "detail": detail, "title": code, "type": code}
        problem |= {"outcome": outcome}
        return route.fulfill(
            status=status, body=json.dumps(problem), content_type="application/problem+json"
        )

    desk.allow(f"status of {status}")
    desk.page.route("**/api/v1/devices/*/config", answer)


@pytest.mark.parametrize(
    ("found", "shown", "words"),
    [
        ("unknown", "unknown", "It is not known whether the change was written."),
        ("unchanged", "silent", "Nothing was written"),
        ("changed", "changed", "the unit was asked again and has the change"),
        (None, "unknown", "It is not known whether the change was written."),
    ],
)
def test_what_became_of_a_write_is_said_as_far_as_it_is_known(
    desk: Desk, standing: str, found: str | None, shown: str, words: str
) -> None:
    answer_writes(desk, 504, "no_answer", "The unit fell silent.", found)
    page = changed_table(desk)

    page.get_by_role("button", name="Review and write…").click()
    page.get_by_role("button", name="Write to the unit").click()

    told = page.get_by_role("dialog").get_by_role("alert")
    expect(told).to_have_attribute("data-outcome", shown)
    expect(told).to_contain_text("The unit fell silent.")
    expect(told).to_contain_text(words)
    assert ("Nothing was written" in told.inner_text()) == (found == "unchanged")


def test_a_written_configuration_is_not_read_again_by_the_page(desk: Desk, standing: str) -> None:
    page = changed_table(desk)
    page.get_by_role("button", name="Review and write…").click()
    asked: list[str] = []
    page.on("request", lambda request: asked.append(f"{request.method} {request.url}"))

    page.get_by_role("button", name="Write to the unit").click()
    expect(page.get_by_test_id("toasts")).to_contain_text("verified")
    for _ in range(2):  # by then the page has seen that the unit has another configuration
        with page.expect_response("**/api/v1/devices"):
            pass

    of_config = [one for one in asked if f"/devices/{standing}/" in one and "/dashboard" not in one]
    assert [one.split()[0] for one in of_config] == ["PATCH"], of_config


def background(button: Locator) -> str:
    return str(button.evaluate("(node) => getComputedStyle(node).backgroundColor"))


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_main_button_keeps_its_colour_under_the_mouse(
    open_desk: OpenDesk, standing: str, theme: str
) -> None:
    button = changed_table(open_desk(theme=theme)).get_by_role("button", name="Review and write…")
    away = background(button)

    button.hover()

    assert button.evaluate("(node) => node.matches(':hover')")
    assert background(button) == away
