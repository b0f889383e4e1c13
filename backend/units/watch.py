"""Watching a unit live: rows picked once for everybody who asks for the same.

A feed belongs to one unit, one list of channels and one rate. It is fed by the unit's reader
thread and fills the queues of its viewers. A viewer's queue is bounded: a slow viewer loses the
oldest rows and is notified how many. Nothing here waits, so a slow browser never delays the reader.

What comes is the unit's state whenever it changes, what the rows are before the first of them and
whenever that changes, and the rows.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol, TypeAlias

import numpy as np
import numpy.typing as npt

from backend.core.channels import ChannelSpec
from backend.device.states import DeviceEvent, StateChanged
from backend.device.stream import StreamBlock, StreamStarted
from backend.errors import FieldError, InvalidRequest

# Three seconds of frames at 20 a second: a browser that was asleep longer wants the present.
QUEUE_FRAMES_MAX = 64
# At most 50 frames a second, whatever the speed factor of a simulated unit.
FRAME_SPACING_US = 20_000
# What may gather between two frames; a unit that sends more than this in 20 ms is not ours.
ROWS_PENDING_MAX = 4096

FeedKey = tuple[str, tuple[str, ...] | None, float | None]


@dataclass(frozen=True)
class StateNow:
    """The unit's state and why."""

    state: str
    reason: str | None


@dataclass(frozen=True)
class StreamNow:
    """How to read the rows that follow: their channels in order, one row every `period_us`."""

    epoch: int
    period_us: int
    channels: tuple[ChannelSpec, ...]


@dataclass(frozen=True)
class LiveRows:
    """Rows one after the other. counts: int16 (rows, channels), shared by all viewers.

    lost_rows: since the rows before, on the way here. t0_us: unit time of the first row.
    """

    sequence: int
    lost_rows: int
    t0_us: int
    counts: npt.NDArray[np.int16]


LiveItem: TypeAlias = StateNow | StreamNow | LiveRows


class Viewer:
    """One client's queue. `wake` is called, from the reader's thread, when it stops being empty."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._lock = threading.Lock()
        self._items: deque[LiveItem] = deque()
        self._lost_rows = 0

    def put(self, item: LiveItem) -> None:
        """Adds an item; the oldest rows go when the queue is full."""
        with self._lock:
            if len(self._items) >= QUEUE_FRAMES_MAX:
                self._drop_oldest()
            was_empty = not self._items
            self._items.append(item)
        if was_empty:
            self._wake()

    def take(self) -> list[LiveItem]:
        """Everything that waits, in order."""
        with self._lock:
            waiting = list(self._items)
            self._items.clear()
            lost_rows, self._lost_rows = self._lost_rows, 0
        taken: list[LiveItem] = []
        for item in waiting:
            if isinstance(item, LiveRows):
                item = replace(item, lost_rows=item.lost_rows + lost_rows)
                lost_rows = 0
            taken.append(item)
        if lost_rows:
            with self._lock:
                self._lost_rows += lost_rows
        return taken

    def _drop_oldest(self) -> None:
        """Drops the oldest rows. Where there are none, the oldest item: a newer one says more."""
        position = next(
            (i for i, item in enumerate(self._items) if isinstance(item, LiveRows)), None
        )
        if position is None:
            self._items.popleft()
            return
        dropped = self._items[position]
        del self._items[position]
        if isinstance(dropped, LiveRows):
            # Loss is reported before the rows that follow it, so it is added to the next ones.
            self._lost_rows += len(dropped.counts) + dropped.lost_rows


class Feed:
    """The rows of one unit for one choice of channels and rate.

    names: in the order they are sent, None for all. rate_hz: rows per second, None for all; the
    nearest whole fraction of the unit's rate is used.
    """

    def __init__(self, names: Sequence[str] | None, rate_hz: float | None) -> None:
        self._lock = threading.Lock()
        self._viewers: list[Viewer] = []
        self._names = names
        self._rate_hz = rate_hz
        self._stream: StreamNow | None = None
        self._state: StateNow | None = None
        self._columns: npt.NDArray[np.intp] = np.empty(0, dtype=np.intp)
        self._epoch: int | None = None
        self._step = 1
        self._next_index: int | None = None
        self._sequence = 0
        self._sent_wall_us = 0
        self._pending: list[npt.NDArray[np.int16]] = []
        self._pending_rows = 0
        self._pending_t0_us = 0
        self._pending_lost = 0

    def admit(self, viewer: Viewer, state: StateNow) -> None:
        """A newcomer gets state and stream at once, so that the first rows can be read.

        state: read after the feed was subscribed; what the feed has heard of since is newer.
        """
        with self._lock:
            self._viewers.append(viewer)
            viewer.put(self._state or state)
            if self._stream is not None:
                viewer.put(self._stream)

    def dismiss(self, viewer: Viewer) -> bool:
        """Whether the viewer was the last one."""
        with self._lock:
            self._viewers.remove(viewer)
            return not self._viewers

    def take(self, event: DeviceEvent) -> None:
        """What the unit's reader thread tells; everything but rows and states is ignored."""
        with self._lock:
            if isinstance(event, StreamBlock):
                if event.epoch != self._epoch:
                    self._begin(event.epoch, event.period_us, event.channels)
                self._take_rows(event)
            elif isinstance(event, StreamStarted):
                self._begin(event.epoch, event.period_us, event.channels)
            elif isinstance(event, StateChanged):
                self._state = StateNow(event.state.value, event.reason)
                self._deliver(self._state)

    def _take_rows(self, block: StreamBlock) -> None:
        """Picks the rows and sends them once 20 ms have gathered."""
        # Rows are numbered through the subscription, so the same ones are picked after a loss.
        offset = -block.first_index % self._step
        rows = block.values[offset :: self._step, self._columns]
        if len(rows):
            self._gather(block, offset, rows)
        waited_us = block.wall_us - self._sent_wall_us
        if self._pending_rows and (
            not 0 <= waited_us < FRAME_SPACING_US or self._pending_rows >= ROWS_PENDING_MAX
        ):
            self._send(block.wall_us)

    def _begin(self, epoch: int, period_us: int, offered: Sequence[ChannelSpec]) -> None:
        self._epoch = epoch
        self._next_index = None
        self._pending, self._pending_rows, self._pending_lost = [], 0, 0
        positions = {channel.name: i for i, channel in enumerate(offered)}
        names = [name for name in self._names or positions if name in positions]
        self._columns = np.array([positions[name] for name in names], dtype=np.intp)
        self._step = max(1, round(1e6 / period_us / self._rate_hz)) if self._rate_hz else 1
        chosen = tuple(offered[positions[name]] for name in names)
        self._stream = StreamNow(epoch, period_us * self._step, chosen)
        self._deliver(self._stream)

    def _gather(self, block: StreamBlock, offset: int, rows: npt.NDArray[np.int16]) -> None:
        first_index = (block.first_index + offset) // self._step
        if self._next_index is not None and first_index > self._next_index:
            # A frame's rows are evenly spaced, so what comes after a hole is another frame.
            if self._pending_rows:
                self._send(block.wall_us)
            self._pending_lost = first_index - self._next_index
        if not self._pending_rows:
            self._pending_t0_us = block.t0_us + offset * block.period_us
        self._pending.append(rows)
        self._pending_rows += len(rows)
        self._next_index = first_index + len(rows)

    def _send(self, wall_us: int) -> None:
        counts = np.concatenate(self._pending)
        rows = LiveRows(self._sequence, self._pending_lost, self._pending_t0_us, counts)
        self._sequence += 1
        self._sent_wall_us = wall_us
        self._pending, self._pending_rows, self._pending_lost = [], 0, 0
        self._deliver(rows)

    def _deliver(self, item: LiveItem) -> None:
        for viewer in self._viewers:
            viewer.put(item)


