"""Recording: a bike that moves makes a ride, and the ride ends when it has stood for a while.

    blocks of rows -> rows of the ride -> a tail a second -> finished after `idle_s` of standstill

All times are the unit's own, so a simulated unit at twenty times real time records the same ride.
Rows that were lost on the way become rows of missing samples, so that row number times period is
always the time. A unit that starts anew, or is away longer than `lost_s`, starts a new ride.
Nothing is acknowledged before the store has it: `rows_saved` counts committed rows only. A store
that refuses (a full disk) is waited for, also by a ride that is over; what is given up is counted.
"""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

import numpy as np

from backend.core._generated import MOVING_KMH, MOVING_RPM, STANDING_S
from backend.core.channels import MISSING_INT16, ChannelSpec
from backend.core.moments import set_by_us
from backend.core.ride import Ride, RideContext, RideSummary
from backend.device.gathering import GATHER_US, Gathering
from backend.device.states import DeviceEvent, LinkState, StateChanged, UnitEvent
from backend.device.stream import LostBy, StreamBlock, unwrap_us
from backend.errors import SpindleError, StoreError
from backend.rides.recording.bounds import (
    Indices,
    MissingRows,
    moving_rows,
    rows_after,
    rows_until_still,
    still_rows,
)
from backend.rides.recording.finishing import (
    RideClock,
    complete_context,
    redate_after_clock_set,
)
from backend.rides.recording.ride_tail import RecorderHealth, RideTail
from backend.rides.recording.running import RunningTotals
from backend.rides.settings_in_force import SettingsInForce
from backend.store import RideStore

LOG = logging.getLogger(__name__)

ContextOf = Callable[[str], RideContext]

# A ride is cut after a day at 100 Hz: it bounds what one crash recovery has to read.
RIDE_ROWS_MAX = 24 * 3600 * 100
# Seconds of a unit that wait for a disk that refuses them: some 3 MB, and the time in which a
# person who reads that the disk is full can make room. More are lost, and counted as lost rows.
TAILS_WAITING_MAX = 600


@dataclass(frozen=True)
class RecordSettings:
    """When a ride begins and ends.

    moving_kmh, moving_rpm: above either the bike is ridden. idle_s: standstill that ends a ride.
    lead_in_s: rows kept from before the first movement. lost_s: a gap longer than this ends it.
    tail_s: how much may be lost when the machine loses power. tails_waiting_max: how many of these
    wait for a store that refuses them.
    """

    moving_kmh: float = MOVING_KMH
    moving_rpm: float = MOVING_RPM
    idle_s: float = STANDING_S
    lead_in_s: float = 2.0
    lost_s: float = 60.0
    tail_s: float = 1.0
    tails_waiting_max: int = TAILS_WAITING_MAX


@dataclass(frozen=True)
class RecordingStatus:
    """A ride that is being recorded.

    ride_id: None while the store refuses to begin it. rows: that came for it. rows_saved: committed
    of them. rows_lost: given up. rows_missing: never came.
    """

    ride_id: int | None
    rows: int
    rows_saved: int
    rows_lost: int
    rows_missing: int


@dataclass
class LiveRide:
    """A ride in the making: row r of it has the unit time t0_us + r * period_us."""

    tail: RideTail
    t0_us: int
    totals: RunningTotals
    clock: RideClock
    still_rows: int = 0
    context: RideContext = field(default_factory=RideContext)
    epoch: int | None = None
    settings: SettingsInForce = field(init=False)

    def __post_init__(self) -> None:
        self.settings = SettingsInForce(self.context.config_crc32)


