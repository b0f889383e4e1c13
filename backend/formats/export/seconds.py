"""A ride second by second, as the formats of bike computers have it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.ride import TimesUs

# What stands at a second's end rather than on its average: counters, places, states.
LAST = frozenset({"distance_m", "latitude_deg", "longitude_deg", "battery_soc_pct", "assist_mode"})
SECOND_US = 1_000_000


@dataclass(frozen=True)
class BySecond:
    """unix_s: int64 (n,), the seconds that have a row. values: by channel, float64 (n,)."""

    unix_s: npt.NDArray[np.int64]
    values: dict[str, Values]

    def __len__(self) -> int:
        return len(self.unix_s)

    def __getitem__(self, name: str) -> Values:
        """A channel, all missing where the ride has none."""
        return self.values.get(name, np.full(len(self), np.nan))


def by_second(started_us: int, times_us: TimesUs, values: Mapping[str, Values]) -> BySecond:
    """Rows (n,) to whole seconds: means of the samples that are there, so that energy stays.

    A second without any sample has no row: whoever reads the file shall see a gap, not a second
    in which nothing was measured.
    """
    second = (started_us + times_us) // SECOND_US
    starts = np.flatnonzero(np.diff(second, prepend=second[:1] - 1))
    means = {name: (last_of if name in LAST else mean_of)(v, starts) for name, v in values.items()}
    some = np.zeros(len(starts), np.bool_)
    for one in means.values():
        some |= np.isfinite(one)
    return BySecond(second[starts][some], {name: one[some] for name, one in means.items()})


def mean_of(values: Values, starts: npt.NDArray[np.intp]) -> Values:
    """Mean of each group of rows beginning at `starts`, NaN for a group without a sample."""
    valid = np.isfinite(values)
    sums = np.add.reduceat(np.where(valid, values, 0.0), starts)
    counts = np.add.reduceat(valid.astype(np.int64), starts)
    means: Values = np.full(len(starts), np.nan)
    np.divide(sums, counts, out=means, where=counts > 0)
    return means


def last_of(values: Values, starts: npt.NDArray[np.intp]) -> Values:
    """The last sample of each group, NaN for a group without one."""
    index = np.where(np.isfinite(values), np.arange(len(values)), -1)
    last = np.maximum.reduceat(index, starts)
    latest: Values = np.where(last >= starts, values[last], np.nan)
    return latest
