"""Goal: what a browser is sent live is the unit's rows, and every row it does not get is counted; a
viewer that vanished without a word is let go, and no fault of the server's.

Blocks are fed as the reader's thread feeds them; frames are taken apart by the layout that the
contract gives (u32, u32, u64, u16, u16, then i16), not by the code that made them.
"""

from __future__ import annotations

import asyncio
import json
import struct
from types import SimpleNamespace
from typing import Any

import numpy as np
from anyio.from_thread import start_blocking_portal

from backend.core.channels import ChannelSpec
from backend.core.person import Permission
from backend.device.states import LinkState, StateChanged
from backend.device.stream import StreamBlock, StreamStarted
from backend.units.live import frame_of, live
from backend.units.watch import QUEUE_FRAMES_MAX, Feed, LiveRows, StateNow, Viewer
from backend.web.sockets import OpenSockets

CHANNELS = (ChannelSpec("speed_kmh", "km/h", 0.01), ChannelSpec("cadence_rpm", "rpm", 0.01))
PERIOD_US = 10_000


def block(first_index: int, rows: int = 5, lost: int = 0, epoch: int = 1) -> StreamBlock:
    """Rows whose first channel is their own number; wall time runs like the unit's."""
    numbers = np.arange(first_index, first_index + rows, dtype=np.int16)
    return StreamBlock(
        t0_us=first_index * PERIOD_US,
        period_us=PERIOD_US,
        first_index=first_index,
        values=np.column_stack([numbers, -numbers]),
        lost_rows_before=lost,
        epoch=epoch,
        wall_us=1_000_000_000 + (first_index + rows) * PERIOD_US,
        channels=CHANNELS,
    )


class Screen:
    """A viewer that is read to the end."""

    def __init__(self, feed: Feed) -> None:
        self.woken = 0
        self.viewer = Viewer(self._wake)
        feed.admit(self.viewer, StateNow("ready", None))
        self.texts: list[dict[str, object]] = []
        self.frames: list[tuple[int, int, int, np.ndarray]] = []

    def _wake(self) -> None:
        self.woken += 1

    def read(self) -> Screen:
        for item in map(frame_of, self.viewer.take()):
            if isinstance(item, str):
                self.texts.append(json.loads(item))
                continue
            sequence, lost, t0_us, rows, channels = struct.unpack_from("<IIQHH", item)
            values = np.frombuffer(item, "<i2", offset=20).reshape(rows, channels)
            self.frames.append((sequence, lost, t0_us, values))
        return self

    def rows(self) -> np.ndarray:
        return np.concatenate([frame[3] for frame in self.frames])


def test_every_row_arrives_in_order_with_its_time() -> None:
    feed = Feed(None, None)
    screen = Screen(feed)

    for start in range(0, 100, 5):
        feed.take(block(start))
    screen.read()

    assert screen.rows()[:, 0].tolist() == list(range(100))
    assert [frame[0] for frame in screen.frames] == list(range(len(screen.frames)))
    assert all(frame[2] == int(frame[3][0, 0]) * PERIOD_US for frame in screen.frames)
    assert sum(frame[1] for frame in screen.frames) == 0


def test_the_description_comes_before_the_rows_and_to_latecomers_too() -> None:
    feed = Feed(["cadence_rpm"], None)
    early = Screen(feed)
    feed.take(StreamStarted(1, PERIOD_US, CHANNELS))
    feed.take(block(0))
    late = Screen(feed)
    feed.take(block(5))

    for screen in (early.read(), late.read()):
        described = screen.texts[-1]
        assert described["type"] == "stream"
        assert described["channels"] == [{"name": "cadence_rpm", "unit": "rpm", "scale": 0.01}]
        assert described["rate_hz"] == 100.0
    assert late.rows()[:, 0].tolist() == [-5, -6, -7, -8, -9]


def test_a_lower_rate_picks_the_same_rows_after_a_loss() -> None:
    feed = Feed(["speed_kmh"], 10.0)
    screen = Screen(feed)

    feed.take(block(0, rows=40))
    feed.take(block(63, rows=40, lost=23))
    screen.read()

    assert screen.rows()[:, 0].tolist() == [0, 10, 20, 30, 70, 80, 90, 100]
    assert [frame[1] for frame in screen.frames] == [0, 3]
    assert screen.texts[-1]["period_us"] == 100_000


def test_rows_lost_on_the_wire_are_told_with_the_rows_that_follow() -> None:
    feed = Feed(None, None)
    screen = Screen(feed)

    feed.take(block(0))
    feed.take(block(25, lost=20))
    screen.read()

    assert [(frame[1], frame[3][0, 0]) for frame in screen.frames] == [(0, 0), (20, 25)]


def test_a_slow_viewer_loses_the_oldest_rows_and_is_told_how_many() -> None:
    feed = Feed(None, None)
    slow, quick = Screen(feed), Screen(feed)
    frames = 3 * QUEUE_FRAMES_MAX

    for start in range(0, 5 * frames, 5):
        feed.take(block(start))
        quick.read()
    slow.read()

    assert len(slow.frames) < QUEUE_FRAMES_MAX
    assert slow.texts[0]["type"] == "state"
    assert slow.rows()[-1, 0] == 5 * frames - 1
    told = sum(frame[1] for frame in slow.frames)
    assert told + len(slow.rows()) == 5 * frames
    assert len(quick.rows()) == 5 * frames
    assert sum(frame[1] for frame in quick.frames) == 0


def test_a_new_subscription_is_described_anew_and_is_no_loss() -> None:
    feed = Feed(None, None)
    screen = Screen(feed)

    feed.take(block(500))
    feed.take(block(0, epoch=2))
    screen.read()

    assert [text.get("epoch") for text in screen.texts] == [None, 1, 2]
    assert [frame[1] for frame in screen.frames] == [0, 0]


def test_a_change_of_state_is_told_and_kept_for_latecomers() -> None:
    feed = Feed(None, None)
    screen = Screen(feed)

    feed.take(StateChanged(LinkState.LOST, "The unit is silent."))
    late = Screen(feed).read()

    told = {"type": "state", "state": "lost", "reason": "The unit is silent."}
    assert screen.read().texts[-1] == told
    assert late.texts == [told]


def test_many_viewers_share_the_same_rows() -> None:
    feed = Feed(None, None)
    screens = [Screen(feed) for _ in range(3)]

    feed.take(block(0))

    items = [item for screen in screens for item in screen.viewer.take()]
    assert len({id(item.counts) for item in items if isinstance(item, LiveRows)}) == 1


def test_a_busy_loop_is_woken_once_for_many_frames() -> None:
    feed = Feed(None, None)
    screen = Screen(feed)
    screen.read()
    before = screen.woken

    for start in range(0, 100, 5):
        feed.take(block(start))

    assert screen.woken == before + 1


def test_a_unit_in_fast_motion_makes_no_more_than_fifty_frames_a_second() -> None:
    feed = Feed(None, None)
    screen = Screen(feed)
    hasty = block(0)

    for number in range(1000):
        wall_us = 1_000_000_000 + number * 1000
        feed.take(StreamBlock(**{**vars(hasty), "first_index": 5 * number, "wall_us": wall_us}))
        screen.read()

    assert len(screen.frames) <= 51
    assert sum(len(frame[3]) for frame in screen.frames) >= 5 * 980


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

    def __init__(self) -> None:
        needed = {"live": Permission.SEE_BIKES}
        state = SimpleNamespace(sockets=OpenSockets(), authenticator=None, needed=needed)
        self.app = SimpleNamespace(state=state)
        self.scope = {"route": SimpleNamespace(name="live")}
        self.client = None

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
