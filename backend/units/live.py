"""`WS /devices/{id}/live`: rows and link states of a unit.

Frames:

- text `{"type": "stream", "epoch", "rate_hz", "period_us", "channels": [{name, unit, scale}]}`
  before the first rows and whenever one of these changes;
- text `{"type": "state", "state", "reason"}` whenever the unit's state changes;
- binary, little-endian: u32 sequence, u32 rows lost since the previous frame, u64 unit time of the
  first row in us, u16 rows n, u16 channels c, then i16[n * c] counts; value = count * scale,
  -32768 is missing.

The reader's thread fills a viewer's bounded queue; this end empties it on the event loop. The
thread wakes the loop only when a queue stops being empty, so a busy loop is not woken in vain.
"""

from __future__ import annotations

import asyncio
import json
import struct
from collections.abc import Coroutine
from typing import Annotated, Any

from fastapi import APIRouter, Query, WebSocket, WebSocketDisconnect

from backend.core.channels import channel_names
from backend.errors import SpindleError
from backend.units.watch import LiveItem, LiveRows, StreamNow, Viewer, Watch
from backend.web.services import provided
from backend.web.sockets import (
    CLOSE_NOT_ALLOWED,
    CLOSE_TOO_MANY,
    OpenSockets,
    until_not_allowed,
)

HEADER = struct.Struct("<IIQHH")
SEQUENCE_MODULUS = 2**32


def frame_of(item: LiveItem) -> str | bytes:
    """The frame that says this; a text is str."""
    if isinstance(item, LiveRows):
        return rows_frame(item)
    if isinstance(item, StreamNow):
        return stream_frame(item)
    return json.dumps({"type": "state", "state": item.state, "reason": item.reason})


def rows_frame(rows: LiveRows) -> bytes:
    """Header and counts."""
    header = HEADER.pack(
        rows.sequence % SEQUENCE_MODULUS,
        min(rows.lost_rows, SEQUENCE_MODULUS - 1),
        rows.t0_us,
        *rows.counts.shape,
    )
    return header + rows.counts.astype("<i2", copy=False).tobytes()


def stream_frame(stream: StreamNow) -> str:
    """How to read the rows after it."""
    return json.dumps(
        {
            "type": "stream",
            "epoch": stream.epoch,
            "rate_hz": 1e6 / stream.period_us,
            "period_us": stream.period_us,
            "channels": [
                {"name": channel.name, "unit": channel.unit, "scale": channel.scale}
                for channel in stream.channels
            ],
        }
    )


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
    watch: Annotated[Watch, provided("watch")],
    channels: Annotated[str | None, Query(max_length=600)] = None,
    rate_hz: Annotated[float | None, Query(gt=0.0, le=1000.0)] = None,
) -> None:
    """Streams until either side leaves, or until who opened it may not see the unit any more."""
    await socket.accept()
    sockets: OpenSockets = socket.app.state.sockets
    with sockets.place(socket) as has_room:
        if has_room:
            await _stream(socket, device_id, watch, channels, rate_hz)
        else:
            await socket.close(CLOSE_TOO_MANY, "too_many_sockets")


async def _stream(
    socket: WebSocket, device_id: str, watch: Watch, channels: str | None, rate_hz: float | None
) -> None:
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
        await _first_to_end(
            _send(socket, viewer, ready), _listen(socket), _end_with_permission(socket)
        )
    finally:
        watch.leave(viewer)


async def _end_with_permission(socket: WebSocket) -> None:
    await until_not_allowed(socket)
    await socket.close(CLOSE_NOT_ALLOWED, "not_allowed")


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
