"""Charge used, and how far the rest would have gone on a ride like this one.

The range is the charge that is left over the charge used for a kilometre. Its band has two causes:
the step of the charge's reading, on the difference of two readings; and how much the thirds of the
distance differ: the short end rides on as in the third that took most, the long end as in the third
that took least. It says nothing of another road, wind or mode. Capacity is in no configuration, so
there is no range without a reading of the charge.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np

from backend.core.channels import Values
from backend.core.charge_use import ChargeJump, ChargeUse, charge_use
from backend.core.described import described
from backend.core.energy import SECONDS_PER_HOUR

USED_PCT_MIN = 3.0
DISTANCE_KM_MIN = 3.0
"""Of less a range would be a guess: with a step of 1 % its band is wider than a third of it."""
PARTS = 3

NoRange: TypeAlias = Literal["no_distance", "short_way", "charged", "little_used"]


@described
class Charge:
    """What was used of the charge, and how far the rest goes on a ride like this one.

    The estimate says nothing of another road, wind or mode.
    """

    soc_pct_first: float
    soc_pct_last: float
    used_pct: float
    """What it fell by, summed up: more than a full charge where the battery was changed."""
    jumps: tuple[ChargeJump, ...]
    step_pct: float
    """The finest change that the reading shows."""
    range_km: float | None
    """With the charge left at the end."""
    range_km_least: float | None
    range_km_most: float | None
    """Null where the leanest third of the distance took nothing."""
    full_range_km: float | None
    """Of a whole charge on a ride like this one."""
    refused: NoRange | None
    """Why there is no range."""


def charge_of(
    soc_pct: Values,
    battery_w: Values | None,
    start_s: Values,
    seconds: Values,
    step_m: Values | None,
) -> Charge | None:
    """Of rows (n,), missing as NaN; None without a reading of the charge.

    battery_w: battery power. start_s, seconds: when each row begins and how long it holds. step_m:
    metres of each row.
    """
    use = charge_use(soc_pct, start_s)
    if use is None:
        return None
    changes = np.abs(np.diff(soc_pct[np.isfinite(soc_pct)]))
    changes = changes[changes > 1e-9]
    step = float(changes.min()) if len(changes) else 0.0
    km = None if step_m is None else float(step_m.sum()) / 1000.0
    refused = refusal(use, step, km)
    known = (use.first_pct, use.last_pct, use.used_pct, use.jumps, step)
    if refused or step_m is None or km is None:
        return Charge(*known, None, None, None, None, refused)
    shares = thirds(use, battery_w, start_s, seconds, step_m)
    most = (use.used_pct - step) * min(shares)
    return Charge(
        *known,
        range_km=use.last_pct * km / use.used_pct,
        range_km_least=use.last_pct * km / ((use.used_pct + step) * max(shares)),
        range_km_most=use.last_pct * km / most if most > 0.0 else None,
        full_range_km=100.0 * km / use.used_pct,
        refused=None,
    )


def refusal(use: ChargeUse, step_pct: float, km: float | None) -> NoRange | None:
    """Why no range can be estimated."""
    if km is None:
        return "no_distance"
    if km < DISTANCE_KM_MIN:
        return "short_way"
    if use.used_pct >= max(USED_PCT_MIN, 2 * step_pct):
        return None
    return "charged" if use.jumps else "little_used"


def thirds(
    use: ChargeUse, battery_w: Values | None, start_s: Values, seconds: Values, step_m: Values
) -> list[float]:
    """What each third of the distance took, over the mean: by battery power, else by the charge."""
    part = np.minimum(np.cumsum(step_m) / step_m.sum() * PARTS, PARTS - 1e-9).astype(np.intp)
    if battery_w is not None and np.isfinite(battery_w).any():
        work = np.where(np.isfinite(battery_w), battery_w, 0.0) * seconds / SECONDS_PER_HOUR
        work_wh = np.bincount(part, work, minlength=PARTS)
        if work_wh.sum() > 0.0:
            return [float(wh) * PARTS / float(work_wh.sum()) for wh in work_wh]
    ends_s = start_s[np.searchsorted(part, np.arange(1, PARTS))]
    used = np.interp(ends_s, use.at_s, use.used_so_far_pct)
    return [
        float(share) * PARTS / use.used_pct
        for share in np.diff(np.concatenate(([0.0], used, [use.used_pct])))
    ]
