"""Minimum and maximum over fixed groups of rows, so that a long window costs no more than a short.

Level with step s: cell i covers rows [i*s, (i+1)*s). Minimum and maximum are of the samples that
are there; a cell without any is missing in both. Nothing is averaged, so no extreme is ever lost.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from backend.core.channels import ChannelSpec, Counts

# Finer than 128 costs more disk than it saves time: raw rows below it take some 15 ms a view.
STEPS = (128, 1024, 8192)


@dataclass(frozen=True)
class Level:
    """One level of the pyramid. minimum, maximum: by channel name, each (cells,) counts."""

    step: int
    channels: tuple[ChannelSpec, ...]
    minimum: Mapping[str, Counts]
    maximum: Mapping[str, Counts]


def reduce_groups(
    minimum: Counts, maximum: Counts, starts: np.ndarray[tuple[int], np.dtype[np.int64]]
) -> tuple[Counts, Counts]:
    """Minimum and maximum of the groups that begin at `starts` (strictly increasing, first 0).

    Missing is the smallest count of the type. It never wins a maximum; for the minimum it is
    taken as the largest number and turned back where the whole group was missing.
    """
    info = np.iinfo(minimum.dtype)
    high = np.maximum.reduceat(maximum, starts)
    hidden = np.where(minimum == info.min, np.asarray(info.max, minimum.dtype), minimum)
    low = np.minimum.reduceat(hidden, starts)
    return np.where(high == info.min, high, low), high


def first_level(counts: Counts, step: int) -> tuple[Counts, Counts]:
    """Minimum and maximum (cells,) of the rows (n,) in groups of `step`."""
    return reduce_groups(counts, counts, np.arange(0, len(counts), step))
