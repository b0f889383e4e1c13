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

from backend.calibration.bike.coast_down import ClimbInputs, Resistance
from backend.calibration.bike.wheel import ROOT_3, as_array, ordered, raise_if
from backend.calibration.plain import Plain
from backend.calibration.verification import en_number
from backend.core.statistics import Numbers
from backend.errors import FieldError

MOTOR_MOST_W = 1.0
"""More, and the motor helped: its share cannot be separated from the legs' this way."""

CLIMB_LEAST_J = 3000.0
"""A hundred kilograms up three metres: less is a bump, and its height is not known to a percent."""

RPM_TO_RAD_S = 2 * math.pi / 60


class Climb(NamedTuple):
    """A climb on the legs alone. Each (n,). motor_w: None where the unit tells none."""

    time_s: Sequence[float]
    speed_ms: Sequence[float]
    torque_nm: Sequence[float]
    cadence_rpm: Sequence[float]
    rise_m: float
    motor_w: Sequence[float] | None = None


@dataclass(frozen=True, slots=True)
class Needed(Plain):
    """Where the energy of the legs went, in joules; each but gravity can be negative. drivetrain_j:
    lost from crank to road."""

    gravity_j: float
    kinetic_j: float
    rolling_j: float
    air_j: float
    drivetrain_j: float


@dataclass(frozen=True, slots=True)
class Balance(Plain):
    """gain_ratio: true torque over told torque. crank_energy_j: by the torque as told.
    motor_energy_j: what the motor gave; None where nobody measured it. needed_energy_j: on the
    road, without the drivetrain's loss. contributions: standard, of the ratio. expanded: k = 2.
    en: the distance from 1 in both uncertainties. agrees: it is 1 or less."""

    gain_ratio: float
    crank_energy_j: float
    motor_energy_j: float | None
    needed_energy_j: float
    needed: Needed
    contributions: dict[str, float]
    expanded: float
    en: float
    agrees: bool
    sentence: str


class _Inputs(NamedTuple):
    mass_kg: float
    wheels_kg: float
    rise_m: float
    gravity_ms2: float
    efficiency: float
    speed_share: float
    wind_ms: float
    rolling_n: float
    air_ns2_m2: float


def balance(
    climb: Climb,
    resistance: Resistance,
    climb_inputs: ClimbInputs,
    calibrated_expanded_share: float,
) -> Balance:
    """The climb's energy against what the torque sensor told.

    calibrated_expanded_share: of the calibration's torque, k = 2, as a share. Raises
    InvalidRequest where the climb cannot tell.
    """
    time_s, speed = as_array(climb.time_s), as_array(climb.speed_ms)
    torque, cadence = as_array(climb.torque_nm), as_array(climb.cadence_rpm)
    _checked_climb(climb, climb_inputs)
    crank_j = float(np.trapezoid(torque * cadence * RPM_TO_RAD_S, time_s))
    if crank_j <= 0:
        raise_if([FieldError("torque_nm", "no_work", "torque_nm: the legs gave nothing")])
    inputs = _Inputs(
        climb_inputs.mass_kg, climb_inputs.wheels_kg, climb.rise_m,
        climb_inputs.gravity_ms2, climb_inputs.efficiency,
        1.0, 0.0, resistance.rolling_n, resistance.air_ns2_m2,
    )  # fmt: skip

    def ratio(inputs_changed: _Inputs) -> float:
        return math.fsum(_road_j(inputs_changed, time_s, speed)) / (
            inputs_changed.efficiency * crank_j
        )

    middle = ratio(inputs)
    parts = _contributions(ratio, inputs, resistance, climb_inputs)
    expanded = 2 * math.sqrt(math.fsum(part**2 for part in parts.values()))
    en = en_number(middle - 1, math.hypot(expanded, calibrated_expanded_share * middle))
    verdict = "agrees with" if en <= 1 else "differs from"
    sentence = (
        f"the climb {verdict} the calibration: true torque is {middle:.3f} ± {expanded:.3f} of what"
        " the sensor tells"
    )
    road = _road_j(inputs, time_s, speed)
    needed_j = math.fsum(road)
    motor_w = climb.motor_w
    motor_j = None if motor_w is None else float(np.trapezoid(as_array(motor_w), time_s))
    needed = Needed(*road, needed_j / climb_inputs.efficiency - needed_j)
    return Balance(
        middle, crank_j, motor_j, needed_j, needed, parts, expanded, en, en <= 1, sentence
    )


def _road_j(
    inputs: _Inputs, time_s: Numbers, recorded_ms: Numbers
) -> tuple[float, float, float, float]:
    """Gravity, kinetic, rolling and air."""
    speed = recorded_ms * inputs.speed_share
    heavy_kg = inputs.mass_kg + inputs.wheels_kg
    against = speed + inputs.wind_ms
    air_j = inputs.air_ns2_m2 * float(np.trapezoid(np.abs(against) * against * speed, time_s))
    rolling_j = inputs.rolling_n * float(np.trapezoid(speed, time_s))
    kinetic_j = heavy_kg * float(speed[-1] ** 2 - speed[0] ** 2) / 2
    return inputs.mass_kg * inputs.gravity_ms2 * inputs.rise_m, kinetic_j, rolling_j, air_j


def _contributions(
    ratio: Callable[[_Inputs], float],
    inputs: _Inputs,
    resistance: Resistance,
    climb_inputs: ClimbInputs,
) -> dict[str, float]:
    """Each by half the difference of one standard uncertainty up and down (GUM 5.1.3, note 2)."""
    standards = {
        "mass_kg": climb_inputs.mass_limit_kg / ROOT_3,
        "wheels_kg": climb_inputs.wheels_limit_kg / ROOT_3,
        "rise_m": climb_inputs.rise_limit_m / ROOT_3,
        "gravity_ms2": climb_inputs.gravity_limit_ms2 / ROOT_3,
        "efficiency": climb_inputs.efficiency_limit / ROOT_3,
        "speed_share": climb_inputs.speed_share_limit / ROOT_3,
        "wind_ms": climb_inputs.wind_limit_ms / ROOT_3,
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
    contributions = {name: abs(value) for name, value in shift.items()}
    contributions["road"] = math.sqrt(max(0.0, float(by @ np.array(resistance.covariance) @ by)))
    return contributions


def _checked_climb(climb: Climb, climb_inputs: ClimbInputs) -> None:
    faults = []
    for name in ("speed_ms", "torque_nm", "cadence_rpm"):
        if not ordered(as_array(climb.time_s), as_array(getattr(climb, name))):
            message = f"{name}: ten samples or more, in order of time, finite"
            faults.append(FieldError(name, "wrong_shape", message))
    if climb.motor_w is not None and max(climb.motor_w, default=0.0) > MOTOR_MOST_W:
        faults.append(FieldError("motor_w", "motor_helped", "motor_w: the motor must be off"))
    if not climb_inputs.mass_kg * climb_inputs.gravity_ms2 * climb.rise_m >= CLIMB_LEAST_J:
        message = f"rise_m: {climb.rise_m:g} m is too little of a climb to tell"
        faults.append(FieldError("rise_m", "too_short", message))
    raise_if(faults)
