"""Charge used, and how far the rest would have gone on a ride like this one.

The range is the charge that is left over the charge used for a kilometre. Its band has two causes:
the step of the charge's reading, on the difference of two readings; and how much the thirds of the
way differ: the short end rides on as in the third that took most, the long end as in the third that
took least. It says nothing of another road, wind or mode. Capacity is in no configuration, so
there is no range without a reading of the charge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from backend.core.channels import Values
from backend.core.energy import SECONDS_PER_HOUR

ENDS_S = 10.0
"""The charge at either end is the median of so long: one reading may be a glitch."""
USED_PCT_MIN = 3.0
DISTANCE_KM_MIN = 3.0
"""Of less a range would be a guess: with a step of 1 % its band is wider than a third of it."""
PARTS = 3


@dataclass(frozen=True)
class Charge:
    """soc_pct_*: at the ends. step_pct: the finest change of the reading. range_km*: with the
    charge left at the end; most is None where the leanest third took nothing. refused: why there
    is no range, a code."""

    soc_pct_first: float
    soc_pct_last: float
    used_pct: float
    step_pct: float
    range_km: float | None
    range_km_least: float | None
    range_km_most: float | None
    refused: str | None


def charge_of(
    soc_pct: Values, battery_w: Values | None, seconds: Values, step_m: Values | None
) -> Charge | None:
    """Of rows (n,), missing as NaN; None without a reading of the charge.

    battery_w: battery power. step_m: way of each row. Refusals: `no_distance`, `short_way`,
    `charged` (the charge rose), `little_used`.
    """
    valid = np.flatnonzero(np.isfinite(soc_pct))
    if not len(valid):
        return None
    charges = soc_pct[valid]
    changes = np.abs(np.diff(charges))
    changes = changes[changes > 1e-9]
    step = float(changes.min()) if len(changes) else 0.0
    passed_s = np.cumsum(seconds[valid])
    first = float(np.median(charges[passed_s <= max(ENDS_S, passed_s[0])]))
    last = float(np.median(charges[passed_s >= passed_s[-1] - ENDS_S]))
    used = first - last
    refused = refusal(used, step, None if step_m is None else float(step_m.sum()) / 1000.0)
    if refused or step_m is None:
        return Charge(first, last, used, step, None, None, None, refused)
    km = float(step_m.sum()) / 1000.0
    shares = thirds(soc_pct, battery_w, seconds, step_m, used)
    most = (used - step) * min(shares)
    return Charge(
        first,
        last,
        used,
        step,
        range_km=last * km / used,
        range_km_least=last * km / ((used + step) * max(shares)),
        range_km_most=last * km / most if most > 0.0 else None,
        refused=None,
    )


def refusal(used_pct: float, step_pct: float, km: float | None) -> str | None:
    """Why no range can be estimated."""
    if km is None:
        return "no_distance"
    if km < DISTANCE_KM_MIN:
        return "short_way"
    if used_pct < -step_pct:
        return "charged"
    return "little_used" if used_pct < max(USED_PCT_MIN, 2 * step_pct) else None


def thirds(
    soc_pct: Values, battery_w: Values | None, seconds: Values, step_m: Values, used_pct: float
) -> list[float]:
    """What each third of the distance took, over the mean: by battery power, else by the charge."""
    part = np.minimum(np.cumsum(step_m) / step_m.sum() * PARTS, PARTS - 1e-9).astype(np.intp)
    if battery_w is not None and np.isfinite(battery_w).any():
        work = np.where(np.isfinite(battery_w), battery_w, 0.0) * seconds / SECONDS_PER_HOUR
        work_wh = np.bincount(part, work, minlength=PARTS)
        if work_wh.sum() > 0.0:
            return [float(wh) * PARTS / float(work_wh.sum()) for wh in work_wh]
    valid = np.flatnonzero(np.isfinite(soc_pct))
    ends = [soc_pct[valid[0]]]
    for index in range(PARTS):
        within = valid[part[valid] <= index]
        ends.append(soc_pct[within[-1]] if len(within) else ends[-1])
    return [float(fall) * PARTS / used_pct for fall in -np.diff(ends)]
