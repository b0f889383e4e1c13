"""Where a ride begins and ends, by its rows and not by how they came in frames; and the rows of
a unit's rides that never came, by where they were lost."""

from __future__ import annotations

import logging
from collections import Counter
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from backend.device.stream import LostBy, StreamBlock

Indices = npt.NDArray[np.intp]


def moving_rows(block: StreamBlock, above: dict[str, float]) -> Indices:
    """Which rows of the block move: ascending indices.

    above: channel name -> the value that at rest is not passed, in the channel's unit.
    """
    moving = np.zeros(len(block.values), np.bool_)
    for index, channel in enumerate(block.channels):
        if channel.name in above:
            moving |= block.values[:, index] > above[channel.name] / channel.scale
    return np.flatnonzero(moving)


def rows_until_still(
    moving: Indices, row_count: int, still_before: int, still_max: int
) -> int | None:
    """After how many of `row_count` rows the bike has stood for `still_max`; None: not in them.

    moving: which of them move, ascending. still_before: how many before them did not.
    """
    ends = np.concatenate(([-still_before], moving + 1)) + still_max
    next_moving = np.append(moving, row_count)
    over = ends[next_moving >= ends]
    return max(0, int(over[0])) if len(over) else None


def still_rows(moving: Indices, row_count: int, still_before: int) -> int:
    """How many rows have not moved since the last that did."""
    return row_count - 1 - int(moving[-1]) if len(moving) else still_before + row_count


def rows_after(block: StreamBlock, row_count: int) -> StreamBlock:
    """The block without its first rows."""
    return replace(
        block,
        t0_us=block.t0_us + row_count * block.period_us,
        first_index=block.first_index + row_count,
        values=block.values[row_count:],
        lost_rows_before=0 if row_count else block.lost_rows_before,
    )


LOG = logging.getLogger(__name__)

# So much of a ride is missing before a warning: a single damaged frame needs none.
MISSING_S_MIN = 1.0
LOST_BY_WORDS = {
    LostBy.MACHINE: "this computer is too busy to read the unit's port in time. End what else runs "
    "on it, or connect fewer units",
    LostBy.LINE: "the line damages or interrupts them. Look at cable, adapter and connectors",
    LostBy.UNIT: "the unit does not send them: the line is slower than the stream, or the unit is "
    "too busy to measure. Raise the line's rate",
}


class MissingRows:
    """Of the latest ride of one unit. Read by those that must not wait for its recorder.

    rows: how many there are. most: where most of them were lost and how many there are, once they
    are worth telling, else None.
    """

    def __init__(self, device_id: str) -> None:
        self._device_id = device_id
        self._by_place: Counter[LostBy] = Counter()
        self.rows = 0
        self.most: tuple[LostBy, int] | None = None

    def begin(self) -> None:
        """Another ride begins."""
        self._by_place.clear()
        self.rows, self.most = 0, None

    def add(self, lost_by: LostBy, rows: int, period_us: int) -> None:
        """Count rows; in the log once a ride."""
        self._by_place[lost_by] += rows
        self.rows += rows
        if self.rows * period_us < MISSING_S_MIN * 1e6:
            return
        place = self._by_place.most_common(1)[0][0]
        if self.most is None:
            words = LOST_BY_WORDS[place]
            LOG.warning("Unit %s: rows of its ride are missing: %s.", self._device_id, words)
        self.most = (place, self.rows)
