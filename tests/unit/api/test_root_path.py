"""Goal: below a path of a site everything is where it says it is, whether or not the proxy takes
the path off, and what looks like the path but is not is left alone.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from fastapi import FastAPI, Request, Response, WebSocket
from fastapi.testclient import TestClient

from backend.app import build_api
from backend.web import pages
from backend.web import problem as errors
from backend.web.app import WebSettings
from backend.web.pages import RootPath

BUILT = Path(__file__).resolve().parents[3] / "frontend" / "index.html"


@pytest.fixture
def client(tmp_path: Path) -> TestClient:
    (tmp_path / "assets").mkdir()
    (tmp_path / "index.html").write_text('<base href="/" /><div id="app">/</div>')
    (tmp_path / "assets" / "app-1a2b.js").write_text("export {}")
    app = FastAPI(docs_url=None)
    errors.install(app)

    @app.post("/api/v1/things")
    async def thing(response: Response, request: Request) -> dict[str, str]:
        response.headers["location"] = "/api/v1/things/7"
        return {"path": request.url.path}

    @app.get("/api/v1/link")
    async def link(request: Request) -> str:
        return str(request.base_url)

    @app.post("/api/v1/elsewhere")
    async def elsewhere(response: Response) -> None:
        response.headers["location"] = "https://other.example/7"

    @app.websocket("/api/v1/live")
    async def live(socket: WebSocket) -> None:
        await socket.accept()
        await socket.send_text("hello")
        await socket.close()

    pages.install(app, tmp_path, "/spindle")
    app.add_middleware(RootPath, root_path="/spindle")
    return TestClient(app)


@pytest.mark.parametrize("taken_off", [True, False])
def test_both_kinds_of_proxies_get_everything(client: TestClient, taken_off: bool) -> None:
    at = "" if taken_off else "/spindle"
    accept = {"accept": "text/html"}

    answer = client.post(f"{at}/api/v1/things")
    assert answer.json() == {"path": "/api/v1/things"}
    assert answer.headers["location"] == "/spindle/api/v1/things/7"
    assert client.post(f"{at}/api/v1/elsewhere").headers["location"] == "https://other.example/7"
    assert client.get(f"{at}/api/v1/link").json() == "http://testserver/spindle/"
    assert client.get(f"{at}/assets/app-1a2b.js").text == "export {}"
    for page in ("/", "/rides/7", "/tune"):
        entry = client.get(f"{at}{page}", headers=accept)
        assert entry.text == '<base href="/spindle/" /><div id="app">/</div>'
        assert entry.headers["cache-control"] == "no-cache"
    assert client.get(f"{at}/api/v1/nothing", headers=accept).status_code == 404
    with client.websocket_connect(f"{at}/api/v1/live") as socket:
        assert socket.receive_text() == "hello"


def test_the_path_without_a_slash_is_the_first_page(client: TestClient) -> None:
    assert "base" in client.get("/spindle", headers={"accept": "text/html"}).text
    assert client.get("/spindles.js").status_code == 404


def test_the_entry_page_has_what_is_replaced() -> None:
    assert BUILT.read_text(encoding="utf-8").count(pages.BASE) == 1


def test_the_description_says_where_the_api_is() -> None:
    app = build_api(WebSettings(version="1", root_path="/spindle"))
    at = TestClient(app, base_url="http://127.0.0.1:8750")

    assert at.get("/spindle/api/v1/openapi.json").json()["servers"] == [{"url": "/spindle"}]
    assert 'href="v1/openapi.json"' in at.get("/spindle/api/docs").text
