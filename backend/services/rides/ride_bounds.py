"""Where a ride begins and ends, told from its rows and not from how they came in frames."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from backend.device.stream import StreamBlock

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
