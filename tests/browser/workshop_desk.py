"""Pages of the workshop's people, and what each of these pages must keep."""

from __future__ import annotations

from playwright.sync_api import Page

from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE, SMALL_TARGETS
from tests.fakes.workshop import Workshop


def sign_in(desk: Desk, workshop: Workshop, who: str) -> Page:
    """A page that somebody is signed in on."""
    token = workshop.clients[who].cookies["spindle_session"]
    address = workshop.server.url
    here = {"value": "1", "url": address}
    desk.page.context.add_cookies(
        [
            {"name": "spindle_session", "value": token, "url": address},
            {"name": "spindle_signed_in", **here},
        ]
    )
    return desk.page


def check(page: Page, axe: str) -> None:
    """What every page must keep: roles and names, the window's width, room for fingers."""
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    assert sideways(page) == 0
    if page.evaluate("matchMedia('(pointer: coarse)').matches"):
        assert page.evaluate(SMALL_TARGETS) == []
