"""Goal: behind a proxy the pages work, or say what the proxy lacks.

Method: a real browser, a proxy in Python with the mistakes that nginx makes unless told otherwise.
The configurations of docs/behind-a-proxy.md are tried with the real ones in tests/stories.
"""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.fakes.proxy import Proxy
from tests.fakes.server import SpindleServer

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
