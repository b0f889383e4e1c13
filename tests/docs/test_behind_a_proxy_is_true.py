"""Goal: what docs/behind-a-proxy.md tells to write works as it stands.

Method: the page's settings and configurations, but for ports, with the real nginx and Caddy in
front of a server: page, scripts, a deep link, signing in, a change, a WebSocket.
"""

from __future__ import annotations

import json
import re
import shlex
import socket
from pathlib import Path
from urllib.parse import urljoin, urlsplit

import httpx
import pytest
from websockets.sync.client import connect

from tests.fakes.real_proxy import real_proxy
from tests.fakes.server import ServerHere

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "behind-a-proxy.md").read_text(encoding="utf-8")
A_PAGE = {"accept": "text/html"}
PERSON = {"name": "Anna", "password": "eine lange Nacht"}


def settings_and_proxy(title: str, kind: str) -> tuple[dict[str, str], str]:
    """What a section tells to set for the server, and its configuration of a proxy."""
    section = PAGE.split(f"\n## {title}\n")[1].split("\n## ")[0]
    blocks = dict(re.findall(r"(?s)```(\w+)\n(.*?)```", section))
    words = shlex.split(blocks["sh"])
    return dict(word.split("=", 1) for word in words if "=" in word), blocks[kind]


@pytest.mark.parametrize("kind", ["nginx", "caddy"])
@pytest.mark.parametrize(
    ("title", "path"), [("A name of its own", ""), ("Below a path of a site", "/spindle")]
)
def test_a_configuration_of_the_page_works(
    title: str, path: str, kind: str, tmp_path: Path
) -> None:
    settings, snippet = settings_and_proxy(title, kind)
    site = settings["SPINDLE_ALLOWED_HOSTS"]
    folder = tmp_path / "proxy"
    folder.mkdir()
    with ServerHere(tmp_path / "data", ["sim:proxied?clock=virtual"], **settings) as server:
        people = server.services.people
        assert people is not None
        token = people.accounts.first_token()
        at = urlsplit(server.url).netloc
        with real_proxy(kind, snippet, site, at, folder) as port:
            origin = f"http://{site}:{port}"
            headers = {"host": f"{site}:{port}", "origin": origin}
            url = f"http://127.0.0.1:{port}"
            with httpx.Client(base_url=url, headers=headers, timeout=30.0) as client:
                the_page_comes_whole(client, f"{path}/")
                the_page_comes_whole(client, f"{path}/rides/7")
                signed_in = client.post(
                    f"{path}/api/v1/first-person", json={"token": token, **PERSON}
                )
                assert signed_in.is_success, signed_in.text
                # The name of the site is nobody's here, so that the client keeps no cookies.
                cookie = signed_in.headers["set-cookie"].split(";")[0]
                items = client.get(f"{path}/api/v1/devices", headers={"cookie": cookie}).json()
                live = f"{path}/api/v1/devices/{items['items'][0]['id']}/live"
            the_socket_speaks(port, f"ws://{site}:{port}{live}", origin, cookie)


def the_page_comes_whole(client: httpx.Client, path: str) -> None:
    """The entry page and its script, asked for as a browser does."""
    page = client.get(path, headers=A_PAGE)
    assert page.status_code == 200, page.text
    base = re.findall(r'<base href="([^"]+)"', page.text)[0]
    script = re.findall(r'<script[^>]* src="([^"]+)"', page.text)[0]
    answer = client.get(urljoin(base, script))
    assert "javascript" in answer.headers["content-type"], answer.text


def the_socket_speaks(port: int, url: str, origin: str, cookie: str) -> None:
    """A WebSocket opens, and tells how the unit is."""
    line = socket.create_connection(("127.0.0.1", port))
    with connect(
        url, sock=line, origin=origin, additional_headers={"cookie": cookie}, proxy=None
    ) as one:
        assert json.loads(one.recv())["type"] == "state"
