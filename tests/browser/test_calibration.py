"""Goal: whoever hangs masses on a pedal gets a calibrated sensor and its certificate from the page,
whatever is lost on the way: the cable, the server, the right mass.

Method: the workshop of the story, a unit behind a cable that is pulled and a sensor with a zero and
a gain of its own; masses are hung on the page's own workbench. The server is behind a relay, so
that the page finds the next one where it was.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from backend.cli import main
from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import COVERED, JUDGE, SMALL_TARGETS
from tests.fakes.relay import Relay
from tests.fakes.server import ServerProcess, eventually
from tests.stories.test_a_sensor_is_calibrated import Workshop

GAIN = 1.03
LOADS_KG = "10, 25, 40"
TAKE = "[data-testid=take]"
WIZARD = "[data-testid=wizard]"


@pytest.fixture
def workshop(tmp_path: Path) -> Iterator[Workshop]:
    key = tmp_path / "maker.pem"
    assert main(["unlock", "keygen", str(key)]) == 0
    made = Workshop(tmp_path, GAIN, key)
    yield made
    made.end()


def relay_to(workshop: Workshop, port: int = 0) -> Relay:
    return Relay(int(workshop.server.url.rsplit(":", 1)[-1]), port)


def begin(page: Page, workshop: Workshop) -> None:
    """Opens a calibration of one pedal and says what hangs there."""
    page.get_by_role("button", name="Begin a calibration").click()
    form = page.get_by_test_id("calibration-setup")
    form.get_by_label("Loads hung on in turn").fill(LOADS_KG)
    page.keyboard.press("Tab")
    # What is typed and not yet sent survives a reload.
    page.reload()
    expect(form.get_by_label("Loads hung on in turn")).to_have_value(LOADS_KG)
    form.get_by_label("left pedal").uncheck()
    page.get_by_role("button", name="Next: zero").click()
    expect(page.get_by_test_id("capture")).to_contain_text("Take everything off")
    (job,) = workshop.server.get("/calibrations")["items"]
    workshop.path = f"/calibrations/{job['id']}"


def hang(page: Page, workshop: Workshop, mass_kg: float | None = None) -> None:
    """Hangs on the simulated bike's workbench what is asked for, or something else."""
    bench = page.get_by_test_id("workbench")
    if mass_kg is not None:
        bench.get_by_label("Mass").fill(str(mass_kg))
    hung_kg = float(bench.get_by_label("Mass").input_value())
    bench.get_by_role("button", name="Hang it there" if hung_kg else "Take it off").click()
    workshop.wait_still(hung_kg)


def capture(page: Page, workshop: Workshop, count: int = 100, hung_kg: float | None = None) -> None:
    """The next steps, with the space bar; something else than is said may hang there."""
    while count and workshop.next_state() is not None:
        there = len(workshop.job()["captures"])
        hang(page, workshop, hung_kg)
        expect(page.locator(TAKE)).to_be_enabled()
        page.keyboard.press("Space")
        eventually(lambda: len(workshop.job()["captures"]), lambda seen, had=there: seen > had)
        expect(page.locator("[data-capture]")).to_have_count(
            sum(step["capture"] is not None for step in workshop.job()["steps"])
        )
        count -= 1


def read_the_crank_again(page: Page, desk: Desk) -> None:
    """First as the next longer crank, which is no reading of this one."""
    again = page.get_by_test_id("arm-again")
    expect(page.get_by_role("button", name="Take this fit")).to_be_disabled()
    again.get_by_label("Crank length").fill("172,5")
    page.keyboard.press("Enter")
    expect(again).to_contain_text("The plan says 170.0 mm")
    desk.picture("calibrate-arm-again", full=True)
    again.get_by_label("Crank length").fill("170")
    page.keyboard.press("Enter")
    expect(again).to_have_count(0)


def lose(page: Page, workshop: Workshop, way: Relay) -> Relay:
    """Pulls the cable, then kills the server; the page goes on both times. The way since then."""
    workshop.cable.cut()
    expect(page.get_by_test_id("away")).to_be_visible()
    expect(page.get_by_test_id("capture")).to_have_count(0)
    workshop.cable.mend()
    expect(page.get_by_test_id("away")).to_have_count(0)
    capture(page, workshop, 2)

    assert isinstance(workshop.server, ServerProcess)
    workshop.server.kill()
    way.cut()
    expect(page.get_by_test_id("lost")).to_be_visible()
    expect(page.locator("[data-capture]")).to_have_count(6)
    workshop.start(here=True)
    way = relay_to(workshop, way.port)
    expect(page.get_by_test_id("lost")).to_have_count(0)
    expect(page.get_by_test_id("capture")).to_be_visible()
    return way


