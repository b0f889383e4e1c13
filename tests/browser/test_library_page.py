"""Goal: a dealer opens a table without writing, keeps what he has drawn, compares two, brings
a file, deletes and takes it back; and looks and compares without a unit.

Method: a server with one simulated unit; what the page says is held against the server's answer.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from playwright.sync_api import Locator, Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import sideways
from tests.browser.judged import JUDGE, SMALL_TARGETS
from tests.fakes.server import SpindleServer


def compared(page: Page) -> str:
    page.wait_for_selector("[data-testid=difference-map][data-draws]")
    return page.inner_text("[data-testid=compared]")


def restored(page: Page, server: SpindleServer, device: str) -> float:
    """What the draft of a revision makes of a value that was changed since."""
    server.stand_still(device)
    body = {"parameters": {"torque_filter_s": 0.6}, "reason": "longer"}
    server.ask("PATCH", f"/devices/{device}/config", json=body)
    before = server.get(f"/devices/{device}/config/revisions")["items"][1]
    page.get_by_label("A", exact=True).last.select_option(f"revision-{before['seq']}")
    page.get_by_role("button", name="A: Open as a draft").click()
    expect(page.get_by_test_id("draft-bar")).to_contain_text("1 changed, not yet in the unit")
    page.get_by_role("button", name="Review").click()
    page.get_by_role("dialog").get_by_role("button", name="Write").click()
    expect(page.get_by_test_id("draft-bar")).to_contain_text("Same as in the unit")
    return float(server.get(f"/devices/{device}/config")["parameters"]["torque_filter_s"])


def replaced_and_brought_back(
    page: Page, server: SpindleServer, kept: Locator, unit: dict[str, Any]
) -> None:
    """The same name again, with the second table, is another version; what it was comes back."""
    path = f"/library/{kept.get_attribute('data-entry')}"
    was = server.get(path)["parameters"]
    page.get_by_label("Name", exact=True).fill("Zhang, city")
    page.get_by_label("Keep in the library").last.select_option("second")
    expect(page.get_by_text("It becomes its version 2")).to_be_visible()
    page.get_by_role("button", name="Replace").click()
    kept.get_by_text("2 versions").click()
    second = server.get(path)["parameters"]
    assert second["fuzzy_rules"]["value"] == unit["second_rules"]
    assert second["fuzzy_inference"]["value"] == unit["second_inference"]
    kept.get_by_role("button", name="Bring back").click()
    expect(kept.get_by_text("3 versions")).to_be_visible()
    assert server.get(path)["parameters"] == was


def test_a_dealer_keeps_opens_compares_and_takes_back(
    open_desk: OpenDesk, server: SpindleServer, standing: str, tmp_path: Path, axe: str
) -> None:
    before = server.get(f"/devices/{standing}/config")["parameters"]
    desk = open_desk(width=1440, height=900)
    page = desk.open("/settings")
    page.get_by_label("Your name").fill("张工")
    page = desk.open("/tune/library?a=even&b=strong-start")

    assert "17 rules differ" in compared(page)
    feel = page.locator("tr[data-feel=start_s] td")
    assert feel.all_inner_texts() == ["12.6 s", "10.2 s"]
    expect(page.locator("[data-entry=even] [data-figure=start_s]")).to_contain_text("12.6 s")

    # Open never writes: the entry is a draft.
    page.locator("[data-entry=strong-start]").get_by_role("button", name="Open as a draft").click()
    page.wait_for_selector("[data-testid=surface][data-draws]")
    expect(page.get_by_test_id("draft-bar")).to_contain_text("not yet in the unit")
    assert server.get(f"/devices/{standing}/config")["parameters"] == before

    page.get_by_role("link", name="Library").click()
    page.get_by_label("Name", exact=True).fill("Zhang, city")
    page.get_by_role("button", name="Save").click()
    kept = page.locator("[data-entry^=own-]").filter(has_text="Zhang, city")
    expect(kept).to_contain_text("张工")
    entry_id = kept.get_attribute("data-entry")
    values, preset = (
        {name: entry["value"] for name, entry in server.get(path)["parameters"].items()}
        for path in (f"/library/{entry_id}", "/library/strong-start")
    )
    assert values == preset

    replaced_and_brought_back(page, server, kept, before)

    page.get_by_label("A", exact=True).last.select_option("draft")
    page.get_by_label("B", exact=True).last.select_option(entry_id)
    expect(page.get_by_test_id("compared")).to_have_text("The two are the same.")

    file = tmp_path / "mine.fis"
    file.write_bytes(server.client.get("/library/even/export?format=fis").content)
    page.locator("input[type=file]").set_input_files(file)
    mine = page.locator("[data-entry^=own-]").filter(has_text="mine")
    expect(mine).to_be_visible()
    expect(page.get_by_text("differs from the file by at most 0.0000")).to_be_visible()
    mine.get_by_role("button", name="Delete").click()
    expect(mine).to_have_count(0)
    page.get_by_role("button", name="Undo").click()
    expect(mine).to_be_visible()
    was = restored(page, server, standing)
    assert was == 0.5
    page.get_by_role("link", name="Library").click()
    compared(page)
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    assert sideways(page) <= 0
    desk.picture("library-1440", full=True)
    assert server.get(f"/devices/{standing}/config")["parameters"] == before


def test_without_a_unit_a_phone_still_looks_and_compares(
    open_desk: OpenDesk, server: SpindleServer, axe: str
) -> None:
    desk = open_desk(width=390, height=844, touch=True, theme="dark", language="zh-CN")
    nobody = {"json": {"items": [], "next": None}}
    desk.page.route("**/api/v1/devices", lambda route: route.fulfill(**nobody))
    page = desk.open("/tune/library?a=even&b=thesis-table")

    assert "条规则不同" in compared(page)
    expect(page.locator("[data-entry=even] [data-figure=start_s]")).to_contain_text("12.6")
    expect(page.locator("[data-entry=even]").get_by_role("button")).to_be_disabled()
    assert page.evaluate(SMALL_TARGETS) == []
    assert sideways(page) <= 0
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    desk.picture("library-390-dark", full=True)
