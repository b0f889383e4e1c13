"""Goal: a unit whose flash holds a table from before points had a least distance keeps its
configuration, with the points moved just far enough apart.

Method: a slot is written as the earlier firmware did, the denormal table that it took in it, and
the unit boots from it. What is expected is counted from the registry's least steps by hand.
"""

from typing import Any

import numpy as np
import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import parameters
from firmware_protocol._generated import (
    Event,
    EvtFaultListRequest,
    EvtFaultListResponse,
)
from firmware_protocol.parameters import default_config, violations
from tests.fakes.bench_unit import BenchUnit
from tests.fakes.config_flash import items_of, slot


def boot_with(config: dict[str, Any]) -> BenchUnit:
    """A unit whose first slot holds this image."""
    unit = BenchUnit()
    stored = bytes(slot(items_of(parameters.pack_image(config)), generation=1))
    unit.flash()[: len(stored)] = np.frombuffer(stored, np.uint8)
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


def test_points_out_of_range_and_too_near_are_put_right_and_told() -> None:
    unit = boot_with({**default_config(), "fuzzy_gain_points": [0.1, 0.2, 0.2, 0.4, 0.6]})

    told = [event.message for event in unit.events if event.code == Event.CONFIG_CONVERTED]
    assert len(told) == 1
    config = unit.config()
    assert config.pop("fuzzy_gain_points") == pytest.approx([0.1, 0.2, 0.201, 0.4, 0.5], abs=2e-6)
    expected = default_config()
    del expected["fuzzy_gain_points"]
    assert config == expected
    faults = unit.ask(EvtFaultListRequest()).message
    assert isinstance(faults, EvtFaultListResponse)
    assert faults.fault_flags == 0
