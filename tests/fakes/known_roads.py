"""Roads whose every metre is known, and riders who answer another speed in a known way.

The truth for whoever predicts a ride: the same road and the same rider, really ridden by the
simulated bike with another mode or table.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from sim_device.firmware.python import law
from sim_device.lockstep import LockstepUnit

STEP_S = 0.01
CADENCE_RPM_MAX = 110.0
CRAWLING_RPM = 14.0
"""Some 1.5 m/s in the one gear. Below it nobody minds his power."""
GIVEN_UP_S = 400.0
SEEN = {
    "speed_kmh": "speed_kmh",
    "cadence_rpm": "cadence_rpm",
    "assist_mode": "assist_mode",
    "motor_torque_nm": "motor_torque_nm",
    "motor_speed_rpm": "motor_speed_rpm",
    "battery_voltage_v": "battery_voltage_v",
    "battery_current_a": "battery_current_a",
    "motor_temperature_degc": "motor_temperature_degc",
    "controller_temperature_degc": "controller_temperature_degc",
    "rider_torque_raw": "torque_raw_counts",
    "distance_m": "distance_m",
}
"""Channel of a ride -> what an observer beside the bike sees."""

Columns = dict[str, npt.NDArray[np.float64]]


@dataclass(frozen=True)
class Stretch:
    """A piece of road: its length, slope and wind, and the push of its rider; or a stop."""

    metres: float = 0.0
    grade_deg: float = 0.0
    wind_ms: float = 0.0
    torque_nm: float = 0.0
    stand_s: float = 0.0


@dataclass(frozen=True)
class Outside:
    """What a ride does not tell of the bike."""

    mass_kg: float = 92.0
    drag_area_m2: float = 0.5
    cogs: tuple[int, ...] = ()
    """Teeth of a cassette that the rider shifts to his cadence; without one there is one gear."""


def road(seed: int, stretches: int = 12) -> list[Stretch]:
    """Two kilometres of slopes, gusts and traffic lights. Whoever starts pushes hard."""
    random = np.random.default_rng(seed)
    found: list[Stretch] = []
    starts = True
    for _ in range(stretches):
        found.append(
            Stretch(
                metres=random.uniform(60.0, 240.0),
                grade_deg=0.0 if starts else float(np.clip(random.normal(0.0, 1.2), -2.5, 2.2)),
                wind_ms=random.normal(0.0, 1.0),
                torque_nm=random.uniform(34.0, 46.0) if starts else random.uniform(26.0, 42.0),
            )
        )
        starts = bool(random.random() < 0.2)
        if starts:
            found.append(Stretch(stand_s=random.uniform(4.0, 12.0)))
    return found


class Ridden:
    """One ride over a road, sample by sample. before: the ride whose rider this is, for one who
    answers another speed."""

    def __init__(
        self,
        stretches: list[Stretch],
        mode: int,
        *,
        rider: str = "torque",
        before: Columns | None = None,
        outside: Outside | None = None,
        overrides: dict[str, Any] | None = None,
        seed: int = 1,
    ) -> None:
        given = outside or Outside()
        bike = {"road.mass_kg": given.mass_kg, "road.drag_area_m2": given.drag_area_m2}
        bike |= {f"gears.cog_teeth_{n + 1}": float(teeth) for n, teeth in enumerate(given.cogs)}
        self._unit = LockstepUnit(seed, overrides, bike={**bike, "sensor.noise_nm": 0.06})
        self._unit.select_mode(mode)
        self._rider = rider
        self._before = before
        self._rows: list[list[float]] = []
        for stretch in stretches:
            if stretch.stand_s > 0.0:
                self._stop(stretch.stand_s)
            else:
                self._ride(stretch)

    @property
    def columns(self) -> Columns:
        """A column for each channel of SEEN, and `brake`, (n,)."""
        rows = np.array(self._rows)
        return {name: rows[:, at] for at, name in enumerate((*SEEN, "brake"))}

    def _tick(self, brake: bool) -> dict[str, Any]:
        self._unit.advance(STEP_S)
        seen = self._unit.observe()
        self._rows.append([float(seen[name]) for name in SEEN.values()] + [float(brake)])
        return seen

    def _stop(self, stand_s: float) -> None:
        self._unit.rider("off")
        self._unit.brake(True)
        while self._tick(True)["speed_kmh"] > 0.01:
            pass
        for _ in range(round(stand_s / STEP_S)):
            self._tick(True)
        self._unit.brake(False)

    def _ride(self, stretch: Stretch) -> None:
        self._unit.road(stretch.grade_deg, stretch.wind_ms)
        self._unit.rider("legs", stretch.torque_nm, CADENCE_RPM_MAX)
        end_m = self._unit.observe()["distance_m"] + stretch.metres
        for step in range(round(GIVEN_UP_S / STEP_S)):
            seen = self._tick(False)
            if seen["distance_m"] >= end_m:
                return
            if self._rider != "torque" and step % 5 == 0:
                torque_nm = stretch.torque_nm * self._share(seen)
                self._unit.rider("legs", torque_nm, CADENCE_RPM_MAX)
        raise AssertionError("the bike does not get to the end of this road; choose another seed")

    def _share(self, seen: dict[str, Any]) -> float:
        """Of the push, by a rider held to the power or to the speed of the ride before, or half to
        its torque and half to its speed."""
        if self._rider == "power":
            before_rpm = self._before_at(seen["distance_m"], "cadence_rpm")
            share = max(before_rpm, CRAWLING_RPM) / max(seen["cadence_rpm"], CRAWLING_RPM)
            return float(np.clip(share, 0.4, 2.5))
        speed_ms = max(seen["speed_kmh"] / 3.6, 1.5)
        before_ms = max(self._before_at(seen["distance_m"], "speed_kmh") / 3.6, 1.5)
        holds_speed = float(np.clip(1.0 + 2.0 * (before_ms - speed_ms), 0.0, 2.5))
        return 0.5 + 0.5 * holds_speed if self._rider == "half" else holds_speed

    def _before_at(self, distance_m: float, channel: str) -> float:
        assert self._before is not None
        return float(np.interp(distance_m, self._before["distance_m"], self._before[channel]))


def configuration(overrides: dict[str, Any] | None = None) -> dict[str, Any]:
    """What the unit of these rides is set to."""
    return {**law.law_defaults(), **(overrides or {})}
