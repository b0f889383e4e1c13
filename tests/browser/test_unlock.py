"""Goal: a limit that only goes down says so before it is written, and goes up again with the
maker's token and nothing but the page and the maker's own tool.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.browser.test_tune_page import review
from tests.fakes.command import spindle
from tests.fakes.server import ServerHere, SpindleServer

CUTOFF = "[data-parameter=assist_cutoff_kmh] input"
PANEL = "[data-testid=unlock]"
ASK = "Ask the unit for a challenge"


def maker(*words: str | Path) -> str:
    """What the maker's tool printed."""
    ran = spindle(None, "unlock", *words)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout.strip()


@pytest.fixture(scope="module")
def key(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The maker's private key; the public one lies beside it."""
    file = tmp_path_factory.mktemp("maker") / "maker.pem"
    maker("keygen", file)
    return file


@pytest.fixture(scope="module")
def shop(key: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    """A server with one standing unit that carries the maker's key."""
    unit = f"sim:shop?scenario=none&unlock_key={key}.pub"
    with ServerHere(tmp_path_factory.mktemp("shop"), [unit]) as running:
        running.ready_device()
        yield running


def ask_for_cutoff(page: Page, kmh: str) -> None:
    """Raises the limit in the page and asks the unit for its challenge."""
    page.fill(CUTOFF, kmh)
    page.press(CUTOFF, "Enter")
    review(page)
    steps = page.get_by_test_id("token-steps")
    expect(steps).to_contain_text("Needs the maker's token: Cut-off speed")
    expect(steps).to_contain_text("Paste the token that comes back")
    page.click(f"dialog footer >> text={ASK}")


def test_a_limit_is_lowered_freely_and_raised_with_a_token(
    open_desk: OpenDesk, shop: SpindleServer, key: Path, tmp_path: Path, axe: str
) -> None:
    desk = open_desk(address=shop.url)
    page = desk.open("/tune/modes")
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

    ask_for_cutoff(page, "25")
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
    token.write_text(maker("sign", key, challenge) + "\n")
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
    page = desk.open("/tune/modes")
    field = "[data-parameter=motor_speed_rpm_max] input"
    page.fill(field, "2600")
    page.press(field, "Enter")
    page.click("text=核对并写入")
    page.click("dialog footer >> text=向单元索取质询")
    panel = page.locator(PANEL)
    panel.locator("textarea").nth(1).fill("00" * 72)
    desk.picture("unlock-phone-zh-dark")
    assert sideways(page) == 0

    panel.get_by_role("button", name="用令牌写入").click()

    expect(page.locator("dialog [role=alert]")).to_contain_text("令牌")
    expect(panel).to_have_count(0)
    desk.picture("unlock-refused-zh")


@pytest.mark.parametrize(("width", "theme"), [(1440, "light"), (390, "dark")])
def test_without_a_key_in_the_unit_what_needs_a_token_is_no_dead_end(
    open_desk: OpenDesk,
    server: SpindleServer,
    standing: str,
    axe: str,
    width: int,
    theme: str,
) -> None:
    # The unit of the other tests carries no key. Two changes: one it takes, one it cannot take.
    desk = open_desk(width=width, height=844, theme=theme)
    page = desk.open("/tune/modes")
    stop = page.locator("[data-parameter=pedal_stop_ms] input")
    stop.fill("160" if width == 1440 else "170")
    wheel = page.locator("[data-parameter=wheel_circumference_m] input")
    beyond_m = round(float(wheel.input_value()) * 1.06, 3)
    wheel.fill(f"{beyond_m:g}")
    wheel.press("Enter")
    review(page)
    steps = page.get_by_test_id("token-steps")
    expect(steps).to_contain_text("Wheel circumference")
    page.click(f"dialog footer >> text={ASK}")
    expect(page.get_by_test_id("no-key")).to_contain_text("carries no maker's key")
    desk.picture(f"raise-without-key-{width}")
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    assert sideways(page) == 0

    steps.get_by_role("button", name="Keep there what the unit has").click()
    expect(steps).to_have_count(0)
    page.click("dialog >> text=Write to the unit")

    expect(page.locator("[role=status]", has_text="verified")).to_be_visible()
    written = server.get(f"/devices/{standing}/config")["parameters"]
    assert written["pedal_stop_ms"] == (160 if width == 1440 else 170)
    assert written["wheel_circumference_m"] < beyond_m


def test_a_parameter_of_the_factory_is_changed_on_purpose_and_with_a_token(
    desk: Desk, standing: str
) -> None:
    page = desk.open("/tune/modes")
    row = page.locator("[data-parameter=gear_ratio]")
    expect(row).to_contain_text("only with the maker's token")
    row.get_by_role("button", name="Change Motor turns per crank turn").click()
    row.locator("input").fill("41")
    row.locator("input").press("Enter")

    review(page)

    expect(page.get_by_test_id("token-steps")).to_contain_text("Motor turns per crank turn")
    page.click(f"dialog footer >> text={ASK}")
    expect(page.get_by_test_id("no-key")).to_be_visible()
