"""Recording: a bike that moves makes a ride, and the ride ends when it has stood for a while.

    blocks of rows -> rows of the ride -> a tail a second -> finished after `idle_s` of standstill

All times are the unit's own, so a simulated unit at twenty times real time records the same ride.
Rows that were lost on the way become rows of missing samples, so that row number times period is
always the time. A unit that starts anew, or is away longer than `lost_s`, starts a new ride.
Nothing is acknowledged before the store has it: `rows_saved` counts committed rows only.
"""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from backend.device.states import DeviceEvent, LinkState, StateChanged
from backend.device.stream import StreamBlock
from backend.domain.channels import MISSING_INT16, ChannelSpec
from backend.domain.ride import Ride, RideContext
from backend.errors import SpindleError, StoreError
from backend.services.ride_bounds import (
    Indices,
    moving_rows,
    rows_after,
    rows_until_still,
    still_rows,
)
from backend.store import RideStore

LOG = logging.getLogger(__name__)

Rows16 = npt.NDArray[np.int16]
ContextOf = Callable[[str], RideContext]

# A ride is cut after a day at 100 Hz: it bounds what one crash recovery has to read.
RIDE_ROWS_MAX = 24 * 3600 * 100
# Seconds that wait for a disk that refuses them; more are lost, and counted as lost rows.
TAILS_WAITING_MAX = 120
# How often a refused second is tried again when the ride ends.
LAST_TRIES = 3


@dataclass(frozen=True)
class RecordSettings:
    """When a ride begins and ends.

    moving_kmh, moving_rpm: above either the bike is ridden. idle_s: standstill that ends a ride.
    lead_in_s: rows kept from before the first movement. lost_s: a gap longer than this ends it.
    tail_s: how much may be lost when the machine loses power.
    """

    moving_kmh: float = 1.0
    moving_rpm: float = 5.0
    idle_s: float = 20.0
    lead_in_s: float = 2.0
    lost_s: float = 60.0
    tail_s: float = 1.0


@dataclass(frozen=True)
class RecordingStatus:
    """A ride that is being recorded. rows: taken; rows_saved: committed; rows_lost: never came."""

    ride_id: int
    rows: int
    rows_saved: int
    rows_lost: int


@dataclass
class LiveRide:
    """A ride in the making: row r of it has the unit time t0_us + r * period_us."""

    ride_id: int
    t0_us: int
    rows: int = 0
    rows_saved: int = 0
    rows_lost: int = 0
    still_rows: int = 0
    context: RideContext = field(default_factory=RideContext)
    last_wall_us: int = 0


