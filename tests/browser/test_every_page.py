"""Goal: every page, in three widths, two themes and two languages, is without fault for axe-core,
moves nothing by itself while it comes, never scrolls sideways, and fits a finger on a phone.

Method: a unit that is being ridden, with a recorded ride behind it. `make test` opens each page
once, the pages in turn in ways that differ most, and then makes its window as wide as the others;
`make prove` opens each page in all ways.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal

import pytest
from playwright.sync_api import Page

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import COVERED, JUDGE, SMALL_TARGETS, moved
from tests.browser.recorded_ride import get_under_way, record_ride
from tests.fakes.server import ServerHere, SpindleServer, eventually

Theme = Literal["light", "dark"]
# A name of a text that has no words would be read as it stands; a database's file is none.
BARE_KEY = re.compile(r"\b[a-z]+\.(?!db\b)[a-z_]+\b")
HEIGHTS = {1440: 900, 1024: 800, 360: 740}
PHONE = 360
WAYS: list[tuple[int, Theme, str]] = [
    (1440, "light", "en-GB"),
    (PHONE, "dark", "zh-CN"),
    (1024, "dark", "en-GB"),
    (PHONE, "light", "en-GB"),
    (1440, "dark", "zh-CN"),
]
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
    "fleet": ("/fleet", "[data-testid=fleet] a"),
    "fleet-bike": ("/fleet/1", "[data-testid=rides-of-bike] a"),
    "audit": ("/audit", "[data-testid=audit] details"),
    "settings": ("/settings", "fieldset"),
}


@pytest.fixture(scope="module")
def bike(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[SpindleServer, int]]:
    """A server whose unit is being ridden, and the id of the ride before."""
    unit = "sim:pages?seed=5&scenario=none&clock=virtual"
    with ServerHere(tmp_path_factory.mktemp("pages"), [unit]) as running:
        device = running.ready_device()
        ride = record_ride(running, device)
        get_under_way(running, device)
        yield running, ride


def misfits(page: Page) -> list[str]:
    """What does not fit the window: the page alone scrolls, and only up and down."""
    found = [f"{row} covers {other}" for row, other in page.evaluate(COVERED)]
    if sideways(page):
        found.append("scrolls sideways")
    height = (page.viewport_size or {})["height"]
    if page.evaluate("document.documentElement.scrollHeight") != height:
        found.append("the window scrolls, not the page in it")
    return found


def faults(desk: Desk, name: str, ride: int, axe: str, themes: list[Theme]) -> list[str]:
    """What is wrong with a page, a line each."""
    path, ready = PAGES[name]
    width = (desk.page.viewport_size or {})["width"]
    desk.page.emulate_media(color_scheme=themes[0])
    page = desk.open(path.format(ride=ride))
    page.wait_for_selector(ready)
    desk.settle()
    # Before axe-core: it holds the page up for so long that live values grow old.
    found: list[object] = [*moved(page)]
    page.evaluate(axe)
    for theme in themes:
        page.emulate_media(color_scheme=theme)
        desk.until(f"document.documentElement.dataset.theme === '{theme}'")
        found += page.evaluate(JUDGE)
    found += misfits(page)
    found += BARE_KEY.findall(page.inner_text("main"))
    if width == PHONE:
        found += page.evaluate(SMALL_TARGETS)
    desk.picture(f"{name}-{width}-{page.get_attribute('html', 'lang')}-{themes[-1]}")
    return [f"{width}: {one}" for one in found]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "way"), [(name, WAYS[i % len(WAYS)]) for i, name in enumerate(PAGES)], ids=[*PAGES]
)
def test_a_page_is_for_everyone(
    open_desk: OpenDesk,
    bike: tuple[SpindleServer, int],
    axe: str,
    name: str,
    way: tuple[int, Theme, str],
) -> None:
    server, ride = bike
    width, theme, language = way
    desk = open_desk(
        width, HEIGHTS[width], theme, language, address=server.url, touch=width == PHONE
    )

    assert "\n".join(faults(desk, name, ride, axe, [theme])) == ""

    for other, height in HEIGHTS.items():
        desk.page.set_viewport_size({"width": other, "height": height})
        # What is drawn follows its window a moment later.
        eventually(lambda: misfits(desk.page), lambda found: found == [], within_s=10.0)


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
