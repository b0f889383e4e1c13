"""Goal: a simulated unit whose firmware hangs pushes nobody, starts anew and says why.

Method: the host board on the virtual clock, its bike at work on the road, its loop stopped in whole
or in part; what the motor does is read from the physics beside it.
"""

from __future__ import annotations

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import codec, framing
from firmware_protocol._generated import BootEvent, FaultFlags, ResetCause
from sim_device.firmware.python.unit import Unit

RIDER_CONSTANT = 1


@pytest.fixture
def unit() -> Unit:
    unit = Unit(uid=b"hung-unit-01", boot_id=7, speed_kmh=12.0)
    unit.set_rider(lib.RIDER_CONSTANT, 40.0, 120.0)
    unit.advance_us(3_000_000)
    unit.transmit()
    assert motor_nm(unit) > 0.2
    return unit


def motor_nm(unit: Unit) -> float:
    return float(unit.observe(["motor_torque_nm"])["motor_torque_nm"])


def boots(unit: Unit) -> list[BootEvent]:
    frames = framing.FrameDecoder().feed(b"\0" + unit.transmit())
    messages = [getattr(codec.decode(frame), "message", None) for frame in frames]
    return [message for message in messages if isinstance(message, BootEvent)]


@pytest.mark.parametrize(
    ("hang", "cause"),
    [
        ({"steps": True, "polls": True}, ResetCause.WATCHDOG),
        ({"steps": False, "polls": True}, ResetCause.WATCHDOG),
        ({"steps": True, "polls": False}, ResetCause.DEADLINE),
    ],
    ids=str,
)
def test_a_hang_ends_with_the_motor_off_and_a_start_that_tells_why(
    unit: Unit, hang: dict[str, bool], cause: ResetCause
) -> None:
    unit.hang(**hang)
    unit.advance_us(30_000)
    let_go_nm = motor_nm(unit)
    unit.advance_us(290_000)

    (boot,) = boots(unit)
    assert boot.boot_id == 8
    assert boot.reset_cause == cause
    if hang["steps"]:
        assert let_go_nm == 0.0
    unit.advance_us(5_000_000)  # the rider pedals on
    assert motor_nm(unit) == 0.0
    assert unit.observe(["fault_flags"])["fault_flags"] & FaultFlags.SAFE_STOP


def test_the_motor_gives_nothing_between_the_hang_and_the_start(unit: Unit) -> None:
    unit.hang()
    torques = []
    for _ in range(500):
        unit.advance_us(1_000)
        torques.append(motor_nm(unit))

    assert max(torques[22:]) == 0.0


def test_a_supply_that_fails_leaves_no_torque_on_the_motor(unit: Unit) -> None:
    unit.cut_power_after(0)

    unit.advance_us(30_000)

    assert not unit.powered
    assert motor_nm(unit) == 0.0
