"""Goal: a workshop sees what was checked and what changed, goes back to what was, and has it on a
sheet.

Real server and unit; the history is made by two changes of the configuration.
"""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import sideways
from tests.browser.test_pages_for_everyone import COVERED, JUDGE, SHIFT
from tests.fakes.server import SpindleServer


def test_two_of_the_history_are_compared_and_the_rules_of_one_restored(
    open_desk: OpenDesk, server: SpindleServer, standing: str, axe: str
) -> None:
    before = server.get(f"/devices/{standing}/config")
    rules = [list(row) for row in before["parameters"]["fuzzy_rules"]]
    rules[0][0] = "NB"
    for parameters in ({"fuzzy_rules": rules}, {"pedal_stop_ms": 210.0}):
        body = {"parameters": parameters, "reason": "wet climbs"}
        server.ask("PATCH", f"/devices/{standing}/config", json=body)
    desk = open_desk(width=1440, height=900)
    page = desk.open("/service")

    checks = page.get_by_test_id("checks")
    expect(checks).to_contain_text("Battery voltage")
    expect(checks.locator("tbody .passed")).to_have_count(7)
    against = page.get_by_test_id("against")
    expect(against).to_contain_text("150 ms")
    name = f"Compare from here: A, generation {before['generation']}"
    page.get_by_role("button", name=name).first.click()
    expect(against.locator(".differs")).to_have_count(2)
    expect(against).to_contain_text("210 ms")
    changes = page.get_by_role("region", name="Changes of the configuration").first
    expect(changes).to_contain_text("1 differ: ZO → NB")
    page.get_by_role("textbox", name="Job", exact=True).fill("0815")
    page.reload()
    expect(page.get_by_test_id("service-bar")).to_contain_text("Job 0815")
    assert page.evaluate(SHIFT) < 0.02
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []

    page.get_by_role("button", name=name).first.click()
    page.get_by_role("button", name="Only the rules").click()

    expect(page).to_have_url(re.compile("/tune$"))
    expect(page.get_by_test_id("draft-bar")).to_contain_text("1 changed")
    page.get_by_role("button", name="Discard").click()


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
