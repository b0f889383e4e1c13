"""Goal: no request for rides keeps others waiting, `/health` least of all.

Method: a service whose calls wait at a barrier, and in which thread they and the making of their
JSON run is noted. No times: while a call is held, another request is answered.
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from typing import Any

import httpx
import pytest
from anyio.from_thread import start_blocking_portal
from pydantic import BaseModel

from backend.web import responses as large
from tests.fakes.api import api_with
from tests.unit.api.sample_rides import SAMPLE_RIDE

# A store for every test, or a crowd of requests: left out of `make test-fast`.
pytestmark = pytest.mark.slow

ASKED = {
    "/api/v1/rides?limit=500": {"items": [SAMPLE_RIDE] * 500, "next": None, "total": 500},
    "/api/v1/rides/1": SAMPLE_RIDE,
    "/api/v1/rides/1/figure": {"data": [{"y": [1.0] * 20_000}], "layout": {}},
}


class HeldRides:
    """Answers when it is let go."""

    def __init__(self, answer: Any) -> None:
        self.answer = answer
        self.asked = threading.Event()
        self.let_go = threading.Event()
        self.thread = ""

    def held(self, *_: Any, **__: Any) -> Any:
        self.thread = threading.current_thread().name
        self.asked.set()
        assert self.let_go.wait(30)
        return self.answer

    list = get = figure = held


@pytest.mark.parametrize("path", ASKED)
def test_while_rides_are_read_others_are_answered(
    path: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    rides = HeldRides(ASKED[path])
    app = api_with(rides=rides)
    made_on: list[str] = []
    make: Callable[[type[BaseModel], Any], Any] = large.json_response

    def noted(model: type[BaseModel], answer: Any) -> Any:
        made_on.append(threading.current_thread().name)
        return make(model, answer)

    monkeypatch.setattr("backend.rides.api.json_response", noted)

    async def story() -> tuple[int, Any]:
        transport = httpx.ASGITransport(app=app)
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            asking = asyncio.create_task(client.get(path))
            await asyncio.to_thread(rides.asked.wait, 30)
            other = await client.options("/api/v1/uploads")
            rides.let_go.set()
            return other.status_code, (await asking).json()

    with start_blocking_portal() as portal:
        other, answer = portal.call(story)

    assert other == 204
    assert answer == ASKED[path]
    assert "MainThread" not in (rides.thread, *made_on)
    assert len(made_on) == 1
