"""Goal: gathered blocks are the same rows at the same times, and none waits for long."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from backend.core.channels import ChannelSpec
from backend.device.gathering import GATHER_US, Gathering
from backend.device.stream import StreamBlock

PERIOD_US = 10_000
CHANNELS = (ChannelSpec("speed_kmh", "km/h", 0.01),)


def block(first: int, rows: int = 3, epoch: int = 1) -> StreamBlock:
    values = np.arange(first, first + rows, dtype=np.int16)[:, np.newaxis]
    return StreamBlock(
        first * PERIOD_US, PERIOD_US, first, values, 0, epoch, 1_000 + first, CHANNELS
    )


def test_rows_that_follow_one_another_come_together_unchanged() -> None:
    gathering = Gathering()
    due = [one for first in range(0, 300, 3) for one in gathering.add(block(first))]
    due += gathering.take()

    rows = np.concatenate([one.values for one in due])
    assert rows[:, 0].tolist() == list(range(300))
    assert all(one.t0_us == one.first_index * PERIOD_US for one in due)
    assert all(one.first_index == one.values[0, 0] for one in due)
    assert all(one.wall_us == 1_000 + one.first_index for one in due)
    assert len(due) < 15
    assert max(len(one.values) for one in due) * PERIOD_US < GATHER_US + 3 * PERIOD_US


def test_what_does_not_follow_does_not_wait_and_what_came_before_goes_first() -> None:
    odd = (
        replace(block(20), lost_rows_before=11),
        block(9, epoch=2),
        replace(block(9), t0_us=5_000_000),
        replace(block(9), period_us=2 * PERIOD_US),
        replace(block(9), channels=(ChannelSpec("cadence_rpm", "rpm", 1.0),)),
    )
    for other in odd:
        gathering = Gathering()
        gathering.add(block(0))
        assert [gathering.add(block(3)), gathering.add(block(6))] == [[], []]
        before, now = gathering.add(other)
        assert before.values[:, 0].tolist() == list(range(3, 9))
        assert now is other
        assert gathering.take() == []


def test_the_first_block_does_not_wait() -> None:
    first = block(0)
    assert Gathering().add(first)[0] is first
