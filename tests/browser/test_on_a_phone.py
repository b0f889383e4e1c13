"""Goal: a rider's phone finds the server by what a screen shows, signs in over TLS, meets the last
ride first, and can keep the page beside its apps.

Method: a server with a certificate of its own; a Chromium that believes the key of this certificate
and no other, and says itself what it thinks of manifest and icons.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
import ssl
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urljoin

import pytest
from cryptography import x509
from cryptography.hazmat.primitives.serialization import Encoding, PublicFormat
from playwright.sync_api import Browser, Error, Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import REFUSED, sideways
from tests.browser.judged import JUDGE, SMALL_TARGETS
from tests.fakes.proxy import Proxy
from tests.fakes.server import ServerHere
from tests.fakes.track_files import gpx_file, gpx_track

PASSWORD = "eine lange Nacht"
NAME = "bikes.example.org"
# Of two rides on one day, in seconds since its beginning.
RIDES = {"Morning": (0, 300), "Evening": (36_000, 36_600)}
ICON_SIZES = {"192x192", "512x512"}


@pytest.fixture
def reached(tmp_path: Path) -> Iterator[ServerHere]:
    """Reached from the network by a name; Rita rides, Anna administers."""
    settings = {"SPINDLE_HOST": "0.0.0.0", "SPINDLE_TLS": "own", "SPINDLE_ALLOWED_HOSTS": NAME}
    with ServerHere(tmp_path, **settings) as running:
        people = running.services.people
        assert people is not None
        people.accounts.add("Anna", "admin", PASSWORD)
        people.accounts.add("Rita", "rider", PASSWORD)
        running.client.headers["origin"] = running.url
        running.ask("POST", "/sign-in", json={"name": "Rita", "password": PASSWORD})
        for name, times_s in RIDES.items():
            track = gpx_file(gpx_track(times_s))
            running.ask("POST", f"/rides/import?name={name}.gpx", content=track)
        yield running


@pytest.fixture
def phones(launch: Callable[..., Browser], reached: ServerHere) -> Iterator[Browser]:
    """A browser in which somebody compared the fingerprint and went on."""
    certificate = reached.services.addresses.certificate
    assert certificate is not None
    key = x509.load_pem_x509_certificate(certificate.certificate.read_bytes()).public_key()
    spki = key.public_bytes(Encoding.DER, PublicFormat.SubjectPublicKeyInfo)
    pin = base64.b64encode(hashlib.sha256(spki).digest()).decode()
    running = launch(
        f"--host-resolver-rules=MAP {NAME} 127.0.0.1",
        f"--ignore-certificate-errors-spki-list={pin}",
    )
    yield running
    running.close()


def sign_in(page: Page, address: str, name: str) -> None:
    """Open the address as somebody who is not signed in yet."""
    page.goto(address)
    page.wait_for_url("**/sign-in*")
    page.locator("input[autocomplete=username]").fill(name)
    page.locator("input[type=password]").fill(PASSWORD)
    page.locator("form button").click()


def installable_at(page: Page, start: str) -> dict[str, Any]:
    """What Chromium makes of the page's manifest, in which it must find no fault."""
    devtools = page.context.new_cdp_session(page)
    read = devtools.send("Page.getAppManifest")
    assert read["errors"] == []
    kind = "async (url) => (await fetch(url)).headers.get('content-type')"
    assert page.evaluate(kind, read["url"]) == "application/manifest+json"
    manifest: dict[str, Any] = json.loads(read["data"])
    for member in ("start_url", "scope"):
        assert urljoin(read["url"], manifest[member]) == start
    for icon in manifest["icons"]:
        width = page.evaluate(
            """async ([src, of]) => {
                const picture = Object.assign(new Image(), { src: new URL(src, of).href })
                await picture.decode()
                return `${picture.naturalWidth}x${picture.naturalHeight}`
            }""",
            [icon["src"], read["url"]],
        )
        assert width == icon["sizes"]
    assert {icon["sizes"] for icon in manifest["icons"] if "purpose" not in icon} == ICON_SIZES
    # A Chromium without windows finds no fault in anything; one with them does.
    assert devtools.send("Page.getInstallabilityErrors") == {"installabilityErrors": []}
    return manifest


def test_a_rider_opens_what_the_screen_shows_and_has_the_last_ride_first(
    open_desk: OpenDesk, phones: Browser, reached: ServerHere, axe: str
) -> None:
    port = reached.url.rsplit(":", 1)[1]
    address = f"https://{NAME}:{port}/"
    screen = open_desk(within=phones, address=address)
    screen.allowed += [REFUSED, re.compile(f"leaves the machine: {address}")]
    sign_in(screen.page, f"{address}settings", "Anna")
    panel = screen.page.get_by_test_id("on-a-phone")
    code = panel.get_by_role("img", name=f"QR code of {address}")
    expect(code).to_be_visible()
    assert code.evaluate("(image) => image.naturalWidth > 0 && image.width >= 200")
    shown = ssl.get_server_certificate(("127.0.0.1", int(port)))
    sha256 = hashlib.sha256(ssl.PEM_cert_to_DER_cert(shown)).digest().hex(" ").upper()
    assert panel.get_by_test_id("fingerprint").inner_text().split() == sha256.split()
    screen.page.evaluate(axe)
    assert screen.page.evaluate(JUDGE) == []
    screen.picture("on-a-phone", full=True)

    phone = open_desk(390, 844, "dark", within=phones, address=address, touch=True)
    phone.allowed += [REFUSED, re.compile(f"leaves the machine: {address}")]
    page = phone.page
    sign_in(page, address, "Rita")

    rides = page.get_by_role("main").get_by_role("link").filter(has_text=re.compile("ning"))
    expect(rides.first).to_contain_text("Evening")
    expect(rides.last).to_contain_text("Morning")
    assert page.evaluate("isSecureContext")
    assert {one["secure"] for one in page.context.cookies()} == {True}
    manifest = installable_at(page, address)
    assert (manifest["name"], manifest["display"]) == ("Spindle", "standalone")
    page.goto(f"{address}settings")
    expect(page.get_by_test_id("fingerprint")).to_be_visible()
    assert sideways(page) == 0
    assert page.evaluate(SMALL_TARGETS) == []
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    phone.picture("on-a-phone-phone", full=True)


def test_a_phone_that_did_not_compare_is_warned(browser: Browser, reached: ServerHere) -> None:
    context = browser.new_context()
    with pytest.raises(Error, match="ERR_CERT_AUTHORITY_INVALID"):
        context.new_page().goto(reached.url)
    context.close()


def test_below_a_path_of_a_site_it_is_a_page_of_its_own_too(
    open_desk: OpenDesk, tmp_path: Path
) -> None:
    settings = {"SPINDLE_ROOT_PATH": "/spindle", "SPINDLE_AUTH": "off"}
    with ServerHere(tmp_path, **settings) as below, Proxy(below.url, below="/spindle") as proxy:
        desk = open_desk(address=f"{proxy.url}/spindle")
        page = desk.open("/settings")

        installable_at(page, f"{proxy.url}/spindle/")
        panel = page.get_by_test_id("on-a-phone")
        expect(panel).to_contain_text("spindle serve --host 0.0.0.0 --tls own")
