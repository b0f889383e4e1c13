"""Breaks of irregular rows: which are pauses, and which were ridden.

A break is longer than PAUSE_SPACINGS usual spacings and than PAUSE_MIN_US, or one in which the
timer of the device stood. A device that writes a row only where something changes leaves breaks in
which the bike went on: what lies between the ends of one of these took about as long as it would at
the speed around it. With a stop in it, it took longer.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.device_metadata import Pause
from backend.core.sphere import REACH_M, REACH_MS, great_circle_m

Mask = npt.NDArray[np.bool_]
TimesUs = npt.NDArray[np.int64]

PAUSE_SPACINGS = 5
PAUSE_MIN_US = 10_000_000
# Between these shares of the speed around, of so many steps, a break was ridden without a stop, and
# not by train; and no device writes nothing for longer than RIDDEN_S.
AROUND_SHARES = 0.5, 2.0
AROUND_STEPS = 10
RIDDEN_S = 600.0
MOVING_MS = 0.5
LATITUDE, LONGITUDE, DISTANCE = "latitude_deg", "longitude_deg", "distance_m"


def long_steps(times_us: TimesUs) -> Mask:
    """Which steps (n - 1,) from row to row are longer than one recording's."""
    steps_us = np.diff(times_us)
    usual_us = float(np.median(steps_us)) if len(steps_us) else 0.0
    long: Mask = steps_us > max(PAUSE_MIN_US, int(PAUSE_SPACINGS * usual_us))
    return long


def find_breaks(
    columns: Mapping[str, Values], times_us: TimesUs, pauses: Sequence[Pause] = ()
) -> Mask:
    """Which steps (n - 1,) from row to row are pauses.

    columns: DISTANCE, LATITUDE, LONGITUDE (n,) as far as there are some, missing as NaN. pauses: of
    the device's timer; a step that one of them covers is a pause however short it is.
    """
    breaks = long_steps(times_us)
    if breaks.any():
        steps_m = steps_of(columns)
        if steps_m is not None:
            breaks &= ~is_ridden(steps_m, np.diff(times_us) / 1e6, breaks)
    for pause in pauses:
        middle_us = 5e5 * (pause.from_s + pause.to_s)
        behind = int(np.searchsorted(times_us, middle_us))
        if 0 < behind < len(times_us):
            stood_us = times_us[behind] - times_us[behind - 1]
            breaks[behind - 1] |= stood_us >= 1e6 * (pause.to_s - pause.from_s) > 0
    return breaks


def steps_of(columns: Mapping[str, Values]) -> Values | None:
    """Metres from row to row (n - 1,) by odometer or positions, NaN where neither is known."""
    if DISTANCE in columns:
        steps_m: Values = np.diff(columns[DISTANCE])
        return steps_m
    if LATITUDE in columns and LONGITUDE in columns:
        return track_steps_m(columns[LATITUDE], columns[LONGITUDE])
    return None


def track_steps_m(latitude_deg: Values, longitude_deg: Values) -> Values:
    """From each position to the next over the ground, (n - 1,)."""
    return great_circle_m(
        latitude_deg[:-1], longitude_deg[:-1], latitude_deg[1:], longitude_deg[1:]
    )


def is_reachable(steps_m: Values, seconds: Values) -> Mask:
    """Whether the time of steps (n,) allows their metres; not where these are unknown."""
    reachable: Mask = np.nan_to_num(steps_m, nan=np.inf) <= REACH_M + REACH_MS * seconds
    return reachable


def is_ridden(steps_m: Values, seconds: Values, long: Mask) -> Mask:
    """Which steps (n,) between rows were ridden: all that can be, but for breaks with a stop.

    steps_m: NaN where unknown. seconds: of each step. long: of these, which are breaks.
    """
    reachable = is_reachable(steps_m, seconds)
    ridden: Mask = reachable & ~long
    speed_ms = np.divide(steps_m, seconds, out=np.zeros(len(steps_m)), where=seconds > 0)
    moving = np.flatnonzero(ridden & (speed_ms > MOVING_MS))
    for step in np.flatnonzero(long & reachable & (seconds <= RIDDEN_S)).tolist():
        at = int(np.searchsorted(moving, step))
        around = speed_ms[moving[max(0, at - AROUND_STEPS // 2) : at + AROUND_STEPS // 2]]
        if len(around):
            slowest, fastest = np.multiply(AROUND_SHARES, np.median(around))
            ridden[step] = slowest <= speed_ms[step] <= fastest
    return ridden


def apart(rows: npt.NDArray[np.intp], times_s: Values, breaks: Mask) -> Mask:
    """Between which of some rows (m,) no line is drawn, (m - 1,): a break of the ride, or so long
    without a position. breaks: of the ride's steps from row to row."""
    paused = np.diff(np.append(0, np.cumsum(breaks))[rows]) > 0
    silent = (np.diff(rows) > 1) & (np.diff(times_s[rows]) * 1e6 > PAUSE_MIN_US)
    either: Mask = paused | silent
    return either
