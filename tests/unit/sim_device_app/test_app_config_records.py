"""Goal: what lies in flash is this unit's own configuration, another firmware's read by ids, or
told as lost; never another market, another limit or full assist without a word.

Method: flash written by hand from SPEC.md's description (tests/fakes/config_flash.py), and every
single bit of it flipped (of which `make test` flips every eleventh). A unit is asked for its
configuration, its faults and what its motor does at a speed above a walking pace.
"""

import struct

import numpy as np
import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import parameters
from firmware_protocol._generated import (
    PARAMETER_BY_NAME,
    Access,
    Event,
    EvtFaultClearRequest,
    FaultFlags,
    Status,
)
from tests import counts
from tests.fakes.bench_unit import FLASH_BLOCK_BYTES, BenchUnit
from tests.fakes.config_flash import AT_COPY, AT_RECORDS, Item, items_of, records_at, slot
from tests.fakes.maker import Maker, challenged, commit, provision, respond, staged

JAPAN = {"market": "japan", "assist_cutoff_kmh": 18.0, "sensor_offset_counts": 120.0}
UNKNOWN_ID = 0x7F00
NOTCHED = 400.0
WALKING_KMH = 6.0
ENOUGH_S = 1.5
WORDS_BYTES = 12
AT_GENERATION = 8


def image_with(**changes: object) -> bytes:
    return parameters.pack_image(parameters.default_config() | changes)


def a_unit(first: bytes, second: bytes = b"") -> BenchUnit:
    """A unit whose flash holds these slots."""
    unit = BenchUnit(provisioned=False)
    lay(unit, first, second)
    return unit


def lay(unit: BenchUnit, first: bytes, second: bytes = b"") -> None:
    unit.flash()[:] = 0xFF
    for at, data in ((0, first), (FLASH_BLOCK_BYTES, second)):
        unit.flash()[at : at + len(data)] = np.frombuffer(bytes(data), np.uint8)
    unit.boot()


def converted(unit: BenchUnit) -> tuple[int, int, int] | None:
    """Added, dropped, clamped, if the unit told of any."""
    unit.advance(0.01)
    for event in unit.events:
        if event.code == Event.CONFIG_CONVERTED:
            told = event.message
            return told.added, told.dropped, told.clamped
    return None


def assist_at(unit: BenchUnit, speed_kmh: float) -> float:
    """The largest torque of the motor while somebody pedals hard at this speed."""
    unit.inputs(
        torque_raw_counts=unit.config()["sensor_offset_counts"] + NOTCHED * 10,
        speed_kmh=speed_kmh,
        cadence_rpm=60.0,
        motor_speed_rpm=1500.0,
        mode_selected=2,
    )
    unit.advance(ENOUGH_S)
    return float(lib.bench_motor_torque_nm(unit.board))


def test_a_slot_as_it_is_described_is_what_a_unit_writes() -> None:
    unit = BenchUnit()
    written = bytes(unit.flash()[:FLASH_BLOCK_BYTES])
    image = unit.read_image()[1]

    mine = slot(items_of(image), generation=1)

    assert written[: len(mine)] == bytes(mine)
    assert set(written[len(mine) :]) == {0xFF}


def test_an_image_of_the_same_layout_is_read_without_a_word() -> None:
    unit = a_unit(slot(items_of(image_with(**JAPAN)), 5))

    assert unit.read_image() == (5, image_with(**JAPAN))
    assert (converted(unit), unit.faults()) == (None, 0)


def test_an_image_with_other_parameters_is_read_by_their_ids() -> None:
    """One that this firmware has is missing, one that it lacks is there, one is too large."""
    gone = PARAMETER_BY_NAME["walk_speed_kmh"].id
    torque = PARAMETER_BY_NAME["motor_torque_nm_max"]
    items = [item for item in items_of(image_with(**JAPAN)) if item.id not in (gone, torque.id)]
    items += [
        Item(torque.id, 1, 4, struct.pack("<f", 3.5)),
        Item(UNKNOWN_ID, 2, 4, bytes(8)),
    ]

    unit = a_unit(slot(items, 7))

    assert converted(unit) == (1, 1, 1)
    assert unit.faults() == 0
    assert unit.config() == parameters.default_config() | JAPAN
    assert assist_at(unit, 17.0) > 0.0