class UnitRecorder:
    """Records one unit. Fed from one thread, closed from any."""

    def __init__(
        self, device_id: str, rides: RideStore, settings: RecordSettings, context_of: ContextOf
    ) -> None:
        self._device_id = device_id
        self._rides = rides
        self._settings = settings
        self._moving_above = {
            "speed_kmh": settings.moving_kmh,
            "cadence_rpm": settings.moving_rpm,
        }
        self._context_of = context_of
        self._lock = threading.Lock()
        self._channels: tuple[ChannelSpec, ...] = ()
        self._period_us = 0
        self._live: LiveRide | None = None
        self._lead: deque[StreamBlock] = deque()
        self._told_trouble = False
        self._finishing: Future[Ride | None] | None = None
        self._unsent: list[Rows16] = []
        self._in_flight: deque[tuple[Future[None], int, Rows16]] = deque()

    def take(self, event: DeviceEvent) -> None:
        """Listener for the unit's events."""
        with self._lock:
            try:
                if isinstance(event, StreamBlock):
                    self._take_block(event)
                elif isinstance(event, StateChanged) and event.state is LinkState.CLOSED:
                    self._end()
                self._told_trouble = False
            except StoreError as error:
                # The reader thread must go on whatever the disk says; the log need not repeat it.
                if not self._told_trouble:
                    LOG.warning("Unit %s is not recorded: %s", self._device_id, error.message)
                self._told_trouble = True

    def end_if_lost(self, now_us: int) -> None:
        """End the ride of a unit that has been silent for `lost_s`; now_us: Unix time."""
        with self._lock:
            silent_us = now_us - self._live.last_wall_us if self._live else 0
            if silent_us > self._settings.lost_s * 1e6:
                self._end()

    def end(self) -> Future[Ride | None] | None:
        """End the ride that is being recorded; the future is done when the last one is finished."""
        with self._lock:
            return self._end() or self._finishing

    @property
    def status(self) -> RecordingStatus | None:
        """The ride that is being recorded, None when there is none."""
        with self._lock:
            live = self._live
            if live is None:
                return None
            self._collect()
            return RecordingStatus(live.ride_id, live.rows, live.rows_saved, live.rows_lost)

    def _take_block(self, block: StreamBlock) -> None:
        if block.channels != self._channels or block.period_us != self._period_us:
            self._end()
            self._lead.clear()
            self._channels, self._period_us = block.channels, block.period_us
        if self._live is not None and not self._continues(self._live, block):
            self._end()
            self._lead.clear()
        while len(block.values):
            block = self._take_part(block)

    def _take_part(self, block: StreamBlock) -> StreamBlock:
        """Takes rows of the block up to where a ride ends; returns the rest of it."""
        moving = moving_rows(block, self._moving_above)
        if self._live is not None:
            return self._add(self._live, block, moving)
        if self._lead and not self._follows(self._lead[-1], block):
            self._lead.clear()
        if len(moving):
            return self._begin(block, int(moving[0]))
        self._keep_lead(block)
        return rows_after(block, len(block.values))

    def _continues(self, live: LiveRide, block: StreamBlock) -> bool:
        """Whether the block belongs to the ride: not before its end, not too long after."""
        ahead = self._rows_ahead(live, block)
        return 0 <= ahead <= self._settings.lost_s * 1e6 / self._period_us

    def _rows_ahead(self, live: LiveRide, block: StreamBlock) -> int:
        due_us = live.t0_us + live.rows * self._period_us
        return round((block.t0_us - due_us) / self._period_us)

    def _keep_lead(self, block: StreamBlock) -> None:
        """Remember the rows before the first movement, as long as they follow one another."""
        self._lead.append(block)
        keep_us = self._settings.lead_in_s * 1e6
        while len(self._lead) > 1 and block.t0_us - self._lead[1].t0_us >= keep_us:
            self._lead.popleft()

    def _follows(self, last: StreamBlock, block: StreamBlock) -> bool:
        due_us = last.t0_us + len(last.values) * self._period_us
        return abs(block.t0_us - due_us) < self._period_us

    def _begin(self, block: StreamBlock, first_moving: int) -> StreamBlock:
        """Starts a ride `lead_in_s` before the first moving row; returns the block's rows of it."""
        lead_rows = sum(len(lead.values) for lead in self._lead)
        kept = round(self._settings.lead_in_s * 1e6 / self._period_us)
        skipped = max(0, lead_rows + first_moving - kept)
        t0_us = (self._lead[0] if self._lead else block).t0_us + skipped * self._period_us
        started_us = block.wall_us - (block.t0_us - t0_us)
        context = replace(self._context(), unit_t0_us=t0_us)
        ride_id = self._rides.start_live(self._channels, self._period_us, started_us, context)
        self._live = LiveRide(ride_id, t0_us, last_wall_us=block.wall_us, context=context)
        if skipped < lead_rows:
            rows = np.concatenate([lead.values for lead in self._lead])
            self._append(self._live, rows[skipped:])
        self._lead.clear()
        return rows_after(block, max(0, skipped - lead_rows))

    def _context(self) -> RideContext:
        try:
            return self._context_of(self._device_id)
        except SpindleError:
            # The unit was removed in the meantime: the ride is kept all the same.
            return RideContext(device_id=self._device_id)

    def _add(self, live: LiveRide, block: StreamBlock, moving: Indices) -> StreamBlock:
        """Adds rows until the ride is over; returns those that are left."""
        lost = self._rows_ahead(live, block)
        if lost > 0:
            missing = np.full((lost, block.values.shape[1]), MISSING_INT16, np.int16)
            self._append(live, missing)
            live.rows_lost += lost
        row_count = len(block.values)
        still_max = max(1, round(self._settings.idle_s * 1e6 / self._period_us))
        until_still = rows_until_still(moving, row_count, live.still_rows, still_max)
        room = max(0, RIDE_ROWS_MAX - live.rows)
        taken = min(row_count, room, row_count if until_still is None else until_still)
        live.still_rows = still_rows(moving[moving < taken], taken, live.still_rows)
        self._append(live, block.values[:taken])
        live.last_wall_us = block.wall_us
        unsent_us = sum(map(len, self._unsent)) * self._period_us
        if unsent_us >= self._settings.tail_s * 1e6:
            self._send(live)
        if taken in (room, until_still):
            self._end()
        return rows_after(block, taken)

    def _append(self, live: LiveRide, rows: Rows16) -> None:
        self._unsent.append(rows)
        live.rows += len(rows)

    def _send(self, live: LiveRide) -> None:
        """Hand the unsent rows to the store."""
        if not self._unsent:
            return
        rows = np.concatenate(self._unsent)
        self._unsent = []
        self._submit(live, live.rows - len(rows), rows)
        self._collect()

    def _submit(self, live: LiveRide, row_start: int, rows: Rows16) -> None:
        future = self._rides.append_tail(live.ride_id, row_start, rows)
        self._in_flight.append((future, row_start, rows))

    def _collect(self) -> None:
        """Count what the disk has taken; what it refused is tried again, a bounded number."""
        while self._in_flight and self._in_flight[0][0].done():
            future, row_start, rows = self._in_flight.popleft()
            live = self._live
            if live is None:
                continue
            if future.exception() is None:
                live.rows_saved += len(rows)
            elif len(self._in_flight) < TAILS_WAITING_MAX:
                self._submit(live, row_start, rows)
                return
            else:
                live.rows_lost += len(rows)

    def _end(self) -> Future[Ride | None] | None:
        """Last rows out, refused ones once more, then finish on the store's thread."""
        live = self._live
        if live is None:
            return None
        self._send(live)
        for _ in range(LAST_TRIES):
            refused = [(start, rows) for done, start, rows in self._in_flight if done.exception()]
            self._in_flight.clear()
            for row_start, rows in refused:
                self._submit(live, row_start, rows)
        self._in_flight.clear()
        self._live = None
        if live.context.gear_ratio is None:
            # The unit may have told its configuration only after the bike began to move.
            context = replace(self._context(), unit_t0_us=live.t0_us)
            if context.gear_ratio is not None:
                self._rides.set_context(live.ride_id, context)
        finished: Future[Ride | None] = self._rides.finish_later(live.ride_id)
        finished.add_done_callback(lambda future: tell_trouble(live.ride_id, future))
        self._finishing = finished
        return finished


