"""The torque gain from an energy balance: coast-downs tell what road and air take, a steady climb
of known mass tells what the legs gave. No mass hangs on a pedal for it, so it is a check that
shares nothing with the calibration.

    eta integral(T omega dt) = m g rise + M (v1^2 - v0^2) / 2 + f0 d + f2 integral(v^3 dt)

with M the mass and what the wheels' inertia adds, f0 and f2 rolling and air of the coast-downs
(thesis eq. 4.1 to 4.3). The motor is off in both.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from backend.domain.calibration.bike.wheel import ROOT_3
from backend.domain.calibration.coefficients import Numbers
from backend.domain.calibration.judgement.verification import en_number
from backend.domain.calibration.plain import Plain
from backend.errors import FieldError, InvalidRequest

MOTOR_MOST_W = 1.0
"""More, and the motor helped: its share cannot be told from the legs' this way."""

CLIMB_LEAST_J = 3000.0
"""A hundred kilograms up three metres: less is a bump, and its height is not known to a percent."""

RPM_TO_RAD_S = 2 * math.pi / 60


class Run(NamedTuple):
    """A coast-down. time_s, speed_ms: (n,), n >= 10. rise_m: from its begin to its end."""

    time_s: Sequence[float]
    speed_ms: Sequence[float]
    rise_m: float = 0.0


class Climb(NamedTuple):
    """A climb on the legs alone. Each (n,). motor_w: None where the unit tells none."""

    time_s: Sequence[float]
    speed_ms: Sequence[float]
    torque_nm: Sequence[float]
    cadence_rpm: Sequence[float]
    rise_m: float
    motor_w: Sequence[float] | None = None


@dataclass(frozen=True, slots=True)
class Known(Plain):
    """What is known besides, and how well: each `_limit` is a half width. wheels_kg: what the
    wheels' inertia adds to the mass. efficiency: from crank to road. speed_share: of the wheel's
    circumference. wind_limit_ms: along the climb, beyond that of the coast-downs."""

    mass_kg: float
    mass_limit_kg: float
    gravity_ms2: float
    rise_limit_m: float
    efficiency: float = 0.97
    efficiency_limit: float = 0.015
    wheels_kg: float = 2.2
    wheels_limit_kg: float = 0.5
    speed_share_limit: float = 0.005
    wind_limit_ms: float = 0.5


@dataclass(frozen=True, slots=True)
class Resistance(Plain):
    """rolling_n: at any speed. air_ns2_m2: times the square of the speed. covariance: of the two,
    from the scatter of the runs about the model."""

    rolling_n: float
    air_ns2_m2: float
    covariance: tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Balance(Plain):
    """gain_ratio: true torque over told torque. contributions: standard, of the ratio. expanded:
    k = 2. en: the distance from 1 in both uncertainties. agrees: it is 1 or less."""

    gain_ratio: float
    crank_energy_j: float
    needed_energy_j: float
    contributions: dict[str, float]
    expanded: float
    en: float
    agrees: bool
    sentence: str


class _Inputs(NamedTuple):
    mass_kg: float
    wheels_kg: float
    rise_m: float
    efficiency: float
    speed_share: float
    wind_ms: float
    rolling_n: float
    air_ns2_m2: float


def resistance(runs: Sequence[Run], known: Known) -> Resistance:
    """Rolling and air from coast-downs, at best the same stretch both ways.

    The momentum lost since each run's begin is f0 t + f2 integral(v^2 dt), less the slope's part:
    a line in two knowns, with each run's first speed free. Raises InvalidRequest.
    """
    _checked_runs(runs)
    heavy_kg = known.mass_kg + known.wheels_kg
    rows, lost = [], []
    for place, run in enumerate(runs):
        time_s, speed = _arrays(run.time_s, run.speed_ms)
        time_s = time_s - time_s[0]
        squares = summed(speed**2, time_s)
        own = np.zeros((time_s.size, len(runs)))
        own[:, place] = 1.0
        rows.append(np.column_stack([time_s, squares, own]))
        distance_m = float(summed(speed, time_s)[-1])
        slope_n = known.mass_kg * known.gravity_ms2 * run.rise_m / distance_m
        lost.append(-heavy_kg * speed - slope_n * time_s)
    matrix, wanted = np.concatenate(rows), np.concatenate(lost)
    values = np.linalg.lstsq(matrix, wanted, rcond=None)[0]
    left = wanted - matrix @ values
    variance = float(left @ left) / (wanted.size - values.size)
    covariance = variance * np.linalg.pinv(matrix.T @ matrix)[:2, :2]
    (a, b), (c, d) = covariance.tolist()
    return Resistance(float(values[0]), float(values[1]), ((a, b), (c, d)))


