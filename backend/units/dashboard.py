"""What a rider wants to know now: speed, acceleration, own power, distance, battery, range.

Made from the rows of the live stream and nothing else; a unit that starts anew starts its account
anew. Strokes make torque and speed ripple, so power and acceleration are those of the last second.
Missing is None, never zero, and time whose rows were lost is left out of the distance and counted.
"""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from backend.core.described import described
from backend.core.energy import (
    DELIVERED,
    KMH_PER_MS,
    MOTOR_TORQUE,
    MOTOR_TORQUE_DEMANDED,
    RADIANS_PER_S_PER_RPM,
    motor_torque_meaning,
)
from backend.device.gathering import Gathering
from backend.device.states import DeviceEvent
from backend.device.stream import StreamBlock
from backend.errors import NotFound

US_PER_S = 1e6
MS_PER_KMH = 1.0 / KMH_PER_MS
WINDOW_S = 1.0
# Before this much is used and ridden, battery per kilometre is a guess: state of charge has steps.
RANGE_SOC_PCT_MIN = 0.5
RANGE_KM_MIN = 0.5
# Charged, or another battery: more than rounding and the recovery of a rested cell.
SOC_RISE_PCT = 3.0

CHANNELS = (
    "speed_kmh",
    "rider_torque_nm",
    "cadence_rpm",
    MOTOR_TORQUE,
    MOTOR_TORQUE_DEMANDED,
    "motor_speed_rpm",
    "battery_soc_pct",
    "battery_voltage_v",
)

Column = npt.NDArray[np.float64]


@described
class Dashboard:
    """What the rider sees. Rider power and motor power are two things; missing is null."""

    t_us: int | None
    """Unit time of the last row."""
    speed_kmh: float | None
    acceleration_ms2: float | None
    """Over the last second."""
    rider_power_w: float | None
    """The rider's own, over the last second."""
    motor_power_w: float | None
    """Mechanical, at the motor's shaft; null from a unit that reports only what it demands of its
    motor."""
    battery_soc_pct: float | None
    battery_voltage_v: float | None
    distance_km: float
    """Since the unit's start or the last charge."""
    missing_s: float
    """Time since then whose rows never came."""
    range_km: float | None
    """At the consumption since then; null until half a kilometre and half a percent."""


@dataclass(frozen=True)
class _Moment:
    """Means over a few rows; t_s: their middle."""

    t_s: float
    rows: int
    speed_ms: float
    rider_power_w: float
    motor_power_w: float


class DashboardAccount:
    """Adds up one unit's rows. Fed and read by whoever owns it, under its own lock."""

    def __init__(self) -> None:
        self._recent: deque[_Moment] = deque()
        self._t_us: int | None = None
        self._latest: dict[str, float | None] = {}
        self._distance_m = 0.0
        self._missing_s = 0.0
        self._soc_at_start_pct: float | None = None

    @property
    def t_us(self) -> int | None:
        """Unit time of the last row, None before the first."""
        return self._t_us

    def take(
        self, t0_us: int, period_us: int, columns: Mapping[str, Column], lost_rows: int = 0
    ) -> None:
        """Add rows. columns: of CHANNELS, those that are streamed, (n,) each with NaN for missing.

        t0_us: unit time of the first row. lost_rows: rows that never came between the last call's
        and these.
        """
        period_s = period_us / US_PER_S
        self._missing_s += lost_rows * period_s
        speed_kmh = columns.get("speed_kmh")
        if speed_kmh is not None:
            valid = np.isfinite(speed_kmh)
            self._missing_s += float(np.count_nonzero(~valid)) * period_s
            self._distance_m += float(speed_kmh[valid].sum()) * MS_PER_KMH * period_s
        rows = max((len(column) for column in columns.values()), default=0)
        if rows == 0:
            return
        self._t_us = t0_us + (rows - 1) * period_us
        self._latest = {name: _last(column) for name, column in columns.items()}
        self._note_charge(self._latest.get("battery_soc_pct"))
        self._remember((t0_us + self._t_us) / 2 / US_PER_S, rows, columns)

    def now(self) -> Dashboard:
        """The values as of the last row."""
        soc_pct = self._latest.get("battery_soc_pct")
        return Dashboard(
            t_us=self._t_us,
            speed_kmh=self._latest.get("speed_kmh"),
            acceleration_ms2=self._acceleration_ms2(),
            rider_power_w=_mean([(one.rider_power_w, one.rows) for one in self._recent]),
            motor_power_w=_mean([(one.motor_power_w, one.rows) for one in self._recent]),
            battery_soc_pct=soc_pct,
            battery_voltage_v=self._latest.get("battery_voltage_v"),
            distance_km=self._distance_m / 1000.0,
            missing_s=self._missing_s,
            range_km=self._range_km(soc_pct),
        )

    def _remember(self, t_s: float, rows: int, columns: Mapping[str, Column]) -> None:
        moment = _Moment(
            t_s=t_s,
            rows=rows,
            speed_ms=_mean_of(columns.get("speed_kmh")) * MS_PER_KMH,
            rider_power_w=_power_w(columns, "rider_torque_nm", "cadence_rpm"),
            motor_power_w=(
                _power_w(columns, MOTOR_TORQUE, "motor_speed_rpm")
                if motor_torque_meaning(columns) == DELIVERED
                else math.nan
            ),
        )
        self._recent.append(moment)
        while self._recent[0].t_s < moment.t_s - WINDOW_S:
            self._recent.popleft()

    def _note_charge(self, soc_pct: float | None) -> None:
        if soc_pct is None:
            return
        start_pct = self._soc_at_start_pct
        if start_pct is None:
            self._soc_at_start_pct = soc_pct
        elif soc_pct > start_pct + SOC_RISE_PCT:
            self._soc_at_start_pct = soc_pct
            self._distance_m = self._missing_s = 0.0

    def _acceleration_ms2(self) -> float | None:
        """The slope of speed over the last second, by least squares."""
        moments = [(m.t_s, m.speed_ms) for m in self._recent if math.isfinite(m.speed_ms)]
        if len(moments) < 2 or moments[-1][0] - moments[0][0] < WINDOW_S / 2:
            return None
        t_s, speed_ms = np.array(moments).T
        t_s = t_s - t_s.mean()
        return float((t_s * speed_ms).sum() / (t_s * t_s).sum())

    def _range_km(self, soc_pct: float | None) -> float | None:
        if soc_pct is None or self._soc_at_start_pct is None:
            return None
        used_pct = self._soc_at_start_pct - soc_pct
        ridden_km = self._distance_m / 1000.0
        if used_pct < RANGE_SOC_PCT_MIN or ridden_km < RANGE_KM_MIN:
            return None
        return soc_pct * ridden_km / used_pct


