"""Stretches of a ride that its recording lacked and that came from the unit's own log.

A log has fewer rows than a recording. Each lies where it was taken, and holds until the next one;
nothing is made up between them. So a ride says of every stretch where its rows are from.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Literal

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.described import described

UNIT_LOG: Final = "unit_log"


@described
class Filled:
    """A stretch the recording lacked, filled from the unit's own log at the log's rate.

    Of the `rows_lost` rows in it `rows_filled` have samples now; nothing was interpolated.
    """

    from_s: float
    to_s: float
    rows_lost: int
    """Rows of the ride that lie in it."""
    rows_filled: int
    """So many of them have samples now."""
    period_us: int
    """Spacing of the source's rows."""
    source: Literal["unit_log"] = UNIT_LOG

    def rows(self, ride_period_us: int) -> tuple[int, int]:
        """First row and the one behind the last, of a ride with this spacing."""
        return row_at(self.from_s, ride_period_us), row_at(self.to_s, ride_period_us)


def row_at(time_s: float, period_us: int) -> int:
    """The row at a time since the ride's start."""
    return round(time_s * 1e6 / period_us)


def filled_mask(
    filled: Sequence[Filled], row_count: int, period_us: int | None
) -> npt.NDArray[np.bool_]:
    """Which rows (row_count,) lie in filled stretches."""
    mask = np.zeros(row_count, dtype=bool)
    for span in filled if period_us else ():
        start, stop = span.rows(period_us or 1)
        mask[start:stop] = True
    return mask


def filled_seconds(
    filled: Sequence[Filled], empty: npt.NDArray[np.bool_], period_us: int
) -> Values:
    """How long the sample of each row (n,) holds, in seconds.

    One period outside filled stretches; inside, a sample holds until the next and an empty row no
    time at all. empty: bool (n,), rows without any sample.
    """
    seconds = np.full(len(empty), period_us / 1e6)
    for span in filled:
        start, stop = span.rows(period_us)
        rows = start + np.flatnonzero(~empty[start:stop])
        seconds[start:stop] = 0.0
        seconds[rows] = np.diff(np.append(rows, stop)) * period_us / 1e6
    return seconds
