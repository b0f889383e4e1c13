"""Wheel circumference, speed pulses per turn and cadence: what the legal cut-off rests on; and the
samples of a ride as these and the energy balance take them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from backend.calibration.bike.track import Track
from backend.calibration.plain import Plain
from backend.core.statistics import Numbers, coverage_factor
from backend.errors import FieldError, InvalidRequest


def as_array(values: Sequence[float] | Numbers) -> Numbers:
    """As float64 (n,)."""
    return np.asarray(values, np.float64)


def summed(values: Numbers, time_s: Numbers) -> Numbers:
    """The integral from the first sample to each (n,), by trapezes."""
    steps = (values[1:] + values[:-1]) / 2 * np.diff(time_s)
    summed: Numbers = np.concatenate([[0.0], np.cumsum(steps)])
    return summed


def ordered(time_s: Numbers, values: Numbers) -> bool:
    """Ten samples or more, finite, in order of time."""
    alike = time_s.ndim == 1 and time_s.shape == values.shape and time_s.size >= 10
    return bool(
        alike
        and np.isfinite(time_s).all()
        and np.isfinite(values).all()
        and (np.diff(time_s) > 0).all()
    )


def raise_if(faults: list[FieldError]) -> None:
    """Raise InvalidRequest with all of them, if there is any."""
    if faults:
        listed = "; ".join(fault.message for fault in faults)
        raise InvalidRequest(f"energy balance: {listed}", "invalid_balance", faults)


ROOT_3 = math.sqrt(3.0)
CIRCUMFERENCE_MIN_M, CIRCUMFERENCE_MAX_M = 0.8, 2.6
"""Wheels of 12 to 29 inch and the widest tyre."""

GPS_LEAST_M = 1000.0
"""Shorter, and nobody can tell the noise of the positions from the way."""

GPS_WANDER_SHARE = 0.005
"""Limit of what positions add that wander slowly: 3 m over 20 s or 60 s make a ride at 20 km/h
0.7 % or 0.3 % too long, which no track tells from its way."""

GPS_EXPANDED_SHARE_MAX = 0.02
"""Half of the band in which a dealer may set a circumference: less is no measurement of it."""

PULSE_TURNS_LEAST = 20.0
"""Enough to tell 100 pulses, the most of a unit, from 101."""

HAND_TURNS = 0.05
"""Limit of how far from its mark a wheel was stopped by hand."""

END_PULSES = 4.0
"""Limit of what the unit tells more or less at either end: the first pulse has no speed yet, and
after the last one a speed fades out for two seconds."""

SLIP_SHARE = 0.002
"""Limit of what a rolling tyre under load and a rolled-out one differ by."""


@dataclass(frozen=True, slots=True)
class Circumference(Plain):
    """expanded_m: for 95.45 %, coverage its factor. method: `roll_out` or `gps`."""

    circumference_m: float
    standard_m: float
    coverage: float
    expanded_m: float
    method: str


@dataclass(frozen=True, slots=True)
class Pulses(Plain):
    """A wheel's pulses in a turn. stored: what the unit counts with. counted, expanded: what its
    distance comes to, k = 2. nearest_integer: the number within that; None where there is none: the
    turns were miscounted, or a magnet is missed. agrees: the stored one is within."""

    stored: int
    counted: float
    expanded: float
    nearest_integer: int | None
    agrees: bool


@dataclass(frozen=True, slots=True)
class CutOff(Plain):
    """What a kept circumference does to a limit. true_kmh: what is ridden when the bike says
    `limit_kmh`. lawful: with all of the uncertainty it stays at or below `limit_kmh` plus what the
    law's test allows."""

    limit_kmh: float
    true_kmh: float
    expanded_kmh: float
    lawful: bool


def roll_out(distances_m: Sequence[float], turns: float, tape_limit_m: float) -> Circumference:
    """From a mark on the ground to the next, rider on the saddle, each over `turns` turns.

    distances_m: (n,), n >= 2 repeats. tape_limit_m: half width of what tape and marks may be off.
    Raises InvalidRequest naming every field at fault.
    """
    faults = []
    each = np.asarray(distances_m, np.float64)
    if each.size < 2 or not (np.isfinite(each).all() and (each > 0).all()):
        faults.append(_fault("distances_m", "two rolls or more, each above 0 m, are needed"))
    if not (math.isfinite(turns) and turns > 0):
        faults.append(_fault("turns", "the turns of a roll must be above 0"))
    if not (math.isfinite(tape_limit_m) and tape_limit_m >= 0):
        faults.append(_fault("tape_limit_m", "the limit must be 0 m or more"))
    _raise(faults)
    mean_m = float(each.mean()) / turns
    scatter = float(each.std(ddof=1)) / math.sqrt(each.size) / turns
    limits = math.hypot(tape_limit_m / turns, SLIP_SHARE * mean_m) / ROOT_3
    return _circumference(mean_m, scatter, each.size - 1, limits, "roll_out")


