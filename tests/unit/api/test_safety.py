"""Goal: other people's pages and oversized requests never reach a route.

A tiny application stands behind the real middleware; what it was asked is all that is looked at.
Attacks: DNS rebinding (RFC 9110 Host, a foreign name that resolves to loopback), cross-site
requests and WebSockets (RFC 6454 Origin, RFC 6455 section 10.2), bodies that lie about their size.
"""

from __future__ import annotations

from typing import Any

import pytest
from anyio.from_thread import start_blocking_portal
from fastapi import FastAPI, Request, WebSocket
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from backend.web import problem as errors
from backend.web.safety import AllowedHosts, BodyBound, SameOriginOnly, SecurityHeaders


def guarded_app(hosts: AllowedHosts, guarded: bool = False) -> FastAPI:
    app = FastAPI()
    errors.install(app)

    @app.get("/value")
    async def value() -> dict[str, int]:
        return {"value": 1}

    @app.post("/value")
    async def put_value(request: Request) -> dict[str, int]:
        return {"bytes": len(await request.body())}

    @app.post("/uploads/one")
    async def upload(request: Request) -> dict[str, int]:
        return {"bytes": len(await request.body())}

    @app.websocket("/live")
    async def live(socket: WebSocket) -> None:
        await socket.accept()
        await socket.send_text("hello")
        await socket.close()

    app.add_middleware(BodyBound, bytes_max=100, upload_bytes_max=1000, upload_paths=("/uploads",))
    app.add_middleware(SameOriginOnly, hosts=hosts, guarded=guarded)
    app.add_middleware(SecurityHeaders)
    return app


@pytest.fixture
def client() -> TestClient:
    return TestClient(guarded_app(AllowedHosts()), base_url="http://127.0.0.1:8750")


@pytest.mark.parametrize("host", ["localhost:8750", "127.0.0.1:8750", "[::1]:8750", "LOCALHOST"])
def test_the_names_of_this_machine_are_let_in(client: TestClient, host: str) -> None:
    assert client.get("/value", headers={"host": host}).status_code == 200


@pytest.mark.parametrize(
    "host", ["evil.example", "localhost.evil.example", "127.0.0.1.evil.example", "192.168.1.7", ""]
)
def test_a_foreign_host_is_refused(client: TestClient, host: str) -> None:
    response = client.get("/value", headers={"host": host})

    assert response.status_code == 403
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["code"] == "foreign_host"


def test_a_server_on_the_network_is_reached_by_address_but_not_by_a_foreign_name() -> None:
    hosts = AllowedHosts(names=frozenset({"workshop"}), any_address=True)
    client = TestClient(guarded_app(hosts))

    assert client.get("/value", headers={"host": "192.168.1.7:8750"}).status_code == 200
    assert client.get("/value", headers={"host": "workshop:8750"}).status_code == 200
    assert client.get("/value", headers={"host": "evil.example"}).status_code == 403


@pytest.mark.parametrize(
    "origin",
    ["http://evil.example", "null", "http://localhost:9999", "http://127.0.0.1", "http://[", ""],
)
def test_a_page_of_another_origin_is_refused(client: TestClient, origin: str) -> None:
    response = client.post("/value", headers={"origin": origin}, content=b"x")

    assert response.status_code == 403
    assert response.json()["code"] == "foreign_origin"


@pytest.mark.parametrize(
    ("code", "header"),
    [
        ("foreign_host", {"host": "<b>evil.example"}),
        ("passed_on", {"x-forwarded-for": "203.0.113.7"}),
        ("foreign_origin", {"origin": "https://bikes.example"}),
    ],
)
def test_who_opens_a_page_that_is_refused_reads_why(
    client: TestClient, code: str, header: dict[str, str]
) -> None:
    """RFC 9110 section 12.5.1: Accept tells a browser that shows a page from a script."""
    page = client.get("/value", headers={"accept": "text/html,*/*;q=0.8", **header})

    assert page.status_code == 403
    assert page.headers["content-type"].startswith("text/html")
    assert code in page.text
    assert 'lang="zh-CN"' in page.text
    assert "<b>" not in page.text
    assert "docs/behind-a-proxy.md" in page.text
    assert client.get("/value", headers=header).json()["code"] == code


