"""Goal: a workshop sees what was checked and what changed, goes back to what was, and has it on a
sheet.

Real server and unit; the history is made by two changes of the configuration.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

from playwright.sync_api import expect

from backend.formats.backup import read_backup
from tests.browser.conftest import OpenDesk
from tests.browser.desk import sideways
from tests.browser.judged import COVERED, JUDGE, moved
from tests.fakes.server import SpindleServer

CALIBRATED = {
    "calibrated_at_utc_s": 1795650000,
    "calibration_number": 4,
    "calibration_certificate": [1, 2, 3, 4, 5, 6, 7, 8],
}


def test_two_of_the_history_are_compared_and_parts_of_one_restored(
    open_desk: OpenDesk, server: SpindleServer, standing: str, axe: str
) -> None:
    before = server.get(f"/devices/{standing}/config")
    rules = [list(row) for row in before["parameters"]["fuzzy_rules"]]
    rules[0][0] = "NB"
    for parameters in (CALIBRATED, {"fuzzy_rules": rules}, {"pedal_stop_ms": 210.0}):
        own = {"read_from": before["unit_key"]}
        body = {"parameters": parameters, "reason": "wet climbs", **own}
        server.ask("PATCH", f"/devices/{standing}/config", json=body)
    desk = open_desk(width=1440, height=900)
    page = desk.open("/service")

    checks = page.get_by_test_id("checks")
    expect(checks).to_contain_text("Battery voltage")
    expect(checks.locator("tbody .passed")).to_have_count(7)
    with page.expect_download() as support:
        page.get_by_role("button", name="File for support").click()
    assert json.loads(support.value.path().read_text())["format"] == "spindle-support"
    against = page.get_by_test_id("against")
    expect(against).to_contain_text("150 ms")
    name = f"Compare from here: A, generation {before['generation']}"
    page.get_by_role("button", name=name).first.click()
    expect(against.locator(".differs")).to_have_count(2)
    expect(against).to_contain_text("210 ms")
    expect(against).to_contain_text("0102030405060708")
    changes = page.get_by_role("region", name="Changes of the configuration").first
    expect(changes).to_contain_text("1 differ: ZO → NB")
    page.get_by_role("textbox", name="Job", exact=True).fill("0815")
    page.reload()
    expect(page.get_by_test_id("service-bar")).to_contain_text("Job 0815")
    assert moved(page) == []
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []

    for restored, told in (("Only the rules", "1 changed"), ("Restore A", "2 changed")):
        page.goto(f"{server.url}/service")
        page.get_by_role("button", name=name).first.click()
        expect(against.get_by_label("Calibration")).not_to_be_checked()
        page.get_by_role("button", name=restored).click()
        expect(page).to_have_url(re.compile("/tune$"))
        expect(page.get_by_test_id("draft-bar")).to_contain_text(told)
        page.get_by_role("button", name="Discard").click()

    page.goto(f"{server.url}/service")
    page.get_by_role("button", name=name).first.click()
    against.get_by_label("Calibration").check()
    desk.picture("service-restore", full=True)
    page.get_by_role("button", name="Restore A").click()
    page.get_by_role("button", name="Review and write").click()
    row = page.get_by_role("dialog").get_by_role("row", name="Certificate")
    expect(row).to_contain_text("0102030405060708")


def test_a_dark_phone_reads_the_service_in_chinese(
    open_desk: OpenDesk, standing: str, axe: str
) -> None:
    desk = open_desk(width=390, height=844, theme="dark", language="zh-CN", touch=True)
    page = desk.open("/service")
    expect(page.get_by_test_id("checks")).to_contain_text("电池电压")

    page.evaluate(axe)

    assert page.evaluate(JUDGE) == []
    assert sideways(page) == 0
    assert page.evaluate(COVERED) == []
    assert re.findall(r"\b[a-z]+\.[a-z_]+\b", page.inner_text("main")) == []


def test_the_backup_of_the_unit_is_read_and_each_revision_has_its_limit_proof(
    open_desk: OpenDesk, server: SpindleServer, standing: str
) -> None:
    config = server.get(f"/devices/{standing}/config")
    desk = open_desk(width=1440, height=900)
    page = desk.open("/service")

    with page.expect_download() as downloading:
        page.get_by_role("button", name="Backup of the unit").click()
    saved = json.loads(Path(downloading.value.path()).read_text())

    assert read_backup(saved, "saved").parameters == config["parameters"]
    assert saved["generation"] == config["generation"]

    changes = page.get_by_role("region", name="Changes of the configuration").first
    changes.get_by_role("button", name="Limit proof").last.click()
    proof = changes.get_by_test_id("proof")
    expect(proof).to_contain_text("statements with their bounds")
