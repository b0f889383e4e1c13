"""The last seconds of every unit's torque sensor, kept as its stream brings them."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.device.states import CONNECTED, DeviceEvent, StateChanged
from backend.device.stream import StreamBlock

RAW, TORQUE, SENSOR_DEGC = "rider_torque_raw", "rider_torque_nm", "sensor_temperature_degc"
STATES = ("speed_kmh", "cadence_rpm", "motor_speed_rpm", "battery_voltage_v", "crank_angle_deg")
CHANNELS = (RAW, TORQUE, SENSOR_DEGC, *STATES)
RETAINED_US = 10_000_000
TRAIL_S = 60
"""How far back the sensor's temperature is known: warming is judged over a minute."""

SILENT_S = 2.0
"""A block comes several times a second; after this the last seconds are not now any more."""


@dataclass(frozen=True)
class Recent:
    """A unit's last rows without a gap among them.

    t_us: unit time (n,). values: of CHANNELS (n,), missing as NaN; a channel that the unit does
    not send is absent. warming_k: of the sensor over the last minute; None where that is not known.
    """

    t_us: npt.NDArray[np.int64]
    period_us: int
    values: dict[str, Values]
    warming_k: float | None

    def since(self, t_us: int) -> Recent:
        """Its rows after a unit time."""
        return self._cut(self.t_us > t_us)

    def last(self, seconds: float) -> Recent:
        """Its rows of the last seconds, whole periods counted."""
        rows = round(seconds * 1e6 / self.period_us)
        return self._cut(np.arange(self.t_us.size) >= self.t_us.size - rows)

    def before(self, seconds: float) -> Recent:
        """Without the last seconds."""
        rows = round(seconds * 1e6 / self.period_us)
        return self._cut(np.arange(self.t_us.size) < self.t_us.size - rows)

    @property
    def duration_s(self) -> float:
        """Time that the rows stand for."""
        return float(self.t_us.size * self.period_us / 1e6)

    def newest(self, name: str) -> float | None:
        """The last value of a channel that is one; None where there is none."""
        values = self.finite(name)
        return float(values[-1]) if values.size else None

    def mean(self, name: str) -> float | None:
        """Mean of a channel's values; None where there is none."""
        values = self.finite(name)
        return float(values.mean()) if values.size else None

    def finite(self, name: str) -> Values:
        """The values of a channel, missing ones left out."""
        values = self.values.get(name, np.empty(0))
        finite_values: Values = values[np.isfinite(values)]
        return finite_values

    def _cut(self, shown: npt.NDArray[np.bool_]) -> Recent:
        values = {name: column[shown] for name, column in self.values.items()}
        return Recent(self.t_us[shown], self.period_us, values, self.warming_k)


@dataclass
class _Retained:
    blocks: deque[StreamBlock] = field(default_factory=deque)
    received_s: float = 0.0
    # Unit second and the sensor's temperature then.
    trail: deque[tuple[int, float]] = field(default_factory=deque)


class RecentReadings:
    """Follows all units; `follow` is their watcher. For any thread. now_s: any steady clock."""

    def __init__(self, now_s: Callable[[], float] = time.monotonic) -> None:
        self._now_s = now_s
        self._lock = threading.Lock()
        self._retained: dict[str, _Retained] = {}

    def follow(self, device_id: str, event: DeviceEvent) -> None:
        """Retain what a unit sent; after a disconnection the next unit may be another one."""
        if isinstance(event, StateChanged) and event.state not in CONNECTED:
            with self._lock:
                self._retained.pop(device_id, None)
        if not isinstance(event, StreamBlock) or not len(event.values):
            return
        with self._lock:
            retained = self._retained.setdefault(device_id, _Retained())
            last = retained.blocks[-1] if retained.blocks else None
            if last is not None and event.t0_us <= last.t0_us:
                retained.trail.clear()
            if last is not None and not continues(last, event):
                retained.blocks.clear()
            retained.blocks.append(event)
            retained.received_s = self._now_s()
            begin_us = end_us(event) - RETAINED_US
            while end_us(retained.blocks[0]) <= begin_us:
                retained.blocks.popleft()
            note_temperature(retained.trail, event)

    def of(self, device_id: str) -> Recent | None:
        """The last seconds; None where the unit is silent or sends no raw counts."""
        with self._lock:
            retained = self._retained.get(device_id)
            if retained is None or self._now_s() - retained.received_s > SILENT_S:
                return None
            blocks, trail = list(retained.blocks), list(retained.trail)
        specs = {spec.name: place for place, spec in enumerate(blocks[0].channels)}
        if RAW not in specs:
            return None
        counts = np.concatenate([block.values for block in blocks])
        period_us = blocks[0].period_us
        return Recent(
            blocks[0].t0_us + period_us * np.arange(len(counts), dtype=np.int64),
            period_us,
            {
                name: blocks[0].channels[specs[name]].to_values(counts[:, specs[name]])
                for name in CHANNELS
                if name in specs
            },
            warming_k(trail),
        )


def note_temperature(trail: deque[tuple[int, float]], block: StreamBlock) -> None:
    """Keep one temperature a second, for a minute and the second before it."""
    second = end_us(block) // 1_000_000
    if trail and trail[-1][0] == second:
        return
    for place, spec in enumerate(block.channels):
        if spec.name == SENSOR_DEGC:
            degc = float(spec.to_values(block.values[-1:, place])[0])
            if np.isfinite(degc):
                trail.append((second, degc))
    while trail and trail[0][0] < second - TRAIL_S:
        trail.popleft()


def warming_k(trail: list[tuple[int, float]]) -> float | None:
    """Over the last minute; None before there was one."""
    if not trail or trail[-1][0] - trail[0][0] < TRAIL_S - 1:
        return None
    return trail[-1][1] - trail[0][1]


def continues(last: StreamBlock, block: StreamBlock) -> bool:
    """Whether a block goes on where another ended, no row lost between them."""
    same = (last.period_us, last.channels) == (block.period_us, block.channels)
    spacing_us = block.t0_us - end_us(last) - block.period_us
    return same and 2 * abs(spacing_us) < block.period_us


def end_us(block: StreamBlock) -> int:
    """Unit time of a block's last row."""
    return block.t0_us + (len(block.values) - 1) * block.period_us
