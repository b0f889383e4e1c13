"""How hard a ride was: time in zones and bands, the best mean power over any time, and its laps.

Zones count means of a second, or of a row that lasts longer: within a stroke power swings between
nothing and double its mean. Power zones are those of Allen and Coggan (Training and Racing with a
Power Meter), in shares of the threshold power; heart-rate zones the five by tenths of the greatest
heart rate that head units use. Nobody agreed on zones of torque, so there are bands of 10 Nm.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.described import described
from backend.core.energy import MOTOR_POWER, RADIANS_PER_S_PER_RPM, RIDER_POWER

POWER_ZONE_SHARES = (0.55, 0.75, 0.90, 1.05, 1.20, 1.50)
HEART_ZONE_SHARES = (0.6, 0.7, 0.8, 0.9)
POWER_STEP_W, TORQUE_STEP_NM, CADENCE_STEP_RPM, HEART_STEP_BPM = 50.0, 10.0, 10.0, 10.0
BANDS_MAX = 16
"""What lies above the last band is in it: one spike makes no hundred bands."""
POWER, TORQUE, CADENCE, HEART = RIDER_POWER.name, "rider_torque_nm", "cadence_rpm", "heart_rate_bpm"
NEEDED = (POWER, TORQUE, CADENCE, HEART)


@described
class Band:
    """Time from `low` up to `high`; null for no end."""

    low: float | None
    high: float | None
    seconds: float


@described
class Distribution:
    """Time of a quantity, in means of a second."""

    channel: str
    zones: bool
    """Zones of `reference`; else plain bands."""
    reference: float | None
    bands: tuple[Band, ...]
    mean: float
    """Of what is counted."""
    most: float
    """The greatest mean of a second."""
    valid_s: float
    unknown_s: float
    """Time without the quantity."""


@dataclass(frozen=True)
class Seconds:
    """A ride by seconds, or by rows that last longer: values by channel and their time (m,)."""

    values: Mapping[str, Values]
    row_s: Values

    def __getitem__(self, name: str) -> Values | None:
        return self.values.get(name)


def by_seconds(columns: Mapping[str, Values], start_s: Values, seconds: Values) -> Seconds:
    """Means over each second of rows (n,) that begin at start_s and hold for `seconds`.

    A sample that is missing has no part in the mean; time without any row is in no second.
    """
    second = np.floor(start_s + 1e-9).astype(np.int64)
    starts = np.flatnonzero(np.diff(second, prepend=second[:1] - 1))
    if not len(starts):
        return Seconds({}, np.zeros(0))
    means_by_name = {}
    for name, values in columns.items():
        valid = np.isfinite(values)
        weight = np.add.reduceat(np.where(valid, seconds, 0.0), starts)
        sums = np.add.reduceat(np.where(valid, values, 0.0) * seconds, starts)
        means: Values = np.full(len(starts), np.nan)
        np.divide(sums, weight, out=means, where=weight > 0.0)
        means_by_name[name] = means
    return Seconds(means_by_name, np.add.reduceat(np.asarray(seconds), starts))


def power_time(ride: Seconds, threshold_w: float | None) -> Distribution | None:
    """The rider's power while pedalling, by zones of the threshold, else by steps."""
    power = ride[POWER]
    if power is None:
        return None
    pedalling = turning(ride) & ~(power <= 0.0)
    edges = zone_edges(POWER_ZONE_SHARES, threshold_w) or steps(power[pedalling], POWER_STEP_W)
    return distribution(POWER, power, ride.row_s, pedalling, edges, threshold_w)


def heart_time(ride: Seconds, bpm_max: float | None) -> Distribution | None:
    """The heart rate, by zones of the greatest, else by steps."""
    rate = ride[HEART]
    if rate is None:
        return None
    always = np.ones(len(rate), np.bool_)
    edges = zone_edges(HEART_ZONE_SHARES, bpm_max) or steps(rate, HEART_STEP_BPM)
    return distribution(HEART, rate, ride.row_s, always, edges, bpm_max)


