"""Goal: on an emulated board the bike has done every step of the time that has passed, before more
is granted; otherwise the next control step would see the sensors of the last.

Method: the board runs beside its bench, so it may go on between any two looks at it. Here is one
that goes on as soon as it has been looked at: the worst there can be.
"""

from __future__ import annotations

import pytest

from sim_device.emulated import EmulatedUnit, Registers
from sim_device.lockstep import LockstepUnit

PIECE_S = 0.010


class HastyBoard(Registers):
    """Does a control step and passes all the time it was granted behind every look."""

    def __init__(self) -> None:
        self.done_steps = 0
        self.counted_steps = 0
        self.steps_behind_a_grant: list[int] = []
        self._granted = 0
        self._passed = 0

    def wait(self, wait_s: float) -> None:
        """Nobody rings; it is looked at all the same."""

    def steps(self) -> int:
        new = self.done_steps - self.counted_steps
        self.counted_steps = self.done_steps
        self._go_on()
        return new

    def decided(self, length: int) -> tuple[bytes, int]:
        return bytes(length), 0

    def request(self) -> tuple[int, bytes] | None:
        self._go_on()
        return None

    def tell(self, inputs: bytes, has_clock: bool, granted_us: int) -> None:
        if granted_us:
            self.steps_behind_a_grant.append(self.done_steps - self.counted_steps)
            self._granted += 1

    @property
    def granted_time_is_left(self) -> bool:
        left = self._passed < self._granted
        self._go_on()
        return left

    def _go_on(self) -> None:
        if self._passed < self._granted:
            self.done_steps += 1
            self._passed = self._granted


def test_no_time_is_granted_before_the_bike_has_done_every_step_of_what_has_passed() -> None:
    bike = LockstepUnit(clock="virtual", bike_alone=True)
    board = HastyBoard()
    unit = EmulatedUnit(bike, board, now_s=0.0)
    before_s = bike.observe()["t_s"]
    bike.simulation_set({"advance_s": 50 * PIECE_S})

    for _ in range(500):
        unit.serve(now_s=0.0, wait_s=0.0)

    assert len(board.steps_behind_a_grant) == 50
    assert set(board.steps_behind_a_grant) == {0}
    assert board.counted_steps == 50
    assert bike.observe()["t_s"] - before_s == pytest.approx(50 * PIECE_S)