def err(page: Page, workshop: Workshop, desk: Desk) -> None:
    """Hangs a wrong mass, sees it refused by name, and takes it again."""
    # 20 kg hang where 10 kg are said.
    capture(page, workshop, 3)
    capture(page, workshop, 1, hung_kg=20.0)
    capture(page, workshop)
    expect(page.locator("[data-refused=wrong_mass]")).to_contain_text("10 kg are named")
    expect(page.get_by_role("button", name="Take this fit")).to_be_disabled()
    desk.picture("calibrate-wrong-mass", full=True)
    page.locator("button.wrong").click()
    page.get_by_role("button", name="Take this one again").click()
    expect(page.locator(WIZARD)).to_have_attribute("data-step", "weights")
    capture(page, workshop)


def test_a_sensor_is_calibrated_though_cable_server_and_a_mass_go_wrong(
    open_desk: OpenDesk, workshop: Workshop, tmp_path: Path, axe: str
) -> None:
    way = relay_to(workshop)
    desk = open_desk(address=f"http://127.0.0.1:{way.port}")
    desk.allow(r"Failed to load resource|WebSocket")
    page = desk.open("/sensor")
    begin(page, workshop)
    capture(page, workshop, 3)
    page.keyboard.press("Backspace")
    expect(page.locator("[data-capture]")).to_have_count(2)
    capture(page, workshop, 2)
    way = lose(page, workshop, way)
    err(page, workshop, desk)

    read_the_crank_again(page, desk)
    page.get_by_role("button", name="Take this fit").click()
    page.get_by_label("Reason").fill("spring service")
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    page.get_by_role("button", name="Write to the unit").click()
    page.get_by_test_id("capture").get_by_label("Mass").fill("30")
    hang(page, workshop)
    expect(page.locator(TAKE)).to_be_enabled()
    page.locator(TAKE).click()
    expect(page.get_by_test_id("verified")).to_contain_text("agrees")
    desk.picture("calibrate-verified", full=True)
    newest = workshop.server.get(f"/devices/{workshop.device}/config/revisions")["items"][0]
    assert newest["reason"] == "spring service"

    # From any step the way back shows what the unit gets, and asks why.
    page.get_by_test_id("steps").get_by_role("button", name="Fit").click()
    page.get_by_role("button", name="Restore the old one").click()
    expect(page.get_by_test_id("restore")).to_contain_text("What the unit gets back")
    expect(page.get_by_test_id("restore").get_by_label("Reason")).to_be_visible()
    page.get_by_role("button", name="Back").click()
    page.get_by_role("button", name="Close with its certificate").click()
    sheet = page.get_by_test_id("certificate-sheet")
    # The wrong mass is told with what it was struck out for.
    expect(sheet.get_by_test_id("captures-table")).to_contain_text("struck out: taken again")
    captured = len(workshop.job()["captures"])
    expect(sheet.get_by_test_id("captures-table").locator("tbody tr")).to_have_count(captured)
    told = sheet.get_by_test_id("certificate-hash").inner_text()
    paper = sheet.get_by_role("link", name="PDF").get_attribute("href")
    answer = page.request.get(f"{desk.address}/{paper}")
    assert answer.headers["content-type"] == "application/pdf"
    assert answer.body().startswith(b"%PDF")
    with page.expect_download() as waiting:
        sheet.get_by_role("link", name="Save as a file").click()
    file = tmp_path / "certificate.json"
    waiting.value.save_as(file)
    assert told in file.read_text()
    assert main(["calibrate", "evaluate", str(file)]) == 0
    assert sideways(page) == 0

    phone = open_desk(width=390, height=844, language="zh-CN", theme="dark", address=desk.address)
    phone.open("/sensor")
    phone.page.get_by_role("button", name="查看").click()
    expect(phone.page.get_by_test_id("certificate-sheet")).to_contain_text("标定证书")
    assert sideways(phone.page) == 0
    assert phone.page.evaluate(SMALL_TARGETS) == []
    assert phone.page.evaluate(COVERED) == []
    way.cut()
