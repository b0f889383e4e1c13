"""Goal: a mechanic sees what the bike did when a fault came, is led to its cause one thing at a
time by what the unit reads, and has what was found on the sheet; the unit is never written to.

The fault is real: an open arm of the bridge in the simulated unit, planted while it is ridden.
"""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, Request, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import sideways
from tests.browser.judged import COVERED, JUDGE, moved
from tests.fakes.server import SpindleServer, eventually

# What a moment tells begins before its fault and ends after it.
BEFORE_S, AFTER_S = 20.0, 10.0


@pytest.fixture
def faulty(server: SpindleServer, standing: str) -> str:
    """The id of a unit whose torque sensor broke on a ride."""
    server.simulate(standing, clock="virtual", scenario="commute", running=True, brake=False)
    server.advance(standing, BEFORE_S)
    server.simulate(standing, faults={"torque_sensor": "open_high"})
    server.advance(standing, AFTER_S)
    eventually(
        lambda: server.get(f"/devices/{standing}")["faults_active"],
        lambda names: names == ["torque_sensor"],
    )
    server.simulate(standing, clock="real")
    return standing


def writes_of(page: Page) -> list[str]:
    """What is asked of units from now on that is not only read; the sheet of a bike is written."""
    asked: list[str] = []

    def seen(request: Request) -> None:
        if request.method != "GET" and "/bikes/" not in request.url:
            asked.append(request.url)

    page.on("request", seen)
    return asked


def test_a_search_ends_with_its_cause_on_the_sheet(
    open_desk: OpenDesk, server: SpindleServer, faulty: str, axe: str
) -> None:
    desk = open_desk(width=1440, height=900)
    # A slow phone: what comes late is seen to come late.
    slow = desk.page.context.new_cdp_session(desk.page)
    slow.send("Emulation.setCPUThrottlingRate", {"rate": 6})
    page = desk.open("/service")
    moment = page.get_by_test_id("fault-moment")
    picture = moment.get_by_role("img")
    expect(picture).to_have_attribute(
        "aria-label", re.compile(r"No reading of it from -?0[.\d]* s")
    )
    expect(moment).to_contain_text("no reading")
    expect(moment.get_by_role("link", name="in its ride")).to_be_visible()
    expect(page.get_by_test_id("will-hold")).to_contain_text("32,767 counts, still as in the fault")
    asked = writes_of(page)

    page.get_by_role("button", name="Guide me").click()

    search = page.get_by_test_id("guide")
    expect(search).to_contain_text("Step 1 of 3")
    expect(search.get_by_test_id("proof")).to_contain_text("32,767 counts")
    expect(search.get_by_test_id("proof")).to_contain_text("speaks for it")
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    page.get_by_role("button", name="No, go on").click()
    expect(search).to_contain_text("bridge arm open or shorted")
    page.get_by_role("button", name="Yes, that is it").click()
    expect(search).to_contain_text("Found: bridge arm open or shorted")
    expect(search.locator("ol li")).to_have_text(
        [re.compile("plug at the spindle.*not this"), re.compile("bridge arm.*it was this")]
    )
    desk.picture("fault-search")
    page.get_by_role("button", name="Put it on the job sheet").click()
    page.get_by_role("button", name="Close").click()

    done = page.get_by_role("textbox", name="Done")
    expect(done).to_have_value("Torque sensor: bridge arm open or shorted.")
    assert asked == []
    assert moved(page) == []


def test_a_dark_phone_searches_in_chinese_and_finds_none(
    open_desk: OpenDesk, faulty: str, axe: str
) -> None:
    desk = open_desk(width=390, height=844, theme="dark", language="zh-CN", touch=True)
    page = desk.open("/service")
    expect(page.get_by_test_id("fault-moment").get_by_role("img")).to_be_visible()

    page.get_by_role("button", name="逐步排查").click()
    for _ in range(3):
        page.get_by_role("button", name="不是，下一步").click()

    search = page.get_by_test_id("guide")
    expect(search).to_contain_text("常见原因均未找到")
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    page.get_by_role("button", name="写入工单").click()
    page.get_by_role("button", name="关闭").click()
    expect(page.get_by_role("textbox", name="已完成的工作")).to_have_value(
        re.compile("未找到原因；已检查：中轴插头")
    )
    assert sideways(page) == 0
    assert page.evaluate(COVERED) == []
