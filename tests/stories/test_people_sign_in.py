"""Goal: a server that the network reaches asks who is there, and a program with a key works on it.

Method: `spindle people`, a server on every address of the machine; a shell with and without a key;
`kill -9`; old authors beside new ones. A server is a process where it is killed or prints its link.
"""

from __future__ import annotations

import json
import re
from contextlib import suppress
from importlib.resources import files
from pathlib import Path

import httpx
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from backend.people.types import PersonChange
from spindle.client import Spindle
from tests.fakes.command import spindle
from tests.fakes.server import ServerHere, ServerProcess, eventually

pytestmark = pytest.mark.slow
PASSWORD = "eine lange Nacht"
LIBRARY = "/api/v1/library"
UNIT = "sim:bench?clock=virtual&scenario=none"
# With the settings as they come, a server that other machines reach asks who is there.
REACHED = {"SPINDLE_HOST": "0.0.0.0"}


def preset(name: str) -> dict[str, object]:
    """A document for the library under another name."""
    path = files("sim_device") / "presets" / "even.json"
    return {**json.loads(path.read_text(encoding="utf-8")), "name": name}


def test_a_workshop_opens_its_server_to_the_network(tmp_path: Path) -> None:
    data = tmp_path / "data"
    folder = ("--data", str(data))
    # Before: on this machine alone, nobody signs in, and who changes something says so.
    with ServerHere(data, SPINDLE_AUTHOR="王工") as alone:
        nobody = {"sign_in": False, "needs_first": False, "signed_in": None, "passkeys": False}
        assert alone.get("/session") == nobody
        before = alone.client.post("/library", json=preset("before"))
    assert "set-cookie" not in before.headers
    assert (before.json()["author"], before.json()["author_proof"]) == ("王工", "stated")

    added = spindle(None, "people", "add", "Anna", "--role", "admin", "--password-stdin", *folder,
                    stdin=f"{PASSWORD}\n")  # fmt: skip
    assert added.returncode == 0, added.stderr
    server = ServerProcess(data, [UNIT], **REACHED).start()
    url = server.url
    assert server.client.get("/devices").status_code == 401
    assert httpx.get(f"{url}/healthz").status_code == 200
    # No second hand in the folder of a running server.
    assert spindle(None, "people", "list", *folder).returncode == 1

    browser = httpx.Client(base_url=url, headers={"origin": url}, timeout=30.0)
    browser.post("/api/v1/sign-in", json={"name": "anna", "password": PASSWORD})
    keys = {
        name: browser.post("/api/v1/keys", json={"name": name, "scopes": scopes}).json()["secret"]
        for name, scopes in {
            "shell": ["see_bikes", "see_library", "change_library"],
            "field": ["upload_files"],
        }.items()
    }
    after = browser.post(LIBRARY, json=preset("after"), headers={"spindle-author": "Mallory"})
    assert (after.json()["author"], after.json()["author_proof"]) == ("Anna", "signed_in")
    rows = {row["name"]: row for row in browser.get(LIBRARY).json()["items"]}
    assert (rows["before"]["author"], rows["before"]["author_proof"]) == ("王工", "stated")

    listing = (server, "device", "list")
    nobody = spindle(*listing)
    assert nobody.returncode == 1
    assert "SPINDLE_KEY" in nobody.stderr
    eventually(
        lambda: spindle(*listing, SPINDLE_KEY=keys["shell"]).stdout, lambda out: "bench" in out
    )
    assert spindle(*listing, "--key", keys["shell"]).returncode == 0
    wrong = spindle(*listing, SPINDLE_KEY=keys["field"])
    assert wrong.returncode == 1
    assert "see_bikes" in wrong.stderr

    a_program_watches_by_a_ticket(url, keys["shell"])

    # A power cut signs nobody out and loses no key.
    server.kill()
    said = server.output()
    assert not [secret for secret in (*keys.values(), PASSWORD) if secret in said]
    with ServerHere(data, **REACHED) as again:
        moved = httpx.Client(base_url=again.url, cookies=browser.cookies, timeout=30.0)
        assert moved.get("/api/v1/session").json()["signed_in"]["person"]["name"] == "Anna"
        assert spindle(again, "device", "list", SPINDLE_KEY=keys["shell"]).returncode == 0


def a_program_watches_by_a_ticket(url: str, key: str) -> None:
    """Opens the live stream of the one unit without a header: where it stands comes first."""
    program = Spindle(url, key)
    device = program.unit().id
    ticket = program.server.ask("POST", "/tickets")["ticket"]
    live = f"{url.replace('http', 'ws')}/api/v1/devices/{device}/live?ticket={ticket}"
    with connect(live, open_timeout=30) as socket:
        assert socket.recv(timeout=30)
    with pytest.raises(Exception, match="401"):
        connect(live, open_timeout=30)


def test_the_first_administrator_comes_by_the_printed_link(tmp_path: Path) -> None:
    server = ServerProcess(tmp_path, [], **REACHED).start()
    link = eventually(lambda: printed(server), bool)
    body = {"token": link, "name": "Anna", "password": PASSWORD}

    made = server.client.post("/first-person", json=body)
    twice = server.client.post(
        "/first-person", json={**body, "name": "M"}, headers={"origin": server.url}
    )

    assert (made.status_code, made.json()["role"]) == (201, "admin")
    assert (twice.status_code, twice.json()["code"]) == (403, "link_used")
    server.stop()
    with ServerHere(tmp_path, **REACHED) as later:
        assert later.get("/session")["needs_first"] is False
    lost = spindle(None, "people", "reset", "anna", "--password-stdin", "--data", tmp_path,
                   stdin="ein anderer Tag\n")  # fmt: skip
    assert (lost.returncode, lost.stdout) == (0, "Anna: admin\n")


def printed(server: ServerProcess) -> str:
    """The token of the link, once it was printed."""
    found = re.search(r"#first=(\S+)", server.output())
    return found[1] if found else ""


# By what somebody loses the right to see a unit.
LOST: dict[str, dict[str, object]] = {
    "disabled": {"enabled": False},
    "lower role": {"role": "rider"},
    "another password": {"password": "ein neuer Morgen"},
}


@pytest.mark.parametrize("how", ["signed out", "disabled", "lower role", "another password"])
def test_a_live_picture_ends_with_the_right_to_see_it(tmp_path: Path, how: str) -> None:
    with ServerHere(tmp_path, [UNIT], **REACHED) as server:
        people = server.services.people
        assert people is not None
        people.accounts.add("admin", "admin", PASSWORD)
        dealer = people.accounts.add("dealer", "dealer", PASSWORD)
        browser = httpx.Client(base_url=server.url, headers={"origin": server.url}, timeout=30.0)
        browser.post("/api/v1/sign-in", json={"name": "dealer", "password": PASSWORD})
        devices = eventually(lambda: browser.get("/api/v1/devices").json()["items"], bool)
        address = f"{server.url.replace('http', 'ws')}/api/v1/devices/{devices[0]['id']}/live"
        cookie = "; ".join(f"{one}={value}" for one, value in browser.cookies.items())
        with connect(address, origin=server.url, additional_headers={"cookie": cookie}) as socket:
            assert socket.recv(timeout=30)

            if how == "signed out":
                browser.delete("/api/v1/session")
            else:
                people.accounts.change(dealer.id, PersonChange.model_validate(LOST[how]))

            with suppress(ConnectionClosed):
                for _ in socket:
                    pass
    assert (socket.close_code, socket.close_reason) == (4403, "not_allowed")
