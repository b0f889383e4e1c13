"""A workshop that hangs masses on the pedals of the simulated torque sensor (its C physics).

The sensor is drawn from a seed, and so are the errors of arm, masses, gravity and level within what
the setup states. Whoever calibrates is told the setup and the counts, and none of this.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from sim_device.firmware.python._native import ffi, lib

from backend.calibration.capture import Capture, State, capture_of
from backend.calibration.setup import Mass, Setup, gravity_at
from backend.calibration.steady import Window, steadiness

SAMPLES, WINDOW_S, SETTLE_S, TRIES = 100, 3.0, 5.0, 3
LOADS_KG = (12.0, 24.0, 36.0, 48.0, 60.0)
VERIFY_KG = 42.0
OPEN_HIGH, STUCK = 2, 1

SETUP = Setup(
    arm_m=0.170,
    arm_limit_m=0.0003,
    gravity=gravity_at(47.4, 408.0),
    masses=(Mass("discs", 12.0, "M3"),),
    loads_kg=LOADS_KG,
    full_scale_nm=100.0,
    gain_nm_per_count=0.01,
    strokes=2,
    level_limit_deg=2.0,
)


@dataclass(frozen=True)
class Specimen:
    """A state of the sensor. sensor: of the C configuration. scatter_nm: from one hanging to the
    next. left_gain: of the left pedal, times that of the right. degc: of each stroke in turn."""

    sensor: dict[str, float]
    scatter_nm: float = 0.02
    left_gain: float = 1.0
    fault: int = 0
    degc: tuple[float, ...] = (20.0, 20.0)
    angles_deg: tuple[float, ...] = (0.0,)


OBEYS = {
    # Thesis tables 3-1 and 5-1 as thesis_checks 3 reads them.
    "table3_1": Specimen({"gain": 1.00419, "zero_counts": 8, "noise_nm": 0.06}, 0.223),
    "table5_1": Specimen({"noise_nm": 0.10}, 0.003),
    "drifted": Specimen(
        {
            "gain": 0.962,
            "zero_counts": 140,
            "noise_nm": 0.06,
            "hysteresis_nm": 0.1,
            "zero_nm_per_k": 0.02,
            "span_share_per_k": 2e-4,
        },
        0.05,
        degc=(12.0, 32.0),
    ),
}
DISOBEYS = {
    "open_arm": Specimen({"noise_nm": 0.06}, fault=OPEN_HIGH),
    "stuck": Specimen({"noise_nm": 0.06}, fault=STUCK),
    "sticky": Specimen({"noise_nm": 0.06, "hysteresis_nm": 1.5, "creep_share": 0.02}),
    "bent": Specimen(
        {"noise_nm": 0.06, "bending_share": 0.06, "bending_lever_m": 0.1, "bending_deg": 45.0},
        angles_deg=(0.0, 40.0),
    ),
    "asymmetric": Specimen({"noise_nm": 0.06}, left_gain=0.97),
}


@dataclass
class Workshop:
    """One calibration of one specimen. refused: why captures were not taken, by code."""

    specimen: Specimen
    seed: int
    refused: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._random = random.Random(self.seed)
        bike = ffi.new("physics_config *")
        lib.physics_default(bike)
        self.config: Any = ffi.new("torque_sensor_config *", bike.sensor)
        for name, value in self.specimen.sensor.items():
            setattr(self.config, name, value)
        self._gain = self.config.gain
        self.state: Any = ffi.new("torque_sensor_state *")
        self.soak(self.specimen.degc[0])
        self.state.random = self.seed
        limit = SETUP.masses[0].limit_share
        self._mass_share = 1 + self._random.uniform(-limit, limit)
        self._arm_m = SETUP.arm_m + self._random.uniform(-1, 1) * SETUP.arm_limit_m
        self._gravity_ms2 = self._random.gauss(
            SETUP.gravity.gravity_ms2, SETUP.gravity.standard_ms2
        )
        self._tilt_deg = self._random.uniform(-1, 1) * SETUP.level_limit_deg

    def captures(self) -> list[Capture]:
        """Strokes up and down again on either pedal, then a mass that was not among them."""
        found: list[Capture] = []
        for state in self._plan():
            taken = self._capture(len(found) + 1, state)
            if taken is not None:
                found.append(taken)
        return found

    def true_counts(self, loads_nm: np.ndarray) -> np.ndarray:
        """Without noise and scatter, at the temperature now: up and down (2, k)."""
        noise, self.config.noise_nm = self.config.noise_nm, 0.0
        self.state.hung_nm = 0.0
        up = [self._counts(load, 0.0) for load in loads_nm]
        down = [self._counts(load, 0.0) for load in loads_nm[::-1]][::-1]
        self.config.noise_nm = noise
        return np.array([up, down], np.float64)

    def _plan(self) -> Iterator[State]:
        for stroke, degc in enumerate(self.specimen.degc, 1):
            self.soak(degc)
            for side in SETUP.sides:
                for angle in self.specimen.angles_deg:
                    common = {"side": side, "stroke": stroke, "sensor_degc": degc}
                    yield State("zero", direction="loading", **common)
                    for direction, loads in (("loading", LOADS_KG), ("unloading", LOADS_KG[::-1])):
                        for kg in loads:
                            yield State("load", mass_kg=kg, direction=direction,
                                        crank_angle_deg=angle, **common)  # fmt: skip
                    yield State("zero", direction="unloading", **common)
        yield State("verify", "right", VERIFY_KG, sensor_degc=self.specimen.degc[-1])

    def _capture(self, number: int, state: State) -> Capture | None:
        """Waits, and tries again; None where it never was steady."""
        load_nm = self._hung_nm(state)
        # Of the spindle: 0 has the left crank up (hung_mass.h).
        level = 0.5 * math.pi if state.side == "left" else 1.5 * math.pi
        angle = level + math.radians(state.crank_angle_deg + self._tilt_deg)
        self.state.hung_nm = self._pull_n(state) * self.config.bending_lever_m
        self.config.gain = self._gain * (self.specimen.left_gain if state.side == "left" else 1.0)
        for _ in range(TRIES):
            self._counts(load_nm, angle, SETTLE_S)
            pause_s = WINDOW_S / SAMPLES
            raw = [self._counts(load_nm, angle, pause_s) for _ in range(SAMPLES)]
            seen = steadiness(Window(raw, WINDOW_S), SETUP)
            assert seen is not None
            if seen.steady:
                return capture_of(number, state, raw, WINDOW_S, number)
        self.refused.extend(reason.code for reason in seen.reasons)
        return None

    def _hung_nm(self, state: State) -> float:
        if state.kind == "zero":
            return 0.0
        angle_deg = state.crank_angle_deg + self._tilt_deg
        hung_nm = self._pull_n(state) * self._arm_m * math.cos(math.radians(angle_deg))
        return hung_nm + self._random.gauss(0.0, self.specimen.scatter_nm)

    def _pull_n(self, state: State) -> float:
        return state.mass_kg * self._mass_share * self._gravity_ms2

    def soak(self, degc: float) -> None:
        """Soaked through: gauges and thermometer at the temperature of the air."""
        self.config.ambient_degc = self.state.board_degc = self.state.gauge_degc = degc

    def _counts(self, load_nm: float, angle_rad: float, dt_s: float = 0.002) -> int:
        fault = self.specimen.fault
        return int(lib.torque_sensor_read(self.config, self.state, load_nm, angle_rad, fault, dt_s))
