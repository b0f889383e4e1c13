"""Goal: a configuration changes as a whole, knowingly, and at a standstill, or not at all.

Method: real firmware on the bench board; what is active is read back through the wire and
compared with an image the host packed for itself.
"""

import math
import struct

import pytest
from sim_device.firmware.python._native import lib

from firmware_protocol import parameters
from firmware_protocol._generated import (
    IMAGE_LENGTH,
    PARAMETER_BY_NAME,
    Access,
    Bank,
    ByeRequest,
    CfgAbortRequest,
    CfgBeginRequest,
    CfgCommitRequest,
    CfgCommitResponse,
    CfgInfoRequest,
    CfgInfoResponse,
    CfgReadRequest,
    CfgSetRequest,
    CfgStagedCrcRequest,
    CfgStagedCrcResponse,
    CfgValidateRequest,
    ConfigState,
    Event,
    FaultFlags,
    LiveSetRequest,
    Status,
    Violation,
)
from firmware_protocol.layout import Value
from tests.fakes.bench_unit import BenchUnit, crc32
from tests.fakes.maker import Maker, provision, write_with_the_makers_word

CHANGES: dict[str, Value] = {
    "sensor_offset_counts": -123.5,
    "torque_rate_interval_ms": 250,
    "mode_names": ["aus", "sparsam", "tour", "sport", "élan"],
    "mode_laws": ["off", "fuzzy", "fixed", "fuzzy", "fuzzy"],
    "fuzzy_rules": [["NB"] * 5, ["NS"] * 5, ["ZO"] * 5, ["PS"] * 5, ["PB"] * 5],
    "fuzzy_inference": "weighted_average",
    "assist_cutoff_kmh": 20.0,
}


def item(name: str, values: bytes, first: int = 0, count: int = 1) -> bytes:
    return struct.pack("<HBB", PARAMETER_BY_NAME[name].id, first, count) + values


def float_item(name: str, value: float, first: int = 0) -> bytes:
    return item(name, struct.pack("<f", value), first)


def info(unit: BenchUnit) -> CfgInfoResponse:
    message = unit.ask(CfgInfoRequest()).message
    assert isinstance(message, CfgInfoResponse)
    return message


def test_what_is_written_is_what_is_read_back_now_and_after_the_next_start(
    unit: BenchUnit,
) -> None:
    generation_before = info(unit).generation

    response = unit.write(CHANGES)

    expected = parameters.pack_image(parameters.default_config() | CHANGES)
    commit = CfgCommitResponse(generation_before + 1, crc32(expected), ConfigState.IDLE)
    assert response.message == commit
    assert unit.read_image() == (generation_before + 1, expected)
    unit.boot()
    assert unit.read_image() == (generation_before + 1, expected)


def test_a_commit_is_announced_with_generation_and_check_value(unit: BenchUnit) -> None:
    unit.write(CHANGES)

    (event,) = [event for event in unit.events if event.code == Event.CONFIG_COMMITTED]
    assert event.fields == {"generation": 2, "crc32": crc32(unit.read_image()[1])}


def test_the_image_before_stays_readable(unit: BenchUnit) -> None:
    factory = unit.read_image()
    assert unit.ask(CfgReadRequest(Bank.PREVIOUS, 0, 99)).status == Status.NOT_FOUND

    unit.write(CHANGES)

    assert unit.read_image(Bank.PREVIOUS) == factory
    assert unit.read_image(Bank.DEFAULT)[1] == parameters.pack_image(parameters.default_config())


def test_reading_beyond_a_bank_or_no_bank_at_all_is_refused(unit: BenchUnit) -> None:
    assert unit.ask(CfgReadRequest(Bank.ACTIVE, IMAGE_LENGTH + 1, 1)).status == Status.RANGE
    assert unit.ask(CfgReadRequest(Bank.STAGED, 0, 1)).status == Status.NOT_FOUND
    assert unit.ask(CfgReadRequest(4, 0, 1)).status == Status.RANGE


def test_a_second_tool_with_an_old_base_is_told_that_it_is_stale(unit: BenchUnit) -> None:
    generation, image = unit.read_image()
    unit.write(CHANGES)

    response = unit.ask(CfgBeginRequest(generation, crc32(image)))

    assert (response.status, response.detail) == (Status.STALE_BASE, generation + 1)


