"""One real server for all browser tests, with a two-hour ride on its shelf; each test brings the
simulated unit it needs, and takes it away again.
"""

from __future__ import annotations

import os
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Playwright, expect, sync_playwright

from tests.browser.chromium import NoChromium, find_chromium
from tests.browser.desk import ROOT, Desk
from tests.browser.long_ride import write_long_ride
from tests.browser.recorded_ride import get_under_way
from tests.fakes.server import ServerHere, SpindleServer
from tests.run import started

OpenDesk = Callable[..., Desk]
# With a window, slow enough to follow.
SLOW_MOTION_MS = 150

# As long as a page is waited for: a machine that is busy is no reason to fail.
expect.set_options(timeout=30_000)


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """A server without a unit, with the long ride."""
    if not (ROOT / "frontend" / "dist" / "index.html").is_file():
        pytest.fail("The pages are not built: run `make setup`.", pytrace=False)
    data = tmp_path_factory.mktemp("browser")
    write_long_ride(data)
    with ServerHere(data) as running:
        yield running


@pytest.fixture(scope="session")
def playwright() -> Iterator[Playwright]:
    with sync_playwright() as running:
        yield running


@pytest.fixture(scope="session")
def launch(playwright: Playwright) -> Callable[..., Browser]:
    """Starts a Chromium; extra words go to its command line. SPINDLE_HEADED=1 shows its window."""
    headed = bool(os.environ.get("SPINDLE_HEADED"))
    try:
        path = find_chromium(playwright.chromium.executable_path, headed)
    except NoChromium as none:
        pytest.fail(str(none), pytrace=False)

    # No sandbox: it needs rights that containers of test machines do not give.
    def start(*words: str) -> Browser:
        started.HERE.note(started.BROWSER)
        return playwright.chromium.launch(
            executable_path=path,
            args=["--no-sandbox", *words],
            headless=not headed,
            slow_mo=SLOW_MOTION_MS if headed else 0,
        )

    return start


@pytest.fixture(scope="session")
def browser(launch: Callable[..., Browser]) -> Iterator[Browser]:
    running = launch()
    yield running
    running.close()


@pytest.fixture
def open_desk(browser: Browser, server: SpindleServer) -> Iterator[OpenDesk]:
    """Opens desks with the wanted width, theme and language; none may complain unexpectedly."""
    desks: list[Desk] = []

    def open_one(
        width: int = 1280,
        height: int = 800,
        theme: Any = "light",
        language: str = "en-GB",
        within: Browser = browser,
        address: str = server.url,
        touch: bool = False,
    ) -> Desk:
        context = within.new_context(
            viewport={"width": width, "height": height},
            color_scheme=theme,
            locale=language,
            timezone_id="Europe/Berlin",
            has_touch=touch,
        )
        context.grant_permissions(["clipboard-read", "clipboard-write"])
        desk = Desk(context.new_page(), address)
        desks.append(desk)
        return desk

    yield open_one
    complaints = [complaint for desk in desks for complaint in desk.unexpected()]
    for desk in desks:
        # An answer that a test's route still waits for must not fail the test after it.
        if not desk.page.is_closed():
            desk.page.unroute_all(behavior="ignoreErrors")
        desk.page.context.close()
    assert complaints == []


@pytest.fixture
def desk(open_desk: OpenDesk) -> Desk:
    """A desk as most have it: 1280 wide, light, English."""
    return open_desk()


@pytest.fixture
def standing(server: SpindleServer, tmp_path: Path) -> Iterator[str]:
    """The id of the only unit there is: at rest, with the configuration of the factory."""
    # Another one for each test, and for each attempt at one.
    seed = zlib.crc32(tmp_path.name.encode())
    device = server.add_unit(f"sim:own?scenario=none&seed={seed}")
    yield device
    server.ask("DELETE", f"/devices/{device}")


@pytest.fixture
def riding(server: SpindleServer, standing: str) -> str:
    """The id of the unit, with a rider who pushes steadily in the fuzzy mode on a flat road."""
    get_under_way(server, standing)
    return standing


@pytest.fixture(scope="session")
def axe() -> str:
    """The source of axe-core, which the frontend pins."""
    return Path(ROOT / "frontend/node_modules/axe-core/axe.min.js").read_text(encoding="utf-8")
