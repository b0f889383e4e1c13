"""Goal: what a page says about a write is what is known of it, and its buttons can be read."""

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


def answer_writes(desk: Desk, status: int, code: str, detail: str) -> None:
    """Every write is answered like this and none reaches the unit."""

    def answer(route: Route) -> None:
        if route.request.method != "PATCH":
            return route.fallback()
        problem = {"status": status, "code": code, "detail": detail, "title": code, "type": code}
        return route.fulfill(
            status=status, body=json.dumps(problem), content_type="application/problem+json"
        )

    desk.allow(f"status of {status}")
    desk.page.route("**/api/v1/devices/*/config", answer)


@pytest.mark.parametrize(
    ("status", "code", "outcome"),
    [(504, "commit_unanswered", "unknown"), (504, "no_answer", "silent")],
)
def test_nothing_was_written_is_said_only_where_it_is_known(
    desk: Desk, standing: str, status: int, code: str, outcome: str
) -> None:
    answer_writes(desk, status, code, "The unit fell silent.")
    page = changed_table(desk)

    page.get_by_role("button", name="Review and write…").click()
    page.get_by_role("button", name="Write to the unit").click()

    told = page.get_by_role("dialog").get_by_role("alert")
    expect(told).to_have_attribute("data-outcome", outcome)
    expect(told).to_contain_text("The unit fell silent.")
    assert ("Nothing was written" in told.inner_text()) == (outcome == "silent")


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