def test_the_right_generation_with_other_contents_is_stale_too(unit: BenchUnit) -> None:
    generation, image = unit.read_image()

    response = unit.ask(CfgBeginRequest(generation, crc32(image) ^ 1))

    assert response.status == Status.STALE_BASE


def test_a_second_transaction_has_to_wait_for_the_first(unit: BenchUnit) -> None:
    unit.begin()
    generation, image = unit.read_image()
    unit.advance(10.0)

    response = unit.ask(CfgBeginRequest(generation, crc32(image)))

    assert (response.status, response.detail) == (Status.BUSY, 20)


def test_setting_changes_only_the_shadow(unit: BenchUnit) -> None:
    active = unit.read_image()
    transaction = unit.begin()

    staged = unit.stage(transaction, CHANGES)

    assert unit.read_image() == active
    assert unit.read_image(Bank.STAGED) == (active[0], staged)
    crc = unit.ask(CfgStagedCrcRequest(transaction)).message
    assert crc == CfgStagedCrcResponse(crc32(staged))


def test_one_element_of_an_array_can_be_set(unit: BenchUnit) -> None:
    transaction = unit.begin()

    unit.ask(CfgSetRequest(transaction, float_item("mode_ratios", 2.5, first=3)))

    staged = parameters.unpack_image(unit.read_image(Bank.STAGED)[1])
    assert staged["mode_ratios"] == [0.0, 0.5, 1.0, 2.5, 1.5]


@pytest.mark.parametrize(
    ("bad", "status", "detail"),
    [
        (float_item("assist_cutoff_kmh", 25.001), Status.RANGE, 0x0400),
        (float_item("assist_cutoff_kmh", -0.001), Status.RANGE, 0x0400),
        (float_item("assist_cutoff_kmh", math.nan), Status.RANGE, 0x0400),
        (float_item("assist_cutoff_kmh", -math.inf), Status.RANGE, 0x0400),
        (item("torque_rate_interval_ms", struct.pack("<H", 501)), Status.RANGE, 0x0103),
        (item("fuzzy_rules", bytes([5]), first=24), Status.RANGE, 0x0305),
        (item("fuzzy_rules", bytes(2), first=24, count=2), Status.TYPE, 0x0305),
        (item("fuzzy_rules", b"", count=0), Status.TYPE, 0x0305),
        (item("assist_cutoff_kmh", bytes(3)), Status.LENGTH, 0x0400),
        (b"\x00\x01\x00", Status.LENGTH, 0),
        (b"\xee\xee\x00\x01\x00", Status.UNKNOWN_ID, 0xEEEE),
        (float_item("gear_ratio", 30.0), Status.ACCESS, Access.FACTORY),
    ],
)
def test_a_bad_item_is_named_and_none_of_its_neighbours_is_taken(
    unit: BenchUnit, bad: bytes, status: Status, detail: int
) -> None:
    transaction = unit.begin()
    before = unit.read_image(Bank.STAGED)

    response = unit.ask(CfgSetRequest(transaction, float_item("torque_filter_s", 1.5) + bad))

    assert (response.status, response.detail) == (status, detail)
    assert unit.read_image(Bank.STAGED) == before


def test_validation_lists_everything_that_is_wrong(unit: BenchUnit) -> None:
    transaction = unit.begin()
    wrong = (
        float_item("fixed_taper_end_kmh", 15.0)
        + float_item("fuzzy_speed_points_kmh", 10.0, first=0)
        + float_item("fuzzy_gain_points", 0.0, first=4)
        + item("fuzzy_table_name", b"\xff" * 24)
    )
    assert unit.ask(CfgSetRequest(transaction, wrong)).status == Status.OK

    response = unit.ask(CfgValidateRequest(transaction))

    assert (response.status, response.detail) == (Status.INVALID_CONFIG, 4)
    assert list(struct.iter_unpack("<HBB", response.payload)) == [
        (PARAMETER_BY_NAME["fuzzy_table_name"].id, 0, Violation.NOT_TEXT),
        (PARAMETER_BY_NAME["fuzzy_speed_points_kmh"].id, 1, Violation.NOT_INCREASING),
        (PARAMETER_BY_NAME["fuzzy_gain_points"].id, 4, Violation.NOT_INCREASING),
        (PARAMETER_BY_NAME["fixed_taper_end_kmh"].id, 0, Violation.TAPER_ORDER),
    ]
    staged = crc32(unit.read_image(Bank.STAGED)[1])
    assert unit.ask(CfgCommitRequest(transaction, staged, 0, 0)).status == Status.STATE


