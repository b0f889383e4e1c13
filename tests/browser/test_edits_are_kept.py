"""Goal: nothing that somebody edited is lost under their hands: by another tab, a reload, a session
that ended, or pages that the server no longer has.

Method: two pages of one browser on one unit; an old page is one whose server has other files, made
by intercepting what the browser asks for.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, Route, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.test_signing_in import OWN, PASSWORD, Workshop, fill_in, workshop_in
from tests.browser.test_tune_page import BAR, CELL, WRITE, open_tune, review
from tests.fakes.server import SpindleServer

pytestmark = pytest.mark.slow

KEPT = "[data-testid=stored-draft]"
MEANWHILE = "[data-testid=meanwhile]"
NEW_VERSION = "[data-testid=new-version]"
REASON = "dialog .reason input"
LAST = (4, 4)


def rules_of(server: SpindleServer, device: str) -> list[list[str]]:
    rules: list[list[str]] = server.get(f"/devices/{device}/config")["parameters"]["fuzzy_rules"]
    return rules


def changed_elsewhere(server: SpindleServer, device: str, row: int, column: int) -> str:
    """Another tab, or a program, writes one other rule; its label before."""
    rules = rules_of(server, device)
    before = rules[row][column]
    rules[row][column] = "NS" if before != "NS" else "PS"
    body = {"parameters": {"fuzzy_rules": rules}, "reason": "elsewhere"}
    server.ask("PATCH", f"/devices/{device}/config", json=body)
    return before


def edit_first_rule(page: Page) -> None:
    page.focus(CELL)
    page.keyboard.press("1")
    expect(page.locator(f"{CELL} .label")).to_have_text("NB")


def test_an_edit_is_of_a_rule_and_another_tab_s_stays(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = open_tune(desk)
    edit_first_rule(page)
    old = changed_elsewhere(server, standing, *LAST)
    new = rules_of(server, standing)[4][4]
    expect(page.locator(MEANWHILE)).to_contain_text("1")

    review(page)

    beside = page.get_by_test_id("concurrent-changes")
    expect(beside).to_contain_text(f"{old} → {new}")
    expect(page.locator("dialog tbody tr")).to_have_count(1)
    desk.picture("concurrent-changes")
    page.click(WRITE)
    expect(page.locator("dialog")).to_have_count(0)
    rules = rules_of(server, standing)
    assert (rules[0][0], rules[4][4]) == ("NB", new)
    expect(page.locator(MEANWHILE)).to_have_count(0)

    page.get_by_test_id("toasts").get_by_role("button", name="Undo").click()
    expect(page.get_by_text("Undone: the old values are back")).to_be_visible()
    assert rules_of(server, standing)[4][4] == new


def test_of_a_rule_that_both_changed_the_review_says_so(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = open_tune(desk)
    edit_first_rule(page)
    old = changed_elsewhere(server, standing, 0, 0)
    expect(page.locator(MEANWHILE)).to_be_visible()

    review(page)

    row = page.locator("dialog tbody tr")
    expect(row).to_contain_text(f"it was {old} when you began")
    expect(page.get_by_test_id("concurrent-changes")).to_have_count(0)
    expect(row.locator(".new")).to_have_text("NB")


@pytest.mark.parametrize(("width", "language"), [(1280, "en-GB"), (390, "zh-CN")])
def test_a_reload_keeps_edits_and_the_reason(
    open_desk: OpenDesk, standing: str, width: int, language: str
) -> None:
    desk = open_desk(width, language=language)
    page = open_tune(desk)
    edit_first_rule(page)
    page.get_by_test_id("draft-bar").locator("button.primary").click()
    page.locator(REASON).fill("softer on wet climbs")

    page.reload()

    expect(page.locator(KEPT)).to_be_visible()
    expect(page.locator(f"{CELL} .label")).to_have_text("NB")
    assert sideways(page) <= 0
    desk.picture(f"kept-{width}")
    page.get_by_test_id("draft-bar").locator("button.primary").click()
    expect(page.locator(REASON)).to_have_value("softer on wet climbs")
    page.keyboard.press("Escape")
    page.get_by_test_id("draft-bar").locator("button").nth(2).click()
    expect(page.locator(KEPT)).to_have_count(0)
    page.reload()
    expect(page.locator(f"{CELL} .label")).not_to_have_text("NB")


@pytest.fixture
def workshop(tmp_path: Path) -> Iterator[Workshop]:
    with workshop_in(tmp_path, OWN) as opened:
        yield opened


def test_a_session_that_ended_elsewhere_takes_nothing_with_it(
    open_desk: OpenDesk, workshop: Workshop
) -> None:
    desk = open_desk(address=workshop.address)
    desk.allow("status of 401|WebSocket")
    page = desk.page
    page.goto(f"{workshop.address}/sign-in#first={workshop.token}")
    fill_in(page, "Anna")
    page.get_by_test_id("person-menu").wait_for()
    open_tune(desk)
    edit_first_rule(page)
    review(page)
    page.locator(REASON).fill("softer on wet climbs")

    # The next thing that the page asks for is refused, whatever somebody is typing.
    page.context.clear_cookies()
    page.wait_for_url("**/sign-in?back=*")
    fill_in(page, "Anna", PASSWORD)

    page.wait_for_url("**/tune")
    expect(page.locator(f"{CELL} .label")).to_have_text("NB")
    review(page)
    expect(page.locator(REASON)).to_have_value("softer on wet climbs")


def updated(page: Page) -> None:
    """From now on the server has other pages: their entry is another, parts of the old are gone."""

    def other_entry(route: Route) -> None:
        answer = route.fetch()
        body = re.sub(r"index-[\w-]+\.js", "index-Updated1.js", answer.text())
        route.fulfill(response=answer, body=body)

    page.route(re.compile(r"/$"), other_entry)
    page.route(re.compile(r"/assets/(?!index-).*\.js$"), lambda route: route.fulfill(status=404))


def test_a_page_left_open_across_an_update_says_so_and_loads_the_new_one(
    desk: Desk, standing: str
) -> None:
    desk.allow("status of 404|dynamically imported module|MIME type|Unable to preload")
    page = open_tune(desk)
    edit_first_rule(page)
    updated(page)

    page.get_by_role("link", name="Service", exact=True).click()

    banner = page.locator(NEW_VERSION)
    expect(banner).to_contain_text("Spindle was updated")
    expect(page.locator("main :is(section, table)")).to_have_count(0)
    desk.picture("new-version")
    page.unroute_all()
    banner.get_by_role("button", name="Load").click()
    expect(page.get_by_role("heading", name="Service", exact=True).first).to_be_visible()
    expect(page.locator("main section").first).to_be_visible()
    page.goto(f"{desk.address}/tune")
    expect(page.locator(f"{CELL} .label")).to_have_text("NB")
    expect(page.locator(BAR)).to_contain_text("1 changed")


def test_a_part_that_does_not_come_is_not_called_an_update(desk: Desk, standing: str) -> None:
    desk.allow("status of 404|dynamically imported module|MIME type|Unable to preload")
    page = open_tune(desk)
    page.route(re.compile(r"/assets/(?!index-).*\.js$"), lambda route: route.fulfill(status=404))

    page.keyboard.press("?")

    expect(page.locator(NEW_VERSION)).to_contain_text("could not be loaded")
