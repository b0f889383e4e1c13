"""Goal: who is not signed in meets the sign-in page and nothing else, comes back to where they
wanted to go, and leaves again; an administrator lets others in.

Method: a server of its own on every address of the machine, its printed link, a real browser.
"""

from __future__ import annotations

import re
from pathlib import Path

from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import REFUSED
from tests.fakes.server import SpindleServer, eventually

PASSWORD = "eine lange Nacht"


def test_signing_in_leads_back_and_signing_out_ends_it(open_desk: OpenDesk, tmp_path: Path) -> None:
    server = SpindleServer(tmp_path, [], SPINDLE_HOST="0.0.0.0").start()
    said = eventually(server.said, lambda words: "#first=" in words)
    address = server.url.replace("0.0.0.0", "127.0.0.1")
    desk = open_desk(address=address)
    desk.allowed.append(REFUSED)
    page = desk.page

    token = said.split("#first=")[1].split()[0]
    page.goto(f"{address}/sign-in#first={token}")
    expect(page.get_by_role("heading")).to_have_text("The first administrator")
    page.get_by_label("Name").fill("Anna Müller")
    page.get_by_label("Password").fill(PASSWORD)
    page.get_by_role("button", name="Begin").click()
    menu = page.get_by_test_id("person-menu")
    expect(menu).to_contain_text("AM")

    page.goto(f"{address}/settings")
    people = page.get_by_test_id("people")
    people.get_by_role("textbox", name="Name").fill("Rita")
    people.get_by_role("combobox", name="Role", exact=True).select_option("rider")
    people.get_by_role("textbox", name="Password").fill(PASSWORD)
    people.get_by_role("button", name="Add").click()
    expect(people.get_by_text("Rita", exact=True)).to_be_visible()
    keys = page.get_by_test_id("api-keys")
    keys.get_by_role("textbox", name="Name").fill("field")
    keys.get_by_role("button", name="Make a key").click()
    expect(keys.get_by_label("The new key")).to_have_value(
        re.compile("sp_[0-9a-f]{8}_[0-9a-f]{64}")
    )

    menu.locator("summary").click()
    menu.get_by_role("button", name="Sign out").click()
    page.wait_for_url("**/sign-in")
    assert [
        cookie for cookie in page.context.cookies() if "spindle" in cookie.get("name", "")
    ] == []
    # Back in the history is nothing of what was seen.
    page.goto(f"{address}/rides?words=alps")
    page.wait_for_url("**/sign-in?back=*")

    page.get_by_label("Name").fill("anna müller")
    page.get_by_label("Password").fill("something else")
    page.get_by_role("button", name="Sign in").click()
    expect(page.get_by_role("alert")).to_have_text("Name or password is wrong.")
    page.get_by_label("Password").fill(PASSWORD)
    page.get_by_role("button", name="Sign in").click()
    page.wait_for_url("**/rides?words=alps")

    phone = open_desk(390, 844, "dark", "zh-CN", address=address)
    phone.allowed.append(REFUSED)
    phone.page.goto(f"{address}/tune")
    phone.page.get_by_label("姓名").fill("Rita")
    phone.page.get_by_label("密码").fill(PASSWORD)
    phone.page.get_by_role("button", name="登录").click()
    expect(phone.page.get_by_text("您已登录为 Rita。")).to_be_visible()
    assert phone.page.evaluate("document.documentElement.scrollWidth") == 390
    server.stop()
