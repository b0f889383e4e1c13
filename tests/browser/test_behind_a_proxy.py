"""Goal: behind a proxy the pages work, or say what the proxy lacks.

Method: a real browser, a proxy in Python with the mistakes that nginx makes unless told otherwise.
The configurations of docs/behind-a-proxy.md are tried with the real ones in tests/stories.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.fakes.proxy import Proxy
from tests.fakes.server import ServerHere, SpindleServer

# How a browser tells of a file that is not what it asked for.
NO_FILE = re.compile("Refused to apply style|Failed to load|404")


def words_of_an_empty_page(desk: Desk, address: str) -> str:
    """What is read where the scripts did not come; it is shown after a while."""
    desk.allowed.append(NO_FILE)
    desk.page.goto(address)
    words = desk.page.get_by_test_id("unloaded")
    expect(words).to_have_css("visibility", "visible")
    return words.inner_text()


def test_a_proxy_with_a_host_of_its_own_is_named(
    open_desk: OpenDesk, server: SpindleServer
) -> None:
    with Proxy(server.url, own_host=True) as proxy:
        words = words_of_an_empty_page(open_desk(), proxy.url)

    assert "proxy_set_header Host" in words
    assert "须原样传递" in words
    assert "SPINDLE_ROOT_PATH" not in words


def test_a_path_that_the_server_does_not_know_is_named(
    open_desk: OpenDesk, server: SpindleServer
) -> None:
    with Proxy(server.url, below="/spindle") as proxy:
        words = words_of_an_empty_page(open_desk(), f"{proxy.url}/spindle/")

    assert "SPINDLE_ROOT_PATH=/spindle" in words
    assert "proxy_set_header" not in words


def test_a_page_that_is_refused_is_words(open_desk: OpenDesk, server: SpindleServer) -> None:
    desk = open_desk()
    desk.page.set_extra_http_headers({"X-Forwarded-For": "203.0.113.7"})

    desk.page.goto(server.url)

    expect(desk.page.get_by_role("heading").first).to_have_text("Spindle does not answer this way")
    expect(desk.page.locator("body")).to_contain_text("SPINDLE_AUTH=required")


@pytest.fixture
def below(tmp_path: Path) -> Iterator[SpindleServer]:
    """A server that knows that it is at /spindle, where people sign in, with a unit."""
    unit = "sim:below?scenario=commute"
    settings = {"SPINDLE_ROOT_PATH": "/spindle", "SPINDLE_AUTH": "required"}
    with ServerHere(tmp_path, [unit], **settings) as server:
        yield server


@pytest.mark.parametrize("strips", [True, False])
def test_below_a_path_everything_works(
    open_desk: OpenDesk, below: SpindleServer, strips: bool, tmp_path: Path
) -> None:
    people = below.services.people
    assert people is not None
    token = people.accounts.first_token()
    with Proxy(below.url, below="/spindle", strips=strips) as proxy:
        desk = open_desk(address=f"{proxy.url}/spindle")
        desk.allowed.append(re.compile("status of 401"))
        page = desk.page
        # A stranger comes back to where they wanted to go, by a deep link.
        page.goto(f"{desk.address}/live")
        page.wait_for_url("**/spindle/sign-in?back=*")
        page.goto(f"{desk.address}/sign-in#first={token}")
        page.reload()
        page.locator("input[autocomplete=username]").fill("Anna")
        page.locator("input[type=password]").fill("eine lange Nacht")
        page.locator("form button").click()
        page.wait_for_url(f"{desk.address}/")
        page.goto(f"{desk.address}/live")
        expect(page.get_by_test_id("stream-status")).to_have_text("Live")
        page.get_by_role("link", name="Rides").first.click()
        page.wait_for_url(f"{desk.address}/rides")
        page.goto(f"{desk.address}/settings")
        with page.expect_download() as saved:
            page.locator("a[href$='store/backup']").click()
        assert saved.value.path().stat().st_size > 0
        with page.context.expect_page() as opened:
            page.locator("a[href='api/docs']").click()
        expect(opened.value.locator("h1")).to_contain_text("API")


def test_values_come_without_a_socket_and_the_page_says_so(
    open_desk: OpenDesk, server: SpindleServer, riding: str
) -> None:
    desk = open_desk()
    desk.allow("WebSocket")
    with Proxy(server.url, sockets=False) as proxy:
        desk.page.goto(f"{proxy.url}/live")
        told = desk.page.get_by_test_id("polled")
        expect(told).to_contain_text("values come once a second")
        expect(told).to_contain_text("docs/behind-a-proxy.md")
        expect(desk.page.get_by_test_id("stream-status")).to_have_text("Live")

        proxy.sockets = True

        expect(told).to_have_count(0)
        expect(desk.page.get_by_test_id("stream-status")).to_have_text("Live")