class Device(Protocol):
    """What a viewer gets about a unit when it joins."""

    @property
    def state(self) -> str: ...
    @property
    def reason(self) -> str: ...


class Devices(Protocol):
    """What is needed of units.service.Devices."""

    def get(self, device_id: str) -> Device: ...
    def channels(self, device_id: str) -> tuple[ChannelSpec, ...]: ...
    def subscribe(
        self, device_id: str, listener: Callable[[DeviceEvent], None]
    ) -> Callable[[], None]: ...


class Watch:
    """Who watches which unit; feeds begin with their first viewer and end with their last."""

    def __init__(self, devices: Devices) -> None:
        self._devices = devices
        self._lock = threading.Lock()
        self._feeds: dict[FeedKey, tuple[Feed, Callable[[], None]]] = {}
        self._keys: dict[Viewer, FeedKey] = {}

    def join(
        self, device_id: str, names: Sequence[str] | None, rate_hz: float | None, viewer: Viewer
    ) -> None:
        """Begins to fill the viewer's queue with the unit's state and what follows.

        Raises NotFound for an unknown unit, CapabilityMissing for one that streams nothing,
        InvalidRequest for an unknown channel.
        """
        check_names(names, [channel.name for channel in self._devices.channels(device_id)])
        key = (device_id, tuple(names) if names else None, rate_hz)
        with self._lock:
            if key not in self._feeds:
                feed = Feed(names, rate_hz)
                self._feeds[key] = (feed, self._devices.subscribe(device_id, feed.take))
            device = self._devices.get(device_id)
            self._feeds[key][0].admit(viewer, StateNow(device.state, device.reason))
            self._keys[viewer] = key

    def leave(self, viewer: Viewer) -> None:
        """Stops filling the viewer's queue."""
        with self._lock:
            key = self._keys.pop(viewer)
            feed, unsubscribe = self._feeds[key]
            if feed.dismiss(viewer):
                del self._feeds[key]
                unsubscribe()


def check_names(names: Sequence[str] | None, offered: Sequence[str]) -> None:
    """Raises InvalidRequest if a channel does not exist."""
    unknown = [name for name in names or () if name not in offered]
    if unknown:
        message = f"There is no channel {', '.join(unknown)}. There is {', '.join(offered)}."
        raise InvalidRequest(message, fields=[FieldError("channels", "unknown_channel", message)])
