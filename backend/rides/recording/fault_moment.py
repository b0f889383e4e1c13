"""What the bike did around a fault: rider torque and motor torque, every sample as it was recorded.

The unit tells when a fault came last, on its own clock; a ride carries that clock too, with the
start of the unit it belongs to. So the moment is cut out of the ride that was being recorded, else
out of the last minutes of the live stream. Where neither has it, the answer says why.
"""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Literal

import numpy as np
import numpy.typing as npt

from backend.core.channels import MISSING_INT16, Values
from backend.core.described import described
from backend.core.energy import MOTOR_TORQUE, MotorTorqueMeaning, motor_torque_meaning
from backend.core.moments import utc
from backend.core.ride import Ride, RideContext
from backend.device.readings import Fault
from backend.device.states import DeviceEvent
from backend.device.stream import StreamBlock
from backend.errors import NotFound
from backend.store import RideStore, Sought

RIDER_TORQUE = "rider_torque_nm"
TORQUES = (RIDER_TORQUE, MOTOR_TORQUE)
BEFORE_US = 2_000_000
AFTER_US = 1_000_000
# Ten minutes of the usual stream: long enough to walk to the screen. A row takes some 60 bytes.
STREAM_ROWS_MAX = 60_000
# A start of the unit that brought more rides than this is covered by the stream alone.
RIDES_MAX = 100
DECIMALS = 4
# Rows that are further apart tell no moment; also the share of the last second that may lack.
ROW_US_MAX = 50_000
# After a longer silence the stream begins anew: nothing is made up for minutes without a unit.
JOINED_GAP_US_MAX = 60_000_000


@described
class FaultMoment:
    """What the bike did from 2 s before a fault to 1 s after it, as it was recorded."""

    fault: str
    unit_t_us: int | None = None
    """When it came last, on the unit's clock."""
    occurred_at: datetime | None = None
    """The same as wall time, where samples tell it."""
    source: Literal["ride", "stream"] | None = None
    """What had the samples."""
    missing: Literal["no_frame", "not_recorded"] | None = None
    """Why there is no sample: it is unknown when the fault came, or nothing was recorded then; null
    where there are some."""
    ride_id: int | None = None
    ride_t_s: float | None = None
    """The fault's place in the ride."""
    motor_torque_meaning: MotorTorqueMeaning | None = None
    complete: bool = True
    """False while samples after the fault are still to come."""
    at_s: Sequence[float] = ()
    """Of each sample; the fault came at 0."""
    rider_torque_nm: Sequence[float | None] = ()
    """At the crank; null: no reading."""
    motor_torque_nm: Sequence[float | None] = ()
    """At the crank; null: no reading, or no gear ratio is known."""


@dataclass(frozen=True)
class Cut:
    """Rows around a moment. t_us: unit time of each. values: of its torques, missing as NaN.

    wall_us: Unix time less unit time. channels: names of all that was recorded.
    """

    t_us: npt.NDArray[np.int64]
    wall_us: int
    values: Mapping[str, Values]
    channels: tuple[str, ...]


