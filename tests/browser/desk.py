"""A browser page on the real server, with an eye on what no page of ours may do."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from playwright.sync_api import ConsoleMessage, Page, Request

from tests.fakes.server import eventually

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "test-results"
# A refused request is also written to the console by the browser itself, not by our code.
REFUSED = re.compile(r"Failed to load resource: the server responded with a status of 4\d\d")

# The page scrolls in `main`; what is wider than the window would be hidden there, too.
BELOW = "(({ scrollHeight, clientHeight }) => scrollHeight - clientHeight)(main)"
SIDEWAYS = """() => Math.max(...[document.documentElement, document.getElementById('main')]
    .filter(Boolean).map(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth))"""
# An answer makes a page ask for more: a unit, its configuration, what that gives.
QUESTIONS_IN_TURN = 3
TWO_FRAMES = """() => new Promise((shown) =>
    requestAnimationFrame(() => requestAnimationFrame(shown)))"""


def sideways(page: Page) -> int:
    """By how many pixels a page is wider than its window."""
    return int(page.evaluate(SIDEWAYS))


# Warnings are told with the place that gave them: one that comes once in a hundred runs has to be
# found from what that run printed.
TRACED = """for (const kind of ['warn', 'error']) {
    const say = console[kind]
    console[kind] = (...words) => say.call(console, ...words, new Error().stack)
}"""


class Desk:
    """One page. `complaints` collects errors of scripts and requests that leave the machine."""

    def __init__(self, page: Page, address: str) -> None:
        self.page = page
        self.address = address
        self.complaints: list[str] = []
        self.allowed: list[re.Pattern[str]] = []
        self.unanswered: set[Request] = set()
        page.add_init_script(TRACED)
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.complaints.append(f"script: {error}"))
        page.on("request", self._request)
        page.on("requestfinished", self._answered)
        page.on("requestfailed", self._answered)

    def open(self, path: str) -> Page:
        """Loads a page of the application and waits until it says something."""
        self.page.goto(self.address + path)
        self.page.wait_for_selector("main :is(section, form, fieldset, table, div)")
        return self.page

    def settle(self) -> None:
        """Waits until what the page has asked for is answered and shown, and what it asked then.

        A page that follows a rider asks for ever, so that there is no end to wait for.
        """
        for _ in range(QUESTIONS_IN_TURN):
            asked = set(self.unanswered)

            eventually(partial(self._left_of, asked), lambda urls: urls == [])

    def picture(self, name: str, full: bool = False) -> None:
        """Keeps a picture for people to look at."""
        PICTURES.mkdir(exist_ok=True)
        window = self.page.viewport_size
        if full and window:
            below = int(self.page.evaluate(BELOW))
            self.page.set_viewport_size({**window, "height": window["height"] + below})
        self.page.screenshot(path=str(PICTURES / f"{name}.png"))
        if full and window:
            self.page.set_viewport_size(window)

    def allow(self, pattern: str) -> None:
        """Complaints like this are what the test provokes."""
        self.allowed.append(re.compile(pattern))

    def unexpected(self) -> list[str]:
        """Complaints that no test asked for."""
        return [c for c in self.complaints if not any(p.search(c) for p in self.allowed)]

    def number(self, selector: str) -> float:
        """The number shown by an element; NaN while it shows a dash."""
        text = self.page.inner_text(selector).replace(",", "").replace("\u2212", "-")
        found = re.search(r"-?\d+(\.\d+)?", text)
        return float(found.group()) if found else float("nan")

    def plot(self, script: str) -> Any:
        """Evaluates an expression over `gd`, the page's Plotly node."""
        found = "const gd = document.querySelector('.js-plotly-plot')"
        return self.page.evaluate(f"() => {{ {found}; return gd ? {script} : null }}")

    def until(self, script: str) -> None:
        """Waits until an expression is true (Playwright's own waiting needs eval: CSP bars it)."""
        eventually(lambda: self.page.evaluate(f"() => {script}"))

    def _console(self, message: ConsoleMessage) -> None:
        if message.type in ("error", "warning") and not REFUSED.search(message.text):
            self.complaints.append(f"console: {message.text}")

    def _left_of(self, asked: set[Request]) -> list[str]:
        """Which of these are not answered two frames later."""
        self.page.evaluate(TWO_FRAMES)
        return [request.url for request in asked & self.unanswered]

    def _answered(self, request: Request) -> None:
        self.unanswered.discard(request)

    def _request(self, request: Request) -> None:
        self.unanswered.add(request)
        parts = urlsplit(request.url)
        if parts.scheme not in ("data", "blob") and parts.hostname != "127.0.0.1":
            self.complaints.append(f"request leaves the machine: {request.url}")
