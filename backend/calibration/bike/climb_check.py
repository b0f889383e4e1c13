"""The torque gain of a unit from rides: coast-downs and a climb that its rider's legs made alone.

What was asked of a motor is not what it gave: a ride that tells only the first needs its rider's
word that the motor was off.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from backend.calibration.bike.balance import Climb, balance
from backend.calibration.bike.coast_down import ClimbInputs, Run, resistance
from backend.calibration.bike.types import CalibratedTorque, CertificateOfTorque, ClimbResult
from backend.calibration.bike.wheel_measure import Rows, refusal, rows_of
from backend.core.channels import Values
from backend.core.energy import KMH_PER_MS, MOTOR_POWER, MOTOR_TORQUE, MOTOR_TORQUE_DEMANDED
from backend.core.ride import Ride
from backend.rides.rows import Window
from backend.store import Store

SPEED, TORQUE, CADENCE, ALTITUDE = "speed_kmh", "rider_torque_nm", "cadence_rpm", "altitude_m"
END_S = 5.0
"""Of heights at either end, through which a line is laid."""
DEMANDED_NM = 0.05
"""At the motor's shaft; asked for more, the motor was not off."""


@dataclass(frozen=True)
class Slope:
    """A window, and how much higher its end lies than its begin; None: by the ride's heights."""

    window: Window
    rise_m: float | None = None


@dataclass(frozen=True)
class Question:
    """coast_downs: at best the same stretch both ways; without any, road and air are typical ones.
    motor_off: the rider's word for it, needed where the ride does not tell what the motor gave.
    calibrated_expanded_share: of the torque by its calibration, k = 2; None: by the certificate of
    the calibration that the unit had on the climb."""

    climb: Slope
    coast_downs: Sequence[Slope]
    climb_inputs: ClimbInputs
    motor_off: bool
    calibrated_expanded_share: float | None


CertifiedOf = Callable[[Ride, float], CertificateOfTorque | None]


class ClimbCheck:
    """Compares a climb's energy with the torque sensor. Safe from any thread.

    certified_of: of a ride and a torque in newton metres, what its unit's certificate says.
    """

    def __init__(self, store: Store, certified_of: CertifiedOf) -> None:
        self._store = store
        self._certified_of = certified_of

    def __call__(self, question: Question) -> ClimbResult:
        """Raises NotFound, ObjectDamaged, and InvalidRequest with every reason why these rides
        cannot tell."""
        runs = []
        for place, slope in enumerate(question.coast_downs):
            rows, rise_m = self._rows(slope, f"coast_downs[{place}]", [SPEED])
            runs.append(Run(rows.time_s.tolist(), list_ms(rows), rise_m))
        rows, rise_m = self._rows(question.climb, "climb", [SPEED, TORQUE, CADENCE])
        climb = Climb(
            rows.time_s.tolist(),
            list_ms(rows),
            rows[TORQUE].tolist(),
            rows[CADENCE].tolist(),
            rise_m,
            self._motor_w(rows.ride.motor_torque_meaning, question),
        )
        fitted = resistance(runs, question.climb_inputs)
        calibrated = self._calibrated(question, rows)
        weighed = balance(climb, fitted, question.climb_inputs, calibrated.expanded_share)
        duration_s = float(rows.time_s[-1] - rows.time_s[0])
        return ClimbResult(
            rows.ride.context.unit_key, rise_m, duration_s, fitted, weighed, calibrated
        )

    def _calibrated(self, question: Question, rows: Rows) -> CalibratedTorque:
        if question.calibrated_expanded_share is not None:
            return CalibratedTorque("given", question.calibrated_expanded_share)
        certified = self._certified_of(rows.ride, float(rows[TORQUE].mean()))
        if certified is None:
            return CalibratedTorque("unknown", 0.0)
        return CalibratedTorque("certificate", certified.expanded_share, certified)

    def _rows(self, slope: Slope, field: str, names: list[str]) -> tuple[Rows, float]:
        """The rows of a slope, and its rise."""
        if slope.rise_m is not None:
            return rows_of(self._store, slope.window, field, names), slope.rise_m
        rows = rows_of(self._store, slope.window, field, [*names, ALTITUDE])
        return rows, rise_by_heights(rows.time_s, rows[ALTITUDE])

    def _motor_w(self, meaning: str | None, question: Question) -> list[float] | None:
        """What the motor gave on the climb; None where its rider says that it was off."""
        window = question.climb.window
        ride = self._store.rides.get(window.ride_id)
        offered = {channel.name for channel in ride.offered}
        if MOTOR_POWER.name in offered:
            rows = rows_of(self._store, window, "climb", [MOTOR_POWER.name])
            power_w: list[float] = rows[MOTOR_POWER.name].tolist()
            return power_w
        if not question.motor_off:
            recorded = "only what was asked of the motor" if meaning else "nothing of the motor"
            message = f"ride {window.ride_id} tells {recorded}: was it off?"
            raise refusal("motor_off", "motor_unknown", message)
        torque_channel = next(
            (one for one in (MOTOR_TORQUE_DEMANDED, MOTOR_TORQUE) if one in offered), None
        )
        if (
            torque_channel
            and rows_of(self._store, window, "climb", [torque_channel])[torque_channel].max()
            > DEMANDED_NM
        ):
            message = f"ride {window.ride_id} asked the motor for torque: it was not off"
            raise refusal("motor_off", "motor_helped", message)
        return None


def list_ms(rows: Rows) -> list[float]:
    """The speed in metres a second."""
    speeds: list[float] = (rows[SPEED] / KMH_PER_MS).tolist()
    return speeds


def rise_by_heights(time_s: Values, altitude_m: Values) -> float:
    """From begin to end of heights (n,): a line through END_S of either tells the height there."""

    def height(at_s: float) -> float:
        near = np.abs(time_s - at_s) <= END_S
        if np.count_nonzero(near) < 3:
            return float(altitude_m[near].mean())
        _, level = np.polyfit(time_s[near] - at_s, altitude_m[near], 1)
        return float(level)

    return height(float(time_s[-1])) - height(float(time_s[0]))
