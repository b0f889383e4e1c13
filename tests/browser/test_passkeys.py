"""Goal: a rider adds a passkey in Settings and signs in with it, without typing; where no browser
has passkeys none is offered, and Settings says why.

Method: a server of its own; a Chromium whose authenticator is Chromium's own virtual one, on a
phone and in the dark; axe-core.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import REFUSED, Desk
from tests.browser.workshop_desk import check
from tests.fakes.house import PASSWORD
from tests.fakes.server import ServerHere

# A phone's own, of a person who has just unlocked it.
PHONE = {
    "protocol": "ctap2",
    "transport": "internal",
    "hasResidentKey": True,
    "hasUserVerification": True,
    "isUserVerified": True,
    "automaticPresenceSimulation": True,
}


@pytest.fixture
def server(tmp_path: Path) -> Iterator[ServerHere]:
    with ServerHere(tmp_path, SPINDLE_AUTH="required") as running:
        assert running.services.people is not None
        running.services.people.accounts.add("Anna", "admin", PASSWORD)
        running.services.people.accounts.add("Rita", "rider", PASSWORD)
        yield running


def settings_of(desk: Desk, name: str) -> Page:
    """Settings, of somebody who has just signed in with the password."""
    desk.allowed.append(REFUSED)
    page = desk.page
    page.goto(f"{desk.address}/settings")
    page.wait_for_url("**/sign-in*")
    page.locator("input[autocomplete=username]").fill(name)
    page.locator("input[type=password]").fill(PASSWORD)
    page.locator("form button").click()
    page.wait_for_url("**/settings")
    return page


def sign_out(page: Page) -> None:
    menu = page.get_by_test_id("person-menu")
    menu.locator("summary").click()
    menu.get_by_role("button", name="Sign out").click()
    page.wait_for_url("**/sign-in*")


def test_a_rider_adds_a_passkey_and_signs_in_without_typing(
    open_desk: OpenDesk, server: ServerHere, axe: str
) -> None:
    address = server.url.replace("127.0.0.1", "localhost")
    desk = open_desk(390, 844, "dark", address=address, touch=True)
    desk.allow(f"leaves the machine: {address}")
    devtools = desk.page.context.new_cdp_session(desk.page)
    devtools.send("WebAuthn.enable")
    phone = devtools.send("WebAuthn.addVirtualAuthenticator", {"options": PHONE})
    page = settings_of(desk, "Rita")
    panel = page.get_by_test_id("passkeys")
    panel.get_by_role("textbox", name="Name of the passkey").fill("Phone")
    panel.get_by_role("textbox", name="Your password").fill("not this one")
    panel.get_by_role("button", name="Add a passkey").click()
    expect(page.get_by_text("This is not your password.")).to_be_visible()
    credentials = devtools.send("WebAuthn.getCredentials", phone)["credentials"]
    assert credentials == []

    panel.get_by_role("textbox", name="Your password").fill(PASSWORD)
    panel.get_by_role("button", name="Add a passkey").click()
    expect(panel.get_by_role("listitem")).to_contain_text("for localhost")
    expect(panel.get_by_role("listitem")).to_contain_text("never used")
    # The same phone makes no second one.
    panel.get_by_role("textbox", name="Name of the passkey").fill("Again")
    panel.get_by_role("textbox", name="Your password").fill(PASSWORD)
    panel.get_by_role("button", name="Add a passkey").click()
    expect(page.get_by_text("has a passkey for you already")).to_be_visible()
    check(page, axe)
    sign_out(page)
    with_passkey = page.get_by_role("button", name="Sign in with a passkey")
    with_passkey.wait_for()
    check(page, axe)
    desk.picture("sign-in-with-a-passkey")
    with_passkey.click()
    page.get_by_test_id("person-menu").wait_for()

    page.goto(f"{address}/settings")
    expect(panel.get_by_role("listitem")).not_to_contain_text("never used")
    desk.picture("passkeys", full=True)
    page.once("dialog", lambda dialog: dialog.accept())
    panel.get_by_role("button", name="Remove Phone").click()
    expect(panel.get_by_role("listitem")).to_have_count(0)
    sign_out(page)
    with_passkey.click()
    expect(page.get_by_role("alert")).to_contain_text("This passkey is not known here")


def test_at_an_address_of_numbers_none_is_offered(open_desk: OpenDesk, server: ServerHere) -> None:
    desk = open_desk(address=server.url)
    desk.allowed.append(REFUSED)
    page = desk.page
    with page.expect_response("**/api/v1/session"):
        page.goto(f"{server.url}/sign-in")
    desk.settle()
    expect(page.locator("form button")).to_be_visible()
    expect(page.get_by_role("button", name="passkey")).to_have_count(0)

    panel = settings_of(desk, "Rita").get_by_test_id("passkeys")

    expect(panel).to_contain_text("Passkeys need https and a name")
    expect(panel.get_by_role("button")).to_have_count(0)