def from_gps(track: Track | None, wheel_m: float, turns: float) -> Circumference:
    """From a ride's track and the turns its speed sensor counted on the same stretch.

    track: None where it is too short. wheel_m: the distance by the wheel sensor. Raises
    InvalidRequest, also for positions that are too inaccurate.
    """
    faults = []
    long_enough = math.isfinite(wheel_m) and wheel_m >= GPS_LEAST_M
    if track is None or not long_enough:
        faults.append(_fault("distance_m", f"a track of {GPS_LEAST_M:g} m or more is needed"))
    if not (math.isfinite(turns) and turns > 0):
        faults.append(_fault("turns", "the turns of the ride must be above 0"))
    _raise(faults)
    assert track is not None
    mean_m = track.ratio * wheel_m / turns
    scatter = track.scatter / track.ratio * mean_m
    bends = track.bends_limit / track.ratio
    share = math.hypot(bends, GPS_WANDER_SHARE, 1 / turns) / ROOT_3
    result = _circumference(mean_m, scatter, track.freedom, share * mean_m, "gps")
    if result.expanded_m > GPS_EXPANDED_SHARE_MAX * mean_m:
        message = (
            f"the positions are {track.noise_m:.1f} m off and bends leave "
            f"{100 * bends:.1f} % open: they tell the circumference to "
            f"{100 * result.expanded_m / mean_m:.1f} % only, {100 * GPS_EXPANDED_SHARE_MAX:g} % "
            "are needed; take a longer and straighter ride under an open sky, or roll out"
        )
        _raise([FieldError("track", "too_rough", f"track: {message}")])
    return result


def cut_off(
    stored_m: float, measured: Circumference, limit_kmh: float, tolerance_pct: float = 0.0
) -> CutOff:
    """The bike counts turns and multiplies by `stored_m`: a wheel that is larger is faster."""
    true_kmh = limit_kmh * measured.circumference_m / stored_m
    expanded = limit_kmh * measured.expanded_m / stored_m
    most = limit_kmh * (1 + tolerance_pct / 100)
    return CutOff(limit_kmh, true_kmh, expanded, true_kmh + expanded <= most)


def pulses_per_turn(stored: int, counted_turns: float, turns: float) -> Pulses:
    """From turns of the wheel by hand, and what the unit made of them with `stored` pulses a turn.

    The unit reports no pulses but a distance: counted_turns is that distance in turns. Raises
    InvalidRequest for too few turns.
    """
    faults = []
    if not (math.isfinite(turns) and turns >= PULSE_TURNS_LEAST):
        message = f"{PULSE_TURNS_LEAST:g} turns or more tell the pulses apart"
        faults.append(FieldError("turns", "too_few_turns", f"turns: {message}"))
    if not counted_turns > 0:
        message = "ride_id: the unit told no speed there: no pulse came"
        faults.append(FieldError("ride_id", "no_pulses", message))
    _raise(faults)
    pulses = stored * counted_turns / turns
    expanded = 2 * math.hypot(pulses * HAND_TURNS, END_PULSES) / turns / ROOT_3
    nearest = max(1, round(pulses))
    whole_pulses = nearest if abs(nearest - pulses) <= expanded else None
    return Pulses(stored, pulses, expanded, whole_pulses, abs(stored - pulses) <= expanded)


def cadence_error_rpm(
    reported_rpm: float, crank_turns: float, duration_s: float
) -> tuple[float, float]:
    """What the unit tells less what was counted, and the expanded uncertainty of the counting:
    half a turn of a crank that started and ended anywhere near its mark, and 0.2 s of a hand."""
    counted_rpm = 60 * crank_turns / duration_s
    share = math.hypot(0.05 / crank_turns, 0.2 / duration_s) / ROOT_3
    return reported_rpm - counted_rpm, 2 * counted_rpm * share


def _circumference(
    mean_m: float, scatter: float, freedom: int | None, limits: float, method: str
) -> Circumference:
    if not CIRCUMFERENCE_MIN_M <= mean_m <= CIRCUMFERENCE_MAX_M:
        _raise([_fault("circumference_m", f"{mean_m:.3f} m is no bicycle's wheel: 0.8 to 2.6 m")])
    standard = math.hypot(scatter, limits)
    effective = freedom * standard**4 / scatter**4 if freedom and scatter else None
    coverage = coverage_factor(effective)
    return Circumference(mean_m, standard, coverage, coverage * standard, method)


def _fault(field: str, message: str) -> FieldError:
    return FieldError(field, "out_of_range", f"{field}: {message}")


def _raise(faults: list[FieldError]) -> None:
    if faults:
        listed = "; ".join(fault.message for fault in faults)
        raise InvalidRequest(f"wheel: {listed}", "invalid_wheel", faults)