class UnitRecorder:
    """Records one unit. Fed from one thread, closed from any."""

    def __init__(
        self,
        device_id: str,
        rides: RideStore,
        settings: RecordSettings,
        context_of: ContextOf,
        finish: Callable[[int, bool], Future[Ride | None]],
        offset_us: Callable[[], int],
    ) -> None:
        self._device_id = device_id
        self._rides = rides
        self._settings = settings
        self._moving_above = {
            "speed_kmh": settings.moving_kmh,
            "cadence_rpm": settings.moving_rpm,
        }
        self._context_of = context_of
        self._offset_us = offset_us
        self._lock = threading.Lock()
        self._channels: tuple[ChannelSpec, ...] = ()
        self._period_us = 0
        self._live: LiveRide | None = None
        self._lead: deque[StreamBlock] = deque()
        self._gathering = Gathering()
        # As the clocks were when the newest block came.
        self._block_offset_us = 0
        self._has_logged_error = False
        # Read by those who must not wait for the lock.
        self.counts = RecorderHealth()
        self.lost_lately = 0
        self.missing = MissingRows(device_id)
        self._finish = finish
        # Rides that are over and whose last rows the store has refused so far.
        self._ending: list[LiveRide] = []
        self._finishing: Future[Ride | None] | None = None

    def take(self, event: DeviceEvent) -> None:
        """Listener for the unit's events."""
        with self._lock:
            if isinstance(event, StreamBlock):
                self._gather(event)
                return
            self._take_blocks(self._gathering.take())
            with self._refusals_logged():
                if isinstance(event, UnitEvent):
                    self._take_unit_event(event)
                elif isinstance(event, StateChanged) and event.state is LinkState.CLOSED:
                    self._end()

    def _gather(self, block: StreamBlock) -> None:
        offset_us = self._offset_us()
        if set_by_us(self._block_offset_us, offset_us):
            # What came before is dated by the clock as it was.
            self._take_blocks(self._gathering.take())
        self._block_offset_us = offset_us
        self._take_blocks(self._gathering.add(block))

    @contextmanager
    def _refusals_logged(self) -> Iterator[None]:
        """The reader thread must go on whatever the disk says; the log need not repeat it."""
        try:
            yield
            self._has_logged_error = False
        except StoreError as error:
            if not self._has_logged_error:
                LOG.warning("Unit %s is not recorded: %s", self._device_id, error.message)
            self._has_logged_error = True

    @contextmanager
    def _up_to_date(self) -> Iterator[None]:
        """No other thread, and with every row that has come."""
        with self._lock:
            self._take_blocks(self._gathering.take())
            yield

    def end_if_lost(self, now_us: int) -> None:
        """End the ride of a unit that has been silent for `lost_s`; now_us: Unix time."""
        with self._up_to_date():
            last_rows_us = self._live.clock.last_rows_us if self._live else now_us
            silent_us = now_us - self._offset_us() - last_rows_us
            if self._live and silent_us > self._settings.lost_s * 1e6:
                self._end()

    def retry(self) -> None:
        """Give a store that refused rows another chance, without waiting for it; and look whether
        the host's clock was set."""
        with self._up_to_date():
            if self._live is not None:
                self._is_dated(self._live)
                self._live.tail.push()
            for ride in list(self._ending):
                ride.tail.push()
                if ride.tail.is_empty:
                    self._over(ride)

    def end(self) -> Future[Ride | None] | None:
        """End the ride that is being recorded; the future is done when the last one is finished."""
        with self._up_to_date():
            return self._end() or self._finishing

    def close(self) -> Future[Ride | None] | None:
        """As `end`, and give up what the store still refuses."""
        with self._up_to_date():
            last = self._end() or self._finishing
            for ride in list(self._ending):
                if not ride.tail.drain():
                    ride.tail.give_up(ride.tail.tails_waiting)
                last = self._over(ride) or last
            return last

    @property
    def status(self) -> RecordingStatus | None:
        """The ride that is being recorded, None when there is none."""
        with self._up_to_date():
            live = self._live
            if live is None:
                return None
            live.tail.collect()
            counts = live.tail.counts
            saved, lost = counts.rows_saved, counts.rows_lost
            rows = saved + lost + counts.rows_waiting
            return RecordingStatus(live.tail.ride_id, rows, saved, lost, self.missing.rows)

    @property
    def newest(self) -> tuple[int, float] | None:
        """The ride that is being recorded, and when its newest row was, s after its start."""
        with self._up_to_date():
            live = self._live
            if live is None or live.tail.ride_id is None:
                return None
            return live.tail.ride_id, max(0, live.tail.rows - 1) * self._period_us / 1e6

    def records(self, ride_id: int) -> bool:
        """Whether it is this ride that is being recorded; never waits."""
        live = self._live
        return live is not None and live.tail.ride_id == ride_id

    def running(self, ride_id: int) -> RideSummary | None:
        """What the ride that is being recorded comes to so far; None for another."""
        with self._up_to_date():
            live = self._live
            return live.totals.summary() if live and live.tail.ride_id == ride_id else None

    def _take_blocks(self, blocks: Sequence[StreamBlock]) -> None:
        for block in blocks:
            with self._refusals_logged():
                self._take_block(block)

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

    def _take_unit_event(self, event: UnitEvent) -> None:
        live = self._live
        if live is None:
            return
        if event.name == "BOOT" and event.fields.get("boot_id") != live.context.boot_id:
            # Its clock begins again: what it tells from now on is not of this ride.
            self._end()
        elif event.name.startswith("CONFIG_"):
            now_us = live.t0_us + live.tail.rows * self._period_us
            t_s = (unwrap_us(event.t_us, now_us) - live.t0_us) / 1e6
            self._note_settings(live, t_s, event.fields.get("crc32"))

    def _note_settings(self, live: LiveRide, t_s: float, crc32: object) -> None:
        """The configuration with this CRC-32 has been in force since then."""
        if isinstance(crc32, int) and (change := live.settings.change(t_s, crc32)):
            live.tail.note(change)

    def _take_part(self, block: StreamBlock) -> StreamBlock:
        """Takes rows of the block up to where a ride ends; returns the rest of it."""
        moving = moving_rows(block, self._moving_above)
        if self._live is not None:
            return self._add(self._live, block, moving)
        if self._lead and not self._follows(self._lead[-1], block):
            self._lead.clear()
        if len(moving):
            return self._begin(block, int(moving[0]))
        self._store_lead(block)
        return rows_after(block, len(block.values))

    def _continues(self, live: LiveRide, block: StreamBlock) -> bool:
        """Whether the block belongs to the ride: not before its end, not too long after."""
        ahead = self._rows_ahead(live, block)
        return 0 <= ahead <= self._settings.lost_s * 1e6 / self._period_us

    def _rows_ahead(self, live: LiveRide, block: StreamBlock) -> int:
        due_us = live.t0_us + live.tail.rows * self._period_us
        return round((block.t0_us - due_us) / self._period_us)

    def _store_lead(self, block: StreamBlock) -> None:
        """Remember the rows before the first movement, as long as they follow one another."""
        self._lead.append(block)
        lead_us = self._settings.lead_in_s * 1e6
        while len(self._lead) > 1 and block.t0_us - self._lead[1].t0_us >= lead_us:
            self._lead.popleft()

    def _follows(self, last: StreamBlock, block: StreamBlock) -> bool:
        due_us = last.t0_us + len(last.values) * self._period_us
        return abs(block.t0_us - due_us) < self._period_us

    def _begin(self, block: StreamBlock, first_moving: int) -> StreamBlock:
        """Starts a ride `lead_in_s` before the first moving row; returns the block's rows of it."""
        lead_rows = sum(len(lead.values) for lead in self._lead)
        lead_rows_max = round(self._settings.lead_in_s * 1e6 / self._period_us)
        skipped = max(0, lead_rows + first_moving - lead_rows_max)
        t0_us = (self._lead[0] if self._lead else block).t0_us + skipped * self._period_us
        started_us = block.wall_us - (block.t0_us - t0_us)
        context = replace(self._context(), unit_t0_us=t0_us)
        channels, period_us = self._channels, self._period_us

        def begin() -> int:
            return self._rides.start_live(channels, period_us, started_us, context)

        tail = RideTail(self._rides, begin, self._count)
        totals = RunningTotals(channels, period_us)
        offset_us = self._block_offset_us
        clock = RideClock(offset_us, block.wall_us - offset_us)
        self._live = LiveRide(tail, t0_us, totals, clock, context=context)
        self.lost_lately = 0
        self.missing.begin()
        if skipped < lead_rows:
            rows = np.concatenate([lead.values for lead in self._lead])
            tail.add(rows[skipped:])
            totals.add(rows[skipped:])
        self._lead.clear()
        # The ride is there as soon as it has begun, not only with its first second.
        tail.push()
        return rows_after(block, max(0, skipped - lead_rows))

    def _count(self, saved: int, lost: int, waiting: int) -> None:
        """Add up over all rides; say once a ride that rows are being lost."""
        self.counts.rows_saved += saved
        self.counts.rows_lost += lost
        self.counts.rows_waiting += waiting
        if lost and not self.lost_lately:
            LOG.error("Unit %s: rows of its ride are lost, nothing takes them.", self._device_id)
        self.lost_lately += lost

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
            live.tail.add(missing, taken=False)
            live.totals.skip(lost)
            self.counts.rows_missing += lost
            was_away = live.epoch not in (None, block.epoch)
            lost_by = block.lost_by or (LostBy.LINE if was_away else LostBy.UNIT)
            self.missing.add(lost_by, lost, self._period_us)
        live.epoch = block.epoch
        row_count = len(block.values)
        still_max = max(1, round(self._settings.idle_s * 1e6 / self._period_us))
        until_still = rows_until_still(moving, row_count, live.still_rows, still_max)
        room = max(0, RIDE_ROWS_MAX - live.tail.rows)
        taken = min(row_count, room, row_count if until_still is None else until_still)
        live.still_rows = still_rows(moving[moving < taken], taken, live.still_rows)
        live.tail.add(block.values[:taken])
        live.totals.add(block.values[:taken])
        live.clock.last_rows_us = block.wall_us - self._block_offset_us
        # What is gathered next waits as well.
        if live.tail.rows_unsent * self._period_us >= self._settings.tail_s * 1e6 - GATHER_US:
            # A change of which the unit's own event was lost, or came while it was away.
            now_s = (live.tail.rows - taken) * self._period_us / 1e6
            self._note_settings(live, now_s, self._context().config_crc32)
            live.tail.send()
            self._shed(live)
        if taken in (room, until_still):
            self._end()
        return rows_after(block, taken)

    def _shed(self, live: LiveRide) -> None:
        """Give the oldest up when too much waits."""
        tails = [ride.tail for ride in (*self._ending, live)]
        too_many = sum(tail.tails_waiting for tail in tails) - self._settings.tails_waiting_max
        for tail in tails:
            if too_many <= 0:
                break
            shed = min(too_many, tail.tails_waiting)
            tail.give_up(shed)
            too_many -= shed

    def _end(self) -> Future[Ride | None] | None:
        """Last rows out, refused ones once more, then finish on the store's thread."""
        live = self._live
        if live is None:
            return None
        self._live = None
        self._ending.append(live)
        if not live.tail.drain():
            return None
        return self._over(live)

    def _over(self, ride: LiveRide) -> Future[Ride | None] | None:
        """Everything of a ride is saved or lost: finish it. None for one that never began, or that
        the store does not let be dated."""
        if not self._is_dated(ride):
            return None
        self._ending.remove(ride)
        ride_id = ride.tail.ride_id
        if ride_id is None:
            return None
        now = replace(self._context(), unit_t0_us=ride.t0_us)
        complete_context(self._rides, ride_id, ride.context, now)
        # Still rows are at the end: without any the bike moved when the recording ended.
        self._finishing = self._finish(ride_id, ride.still_rows == 0)
        return self._finishing

    def _is_dated(self, ride: LiveRide) -> bool:
        """Date it anew where the host's clock was set; False while the store refuses that."""
        if (ride_id := ride.tail.ride_id) is None:
            return True
        t_s = ride.tail.rows * self._period_us / 1e6
        return redate_after_clock_set(self._rides, ride_id, ride.clock, self._offset_us(), t_s)
