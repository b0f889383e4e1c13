"""Goal: the unit keeps a calibration with its temperatures, and none is a value where it may be.

Method: a unit on the bench, the configuration's transaction by hand. NaN 0x7FC00000 is none (SPEC
3); what a sensor as drawn does with temperature is thesis_checks 6.
"""

import struct
from typing import Any

import numpy as np
import pytest

from firmware_protocol._generated import (
    CHANNEL_BY_NAME,
    PARAMETER_BY_NAME,
    CfgSetRequest,
    FaultFlags,
    LiveSetRequest,
    Status,
    StrSubscribeRequest,
)
from tests.fakes.bench_unit import BenchUnit
from tests.fakes.config_flash import records_at

NONE_BITS = 0x7FC00000
AS_DRAWN = {
    "sensor_offset_counts_per_k": 2.0,
    "sensor_gain_share_per_k": pytest.approx(-2e-4),
    "sensor_reference_degc": 20.0,
}
RECORD: dict[str, Any] = {
    "sensor_offset_counts_per_k": None,
    "sensor_gain_share_per_k": -0.0003,
    "sensor_reference_degc": 24.25,
    "calibrated_at_utc_s": 0xFFFFFFFF,
    "calibration_number": 70000,
    "calibration_certificate": [1, 2, 3, 4, 252, 253, 254, 255],
}


def float_item(name: str, bits: int) -> bytes:
    return struct.pack("<HBBI", PARAMETER_BY_NAME[name].id, 0, 1, bits)


def told_of(unit: BenchUnit, names: Any) -> dict[str, Any]:
    config = unit.config()
    return {name: config[name] for name in names}


def test_a_record_is_kept_over_a_restart_with_what_is_none() -> None:
    unit = BenchUnit()

    assert unit.write(RECORD).status == Status.OK
    unit.boot()

    assert told_of(unit, RECORD) == RECORD
    assert unit.faults() == 0


@pytest.mark.parametrize("bits", [NONE_BITS | 1 << 31, NONE_BITS + 1, 0x7F800001, 0x7F800000])
def test_no_other_nan_and_no_infinity_is_taken(bits: int) -> None:
    unit = BenchUnit()
    transaction = unit.begin()
    item = float_item("sensor_reference_degc", bits)

    assert unit.ask(CfgSetRequest(transaction, item)).status == Status.RANGE
    assert unit.ask(LiveSetRequest(5, item)).status == Status.RANGE


def test_what_may_not_be_none_is_not() -> None:
    unit = BenchUnit()
    item = float_item("sensor_gain_nm_per_count", NONE_BITS)

    assert unit.ask(CfgSetRequest(unit.begin(), item)).status == Status.RANGE


def test_a_lost_calibration_is_that_of_a_sensor_as_drawn() -> None:
    unit = BenchUnit()

    unit.flash()[records_at(unit.flash())["CALIBRATION"][5]] ^= np.uint8(1)
    unit.boot()

    assert told_of(unit, AS_DRAWN) == AS_DRAWN
    assert unit.faults() == FaultFlags.CONFIG_DEFAULTED


def test_reading_and_temperature_come_together_a_hundred_times_a_second() -> None:
    unit = BenchUnit()
    unit.write({name: AS_DRAWN[name] for name in AS_DRAWN} | {"sensor_gain_share_per_k": -2e-4})
    unit.inputs(torque_raw_counts=1020.0, torque_age_ms=0, sensor_temperature_degc=30.0)
    names = ("rider_torque_raw", "sensor_temperature_degc", "rider_torque_nm")
    ids = bytes(CHANNEL_BY_NAME[name].id for name in names)
    assert unit.ask(StrSubscribeRequest(1, 1, 5, 0, 255, ids)).status == Status.OK

    unit.advance(1.0)

    rows = np.concatenate([stream.values for stream in unit.streams])
    assert len(rows) == 100
    # 10 K above 20: 20 counts of zero, and 0.2 % less of the rest; Nm and degrees in hundredths.
    assert rows[-1].tolist() == [1020, 3000, 998]