def balance(
    climb: Climb, found: Resistance, known: Known, calibrated_expanded_share: float
) -> Balance:
    """The climb's energy against what the torque sensor told.

    calibrated_expanded_share: of the calibration's torque, k = 2, as a share. Raises
    InvalidRequest where the climb cannot tell.
    """
    time_s, speed = _arrays(climb.time_s, climb.speed_ms)
    torque, cadence = _arrays(climb.torque_nm, climb.cadence_rpm)
    _checked_climb(climb, known)
    crank_j = float(np.trapezoid(torque * cadence * RPM_TO_RAD_S, time_s))
    if crank_j <= 0:
        _raise([FieldError("torque_nm", "no_work", "torque_nm: the legs gave nothing")])
    inputs = _Inputs(
        known.mass_kg, known.wheels_kg, climb.rise_m, known.efficiency, 1.0, 0.0,
        found.rolling_n, found.air_ns2_m2,
    )  # fmt: skip

    def ratio(given: _Inputs) -> float:
        return _needed_j(given, known.gravity_ms2, time_s, speed) / (given.efficiency * crank_j)

    middle = ratio(inputs)
    parts = _contributions(ratio, inputs, found, known)
    expanded = 2 * math.sqrt(math.fsum(part**2 for part in parts.values()))
    en = en_number(middle - 1, math.hypot(expanded, calibrated_expanded_share * middle))
    said = "agrees with" if en <= 1 else "differs from"
    sentence = (
        f"the climb {said} the calibration: true torque is {middle:.3f} ± {expanded:.3f} of what"
        " the sensor tells"
    )
    needed = _needed_j(inputs, known.gravity_ms2, time_s, speed)
    return Balance(middle, crank_j, needed, parts, expanded, en, en <= 1, sentence)


def _needed_j(given: _Inputs, gravity_ms2: float, time_s: Numbers, told_ms: Numbers) -> float:
    speed = told_ms * given.speed_share
    heavy_kg = given.mass_kg + given.wheels_kg
    against = speed + given.wind_ms
    air_j = given.air_ns2_m2 * float(np.trapezoid(np.abs(against) * against * speed, time_s))
    rolling_j = given.rolling_n * float(np.trapezoid(speed, time_s))
    kinetic_j = heavy_kg * float(speed[-1] ** 2 - speed[0] ** 2) / 2
    return given.mass_kg * gravity_ms2 * given.rise_m + kinetic_j + rolling_j + air_j


def _contributions(
    ratio: Callable[[_Inputs], float], inputs: _Inputs, found: Resistance, known: Known
) -> dict[str, float]:
    """Each by half the difference of one standard uncertainty up and down (GUM 5.1.3, note 2)."""
    standards = {
        "mass_kg": known.mass_limit_kg / ROOT_3,
        "wheels_kg": known.wheels_limit_kg / ROOT_3,
        "rise_m": known.rise_limit_m / ROOT_3,
        "efficiency": known.efficiency_limit / ROOT_3,
        "speed_share": known.speed_share_limit / ROOT_3,
        "wind_ms": known.wind_limit_ms / ROOT_3,
        "rolling_n": 1.0,
        "air_ns2_m2": 1.0,
    }
    shift = {
        name: (
            ratio(inputs._replace(**{name: getattr(inputs, name) + standard}))
            - ratio(inputs._replace(**{name: getattr(inputs, name) - standard}))
        )
        / 2
        for name, standard in standards.items()
    }
    by = np.array([shift.pop("rolling_n"), shift.pop("air_ns2_m2")])
    told = {name: abs(value) for name, value in shift.items()}
    told["coast_down"] = math.sqrt(max(0.0, float(by @ np.array(found.covariance) @ by)))
    return told


def summed(values: Numbers, time_s: Numbers) -> Numbers:
    """The integral from the first sample to each (n,), by trapezes."""
    steps = (values[1:] + values[:-1]) / 2 * np.diff(time_s)
    summed: Numbers = np.concatenate([[0.0], np.cumsum(steps)])
    return summed


def _arrays(first: Sequence[float], second: Sequence[float]) -> tuple[Numbers, Numbers]:
    return np.asarray(first, np.float64), np.asarray(second, np.float64)


def _checked_runs(runs: Sequence[Run]) -> None:
    faults = []
    if not runs:
        faults.append(FieldError("runs", "missing", "runs: a coast-down is needed"))
    for place, run in enumerate(runs):
        time_s, speed = _arrays(run.time_s, run.speed_ms)
        if not _ordered(time_s, speed):
            field = f"runs[{place}]"
            message = f"{field}: ten samples or more, in order of time, finite"
            faults.append(FieldError(field, "wrong_shape", message))
        elif not speed.max() - speed.min() > 0.3 * speed.max():
            field = f"runs[{place}].speed_ms"
            message = f"{field}: the speed must fall by a third to tell rolling from air"
            faults.append(FieldError(field, "too_short", message))
    _raise(faults)


def _checked_climb(climb: Climb, known: Known) -> None:
    faults = []
    for name in ("speed_ms", "torque_nm", "cadence_rpm"):
        if not _ordered(*_arrays(climb.time_s, getattr(climb, name))):
            message = f"{name}: ten samples or more, in order of time, finite"
            faults.append(FieldError(name, "wrong_shape", message))
    if climb.motor_w is not None and max(climb.motor_w, default=0.0) > MOTOR_MOST_W:
        faults.append(FieldError("motor_w", "motor_helped", "motor_w: the motor must be off"))
    if not known.mass_kg * known.gravity_ms2 * climb.rise_m >= CLIMB_LEAST_J:
        message = f"rise_m: {climb.rise_m:g} m is too little of a climb to tell"
        faults.append(FieldError("rise_m", "too_short", message))
    _raise(faults)


def _ordered(time_s: Numbers, values: Numbers) -> bool:
    alike = time_s.ndim == 1 and time_s.shape == values.shape and time_s.size >= 10
    return bool(
        alike
        and np.isfinite(time_s).all()
        and np.isfinite(values).all()
        and (np.diff(time_s) > 0).all()
    )


def _raise(faults: list[FieldError]) -> None:
    if faults:
        listed = "; ".join(fault.message for fault in faults)
        raise InvalidRequest(f"energy balance: {listed}", "invalid_balance", faults)
