"""Goal: a viewer that vanished without a word is let go, and no fault of the server's.

Method: the route itself over a socket by script, which says what uvicorn says.
"""

from __future__ import annotations

import asyncio
from typing import Any

from anyio.from_thread import start_blocking_portal

from backend.units.live import live
from backend.units.watch import StateNow, Viewer


class Watch:
    """Says one thing to each viewer, and remembers who left."""

    def __init__(self) -> None:
        self.left: list[Viewer] = []

    def join(self, device_id: str, channels: object, rate_hz: object, viewer: Viewer) -> None:
        viewer.put(StateNow("ready", None))

    def leave(self, viewer: Viewer) -> None:
        self.left.append(viewer)


class ClosedSocket:
    """uvicorn closed it, because no ping was answered; nobody has heard of it yet."""

    async def accept(self) -> None: ...

    async def receive(self) -> None:
        await asyncio.Event().wait()

    async def send_text(self, text: str) -> None:
        raise RuntimeError(
            "Unexpected ASGI message 'websocket.send', after sending 'websocket.close'."
        )


def test_a_viewer_that_answers_no_ping_is_no_fault() -> None:
    watch: Any = Watch()
    socket: Any = ClosedSocket()

    with start_blocking_portal() as portal:
        portal.call(live, socket, "bike", watch)

    assert len(watch.left) == 1
