"""Goal: however many imports wait for their turn, every other route is answered.

Method: the application over a real store with a reader that the test holds, and more imports than
the server has threads for requests (anyio: 40). No times: once all have arrived, another is asked.
"""

from __future__ import annotations

import asyncio
import threading
from pathlib import Path

import httpx
import pytest
from anyio.from_thread import start_blocking_portal

from backend.formats import Outcome
from backend.formats.outcome import rejected
from backend.imports.service import Arrival, Uploads
from backend.store import Store
from tests.fakes.api import api_with

# A store for every test, or a crowd of requests: left out of `make test-fast`.
pytestmark = pytest.mark.slow

IMPORTS = 60


class CountedUploads(Uploads):
    """Says when a whole file has arrived."""

    arrived = threading.Semaphore(0)

    def add(self, upload_id: str, offset: int, data: bytes) -> Arrival:
        arrival = super().add(upload_id, offset, data)
        self.arrived.release()
        return arrival


def test_while_many_imports_wait_another_route_is_answered(store: Store) -> None:
    let_go = threading.Event()

    def held(path: Path, name: str) -> Outcome:
        assert let_go.wait(60)
        return rejected("unknown_format", "No ride.")

    async def story(uploads: CountedUploads) -> tuple[list[str], list[str]]:
        transport = httpx.ASGITransport(app=api_with(uploads=uploads))
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            sending = [
                asyncio.create_task(
                    client.post("/api/v1/rides/import?name=a", content=b"%d" % number)
                )
                for number in range(IMPORTS)
            ]
            try:
                for _ in sending:
                    assert await asyncio.to_thread(uploads.arrived.acquire, timeout=30)
                listing = client.get(f"/api/v1/uploads?limit={IMPORTS}")
                listed = (await asyncio.wait_for(listing, 30)).json()["items"]
            finally:
                let_go.set()
            answers = [(await sent).json() for sent in sending]
        return [each["state"] for each in listed], [each["state"] for each in answers]

    with start_blocking_portal() as portal:
        meanwhile, afterwards = portal.call(story, CountedUploads(store, reader=held))

    assert meanwhile == ["queued"] * IMPORTS
    assert afterwards == ["rejected"] * IMPORTS
