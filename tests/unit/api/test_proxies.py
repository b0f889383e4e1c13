"""Goal: who asks is who the connection is from, unless a proxy that was named passes somebody on.

Method: a real uvicorn as it is configured to serve, with one address that answers who asked.
"""

from __future__ import annotations

import httpx
import pytest
from fastapi import FastAPI, Request

from backend.listening import listening_socket, server_config
from tests.fakes.server import serving

PASSED_ON = {"x-forwarded-for": "203.0.113.7", "x-forwarded-proto": "https"}


@pytest.mark.parametrize(
    ("proxies", "seen"),
    [
        ((), ["127.0.0.1", "http"]),
        (("10.0.3.0/24",), ["127.0.0.1", "http"]),
        (("127.0.0.1",), ["203.0.113.7", "https"]),
    ],
)
def test_only_a_named_proxy_is_believed(proxies: tuple[str, ...], seen: list[str]) -> None:
    app = FastAPI()

    @app.get("/who")
    def who(request: Request) -> list[str]:
        assert request.client is not None
        return [request.client.host, request.url.scheme]

    with (
        listening_socket("127.0.0.1", 0) as listening,
        serving(server_config(app, proxies), listening) as (host, port),
    ):
        answer = httpx.get(f"http://{host}:{port}/who", headers=PASSED_ON, timeout=20)

    assert answer.json() == seen
