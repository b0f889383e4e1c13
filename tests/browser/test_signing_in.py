"""Goal: who is not signed in meets the sign-in page and nothing else, comes back to where they
wanted to go, and leaves again; an administrator lets others in.

Method: a server of its own on every address of the machine, its link, a real browser; a
phone in the dark, in Chinese; axe-core.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import REFUSED, sideways
from tests.browser.judged import JUDGE, SMALL_TARGETS
from tests.fakes.server import ServerHere, SpindleServer

PASSWORD = "eine lange Nacht"
OWN = "sim:own?scenario=none"


@dataclass
class Workshop:
    """A server that asks who is there. token: of the link it prints."""

    server: SpindleServer
    address: str
    token: str


@contextmanager
def workshop_in(folder: Path, *units: str) -> Iterator[Workshop]:
    """One without people yet, reached from the network."""
    with ServerHere(folder, units, SPINDLE_HOST="0.0.0.0") as server:
        assert server.services.people is not None
        token = server.services.people.accounts.first_token()
        assert token is not None
        yield Workshop(server, server.url.replace("0.0.0.0", "127.0.0.1"), token)


@pytest.fixture
def workshop(tmp_path: Path) -> Iterator[Workshop]:
    with workshop_in(tmp_path) as opened:
        yield opened


def fill_in(page: Page, name: str, password: str = PASSWORD) -> None:
    """What the form asks for, in either language, and its button."""
    page.locator("input[autocomplete=username]").fill(name)
    page.locator("input[type=password]").fill(password)
    page.locator("form button").click()


def test_an_administrator_comes_by_the_link_and_lets_others_in(
    open_desk: OpenDesk, workshop: Workshop, axe: str
) -> None:
    desk = open_desk(address=workshop.address)
    desk.allowed.append(REFUSED)
    page = desk.page
    page.goto(f"{workshop.address}/sign-in#first={workshop.token}")
    expect(page.get_by_role("heading")).to_have_text("The first administrator")
    fill_in(page, "Anna Müller")
    menu = page.get_by_test_id("person-menu")
    expect(menu).to_contain_text("AM")

    page.goto(f"{workshop.address}/settings")
    people = page.get_by_test_id("people")
    people.get_by_role("textbox", name="Name").fill("Rita")
    people.get_by_role("combobox", name="Role", exact=True).select_option("rider")
    people.get_by_role("textbox", name="Password").fill(PASSWORD)
    people.get_by_role("button", name="Add").click()
    expect(people.get_by_text("Rita", exact=True)).to_be_visible()
    people.get_by_role("button", name="Edit Rita").click()
    people.locator("form.edit").get_by_role("textbox", name="Name").fill("Rita Berg")
    people.locator("form.edit").get_by_role("button", name="Save").click()
    expect(people.get_by_text("Rita Berg", exact=True)).to_be_visible()
    page.once("dialog", lambda dialog: dialog.accept())
    people.get_by_role("button", name="Edit Rita Berg").click()
    people.get_by_role("button", name="Remove").click()
    expect(people.get_by_text("Rita Berg", exact=True)).to_have_count(0)
    keys = page.get_by_test_id("api-keys")
    keys.get_by_role("textbox", name="Name").fill("field")
    keys.get_by_role("button", name="Make a key").click()
    form = re.compile("sp_[0-9a-f]{8}_[0-9a-f]{64}")
    expect(keys.get_by_label("The new key")).to_have_value(form)
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []

    menu.locator("summary").click()
    menu.get_by_role("button", name="Sign out").click()
    page.wait_for_url("**/sign-in*")
    assert [one for one in page.context.cookies() if "spindle" in one.get("name", "")] == []
    page.goto(f"{workshop.address}/rides?words=alps")
    page.wait_for_url("**/sign-in?back=*")
    fill_in(page, "anna müller", "something else")
    expect(page.get_by_role("alert")).to_have_text("Name or password is wrong.")
    fill_in(page, "anna müller")
    page.wait_for_url("**/rides?words=alps")


def test_a_rider_on_a_phone_has_their_own_rides_and_bikes_and_no_page_of_a_unit(
    open_desk: OpenDesk, workshop: Workshop, axe: str
) -> None:
    ask = workshop.server.ask
    ask("POST", "/first-person", json={"token": workshop.token, "name": "A", "password": PASSWORD})
    rita = {"name": "Rita", "role": "rider", "password": PASSWORD}
    ask("POST", "/people", json=rita, headers={"origin": workshop.server.url})
    desk = open_desk(390, 844, "dark", "zh-CN", address=workshop.address, touch=True)
    desk.allowed.append(REFUSED)
    page = desk.page

    page.goto(f"{workshop.address}/tune")
    page.get_by_label("姓名").wait_for()
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    assert page.evaluate(SMALL_TARGETS) == []
    fill_in(page, "Rita")
    expect(page.get_by_text("此地址没有您可以使用的页面。")).to_be_visible()
    places = page.get_by_role("navigation").get_by_role("link")
    expect(places.filter(visible=True)).to_have_text(["骑行", "我的车", "设置"])
    page.goto(f"{workshop.address}/")
    expect(page.get_by_role("heading", name="还没有骑行")).to_be_visible()
    page.goto(f"{workshop.address}/fleet")
    expect(page.get_by_role("heading", name="您在这里还没有车")).to_be_visible()
    assert page.evaluate(SMALL_TARGETS) == []
    page.get_by_test_id("person-menu").locator("summary").click()
    page.get_by_role("button", name="退出登录").click()

    page.wait_for_url("**/sign-in*")
    fill_in(page, "A")
    page.get_by_test_id("device-pill").wait_for()
    page.goto(f"{workshop.address}/settings")
    page.get_by_test_id("api-keys").wait_for()
    assert page.evaluate(SMALL_TARGETS) == []
    assert sideways(page) == 0
