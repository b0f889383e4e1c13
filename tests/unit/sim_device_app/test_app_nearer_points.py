"""Goal: a unit whose flash holds a table from before points had a least distance keeps its
configuration, with the points moved just far enough apart.

Method: a slot is written as the earlier firmware did, the denormal table that it took in it, and
the unit boots from it. What is expected is counted from the registry's least steps by hand.
"""

import struct
import zlib
from typing import Any

import numpy as np
import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import parameters
from firmware_protocol._generated import (
    EvtFaultListRequest,
    EvtFaultListResponse,
)
from firmware_protocol.parameters import default_config, violations
from tests.fakes.bench_unit import BenchUnit

AT_CRC, AT_LAYOUT, HEADER_LENGTH, AT_IMAGE = 4, 8, 24, 36
"""Of a slot, as config_store.c lays it out."""


def boot_with(config: dict[str, Any]) -> BenchUnit:
    """A unit whose first slot holds this image, whole by its own check value."""
    unit = BenchUnit()
    slot = unit.flash()
    image = parameters.pack_image(config)
    slot[AT_IMAGE : AT_IMAGE + len(image)] = np.frombuffer(image, np.uint8)
    crc = zlib.crc32(image, zlib.crc32(slot[AT_LAYOUT:HEADER_LENGTH].tobytes()))
    slot[AT_CRC : AT_CRC + 4] = np.frombuffer(struct.pack("<I", crc), np.uint8)
    unit.boot()
    unit.hello()
    return unit


@pytest.mark.parametrize(
    ("stored", "kept"),
    [
        ([0.0, 1.4e-45, 2.8e-45, 4.2e-45, 5.6e-45], [0.0, 0.001, 0.002, 0.003, 0.004]),
        ([0.1, 0.2, 0.2001, 0.4, 0.5], [0.1, 0.2, 0.201, 0.4, 0.5]),
        ([0.1, 0.2, 0.3, 0.49999, 0.5], [0.1, 0.2, 0.3, 0.499, 0.5]),
        ([0.49996, 0.49997, 0.49998, 0.49999, 0.5], [0.496, 0.497, 0.498, 0.499, 0.5]),
    ],
)
def test_an_earlier_firmwares_table_is_spread_and_nothing_else_is_lost(
    stored: list[float], kept: list[float]
) -> None:
    told = {**default_config(), "fuzzy_gain_points": stored, "sensor_offset_counts": -77.0}
    told["battery_current_a_max"] = 8.0

    unit = boot_with(told)

    config = unit.config()
    points = config.pop("fuzzy_gain_points")
    del told["fuzzy_gain_points"]
    assert points == pytest.approx(kept, abs=2e-6)
    assert config == told
    assert violations({**config, "fuzzy_gain_points": points}) == []
    faults = unit.ask(EvtFaultListRequest()).message
    assert isinstance(faults, EvtFaultListResponse)
    assert faults.fault_flags == 0


def test_the_table_that_once_gave_every_limits_maximum_assists_within_its_gain() -> None:
    denormal = [0.0, 1.4e-45, 2.8e-45, 4.2e-45, 5.6e-45]
    unit = boot_with(
        {**default_config(), "fuzzy_gain_points": denormal, "fuzzy_rules": [["NS"] * 5] * 5}
    )

    unit.inputs(torque_raw_counts=150.0, speed_kmh=12.0, cadence_rpm=60.0, motor_speed_rpm=1500.0)
    unit.inputs(battery_voltage_v=38.0, mode_selected=3)
    unit.advance(4.0)

    assert 0.0 < unit.output().fuzzy_gain < 0.004
    crank_nm = lib.bench_motor_torque_nm(unit.board) * 40.34
    assert crank_nm == pytest.approx(1.5, abs=0.02)  # the rider's own 1.5 Nm, at a ratio of 1


def test_an_image_that_is_wrong_in_another_way_is_not_touched() -> None:
    torn = {**default_config(), "fuzzy_gain_points": [0.1, 0.2, 0.2, 0.4, 0.6]}

    unit = boot_with(torn)

    assert unit.config() == default_config()
    faults = unit.ask(EvtFaultListRequest()).message
    assert isinstance(faults, EvtFaultListResponse)
    assert faults.fault_flags != 0
