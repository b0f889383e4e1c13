"""`WS /devices/{id}/live`: rows and link states of a unit; frames as in live_frames.py.

The reader's thread fills a viewer's bounded queue; this end empties it on the event loop. The
thread wakes the loop only when a queue stops being empty, so a busy loop is not woken in vain.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Coroutine
from typing import Annotated, Any

from fastapi import APIRouter, Query, WebSocket, WebSocketDisconnect

from backend.api.live_frames import frame_of
from backend.api.routes.rides import channel_names
from backend.api.services import services_of
from backend.errors import SpindleError
from backend.services.units.watch import Viewer

router = APIRouter(tags=["live"])

# Codes 4000 to 4999 are an application's own. The unit or a channel does not exist: trying the
# same again will not help, unlike after any other close.
CLOSE_REFUSED = 4404
# RFC 6455, 7.1.5: closed without a word.
GONE = 1006


@router.websocket("/devices/{device_id}/live")
async def live(
    socket: WebSocket,
    device_id: str,
    channels: Annotated[str | None, Query(max_length=600)] = None,
    rate_hz: Annotated[float | None, Query(gt=0.0, le=1000.0)] = None,
) -> None:
    """Streams until either side leaves."""
    watch = services_of(socket).watch
    await socket.accept()
    loop = asyncio.get_running_loop()
    ready = asyncio.Event()

    def wake() -> None:
        loop.call_soon_threadsafe(ready.set)

    viewer = Viewer(wake)
    try:
        watch.join(device_id, channel_names(channels), rate_hz, viewer)
    except SpindleError as error:
        text = json.dumps({"type": "error", "code": error.code, "detail": error.message})
        await socket.send_text(text)
        await socket.close(CLOSE_REFUSED, error.code)
        return
    try:
        await _first_to_end(_send(socket, viewer, ready), _listen(socket))
    finally:
        watch.leave(viewer)


async def _send(socket: WebSocket, viewer: Viewer, ready: asyncio.Event) -> None:
    while True:
        await ready.wait()
        ready.clear()
        for item in viewer.take():
            frame = frame_of(item)
            try:
                if isinstance(frame, str):
                    await socket.send_text(frame)
                else:
                    await socket.send_bytes(frame)
            except RuntimeError as closed:
                # The server gave up a client that answers no ping; the listener hears of it later.
                raise WebSocketDisconnect(GONE) from closed


async def _listen(socket: WebSocket) -> None:
    """Clients have nothing to say; reading is how a closed socket is noticed."""
    while (await socket.receive())["type"] != "websocket.disconnect":
        pass


async def _first_to_end(*coroutines: Coroutine[Any, Any, None]) -> None:
    """Runs all until one ends, then ends the others. A client's leaving is no error."""
    tasks = [asyncio.create_task(coroutine) for coroutine in coroutines]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        outcomes = await asyncio.gather(*tasks, return_exceptions=True)
    for outcome in outcomes:
        if isinstance(outcome, Exception) and not isinstance(outcome, WebSocketDisconnect):
            raise outcome
