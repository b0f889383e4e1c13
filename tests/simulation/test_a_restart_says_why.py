"""Goal: a unit that stopped itself under way is connected again, and its host knows why it started.

Method: the host's session against the unit's C on a virtual clock; the firmware is hung beside it.
A firmware from before START_INFO is the fake one, which refuses what it does not know.
"""

from __future__ import annotations

import pytest

from backend.device.states import Identity, LinkState
from sim_device.lockstep import LockstepUnit
from tests.fakes.bench import Bench
from tests.fakes.simulated_unit import LockstepAsUnit
from tests.fakes.unit import FakeUnit


def identity(bench: Bench) -> Identity:
    assert bench.session.handshake is not None
    return bench.session.handshake.identity


@pytest.mark.parametrize(("steps", "cause"), [(False, "watchdog"), (True, "deadline")])
def test_a_unit_that_hung_is_greeted_again_with_its_cause_and_its_fault(
    steps: bool, cause: str
) -> None:
    unit = LockstepUnit(seed=1)
    bench = Bench(LockstepAsUnit(unit)).connect()
    before = identity(bench)
    assert before.reset_cause == "power_on"

    unit.unit.hang(steps=True, polls=not steps)
    bench.run_until(lambda: identity(bench).boot_id != before.boot_id)
    bench.run_until(lambda: bench.session.state is LinkState.READY)

    assert identity(bench).reset_cause == cause
    assert bench.session.unit_state.faults_active == ("safe_stop",)


def test_a_firmware_that_cannot_tell_is_connected_all_the_same() -> None:
    bench = Bench(FakeUnit()).connect()

    assert bench.session.state is LinkState.READY
    assert identity(bench).reset_cause is None