def test_our_own_page_and_programs_without_an_origin_are_let_in(client: TestClient) -> None:
    assert client.post("/value", headers={"origin": "http://127.0.0.1:8750"}).status_code == 200
    assert client.post("/value").status_code == 200


def test_a_foreign_page_gets_no_websocket(client: TestClient) -> None:
    foreign = {"origin": "http://evil.example"}
    with pytest.raises(WebSocketDisconnect), client.websocket_connect("/live", headers=foreign):
        pass

    with client.websocket_connect("/live", headers={"host": "127.0.0.1:8750"}) as socket:
        assert socket.receive_text() == "hello"


@pytest.mark.parametrize(
    "header",
    [
        {"forwarded": "for=203.0.113.7"},
        {"via": "1.1 proxy"},
        {"x-forwarded-for": "203.0.113.7"},
        {"X-Forwarded-Proto": "https"},
        {"x-real-ip": ""},
    ],
)
def test_what_a_proxy_passed_on_needs_a_guard(client: TestClient, header: dict[str, str]) -> None:
    """RFC 7239 section 4, RFC 9110 section 7.6.3: from the network, though it comes from here."""
    refused = client.get("/value", headers=header)
    assert (refused.status_code, refused.json()["code"]) == (403, "passed_on")
    assert "SPINDLE_AUTH=off" in refused.json()["detail"]
    with pytest.raises(WebSocketDisconnect), client.websocket_connect("/live", headers=header):
        pass

    guarded = TestClient(guarded_app(AllowedHosts(), guarded=True), base_url="http://127.0.0.1")
    assert guarded.get("/value", headers=header).status_code == 200


def test_a_declared_size_beyond_the_bound_is_refused_unread(client: TestClient) -> None:
    response = client.post("/value", content=b"x" * 101)

    assert response.status_code == 413
    assert response.json()["code"] == "too_large"


def test_a_size_that_is_no_number_is_refused(client: TestClient) -> None:
    for declared in ("9" * 5000, "-1", "ten"):
        response = client.post("/value", headers={"content-length": declared}, content=b"")

        assert response.status_code == 413


def test_a_body_without_a_declared_size_is_cut_off_at_the_bound(client: TestClient) -> None:
    pieces = (b"x" * 60 for _ in range(1000))

    response = client.post("/value", content=pieces)

    assert response.status_code == 413
    assert response.headers["content-type"] == "application/problem+json"


def test_an_endless_body_is_not_read_to_its_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("backend.web.safety.DROPPED_BYTES_MAX", 300)
    asked = 0

    async def receive() -> dict[str, Any]:
        nonlocal asked
        asked += 1
        return {"type": "http.request", "body": b"x" * 60, "more_body": True}

    sent: list[dict[str, Any]] = []

    async def send(message: Any) -> None:
        sent.append(message)

    scope = {
        "type": "http",
        "method": "POST",
        "path": "/value",
        "raw_path": b"/value",
        "query_string": b"",
        "headers": [(b"host", b"localhost")],
        "scheme": "http",
        "http_version": "1.1",
        "server": ("localhost", 80),
        "client": ("127.0.0.1", 1),
        "app": None,
    }
    with start_blocking_portal() as portal:
        portal.call(guarded_app(AllowedHosts()), scope, receive, send)

    assert sent[0]["status"] == 413
    assert asked <= 3 + 300 // 60


def test_uploads_have_a_bound_of_their_own(client: TestClient) -> None:
    assert client.post("/uploads/one", content=b"x" * 900).json() == {"bytes": 900}
    assert client.post("/uploads/one", content=b"x" * 1001).status_code == 413


def test_every_response_forbids_foreign_scripts_and_framing(client: TestClient) -> None:
    for response in (client.get("/value"), client.get("/nothing")):
        policy = response.headers["content-security-policy"]
        assert "script-src 'self'" in policy
        assert "unsafe-eval" not in policy
        assert "frame-ancestors 'none'" in policy
        assert response.headers["x-content-type-options"] == "nosniff"
