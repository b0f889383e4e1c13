"""Goal: a fault keeps what the bike did when it came, and the unit's time can be told.

Method: real firmware on the bench board; sensors break at known inputs and at a known time.
"""

import numpy as np
import pytest

from firmware_protocol._generated import (
    CHANNELS,
    EvtFaultClearRequest,
    EvtFaultClearResponse,
    EvtFaultFreezeRequest,
    EvtFaultFreezeResponse,
    FaultFlags,
    Status,
    TimSetRequest,
    TimSyncRequest,
    TimSyncResponse,
)
from tests.fakes.bench_unit import BenchUnit

TORQUE_BIT = 0
BATTERY_BIT = 2
UNIX_US = 1_790_000_000_000_000


def frozen(unit: BenchUnit, bit: int = TORQUE_BIT) -> EvtFaultFreezeResponse:
    message = unit.ask(EvtFaultFreezeRequest(bit)).message
    assert isinstance(message, EvtFaultFreezeResponse)
    return message


def channel(frame: EvtFaultFreezeResponse, name: str) -> float:
    places = [row.name for row in CHANNELS]
    place = places.index(name)
    return float(np.frombuffer(frame.values, "<i2")[place] * CHANNELS[place].scale)


def break_torque_sensor(unit: BenchUnit) -> None:
    unit.inputs(torque_raw_counts=32767.0)
    unit.advance(0.5)


def mend_torque_sensor(unit: BenchUnit) -> None:
    unit.inputs(torque_raw_counts=0.0)
    unit.advance(2.0)


def test_a_fault_keeps_the_row_of_the_step_that_set_it(unit: BenchUnit) -> None:
    unit.inputs(speed_kmh=18.0, cadence_rpm=70.0)
    unit.advance(1.0)
    break_torque_sensor(unit)
    unit.inputs(speed_kmh=3.0)
    unit.advance(1.0)

    frame = frozen(unit)

    assert channel(frame, "speed_kmh") == pytest.approx(18.0)
    assert channel(frame, "cadence_rpm") == pytest.approx(70.0)
    assert channel(frame, "fault_flags") == FaultFlags.TORQUE_SENSOR
    assert (frame.active, frame.count) == (1, 1)
    # Ten bad steps of 10 ms make a fault.
    assert frame.t_us == pytest.approx(1_100_000, abs=20_000)


def test_the_latest_time_counts_and_how_often_it_came(unit: BenchUnit) -> None:
    for speed_kmh in (5.0, 10.0, 15.0):
        unit.inputs(speed_kmh=speed_kmh, battery_voltage_v=29.5)
        unit.advance(1.0)
        unit.inputs(battery_voltage_v=36.0)
        unit.advance(2.0)

    frame = frozen(unit, BATTERY_BIT)

    assert (frame.active, frame.count) == (0, 3)
    assert channel(frame, "speed_kmh") == pytest.approx(15.0)


@pytest.mark.parametrize("bit", [0, 1, 7, 255])
def test_a_fault_that_never_came_has_no_frame(unit: BenchUnit, bit: int) -> None:
    assert unit.ask(EvtFaultFreezeRequest(bit)).status == Status.NOT_FOUND


def test_clearing_forgets_what_is_over_and_keeps_what_is_not(unit: BenchUnit) -> None:
    break_torque_sensor(unit)

    still = unit.ask(EvtFaultClearRequest(0xFFFF)).message
    kept = frozen(unit)
    mend_torque_sensor(unit)
    over = unit.ask(EvtFaultClearRequest(0xFFFF)).message

    assert still == EvtFaultClearResponse(FaultFlags.TORQUE_SENSOR)
    assert kept.count == 1
    assert over == EvtFaultClearResponse(0)
    assert unit.ask(EvtFaultFreezeRequest(TORQUE_BIT)).status == Status.NOT_FOUND


def test_a_unit_without_a_configuration_has_a_frame_of_that() -> None:
    unit = BenchUnit(provisioned=False)

    assert frozen(unit, bit=16).count == 1


def sync(unit: BenchUnit, host_us: int) -> TimSyncResponse:
    message = unit.ask(TimSyncRequest(host_us)).message
    assert isinstance(message, TimSyncResponse)
    return message


def test_the_host_s_time_comes_back_with_the_unit_s(unit: BenchUnit) -> None:
    unit.advance(2.5)

    answer = sync(unit, 2**63 + 5)

    assert answer.host_us == 2**63 + 5
    assert answer.heard_us == answer.answered_us == pytest.approx(2_500_000, abs=1000)
    assert answer.unix_us == 0


def test_the_unit_keeps_the_time_of_the_world_until_it_is_switched_off(unit: BenchUnit) -> None:
    assert unit.ask(TimSetRequest(UNIX_US, 480, 2000)).status == Status.OK
    unit.advance(10.0)

    assert sync(unit, 1).unix_us == UNIX_US + 10_000_000
    unit.boot()
    assert sync(unit, 1).unix_us == 0


def test_a_time_before_the_unit_was_switched_on_is_refused(unit: BenchUnit) -> None:
    unit.advance(10.0)

    assert unit.ask(TimSetRequest(5, 0, 0)).status == Status.RANGE