def _last(column: Column) -> float | None:
    value = float(column[-1]) if len(column) else math.nan
    return value if math.isfinite(value) else None


def _mean_of(column: Column | None) -> float:
    if column is None or not len(column):
        return math.nan
    return float(column.mean())


def _power_w(columns: Mapping[str, Column], torque_nm: str, speed_rpm: str) -> float:
    torque, speed = columns.get(torque_nm), columns.get(speed_rpm)
    if torque is None or speed is None:
        return math.nan
    return float((torque * speed).mean()) * RADIANS_PER_S_PER_RPM


def _mean(values: list[tuple[float, int]]) -> float | None:
    """Of means over so many rows; None where none of them is a number."""
    numbers = [(value, rows) for value, rows in values if math.isfinite(value)]
    rows = sum(rows for _, rows in numbers)
    return sum(value * rows for value, rows in numbers) / rows if rows else None


@dataclass
class _Account:
    """One unit's account and the number of rows its subscription has brought."""

    account: DashboardAccount = field(default_factory=DashboardAccount)
    epoch: int | None = None
    gathering: Gathering = field(default_factory=Gathering)

    def take(self, block: StreamBlock) -> None:
        if self.account.t_us is not None and block.t0_us < self.account.t_us:
            self.account, self.epoch = DashboardAccount(), None
        lost_rows = block.lost_rows_before if self.epoch == block.epoch else 0
        self.epoch = block.epoch
        self.account.take(block.t0_us, block.period_us, _columns(block), lost_rows)


class Dashboards:
    """Follows all units; `follow` is their watcher."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._accounts: dict[str, _Account] = {}

    def follow(self, device_id: str, event: DeviceEvent) -> None:
        """Take what a unit sent; anything but rows is not for us."""
        if not isinstance(event, StreamBlock):
            return
        with self._lock:
            account = self._accounts.setdefault(device_id, _Account())
            for block in account.gathering.add(event):
                account.take(block)

    def get(self, device_id: str) -> Dashboard:
        """The values of a unit as of its last row. Raises NotFound before the first."""
        with self._lock:
            if device_id not in self._accounts:
                raise NotFound(f"{device_id} has sent no row yet, or there is no such unit.")
            account = self._accounts[device_id]
            for block in account.gathering.take():
                account.take(block)
            return account.account.now()


def _columns(block: StreamBlock) -> dict[str, Column]:
    return {
        spec.name: spec.to_values(block.values[:, number])
        for number, spec in enumerate(block.channels)
        if spec.name in CHANNELS
    }