class RecentRows:
    """The last minutes of every unit's live stream. `follow` is their watcher; for any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._blocks: dict[str, deque[StreamBlock]] = {}
        self._rows: dict[str, int] = {}

    def follow(self, device_id: str, event: DeviceEvent) -> None:
        """Keep what a unit sent; anything but rows is not for us."""
        if not isinstance(event, StreamBlock):
            return
        with self._lock:
            recent = self._blocks.setdefault(device_id, deque())
            if recent and not follows(recent[-1], event):
                recent.clear()
                self._rows[device_id] = 0
            recent.append(event)
            rows = self._rows.get(device_id, 0) + len(event.values)
            while rows > STREAM_ROWS_MAX:
                rows -= len(recent.popleft().values)
            self._rows[device_id] = rows

    def around(self, device_id: str, t_us: int) -> Cut | None:
        """The rows around a unit time, those that never came as missing; None without it."""
        with self._lock:
            blocks = [
                block
                for block in self._blocks.get(device_id, ())
                if end_us(block) >= t_us - BEFORE_US and block.t0_us <= t_us + AFTER_US
            ]
        if not blocks or not blocks[0].t0_us <= t_us <= end_us(blocks[-1]):
            return None
        first = blocks[0]
        row_count = 1 + row_at(first, end_us(blocks[-1]))
        times = first.t0_us + first.period_us * np.arange(row_count, dtype=np.int64)
        shown = (times >= t_us - BEFORE_US) & (times <= t_us + AFTER_US)
        values = {}
        for place, spec in enumerate(first.channels):
            if spec.name not in TORQUES:
                continue
            counts = np.full(row_count, MISSING_INT16, np.int16)
            for block in blocks:
                start = row_at(first, block.t0_us)
                counts[start : start + len(block.values)] = block.values[:, place]
            values[spec.name] = spec.to_values(counts[shown])
        names = tuple(spec.name for spec in first.channels)
        return Cut(times[shown], first.wall_us - end_us(first), values, names)


class FaultMoments:
    """What the bike did when a unit's faults came. For any thread.

    faults_of: a unit's faults with their frames. context_of: of a ride that would begin now.
    """

    def __init__(
        self,
        rides: RideStore,
        recent: RecentRows,
        faults_of: Callable[[str], Sequence[Fault]],
        context_of: Callable[[str], RideContext],
    ) -> None:
        self._rides = rides
        self._recent = recent
        self._faults_of = faults_of
        self._context_of = context_of

    def __call__(self, device_id: str, fault_name: str) -> FaultMoment:
        """Raises NotFound for a unit or a fault that is not there, NoAnswer, ObjectDamaged."""
        fault = next((one for one in self._faults_of(device_id) if one.name == fault_name), None)
        if fault is None:
            raise NotFound(f"{device_id} has no fault {fault_name}, and none is remembered.")
        if fault.frozen is None:
            return FaultMoment(fault_name, missing="no_frame")
        t_us, context = fault.frozen.t_us, self._context_of(device_id)
        ride = self._ride_at(context, t_us)
        if ride is not None:
            cut = self._cut(ride, t_us)
            result = moment(fault_name, t_us, cut, ride.context.gear_ratio, ride.state == "live")
            ride_t_s = (t_us - start_us(ride)) / 1e6
            return replace(result, source="ride", ride_id=ride.id, ride_t_s=ride_t_s)
        recent = self._recent.around(device_id, t_us)
        if recent is not None:
            result = moment(fault_name, t_us, recent, context.gear_ratio, goes_on=True)
            return replace(result, source="stream")
        return FaultMoment(fault_name, unit_t_us=t_us, missing="not_recorded")

    def _ride_at(self, now: RideContext, t_us: int) -> Ride | None:
        """The ride of the unit's present start that has a row at a unit time."""
        if now.unit_key is None or now.boot_id is None:
            return None
        for ride in self._rides.list(Sought(device=now.unit_key), RIDES_MAX).items:
            recorded, period_us = ride.context, ride.period_us
            if recorded.boot_id != now.boot_id or recorded.unit_t0_us is None or period_us is None:
                continue
            if 0 <= t_us - recorded.unit_t0_us < ride.row_count * period_us:
                return ride
        return None

    def _cut(self, ride: Ride, t_us: int) -> Cut:
        """The rows of a ride around a unit time."""
        reader = self._rides.reader(ride.id)
        period_us = ride.period_us or 1
        begin = max(0, (t_us - BEFORE_US - start_us(ride)) // period_us)
        end = min(reader.row_count, (t_us + AFTER_US - start_us(ride)) // period_us + 1)
        specs = [channel for channel in ride.channels if channel.name in TORQUES]
        counts = reader.counts([spec.name for spec in specs], begin, end)
        values = {spec.name: spec.to_values(counts[spec.name]) for spec in specs}
        times = start_us(ride) + reader.times_us(begin, end)
        names = tuple(channel.name for channel in ride.channels)
        return Cut(times, ride.started_us - start_us(ride), values, names)


def moment(fault: str, t_us: int, cut: Cut, gear_ratio: float | None, goes_on: bool) -> FaultMoment:
    """A cut as the answer has it. goes_on: rows are still to come."""
    rider = cut.values.get(RIDER_TORQUE)
    motor = cut.values.get(MOTOR_TORQUE)
    at_crank = None if motor is None or gear_ratio is None else motor * gear_ratio
    last_us = int(cut.t_us[-1]) if len(cut.t_us) else t_us
    return FaultMoment(
        fault,
        unit_t_us=t_us,
        occurred_at=utc(t_us + cut.wall_us),
        motor_torque_meaning=None if at_crank is None else motor_torque_meaning(cut.channels),
        complete=not goes_on or last_us >= t_us + AFTER_US - ROW_US_MAX,
        at_s=((cut.t_us - t_us) / 1e6).tolist(),
        rider_torque_nm=numbers_or_none(rider, len(cut.t_us)),
        motor_torque_nm=numbers_or_none(at_crank, len(cut.t_us)),
    )


def numbers_or_none(values: Values | None, count: int) -> list[float | None]:
    """Samples as numbers, None for each without a reading; count: how many there are."""
    if values is None:
        return [None] * count
    return [round(value, DECIMALS) if math.isfinite(value) else None for value in values.tolist()]


def follows(last: StreamBlock, block: StreamBlock) -> bool:
    """Whether a block goes on where another ended, rows lost between them or not."""
    same = (last.period_us, last.channels) == (block.period_us, block.channels)
    return same and block.t0_us > last.t0_us and block.t0_us - end_us(last) < JOINED_GAP_US_MAX


def end_us(block: StreamBlock) -> int:
    """Unit time of a block's last row."""
    return block.t0_us + (len(block.values) - 1) * block.period_us


def row_at(first: StreamBlock, t_us: int) -> int:
    """Number of the row at a unit time, counted from a block's first."""
    return round((t_us - first.t0_us) / first.period_us)


def start_us(ride: Ride) -> int:
    """Unit time of a ride's first row; of rides that carry it only."""
    assert ride.context.unit_t0_us is not None
    return ride.context.unit_t0_us