def torque_time(ride: Seconds) -> Distribution | None:
    """The rider's torque over turning cranks; of power and cadence where it was not measured."""
    torque, power, cadence = ride[TORQUE], ride[POWER], ride[CADENCE]
    if torque is None and power is not None and cadence is not None:
        turns = cadence > 0.0
        torque = np.full(len(power), np.nan)
        np.divide(power, cadence * RADIANS_PER_S_PER_RPM, out=torque, where=turns)
    if torque is None:
        return None
    pushing = turning(ride)
    edges = steps(torque[pushing], TORQUE_STEP_NM)
    return distribution(TORQUE, torque, ride.row_s, pushing, edges, None)


def cadence_time(ride: Seconds) -> Distribution | None:
    """The cadence of turning cranks."""
    cadence = ride[CADENCE]
    if cadence is None:
        return None
    pushing = turning(ride)
    edges = steps(cadence[pushing], CADENCE_STEP_RPM)
    return distribution(CADENCE, cadence, ride.row_s, pushing, edges, None)


def turning(ride: Seconds) -> npt.NDArray[np.bool_]:
    """Seconds in which the cranks turn, or may: where nobody measured it."""
    cadence = ride[CADENCE]
    if cadence is None:
        return np.ones(len(ride.row_s), np.bool_)
    return ~(cadence <= 0.0)


def zone_edges(shares: Sequence[float], reference: float | None) -> list[float]:
    """Where zones meet; none without what they are shares of."""
    return [] if reference is None else [share * reference for share in shares]


def steps(values: Values, step: float) -> list[float]:
    """Edges of bands of `step` between the least and the greatest of values (n,)."""
    valid = values[np.isfinite(values)]
    if not len(valid):
        return []
    first, last = (int(value // step) for value in (valid.min(), valid.max()))
    return [step * index for index in range(first + 1, min(last, first + BANDS_MAX - 1) + 1)]


def distribution(
    channel: str,
    values: Values,
    seconds: Values,
    counted: npt.NDArray[np.bool_],
    edges: Sequence[float],
    reference: float | None,
) -> Distribution | None:
    """Time of values (n,) between edges, over what is counted; None where there is no value."""
    valid = counted & np.isfinite(values)
    if not valid.any():
        return None
    spent = np.bincount(np.digitize(values[valid], edges), seconds[valid], len(edges) + 1)
    limits: list[float | None] = [None, *edges, None]
    return Distribution(
        channel,
        reference is not None,
        reference,
        tuple(
            Band(low, high, float(time_s))
            for (low, high), time_s in zip(pairwise(limits), spent, strict=True)
        ),
        mean=float(np.average(values[valid], weights=seconds[valid])),
        most=float(values[valid].max()),
        valid_s=float(seconds[valid].sum()),
        unknown_s=float(seconds[~np.isfinite(values)].sum()),
    )


HEART = "heart_rate_bpm"
MEANS = (RIDER_POWER.name, MOTOR_POWER.name, HEART)


@described
class LapFigures:
    """A lap of the device that recorded the ride."""

    from_s: float
    to_s: float
    seconds: float
    """Of the rows in the lap."""
    distance_km: float | None
    rider_power_w_mean: float | None
    motor_power_w_mean: float | None
    heart_rate_bpm_mean: float | None


def lap_figures(
    columns: Mapping[str, Values],
    start_s: Values,
    seconds: Values,
    step_m: Values | None,
    laps: Iterable[tuple[float, float]],
) -> list[LapFigures]:
    """Of laps from when to when, over rows (n,) that begin at start_s."""
    figures = []
    for from_s, to_s in laps:
        first, last = np.searchsorted(start_s, (from_s - 1e-6, to_s - 1e-6))
        rows = slice(int(first), int(last))
        means = (mean(columns.get(name), seconds, rows) for name in MEANS)
        km = None if step_m is None else float(step_m[rows].sum()) / 1000.0
        figures.append(LapFigures(from_s, to_s, float(seconds[rows].sum()), km, *means))
    return figures


def mean(values: Values | None, seconds: Values, rows: slice) -> float | None:
    """Mean of rows by how long they hold."""
    if values is None:
        return None
    valid = np.isfinite(values[rows])
    duration_s = float(seconds[rows][valid].sum())
    if duration_s <= 0.0:
        return None
    return float((values[rows][valid] * seconds[rows][valid]).sum()) / duration_s
