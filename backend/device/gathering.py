"""Blocks of a few rows become larger ones: what is done for each block costs as much as for a
hundred rows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from backend.device.stream import StreamBlock

# Of the unit's time: a quarter of what a tail has.
GATHER_US = 250_000


class Gathering:
    """Blocks of one unit that follow one another, until enough of them have come. One that follows
    none, as after a gap, does not wait."""

    def __init__(self) -> None:
        self._blocks: list[StreamBlock] = []
        self._rows = 0
        self._last: StreamBlock | None = None

    def add(self, block: StreamBlock) -> list[StreamBlock]:
        """Blocks that are due with this one, oldest first."""
        last, self._last = self._last, block
        if last is None or not follows(last, block):
            return [*self.take(), block]
        self._blocks.append(block)
        self._rows += len(block.values)
        return self.take() if self._rows * block.period_us >= GATHER_US else []

    def take(self) -> list[StreamBlock]:
        """What has come so far, as one block, or nothing. Its wall time is that of its first."""
        blocks, self._blocks, self._rows = self._blocks, [], 0
        if len(blocks) < 2:
            return blocks
        return [replace(blocks[0], values=np.concatenate([block.values for block in blocks]))]


def follows(last: StreamBlock, block: StreamBlock) -> bool:
    """Whether a block's first row is the one after the last of another, of the same kind."""
    due_us = last.t0_us + len(last.values) * last.period_us
    return (
        block.epoch == last.epoch
        and block.first_index == last.first_index + len(last.values)
        and block.lost_rows_before == 0
        and abs(block.t0_us - due_us) < block.period_us
        and block.channels == last.channels
        and block.period_us == last.period_us
    )