def test_it_goes_up_and_down_between_two_firmwares_and_keeps_what_both_know() -> None:
    """What another firmware wrote is changed here and read again; the unknown value is gone."""
    unit = a_unit(slot([*items_of(image_with(**JAPAN)), Item(UNKNOWN_ID, 1, 4, bytes(4))], 3))

    assert unit.write({"mode_ratios": (0.0, 0.25, 0.5, 1.0, 1.5)}).status == Status.OK
    unit.boot()

    assert unit.read_image()[0] == 4
    assert unit.config()["sensor_offset_counts"] == 120.0
    assert unit.config()["market"] == "japan"
    assert converted(unit) is None


def test_values_that_break_a_rule_together_get_their_defaults_and_it_is_told() -> None:
    default = parameters.default_config()
    turned = image_with(fixed_taper_start_kmh=24.0, fixed_taper_end_kmh=10.0)

    unit = a_unit(slot(items_of(turned), 2))

    assert converted(unit) is not None
    assert unit.config()["fixed_taper_start_kmh"] == default["fixed_taper_start_kmh"]
    assert unit.config()["fixed_taper_end_kmh"] == default["fixed_taper_end_kmh"]
    assert unit.faults() == 0


def test_a_market_this_firmware_does_not_know_is_not_taken_for_another() -> None:
    market = PARAMETER_BY_NAME["market"].id
    items = [item for item in items_of(image_with(**JAPAN)) if item.id != market]

    unit = a_unit(slot([*items, Item(market, 1, 1, bytes([77]))], 2))

    assert unit.faults() == FaultFlags.CONFIG_DEFAULTED
    assert assist_at(unit, 3.0) == 0.0


def told_or_same(unit: BenchUnit, before: tuple[int, bytes]) -> bool:
    """The configuration is what it was, or the unit says that it is not and holds back."""
    if unit.read_image() == before and unit.faults() == 0:
        return True
    assert unit.faults() & FaultFlags.CONFIG_DEFAULTED
    assert Event.CONFIG_DEFAULTED in [event.code for event in unit.events]
    return assist_at(unit, 10.0) == 0.0


@pytest.mark.large_count
@pytest.mark.board_long
@pytest.mark.parametrize("copies", [1, 2], ids=["one copy", "two copies"])
@pytest.mark.slow
def test_no_flipped_bit_of_a_slot_changes_anything_without_a_word(copies: int) -> None:
    new = slot(items_of(image_with(**JAPAN)), 2)
    old = slot(items_of(image_with()), 1) if copies == 2 else b""
    unit = a_unit(new, old)
    before = unit.read_image()
    flips_felt = []

    for bit in range(0, 8 * (len(new) + len(old)), counts.stride()):
        place = bit // 8 if bit // 8 < len(new) else FLASH_BLOCK_BYTES + bit // 8 - len(new)
        lay(unit, new, old)
        unit.flash()[place] ^= np.uint8(1 << bit % 8)
        unit.boot()
        assert told_or_same(unit, before), (place, bit % 8)
        if unit.faults():
            flips_felt.append(place)

    # The header is there twice; a record that was changed since has no twin.
    assert flips_felt
    assert min(flips_felt) >= AT_RECORDS
    assert max(flips_felt) < len(new)


def test_a_newer_slot_that_cannot_be_read_is_reported_and_holds_assist_back() -> None:
    unit = BenchUnit(provisioned=False)
    newer = slot(items_of(image_with(**JAPAN)), 2)
    for at in (AT_GENERATION, AT_COPY + AT_GENERATION):
        newer[at] ^= 1

    lay(unit, newer, slot(items_of(image_with()), 1))

    assert unit.faults() & FaultFlags.CONFIG_DEFAULTED
    assert assist_at(unit, 10.0) == 0.0


@pytest.mark.parametrize("record", ["MARKET", "FACTORY", "CALIBRATION", "TUNABLE"])
def test_a_record_that_did_not_change_is_taken_from_its_twin(record: str) -> None:
    unit = BenchUnit()
    unit.write({"assist_cutoff_kmh": 20.0, "sensor_offset_counts": 55.0})
    unit.write({"assist_cutoff_kmh": 19.0})
    before = unit.read_image()

    unit.flash()[records_at(unit.flash())[record][6]] ^= np.uint8(4)
    unit.boot()

    if record == "TUNABLE":
        assert unit.faults() == FaultFlags.CONFIG_DEFAULTED
    else:
        assert (unit.read_image(), unit.faults()) == (before, 0)


