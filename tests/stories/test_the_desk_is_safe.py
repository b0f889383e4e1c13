"""Goal: the running server refuses what a foreign page or a broken program may try.

The same rules are tested one by one in tests/unit/api; here they are tried on the real sockets.
"""

from __future__ import annotations

import socket
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from tests.fakes.server import SpindleServer


def test_it_listens_on_loopback_only(server: SpindleServer) -> None:
    port = urlsplit(server.url).port
    assert urlsplit(server.url).hostname == "127.0.0.1"

    # Whoever listens on every address of a machine listens on this one of its loopback, too.
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.2", port), timeout=2.0).close()


def test_a_foreign_host_or_origin_gets_nothing(server: SpindleServer) -> None:
    foreign_host = server.client.get("/devices", headers={"host": "evil.example"})
    foreign_origin = server.client.get("/devices", headers={"origin": "https://evil.example"})

    assert foreign_host.status_code == foreign_origin.status_code == 403
    assert foreign_host.headers["content-type"] == "application/problem+json"
    assert "items" not in foreign_host.text


def test_a_foreign_page_gets_no_live_stream(server: SpindleServer, device: str) -> None:
    url = f"{server.url.replace('http', 'ws')}/api/v1/devices/{device}/live"

    with pytest.raises(InvalidStatus) as refusal:
        connect(url, origin="https://evil.example")

    assert refusal.value.response.status_code == 403


def test_a_big_body_is_refused_before_it_is_read(server: SpindleServer) -> None:
    address = urlsplit(server.url)
    with socket.create_connection((address.hostname, address.port), timeout=10.0) as line:
        line.sendall(
            b"POST /api/v1/surface HTTP/1.1\r\nHost: localhost\r\n"
            b"Content-Type: application/json\r\nContent-Length: 10000000000\r\n\r\n"
        )
        answer = line.recv(65536)

    assert answer.startswith(b"HTTP/1.1 413")


def test_numbers_that_are_none_are_refused(server: SpindleServer, device: str) -> None:
    table = server.get(f"/devices/{device}/parts/fuzzy_table")
    for text in ("NaN", "Infinity", "-Infinity", "1e999"):
        body = (
            httpx.Request("POST", server.url, json={"fuzzy_table": table, "points": [[0.5, 0.25]]})
            .read()
            .replace(b"0.5,0.25", f"{text},0.25".encode())
        )

        response = server.client.post(
            "/surface/points", content=body, headers={"content-type": "application/json"}
        )

        assert response.status_code == 422, text
        assert "points[0][0]" in response.json()["errors"][0]["field"]


# They take nothing that could be refused.
PROBES = {"/healthz", "/readyz"}


def test_every_route_is_described_with_an_id_and_one_kind_of_refusal(
    server: SpindleServer,
) -> None:
    description = server.get("/openapi.json")

    ids = []
    for path, methods in description["paths"].items():
        for method, operation in methods.items():
            ids.append(operation["operationId"])
            if path in PROBES:
                continue
            refused = operation["responses"]["422"]["content"]
            assert list(refused) == ["application/problem+json"], (method, path)
    assert len(ids) == len(set(ids)) > 30
    assert "Problem" in description["components"]["schemas"]
    assert "HTTPValidationError" not in description["components"]["schemas"]


def test_the_documentation_loads_nothing_from_elsewhere(server: SpindleServer) -> None:
    page = server.client.get(f"{server.url}/api/docs").text

    assert "list_rides" not in page or "<script" not in page
    assert "https://" not in page
    assert "/api/v1/devices/{device_id}/config" in page


@pytest.mark.parametrize(
    ("method", "path", "body"),
    [
        ("GET", "/rides/99999999999999999999999", None),
        ("GET", "/rides?cursor=99999999999999999999999.1", None),
        ("GET", "/rides?limit=100000", None),
        ("GET", "/rides/1/series?from_s=nan", None),
        ("POST", "/devices", {"url": "/dev/\x00"}),
        ("POST", "/devices", {"url": "http://evil.example"}),
        ("POST", "/rides/import", None),
    ],
)
def test_what_makes_no_sense_is_refused_and_not_our_fault(
    server: SpindleServer, method: str, path: str, body: object
) -> None:
    response = server.client.request(method, path, json=body)

    assert response.status_code == 422
    assert response.json()["detail"]


def test_true_is_no_number(server: SpindleServer, device: str) -> None:
    response = server.client.patch(
        f"/devices/{device}/config", json={"parameters": {"torque_filter_s": True}}
    )

    assert response.status_code == 422


@pytest.mark.parametrize("setting", ["flash", "unlock_key"])
def test_a_request_names_no_file_of_this_machine(
    server: SpindleServer, tmp_path: Path, setting: str
) -> None:
    wanted = tmp_path / "wanted"

    response = server.client.post("/devices", json={"url": f"sim:a#b?{setting}={wanted}"})

    assert response.status_code == 422
    assert response.json()["errors"][0]["field"] == "url"
    assert not wanted.exists()
