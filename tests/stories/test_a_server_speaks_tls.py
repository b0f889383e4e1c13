"""Goal: a server that makes its own certificate is used over TLS by browsers, programs and the
command, and is the same one after a power cut; one with wrong files says so before it starts.

Method: a server on every address of the machine, in this process and as one of its own; Python's
ssl believes its certificate and no other.
"""

from __future__ import annotations

import hashlib
import re
import socket
import ssl
from contextlib import suppress
from pathlib import Path

import httpx
import pytest
from websockets.sync.client import connect

from spindle.client import Spindle
from tests.fakes.command import refused_start, spindle
from tests.fakes.server import ServerHere, ServerProcess, eventually

pytestmark = pytest.mark.slow
PASSWORD = "eine lange Nacht"
UNIT = "sim:bench?clock=virtual&scenario=none"
OWN = {"SPINDLE_HOST": "0.0.0.0", "SPINDLE_TLS": "own"}


def fingerprint_at(url: str) -> str:
    """Of the certificate that a server shows, as anybody who connects works it out."""
    host, port = url.removeprefix("https://").split(":")
    shown = ssl.PEM_cert_to_DER_cert(ssl.get_server_certificate((host, int(port))))
    return hashlib.sha256(shown).digest().hex(":").upper()


def test_people_programs_and_the_command_use_it(tmp_path: Path) -> None:
    with ServerHere(tmp_path, [UNIT], **OWN) as server:
        ca = tmp_path / "tls" / "certificate.pem"
        trusting = ssl.create_default_context(cafile=ca)
        people = server.services.people
        assert people is not None
        people.accounts.add("Anna", "admin", PASSWORD)
        browser = httpx.Client(
            base_url=server.url, headers={"origin": server.url}, verify=trusting, timeout=30.0
        )

        signed_in = browser.post("/api/v1/sign-in", json={"name": "Anna", "password": PASSWORD})

        assert signed_in.status_code == 200, signed_in.text
        cookies = signed_in.headers.get_list("set-cookie")
        session = next(one for one in cookies if one.startswith("__Host-spindle_session="))
        assert {"Secure", "HttpOnly", "Path=/", "SameSite=strict"} <= set(session.split("; "))
        # A browser that believed this header would let nobody past its warning any more.
        assert "strict-transport-security" not in signed_in.headers
        plain = server.url.replace("https", "http")
        foreign = browser.post("/api/v1/sign-in", json={}, headers={"origin": "https://x"})
        assert foreign.json()["code"] == "foreign_origin"

        devices = eventually(lambda: browser.get("/api/v1/devices").json()["items"], bool)
        live = f"{server.url.replace('https', 'wss')}/api/v1/devices/{devices[0]['id']}/live"
        cookie = {"cookie": "; ".join(f"{name}={value}" for name, value in browser.cookies.items())}
        with connect(live, ssl=trusting, origin=server.url, additional_headers=cookie) as watching:
            assert watching.recv(timeout=30)

        answer = browser.get("/api/v1/server/addresses").json()
        assert answer["certificate"]["sha256"] == fingerprint_at(server.url)
        assert answer["certificate"]["is_own"] is True
        assert {one["url"].partition("://")[0] for one in answer["addresses"]} <= {"https"}

        body = {"name": "shell", "scopes": ["see_bikes", "see_server"]}
        key = browser.post("/api/v1/keys", json=body).json()["secret"]
        assert Spindle(server.url, key, str(ca)).health().status == "ok"
        listing = (server, "device", "list", "--key", key)
        assert "bench" in spindle(*listing, SPINDLE_CA=str(ca)).stdout
        assert "bench" in spindle(*listing, "--ca", ca).stdout
        unbelieved = spindle(*listing)
        assert (unbelieved.returncode, "--ca" in unbelieved.stderr) == (1, True)
        nothing = spindle(*listing, "--ca", tmp_path / "nothing.pem")
        assert (nothing.returncode, "cannot be read" in nothing.stderr) == (2, True)
        assert spindle(server, "device", "list", "--server", plain).returncode == 1


def test_after_a_power_cut_it_is_the_server_that_phones_know(tmp_path: Path) -> None:
    server = ServerProcess(tmp_path, [], **OWN).start()
    url = server.url.replace("0.0.0.0", "127.0.0.1")
    printed = words_until("#first=", server)
    shown = fingerprint_at(url)

    assert server.url.startswith("https://0.0.0.0:")
    assert shown in printed
    assert "  https://localhost:" in printed
    host, port = url.removeprefix("https://").split(":")
    with socket.create_connection((host, int(port)), timeout=30) as plain, suppress(OSError):
        plain.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n")
        assert b"HTTP" not in plain.recv(4096)
    server.kill()
    assert server.output() == ""
    with ServerHere(tmp_path, **OWN) as again:
        assert fingerprint_at(again.url) == shown


def words_until(last: str, server: ServerProcess) -> str:
    """What it printed since its address."""
    words: list[str] = []

    def printed() -> str:
        words.append(server.output())
        return "".join(words)

    return eventually(printed, lambda said: last in said)


def test_files_that_do_not_fit_are_named_before_anything_is_opened(tmp_path: Path) -> None:
    with ServerHere(tmp_path / "made", **OWN):
        made = tmp_path / "made" / "tls"
    files = {
        "SPINDLE_TLS": "files",
        "SPINDLE_TLS_CERTIFICATE": str(made / "certificate.pem"),
        "SPINDLE_TLS_KEY": str(made / "key.pem"),
    }
    with ServerHere(tmp_path / "given", **files) as given:
        assert given.url.startswith("https://")
        own = spindle(given, "device", "list", "--ca", made / "certificate.pem")
        assert own.returncode == 0, own.stderr

    for wrong in ("SPINDLE_TLS_CERTIFICATE", "SPINDLE_TLS_KEY"):
        refused = refused_start(tmp_path / "none", **{**files, wrong: str(tmp_path / "no.pem")})
        assert (refused.returncode, "Traceback" in refused.stderr) == (2, False)
        assert re.search(rf"\b{wrong.removeprefix('SPINDLE_').lower()}: .*no\.pem", refused.stderr)
    assert not (tmp_path / "none").exists()