def test_lost_settings_mean_walking_pace_until_a_dealer_writes_them() -> None:
    unit = BenchUnit()
    unit.flash()[records_at(unit.flash())["TUNABLE"][20]] ^= np.uint8(1)
    unit.boot()

    assert unit.faults() == FaultFlags.CONFIG_DEFAULTED
    assert assist_at(unit, 4.0) > 0.0
    assert assist_at(unit, WALKING_KMH + 0.1) == 0.0
    unit.inputs(speed_kmh=0.0, cadence_rpm=0.0, motor_speed_rpm=0.0, torque_raw_counts=0.0)
    unit.advance(ENOUGH_S)
    still = unit.ask(EvtFaultClearRequest(0xFFFFFFFF)).message
    assert still.fault_flags == FaultFlags.CONFIG_DEFAULTED

    assert unit.write({}).status == Status.OK

    assert unit.faults() == 0
    assert assist_at(unit, 15.0) > 0.0
    unit.boot()
    assert unit.faults() == 0


def test_a_lost_calibration_becomes_what_the_factory_measured() -> None:
    measured = image_with(sensor_offset_counts_factory=300.0, sensor_offset_counts=310.0)
    unit = a_unit(slot(items_of(measured), 1))
    unit.flash()[records_at(unit.flash())["CALIBRATION"][5]] ^= np.uint8(1)
    unit.boot()

    assert unit.config()["sensor_offset_counts"] == 300.0
    assert unit.faults() == FaultFlags.CONFIG_DEFAULTED
    assert assist_at(unit, WALKING_KMH + 0.1) == 0.0


@pytest.mark.parametrize("record", ["MARKET", "FACTORY"])
def test_what_the_maker_chose_is_not_written_anew_by_a_dealer(record: str) -> None:
    maker = Maker()
    unit = BenchUnit()
    provision(unit, maker)
    unit.flash()[records_at(unit.flash())[record][5]] ^= np.uint8(1)
    unit.boot()
    assert unit.faults() == FaultFlags.CONFIG_DEFAULTED

    refused = unit.write({"assist_cutoff_kmh": 20.0})
    assert (refused.status, refused.detail) == (Status.ACCESS, Access.FACTORY)
    unit.advance(31.0)
    transaction, image = staged(unit, {"market": "china"})
    token = maker.sign(challenged(unit, Access.FACTORY, image))
    assert respond(unit, transaction, token).status == Status.OK
    assert commit(unit, transaction, image).status == Status.OK

    assert unit.faults() == 0
    unit.boot()
    assert (unit.config()["market"], unit.faults()) == ("china", 0)


def test_a_newer_slot_that_cannot_be_read_at_all_leaves_the_older_one_at_a_walking_pace() -> None:
    unit = BenchUnit()
    unit.write({"assist_cutoff_kmh": 12.0})
    factory = unit.flash()[FLASH_BLOCK_BYTES : FLASH_BLOCK_BYTES + AT_RECORDS]
    factory[[1, 70]] ^= np.uint8(1)
    unit.boot()

    assert unit.read_image()[0] == 1
    assert unit.faults() == FaultFlags.CONFIG_DEFAULTED
    assert assist_at(unit, 10.0) == 0.0


def test_a_unit_that_was_never_provisioned_gives_no_assist() -> None:
    unit = BenchUnit(provisioned=False)

    assert unit.faults() == FaultFlags.NOT_PROVISIONED
    assert assist_at(unit, 3.0) == 0.0
    unit.inputs(speed_kmh=0.0, cadence_rpm=0.0, motor_speed_rpm=0.0, torque_raw_counts=0.0)
    unit.advance(ENOUGH_S)
    assert unit.ask(EvtFaultClearRequest(0xFFFFFFFF)).message.fault_flags != 0
    refused = unit.write({"assist_cutoff_kmh": 20.0})
    assert (refused.status, refused.detail) == (Status.ACCESS, Access.FACTORY)


@pytest.mark.board_long
def test_a_factory_that_loses_power_may_begin_again() -> None:
    whole = BenchUnit()
    assert lib.bench_provision(whole.board) == 0
    writing = len(slot(items_of(whole.read_image()[1]), 1)) - WORDS_BYTES
    for steps in range(0, FLASH_BLOCK_BYTES + writing, 7):
        unit = BenchUnit(provisioned=False)
        lib.bench_flash_cut_after(unit.board, steps)
        done = lib.bench_provision(unit.board)
        unit.boot()
        assert done != 0
        assert unit.faults() == FaultFlags.NOT_PROVISIONED

        assert lib.bench_provision(unit.board) == 0
        unit.boot()

        assert (unit.faults(), unit.read_image()[0]) == (0, 1)
