"""A capture: raw counts of the torque sensor, taken while a known load hung still."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from backend.calibration.plain import Plain, from_plain
from backend.calibration.setup import Angle, Setup, Side, torque_nm
from backend.core.statistics import MAD_TO_DEVIATION
from backend.errors import FieldError

Kind = Literal["zero", "load", "verify"]
Direction = Literal["loading", "unloading"]

OUTLIER_DEVIATIONS = 6.0
"""From the median, in deviations estimated from the median of distances: one word in half a
billion if the noise is normal; a damaged word that its checksum let pass is much further away."""


@dataclass(frozen=True, slots=True)
class State(Plain):
    """What was known while the counts were taken.

    side, direction: None at zero where they make no difference. mass_kg: all that hangs on the
    pedal. arm_m: None is the setup's. sensor_degc: None where the unit does not tell it.
    """

    kind: Kind
    side: Side | None = None
    mass_kg: Annotated[float, Field(ge=0, le=200)] = 0.0
    arm_m: Annotated[float, Field(ge=0.05, le=1.0)] | None = None
    crank_angle_deg: Angle = 0.0
    stroke: Annotated[int, Field(ge=1, le=100)] = 1
    direction: Direction | None = None
    sensor_degc: Annotated[float, Field(ge=-60, le=150)] | None = None

    def load_nm(self, setup: Setup) -> float:
        """At the spindle; 0 at zero."""
        arm_m = setup.arm_m if self.arm_m is None else self.arm_m
        return torque_nm(self.mass_kg, setup.gravity.gravity_ms2, arm_m, self.crank_angle_deg)


@dataclass(frozen=True, slots=True)
class Capture(Plain):
    """One reading.

    number: of the capture in its calibration, never used again. raw_counts: all samples of the
    steady window. rejected: indices of those left out as outliers. mean_counts,
    deviation_counts: of the `count` samples that are left.
    """

    number: Annotated[int, Field(ge=1)]
    state: State
    raw_counts: Annotated[
        tuple[Annotated[int, Field(ge=-(2**31), lt=2**31)], ...],
        Field(min_length=2, max_length=100_000),
    ]
    rejected: tuple[Annotated[int, Field(ge=0)], ...]
    count: Annotated[int, Field(ge=2)]
    mean_counts: float
    deviation_counts: Annotated[float, Field(ge=0)]
    duration_s: Annotated[float, Field(gt=0, le=3600)]
    at_utc_us: Annotated[int, Field(ge=0)]


def capture_of(
    number: int, state: State, raw_counts: Sequence[int], duration_s: float, at_utc_us: int
) -> Capture:
    """A capture of raw counts (n,), with the figures of those that are no outliers."""
    raw = np.asarray(raw_counts, np.int64)
    out = outliers(raw)
    remaining = np.delete(raw, out).astype(np.float64)
    return Capture(
        number=number,
        state=state,
        raw_counts=tuple(int(value) for value in raw),
        rejected=tuple(int(index) for index in out),
        count=remaining.size,
        mean_counts=float(remaining.mean()),
        deviation_counts=float(remaining.std(ddof=1)),
        duration_s=duration_s,
        at_utc_us=at_utc_us,
    )


def outliers(raw_counts: Sequence[int] | np.ndarray) -> np.ndarray:
    """Indices of samples far beyond the noise. A step of one count is never one."""
    raw = np.asarray(raw_counts, np.float64)
    away = np.abs(raw - np.median(raw))
    deviation = max(1.0, MAD_TO_DEVIATION * float(np.median(away)))
    indices: np.ndarray = np.flatnonzero(away > OUTLIER_DEVIATIONS * deviation)
    return indices


def state_of(body: Any) -> State:
    """From plain JSON. Raises InvalidRequest naming every field at fault."""
    return from_plain(State, body, faults_of_state)


def captured_of(body: Any) -> Capture:
    """From plain JSON. Raises InvalidRequest naming every field at fault."""
    return from_plain(Capture, body, faults_of_capture)


def faults_of_state(state: State, prefix: str = "") -> list[FieldError]:
    """What no single field shows."""
    faults = []
    if state.kind == "zero" and state.mass_kg != 0.0:
        faults.append(_fault(prefix, "mass_kg", "not_zero", "nothing hangs at a zero"))
    if state.kind != "zero":
        if state.mass_kg <= 0.0:
            faults.append(_fault(prefix, "mass_kg", "missing", "a load needs its mass"))
        if state.side is None:
            faults.append(_fault(prefix, "side", "missing", "a load hangs left or right"))
    if state.kind == "load" and state.direction is None:
        faults.append(_fault(prefix, "direction", "missing", "loading or unloading"))
    return faults


def faults_of_capture(capture: Capture) -> list[FieldError]:
    """What no single field shows; whether the figures are those of the counts is for evaluate."""
    faults = faults_of_state(capture.state, "state.")
    if any(index >= len(capture.raw_counts) for index in capture.rejected):
        faults.append(_fault("", "rejected", "out_of_range", "names a sample that is not there"))
    if len(set(capture.rejected)) != len(capture.rejected):
        faults.append(_fault("", "rejected", "named_twice", "a sample is named twice"))
    if capture.count != len(capture.raw_counts) - len(set(capture.rejected)):
        faults.append(_fault("", "count", "wrong", "not the number of samples that are left"))
    return faults


def _fault(prefix: str, name: str, code: str, message: str) -> FieldError:
    field = f"{prefix}{name}"
    return FieldError(field, code, f"{field}: {message}")