@pytest.mark.parametrize(
    "name",
    [
        "fuzzy_speed_points_kmh",
        "fuzzy_torque_rate_points",
        "fuzzy_gain_points",
        "second_gain_points",
    ],
)
def test_points_nearer_than_their_least_step_never_become_active(
    unit: BenchUnit, name: str
) -> None:
    before = unit.read_image()
    transaction = unit.begin()
    points = struct.pack("<5I", *range(5))  # zero and the four floats after it
    header = struct.pack("<HBB", PARAMETER_BY_NAME[name].id, 0, 5)
    assert unit.ask(CfgSetRequest(transaction, header + points)).status == Status.OK

    response = unit.ask(CfgValidateRequest(transaction))
    staged = crc32(unit.read_image(Bank.STAGED)[1])
    live = unit.ask(LiveSetRequest(10, header + points))

    assert response.status == Status.INVALID_CONFIG
    assert list(struct.iter_unpack("<HBB", response.payload)) == [
        (PARAMETER_BY_NAME[name].id, index, Violation.NOT_INCREASING) for index in (1, 2, 3, 4)
    ]
    assert unit.ask(CfgCommitRequest(transaction, staged, 0, 0)).status == Status.STATE
    assert live.status == Status.INVALID_CONFIG
    assert unit.read_image() == before


def test_what_was_validated_and_then_changed_must_be_validated_again(unit: BenchUnit) -> None:
    transaction = unit.begin()
    unit.stage(transaction, CHANGES)
    unit.ask(CfgSetRequest(transaction, float_item("torque_filter_s", 1.5)))

    staged = crc32(unit.read_image(Bank.STAGED)[1])

    assert unit.ask(CfgCommitRequest(transaction, staged, 0, 0)).status == Status.STATE


def test_a_commit_of_something_else_than_the_host_believes_is_refused(unit: BenchUnit) -> None:
    transaction = unit.begin()
    staged = unit.stage(transaction, CHANGES)

    response = unit.ask(CfgCommitRequest(transaction, crc32(staged) ^ 0x8000, 0, 0))

    assert (response.status, response.detail) == (Status.CRC_MISMATCH, crc32(staged) & 0xFFFF)


@pytest.mark.parametrize(
    ("flags", "confirm_s", "status"),
    [(1, 0, Status.RANGE), (0, 10, Status.RANGE), (2, 0, Status.UNSUPPORTED)],
)
def test_a_commit_that_contradicts_itself_is_refused(
    unit: BenchUnit, flags: int, confirm_s: int, status: Status
) -> None:
    active = unit.read_image()
    transaction = unit.begin()
    staged = unit.stage(transaction, CHANGES)

    response = unit.ask(CfgCommitRequest(transaction, crc32(staged), flags, confirm_s))

    assert response.status == status
    assert unit.read_image() == active


@pytest.mark.parametrize(
    "moving",
    [
        {"speed_kmh": 3.0},
        {"motor_speed_rpm": 200.0},
        {"motor_speed_rpm": -200.0},
        {"speed_kmh": math.nan},
    ],
    ids=str,
)
def test_nothing_is_written_while_the_bike_or_its_motor_moves(
    unit: BenchUnit, moving: dict[str, float]
) -> None:
    active = unit.read_image()
    transaction = unit.begin()
    staged = unit.stage(transaction, CHANGES)
    unit.inputs(**moving)

    response = unit.ask(CfgCommitRequest(transaction, crc32(staged), 0, 0))

    assert response.status == Status.NOT_STOPPED
    assert unit.read_image() == active
    unit.inputs(speed_kmh=0.0, motor_speed_rpm=0.0)
    again = unit.ask(CfgCommitRequest(transaction, crc32(staged), 0, 0))
    assert again.status == Status.OK


def test_nothing_is_written_while_the_battery_may_give_out(unit: BenchUnit) -> None:
    transaction = unit.begin()
    staged = unit.stage(transaction, CHANGES)
    unit.inputs(battery_voltage_v=20.0)

    response = unit.ask(CfgCommitRequest(transaction, crc32(staged), 0, 0))

    assert response.status == Status.UNDERVOLTAGE


