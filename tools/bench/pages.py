"""How long whoever works on a page waits, in a real browser: from the key that edits a rule to the
map and to the surface in three dimensions, from the end of a drag to a ride's finer curve; and how
smoothly the live strips run.

Each waits for what is drawn and for the frame after it, so that what the eye sees is counted. The
browser paints by software, as on a machine without a graphics card.
"""

import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from playwright.sync_api import Page, sync_playwright

from tests.browser.chromium import NoChromium, find_chromium
from tests.browser.long_ride import ROWS, write_long_ride
from tools.bench.figures import Figure
from tools.bench.server import ask, serving

EDITS = 40
EDITS_3D = 20
ZOOMS = 20
OPENINGS = 10
WITHIN_MS = 20_000
WATCHED_S = 10.0
FRAMES_A_SECOND_MIN = 25.0
# Frames a second that the browser has shown while so many seconds passed.
FRAME_RATE = """(watched_s) => new Promise((told) => {
    const begun_ms = performance.now()
    let frames = 0
    const next = () => {
        frames += 1
        const passed_s = (performance.now() - begun_ms) / 1000
        if (passed_s < watched_s) requestAnimationFrame(next)
        else told(frames / passed_s)
    }
    requestAnimationFrame(next)
})"""
# Counts from the event to the frame after the next drawing of other data: pixels of ours, or a
# Plotly curve that is not the old one moved.
STOPWATCH = """([kind, where]) => {
    window.taken_ms = null
    const node = document.querySelector(where)
    const drawn = () => {
        if (node.data) return String(node.data[0].x)
        const canvas = node.querySelector('canvas')
        const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height)
        return new Uint32Array(data.buffer).reduce((sum, pixel) => (31 * sum + pixel) | 0, 7)
    }
    const before = drawn()
    addEventListener(kind, (event) => {
        const begun_ms = event.timeStamp
        const seen = new MutationObserver(() => {
            if (drawn() === before) return
            seen.disconnect()
            requestAnimationFrame(() => setTimeout(() =>
                (window.taken_ms = performance.now() - begun_ms)))
        })
        seen.observe(node, { attributes: true, attributeFilter: ['data-draws'] })
    }, { once: true, capture: true })
}"""


def run() -> list[Figure]:
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        data = Path(folder)
        write_long_ride(data)
        try:
            path = find_chromium(playwright.chromium.executable_path)
        except NoChromium as none:
            return [Figure("pages in a browser", "not measured", "", None, str(none).split(".")[0])]
        with serving(data, "sim:pages?scenario=none") as (_process, address, _ready):
            device = ask(address, "/devices")["items"][0]["id"]
            still = {"rider": {"kind": "off"}, "brake": True}
            ask(address, f"/devices/{device}/simulation", "PUT", still)
            ride = next(r["id"] for r in ask(address, "/rides")["items"] if r["row_count"] >= ROWS)
            browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
            page = browser.new_page(viewport={"width": 1280, "height": 800})
            try:
                return measure(page, address.removesuffix("/api/v1"), ride)
            finally:
                browser.close()


def measure(page: Page, site: str, ride: int) -> list[Figure]:
    page.goto(f"{site}/live")
    page.wait_for_selector("[data-channel=speed_kmh]")
    frames_a_second = float(page.evaluate(FRAME_RATE, WATCHED_S))
    page.goto(f"{site}/tune")
    surface = "[data-testid=surface]"
    page.wait_for_selector(f"{surface}[data-draws]")
    map_ms = waits(page, "keydown", surface, EDITS, edit)
    page.get_by_role("button", name="3D").click()
    solid = f"{surface}[data-kind='3d']"
    page.wait_for_selector(f"{solid}[data-draws]", timeout=60_000)
    solid_ms = waits(page, "keydown", solid, EDITS_3D, edit)
    traces = "[data-testid=traces]"
    open_ms = sorted(opens(page, f"{site}/rides/{ride}", f"{traces}[data-draws]"))
    zoom_ms = waits(page, "mouseup", traces, ZOOMS, zoom)
    return [
        figure("a rule is edited: until the map shows it", map_ms, 60),
        figure("a rule is edited: until the surface in three dimensions shows it", solid_ms, 300),
        figure("a two-hour ride is opened: until its traces are there", open_ms, 1500),
        figure("a two-hour ride is zoomed: until the finer curve is there", zoom_ms, 150),
        Figure(
            "live strips, while the unit streams",
            f"{frames_a_second:.0f} frames/s",
            f">= {FRAMES_A_SECOND_MIN:.0f} frames/s",
            frames_a_second >= FRAMES_A_SECOND_MIN,
            f"over {WATCHED_S:.0f} s, painted by software",
        ),
    ]


def waits(
    page: Page, kind: str, where: str, times: int, act: Callable[[Page, int], None]
) -> list[float]:
    """How long each of so many acts took until it was seen, in ms; the first three are warm-up."""
    taken = []
    for number in range(times + 3):
        page.evaluate(STOPWATCH, [kind, where])
        act(page, number)
        taken.append(until_taken(page))
    return sorted(taken[3:])


def opens(page: Page, address: str, ready: str) -> list[float]:
    """How long a page takes from its address to what it is for, in ms, the browser's cache warm
    after the first."""
    taken = []
    for _ in range(OPENINGS + 1):
        page.goto("about:blank")
        begun_s = time.monotonic()
        page.goto(address)
        page.wait_for_selector(ready)
        taken.append((time.monotonic() - begun_s) * 1000.0)
    return taken[1:]


def until_taken(page: Page) -> float:
    end_s = time.monotonic() + WITHIN_MS / 1000
    while time.monotonic() < end_s:
        # What comes after the drawing (findings, paint) must not run into the next act.
        page.wait_for_timeout(250)
        taken: Any = page.evaluate("window.taken_ms")
        if taken is not None:
            return float(taken)
    raise TimeoutError(f"nothing was drawn within {WITHIN_MS} ms")


def edit(page: Page, _number: int) -> None:
    """A rule in the middle goes from one end to the other."""
    page.focus("[data-cell='2,2']")
    lowest = page.inner_text("[data-cell='2,2'] .label") == "NB"
    page.keyboard.press("5" if lowest else "1")


def zoom(page: Page, number: int) -> None:
    """A drag over a part of the whole ride, another one each time."""
    whole = page.get_by_role("button", name="Whole ride")
    if whole.is_enabled():
        whole.click()
        page.wait_for_timeout(400)
    page.evaluate(STOPWATCH, ["mouseup", "[data-testid=traces]"])
    box = page.locator("[data-testid=traces]").bounding_box()
    assert box is not None
    left = box["x"] + 120 + 20 * (number % 20)
    page.mouse.move(left, box["y"] + 60)
    page.mouse.down()
    page.mouse.move(left + 150, box["y"] + 62, steps=4)
    page.mouse.up()


def figure(subject: str, taken_ms: list[float], most_ms: float) -> Figure:
    late_ms = taken_ms[int(0.95 * (len(taken_ms) - 1) + 0.5)]
    median_ms = taken_ms[len(taken_ms) // 2]
    return Figure(
        subject,
        f"{late_ms:.0f} ms (95th percentile)",
        f"<= {most_ms:.0f} ms",
        late_ms <= most_ms,
        f"median {median_ms:.0f} ms of {len(taken_ms)}, painted by software",
    )
