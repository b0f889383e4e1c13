"""Goal: every page, in three widths, two themes and two languages, is without fault for axe-core,
moves nothing by itself while it comes, never scrolls sideways, and fits a finger on a phone.

Method: a unit that is being ridden, with a recorded ride behind it. `make test` opens each page in
the two ways that differ most, `make prove` in all.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal

import pytest

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.recorded_ride import record_ride, ride_off
from tests.browser.test_pages_for_everyone import COVERED, JUDGE, SMALL_TARGETS
from tests.fakes.server import ServerProcess, SpindleServer

Theme = Literal["light", "dark"]
SHIFT_MAX = 0.02
# A name of a text that has no words would be read as it stands; a database's file is none.
BARE_KEY = re.compile(r"\b[a-z]+\.(?!db\b)[a-z_]+\b")
# What moved by itself while the page came, how much of the window that was, and where from and to.
MOVES = """() => new Promise((told) => {
    const place = ({ y, height }) => `${Math.round(y)}+${Math.round(height)}`
    const name = (node) => node ? (node.className || node.nodeName) + ' ' +
        (node.textContent ?? '').trim().replace(/\\s+/g, ' ').slice(0, 30) : ''
    const moves = []
    new PerformanceObserver((list) => moves.push(...list.getEntries())).observe(
        { type: 'layout-shift', buffered: true })
    setTimeout(() => told(moves.filter((move) => !move.hadRecentInput).map(({ value, sources }) =>
        [value, sources.map(({ node, previousRect, currentRect }) =>
            `${name(node)}: ${place(previousRect)} to ${place(currentRect)}`).join('; ')])), 500)
})"""
HEIGHTS = {1440: 900, 1024: 800, 390: 844}
PHONE = 390
PAGES = {
    "bike": ("/", "[data-testid=link-health]"),
    "connect": ("/connect", "[data-testid=what-works] dd"),
    "live": ("/live", "[data-draws]"),
    "tune": ("/tune", "[data-testid=surface][data-draws]"),
    "modes": ("/tune/modes", "[data-testid=modes] .ridden svg"),
    "try": ("/tune/try?ride={ride}&with=unit", "[data-testid=traces][data-draws]"),
    "why-ride": ("/tune/why?ride={ride}", "[data-testid=why-answer]"),
    "why-now": ("/tune/why?now", "[data-testid=why-answer]"),
    "why-state": ("/tune/why?state", "[data-testid=why-answer]"),
    "library": ("/tune/library", "[data-testid=difference-map][data-draws]"),
    "rides": ("/rides", "[data-testid=ride-table]"),
    "ride": ("/rides/{ride}", "[data-testid=traces][data-draws]"),
    "compare": (
        "/rides/compare?a={ride}&b={ride}&b_from_s=5",
        "[data-testid=traces][data-draws]",
    ),
    "sensor": ("/sensor", "[data-parameter=sensor_offset_counts]"),
    "service": ("/service", "[data-testid=fault-box], section"),
    "settings": ("/settings", "fieldset"),
}


@pytest.fixture(scope="module")
def bike(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[SpindleServer, int]]:
    """A server whose unit is being ridden, and the id of the ride before."""
    running = ServerProcess(tmp_path_factory.mktemp("pages"), ["sim:pages?seed=5&speed=5"]).start()
    device = running.ready_device()
    ride = record_ride(running, device)
    running.simulate(device, speed_factor=1.0)
    ride_off(running, device)
    yield running, ride
    running.stop()


def faults(desk: Desk, name: str, ride: int, axe: str, themes: list[Theme]) -> list[str]:
    """What is wrong with a page, a line each."""
    path, ready = PAGES[name]
    width = (desk.page.viewport_size or {})["width"]
    desk.page.emulate_media(color_scheme=themes[0])
    page = desk.open(path.format(ride=ride))
    page.wait_for_selector(ready)
    # Before axe-core: it holds the page up for so long that live values grow old.
    moves = page.evaluate(MOVES)
    page.evaluate(axe)
    found: list[object] = []
    for theme in themes:
        page.emulate_media(color_scheme=theme)
        desk.until(f"document.documentElement.dataset.theme === '{theme}'")
        found += page.evaluate(JUDGE)
    if sum(share for share, _ in moves) >= SHIFT_MAX:
        found += [f"{share:.3f} moved: {what}" for share, what in moves]
    if sideways(page):
        found.append("scrolls sideways")
    found += page.evaluate(COVERED)
    found += BARE_KEY.findall(page.inner_text("main"))
    if width == PHONE:
        found += page.evaluate(SMALL_TARGETS)
    desk.picture(f"{name}-{width}-{page.get_attribute('html', 'lang')}-{themes[-1]}")
    return [f"{width}: {one}" for one in found]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("width", "theme", "language"), [(1440, "light", "en-GB"), (PHONE, "dark", "zh-CN")]
)
@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_for_everyone(
    open_desk: OpenDesk,
    bike: tuple[SpindleServer, int],
    axe: str,
    name: str,
    width: int,
    theme: Theme,
    language: str,
) -> None:
    server, ride = bike
    desk = open_desk(
        width, HEIGHTS[width], theme, language, address=server.url, touch=width == PHONE
    )

    assert "\n".join(faults(desk, name, ride, axe, [theme])) == ""


@pytest.mark.long
@pytest.mark.slow
@pytest.mark.parametrize("language", ["en-GB", "zh-CN"])
@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_for_everyone_in_every_width_and_theme(
    open_desk: OpenDesk,
    bike: tuple[SpindleServer, int],
    axe: str,
    name: str,
    language: str,
) -> None:
    server, ride = bike

    def at(width: int) -> list[str]:
        desk = open_desk(
            width, HEIGHTS[width], "light", language, address=server.url, touch=width == PHONE
        )
        return faults(desk, name, ride, axe, ["light", "dark"])

    assert "\n".join(fault for width in HEIGHTS for fault in at(width)) == ""