def test_committing_what_is_active_already_spares_the_flash(unit: BenchUnit) -> None:
    active = unit.read_image()
    unit.boot()

    response = unit.write({"torque_filter_s": 0.5})

    assert response.message == CfgCommitResponse(active[0], crc32(active[1]), ConfigState.IDLE)
    assert unit.read_image() == active
    assert lib.bench_flash_steps(unit.board) == 0


def test_a_lease_that_ends_leaves_the_active_configuration_untouched(unit: BenchUnit) -> None:
    active = unit.read_image()
    transaction = unit.begin()
    staged = unit.stage(transaction, CHANGES)
    unit.advance(29.9)
    assert unit.ask(CfgStagedCrcRequest(transaction)).status == Status.OK

    unit.advance(30.1)

    commit = unit.ask(CfgCommitRequest(transaction, crc32(staged), 0, 0))
    assert commit.status == Status.EXPIRED
    assert unit.ask(CfgStagedCrcRequest(transaction + 1)).status == Status.STATE
    assert unit.read_image() == active
    assert info(unit).state == ConfigState.IDLE
    assert unit.write(CHANGES).status == Status.OK


def test_whoever_keeps_working_on_a_transaction_keeps_it(unit: BenchUnit) -> None:
    transaction = unit.begin()
    staged = unit.stage(transaction, CHANGES)

    for _ in range(5):
        unit.advance(29.0)
        assert unit.ask(CfgStagedCrcRequest(transaction)).status == Status.OK

    unit.advance(29.0)
    assert unit.ask(CfgCommitRequest(transaction, crc32(staged), 0, 0)).status == Status.OK


@pytest.mark.parametrize("farewell", ["abort", "bye", "hello"])
def test_leaving_drops_what_was_staged(unit: BenchUnit, farewell: str) -> None:
    active = unit.read_image()
    transaction = unit.begin()
    unit.stage(transaction, CHANGES)

    if farewell == "abort":
        unit.ask(CfgAbortRequest(transaction))
    elif farewell == "bye":
        unit.ask(ByeRequest())
    else:
        unit.hello(nonce=b"another!")

    assert unit.read_image() == active
    assert info(unit).state == ConfigState.IDLE
    assert unit.ask(CfgStagedCrcRequest(transaction)).status == Status.STATE


def test_another_transactions_number_opens_nothing(unit: BenchUnit) -> None:
    transaction = unit.begin()

    for number in (0, transaction - 1, transaction + 1, 0xFFFF):
        assert unit.ask(CfgAbortRequest(number)).status == Status.STATE

    assert unit.ask(CfgAbortRequest(transaction)).status == Status.OK


def test_a_unit_without_a_configuration_says_so_until_the_maker_gives_it_one() -> None:
    maker = Maker()
    unit = BenchUnit(provisioned=False)
    provision(unit, maker)

    assert unit.read_image() == (0, parameters.pack_image(parameters.default_config()))
    assert unit.faults() == FaultFlags.NOT_PROVISIONED
    codes = [event.code for event in unit.events]
    assert codes == [Event.BOOT, Event.CONFIG_DEFAULTED, Event.FAULT_SET]

    write_with_the_makers_word(unit, maker, CHANGES)

    assert unit.faults() == 0
    assert info(unit).generation == 1


def test_flash_without_room_for_two_slots_is_not_written() -> None:
    maker = Maker()
    unit = BenchUnit(provisioned=False, flash_block_bytes=512, flash_bytes=3 * 512)

    refused = unit.write(CHANGES)

    # Without a block for the maker's key either there is nobody who could allow it.
    assert (refused.status, refused.detail) == (Status.ACCESS, Access.FACTORY)
    assert lib.bench_provision_unlock_key(unit.board, maker.public_key) != 0
    assert lib.bench_provision(unit.board) != 0
    assert (unit.flash() == 0xFF).all()


@pytest.mark.parametrize("block_bytes", [80, 128, 331, 1024])
def test_slots_of_any_number_of_blocks_work(block_bytes: int) -> None:
    unit = BenchUnit(flash_block_bytes=block_bytes, flash_bytes=block_bytes * 24)

    for cutoff in (24.0, 23.0, 22.0, 21.0):
        assert unit.write({"assist_cutoff_kmh": cutoff}).status == Status.OK
        unit.boot()
        assert unit.config()["assist_cutoff_kmh"] == cutoff
