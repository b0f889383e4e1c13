"""Goal: a limit that only goes down says so before it is written, and goes up again with the
maker's token and nothing but the page and the maker's own tool.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import ROOT
from tests.browser.test_pages_for_everyone import JUDGE
from tests.browser.test_tune_page import review
from tests.fakes.server import SpindleServer

CUTOFF = "[data-parameter=assist_cutoff_kmh] input"
PANEL = "[data-testid=unlock]"


def spindle(*words: str | Path) -> str:
    done = subprocess.run(
        [sys.executable, "-m", "backend.cli", *map(str, words)],
        cwd=ROOT, capture_output=True, text=True, timeout=60, check=True,
    )  # fmt: skip
    return done.stdout.strip()


@pytest.fixture(scope="module")
def key(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The maker's private key; the public one lies beside it."""
    file = tmp_path_factory.mktemp("maker") / "maker.pem"
    spindle("unlock", "keygen", file)
    return file


@pytest.fixture(scope="module")
def shop(key: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """A server with one standing unit that carries the maker's key."""
    unit = f"sim:shop?scenario=none&unlock_key={key}.pub"
    running = SpindleServer(tmp_path_factory.mktemp("shop"), [unit]).start()
    running.ready_device()
    yield running
    running.stop()


def write_cutoff(page: Page, kmh: str) -> None:
    page.fill(CUTOFF, kmh)
    page.press(CUTOFF, "Enter")
    review(page)
    page.click("dialog >> text=Write to the unit")


def test_a_limit_is_lowered_freely_and_raised_with_a_token(
    open_desk: OpenDesk, shop: SpindleServer, key: Path, tmp_path: Path, axe: str
) -> None:
    desk = open_desk(address=shop.url)
    page = desk.open("/tune")
    page.click("summary >> text=Limits")
    limit = page.locator("[data-parameter=assist_cutoff_kmh]")
    expect(limit).to_contain_text("up again only with the maker's token")
    page.fill(CUTOFF, "20")
    page.press(CUTOFF, "Enter")
    review(page)
    expect(page.locator("dialog")).to_contain_text("Can be lowered freely")
    desk.picture("ratchet-review")
    page.click("dialog >> text=Write to the unit")
    done = page.locator("[role=status]", has_text="verified")
    expect(done).to_be_visible()
    expect(done.get_by_role("button", name="Undo")).to_have_count(0)

    write_cutoff(page, "25")
    panel = page.locator(PANEL)
    expect(panel).to_contain_text(shop.get("/devices")["items"][0]["identity"]["serial_number"])
    desk.picture("unlock")
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    with page.expect_download() as waiting:
        panel.get_by_role("button", name="Save as a file").click()
    challenge = tmp_path / waiting.value.suggested_filename
    waiting.value.save_as(challenge)
    panel.get_by_label("Token from the maker").fill("hello")
    expect(panel).to_contain_text("This is no token")
    token = tmp_path / "token.txt"
    token.write_text(spindle("unlock", "sign", key, challenge) + "\n")
    panel.locator("input[type=file]").set_input_files(token)
    panel.get_by_role("button", name="Write with the token").click()

    expect(page.locator("dialog")).to_have_count(0)
    device = shop.ready_device()
    assert shop.get(f"/devices/{device}/config")["parameters"]["assist_cutoff_kmh"] == 25.0


def test_a_token_of_somebody_else_is_refused_and_another_challenge_can_be_asked_for(
    open_desk: OpenDesk, shop: SpindleServer
) -> None:
    device = shop.ready_device()
    body = {"parameters": {"motor_speed_rpm_max": 2500.0}, "reason": "lower"}
    shop.ask("PATCH", f"/devices/{device}/config", json=body)
    desk = open_desk(width=360, height=740, language="zh-CN", theme="dark", address=shop.url)
    page = desk.open("/tune")
    page.click("summary >> text=限制")
    field = "[data-parameter=motor_speed_rpm_max] input"
    page.fill(field, "2600")
    page.press(field, "Enter")
    page.click("text=核对并写入")
    page.click("dialog >> text=写入单元")
    panel = page.locator(PANEL)
    panel.locator("textarea").nth(1).fill("00" * 72)
    desk.picture("unlock-phone-zh-dark")
    assert page.evaluate("document.documentElement.scrollWidth") <= 360

    panel.get_by_role("button", name="用令牌写入").click()

    expect(page.locator("dialog [role=alert]")).to_contain_text("令牌")
    expect(panel).to_have_count(0)
    desk.picture("unlock-refused-zh")
