"""Goal: a value can be tried while riding without touching flash, CRC or anybody's configuration.

Method: real firmware on the bench board; flash steps are counted, the law's output is looked at.
"""

import struct

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import parameters
from firmware_protocol._generated import (
    PARAMETER_BY_NAME,
    Access,
    CfgStatusRequest,
    LiveSetRequest,
    ParamGetRequest,
    ParamGetResponse,
    Status,
)
from firmware_protocol.layout import Value
from tests.fakes.bench_unit import BenchUnit

TTL_S = 5


def live(unit: BenchUnit, changes: dict[str, Value], ttl_s: int = TTL_S) -> Status | int:
    (items,) = parameters.set_items(changes)
    return unit.ask(LiveSetRequest(ttl_s, items)).status


def in_force(unit: BenchUnit, name: str) -> float:
    ids = struct.pack("<H", PARAMETER_BY_NAME[name].id)
    message = unit.ask(ParamGetRequest(ids)).message
    assert isinstance(message, ParamGetResponse)
    return float(struct.unpack("<f", message.items[4:])[0])


def test_a_live_value_is_in_force_and_in_no_configuration(unit: BenchUnit) -> None:
    active = unit.read_image()
    unit.boot()

    assert live(unit, {"assist_cutoff_kmh": 12.0}) == Status.OK

    assert in_force(unit, "assist_cutoff_kmh") == 12.0
    assert unit.read_image() == active
    assert lib.bench_flash_steps(unit.board) == 0


def test_the_law_runs_on_live_values_until_their_time_is_over(unit: BenchUnit) -> None:
    unit.inputs(
        mode_selected=2, cadence_rpm=60.0, crank_angle_deg=90.0, torque_raw_counts=2000.0,
        speed_kmh=10.0, motor_speed_rpm=2420.0,
    )  # fmt: skip
    unit.advance(10.0)
    usual = unit.output().motor_torque_nm
    assert usual > 0.0

    live(unit, {"motor_torque_nm_max": 0.0})
    unit.advance(1.0)
    tried = unit.output().motor_torque_nm
    unit.advance(TTL_S + 5.0)

    assert tried == 0.0
    assert unit.output().motor_torque_nm == pytest.approx(usual, rel=0.001)


def test_every_live_set_renews_the_time_of_all(unit: BenchUnit) -> None:
    live(unit, {"assist_cutoff_kmh": 12.0})
    unit.advance(TTL_S - 1)
    live(unit, {"torque_filter_s": 0.2})
    unit.advance(TTL_S - 1)

    assert in_force(unit, "assist_cutoff_kmh") == 12.0
    assert unit.ask(CfgStatusRequest()).message.live_left_ms == pytest.approx(1000, abs=10)
    unit.advance(1.0)
    assert in_force(unit, "assist_cutoff_kmh") == 25.0


def test_a_time_of_zero_ends_live_values_now(unit: BenchUnit) -> None:
    live(unit, {"assist_cutoff_kmh": 12.0})

    assert unit.ask(LiveSetRequest(0, b"")).status == Status.OK

    assert in_force(unit, "assist_cutoff_kmh") == 25.0


@pytest.mark.parametrize(
    ("changes", "status"),
    [
        ({"assist_cutoff_kmh": 25.5}, Status.RANGE),
        ({"gear_ratio": 30.0}, Status.ACCESS),
        ({"fixed_taper_end_kmh": 10.0}, Status.INVALID_CONFIG),
    ],
)
def test_a_live_value_obeys_the_same_rules_as_a_lasting_one(
    unit: BenchUnit, changes: dict[str, Value], status: Status
) -> None:
    live(unit, {"torque_filter_s": 0.25})

    response = unit.ask(LiveSetRequest(TTL_S, parameters.set_items(changes)[0]))

    assert response.status == status
    if status == Status.ACCESS:
        assert response.detail == Access.FACTORY
    assert in_force(unit, "torque_filter_s") == 0.25


def test_a_commit_ends_live_values_and_does_not_contain_them(unit: BenchUnit) -> None:
    live(unit, {"assist_cutoff_kmh": 12.0})

    unit.write({"torque_filter_s": 0.25})

    assert in_force(unit, "assist_cutoff_kmh") == 25.0
    assert unit.config()["assist_cutoff_kmh"] == 25.0


def test_parameters_are_asked_for_by_id(unit: BenchUnit) -> None:
    unknown = unit.ask(ParamGetRequest(b"\xee\xee"))
    odd = unit.ask(ParamGetRequest(b"\x01"))
    ids = [struct.pack("<H", row.id) for row in PARAMETER_BY_NAME.values()]

    assert (unknown.status, unknown.detail) == (Status.UNKNOWN_ID, 0xEEEE)
    assert odd.status == Status.LENGTH
    halves = (b"".join(ids[:20]), b"".join(ids[20:]))
    whole = b"".join(unit.ask(ParamGetRequest(half)).message.items for half in halves)
    assert whole == b"".join(parameters.set_items(unit.config(), 4096))