class Recorder:
    """Records every unit that is followed."""

    def __init__(
        self,
        rides: RideStore,
        context_of: ContextOf = lambda device_id: RideContext(device_id=device_id),
        settings: RecordSettings | None = None,
    ) -> None:
        self._rides = rides
        self._context_of = context_of
        self._settings = settings or RecordSettings()
        self._units: dict[str, UnitRecorder] = {}
        self._lock = threading.Lock()

    def listener(self, device_id: str) -> Callable[[DeviceEvent], None]:
        """What to subscribe to a unit's events; the same for the same unit."""
        with self._lock:
            if device_id not in self._units:
                self._units[device_id] = UnitRecorder(
                    device_id, self._rides, self._settings, self._context_of
                )
            return self._units[device_id].take

    def watch(self, device_id: str, event: DeviceEvent) -> None:
        """Watcher of every device: records whichever moves."""
        self.listener(device_id)(event)

    def status(self, device_id: str) -> RecordingStatus | None:
        """The ride a unit is recording now, None when it records none."""
        unit = self._units.get(device_id)
        return unit.status if unit else None

    def tick(self, now_us: int) -> None:
        """End the rides of units that have been silent too long; now_us: Unix time."""
        for unit in self._all():
            unit.end_if_lost(now_us)

    def close(self) -> None:
        """End and finish every ride; what cannot be finished now is finished at the next start."""
        for future in [unit.end() for unit in self._all()]:
            if future is not None:
                future.exception()

    def _all(self) -> Sequence[UnitRecorder]:
        with self._lock:
            return list(self._units.values())


def tell_trouble(ride_id: int, future: Future[Ride | None]) -> None:
    """Say in the log when a ride could not be finished."""
    error = future.exception()
    if isinstance(error, StoreError):
        LOG.warning("Ride %d is kept but not finished: %s", ride_id, error.message)
    elif error is not None:
        LOG.error("Ride %d was not finished.", ride_id, exc_info=error)
