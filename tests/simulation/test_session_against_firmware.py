"""The host's session against the unit's real firmware, in virtual time.

The C firmware runs on the lockstep board; the bytes between both are harmed on purpose. What the
session believes must be what the unit holds.
"""

from __future__ import annotations

import random

import numpy as np
import pytest

from backend.device.configuration import ConfigImage
from backend.device.ebl.operations.config_transaction import read_bank, read_config, write_config
from backend.device.ebl.operations.config_trial import confirm_config, rollback_config
from backend.device.ebl.operations.readings import clear_faults, fault_frames, read_values
from backend.device.ebl.operations.simulation import simulation_get, simulation_set
from backend.device.ebl.session import handshake
from backend.device.ebl.session.operation import query
from backend.device.ebl.session.schema import differences, unpack_schema
from backend.device.ebl.session.stream_receiver import BATCH_DEFAULT, StreamPlan
from backend.device.ebl.session.trial_status import trial_status
from backend.device.states import LinkState
from backend.errors import (
    AccessDenied,
    ConfigConflict,
    InvalidRequest,
    LimitViolation,
    LinkError,
    NotFound,
    NotStandingStill,
    PeerProtocolError,
)
from firmware_protocol._generated import (
    BAND_BY_NAME,
    CHANNELS,
    PARAMETERS,
    SCHEMA_HASH,
    TimSyncRequest,
    TimSyncResponse,
)
from firmware_protocol.bands import band_limits
from firmware_protocol.codec import Event, decode
from firmware_protocol.framing import FrameDecoder, encode_frame
from firmware_protocol.layout import Value
from firmware_protocol.parameters import default_config
from sim_device.lockstep import LockstepUnit
from tests.fakes.bench import Bench, bytewise
from tests.fakes.simulated_unit import LockstepAsUnit, new_unit_config


def bench_with(unit: LockstepUnit, plan: StreamPlan | None = None) -> Bench:
    return Bench(LockstepAsUnit(unit), plan)


def connected(plan: StreamPlan | None = None) -> tuple[Bench, ConfigImage]:
    bench = bench_with(LockstepUnit(seed=1), plan).connect()
    return bench, bench.ask(read_config())


def test_the_firmware_is_ready_and_has_the_registry_s_defaults() -> None:
    bench, config = connected()

    assert bench.session.state is LinkState.READY
    assert config.parameters == new_unit_config()
    assert config.generation == bench.session.unit_state.config_generation
    assert config.crc32 == bench.session.unit_state.config_crc32


def test_a_minute_of_stream_has_no_row_missing_and_none_made_up() -> None:
    bench, _ = connected(StreamPlan())
    bench.split = bytewise
    bench.run(60.0)

    blocks = bench.blocks()
    counted = bench.session.link_statistics()
    assert counted.stream_rows_lost == 0
    assert counted.stream_rows >= 5990
    times = np.concatenate([block.t0_us + np.arange(BATCH_DEFAULT) * 10_000 for block in blocks])
    assert set(np.diff(times)) == {10_000}


def test_rows_lost_on_the_way_are_counted_as_the_firmware_counts_them() -> None:
    bench, _ = connected(StreamPlan())
    noise = random.Random(5)

    def harm(data: bytes) -> bytes:
        if not data or noise.random() > 0.1:
            return data
        at = noise.randrange(len(data))
        return data[:at] + bytes([data[at] ^ 0x10]) + data[at + 1 :]

    bench.to_host = harm
    bench.run(60.0)
    bench.to_host = lambda data: data
    bench.run(2.5)

    counted = bench.session.link_statistics()
    assert counted.stream_rows_lost > 50
    assert counted.stream_rows_lost % BATCH_DEFAULT == 0
    # The firmware tells its own count once a second; up to a second of frames came since.
    built = counted.unit_frames_built
    assert built is not None
    received_and_lost = (counted.stream_rows + counted.stream_rows_lost) // BATCH_DEFAULT
    assert 0 <= received_and_lost - built <= 100 // BATCH_DEFAULT + 1


def test_a_written_table_is_in_the_unit_and_survives_a_restart() -> None:
    unit = LockstepUnit(seed=1)
    bench = bench_with(unit).connect()
    base = bench.ask(read_config())
    changes: dict[str, Value] = {
        "fuzzy_rules": [["NB", "NS", "ZO", "PS", "PB"]] * 5,
        "fuzzy_table_name": "Regen-Tabelle",
        "mode_ratios": [0.0, 0.4, 0.8, 1.2, 1.6],
        "pedal_stop_ms": 220,
    }

    after = bench.ask(write_config(base, changes))

    restarted = LockstepUnit(seed=1, flash=unit.unit.flash(), boot_id=2)
    again = bench_with(restarted).connect()
    kept = again.ask(read_config())
    assert after.parameters == new_unit_config() | changes
    assert kept.parameters == after.parameters
    assert kept.generation == after.generation


def test_every_parameter_a_dealer_may_write_can_be_written_and_reads_back() -> None:
    bench, base = connected()
    changes: dict[str, Value] = {}
    for row in PARAMETERS:
        if row.access < 2 and row.type != "text" and row.enum is None and not row.increasing:
            band = BAND_BY_NAME.get(row.name)
            low, high = row.min or 0.0, row.max or 0.0
            if band is not None:
                low, high = band_limits(band, base.parameters)
            value = low + 0.75 * (high - low)
            number = value if row.type == "f32" else round(value)
            changes[row.name] = [number] * row.count if row.shape else number
    changes["fixed_taper_end_kmh"] = 20.0

    after = bench.ask(write_config(base, changes))

    assert after.generation == base.generation + 1
    assert after.parameters["motor_torque_nm_max"] == 1.5
    assert after.parameters["pedal_stop_ms"] == round(50 + 0.75 * 950)


def test_the_unit_refuses_what_is_out_of_range_on_its_own() -> None:
    bench, base = connected()

    with pytest.raises(LimitViolation) as caught:
        bench.ask(write_config(base, {"motor_torque_nm_max": 9.0, "assist_cutoff_kmh": 45.0}))

    named = {fault.field.partition("[")[0] for fault in caught.value.fields}
    assert named <= {"motor_torque_nm_max", "assist_cutoff_kmh"}
    assert named
    assert bench.ask(read_config()) == base


def test_the_unit_refuses_points_that_do_not_increase() -> None:
    bench, base = connected()

    with pytest.raises(LimitViolation) as caught:
        bench.ask(write_config(base, {"fuzzy_gain_points": [0.1, 0.2, 0.2, 0.4, 0.5]}))

    assert [fault.field for fault in caught.value.fields] == ["fuzzy_gain_points[2]"]
    assert bench.ask(read_config()) == base


def test_the_unit_denies_the_factory_s_parameters() -> None:
    bench, base = connected()

    with pytest.raises(AccessDenied):
        bench.ask(write_config(base, {"gear_ratio": 36.744}))

    assert bench.ask(read_config()) == base


def test_a_riding_bike_is_not_changed() -> None:
    unit = LockstepUnit(seed=1)
    bench = bench_with(unit).connect()
    base = bench.ask(read_config())
    unit.rider("legs", torque_nm=30.0)
    bench.run(5.0)

    with pytest.raises(NotStandingStill):
        bench.ask(write_config(base, {"pedal_stop_ms": 200}))

    assert bench.ask(read_config()) == base


def test_what_was_before_and_what_the_firmware_brings_are_read_whole() -> None:
    bench, base = connected()
    with pytest.raises(NotFound, match="no previous configuration"):
        bench.ask(read_bank("previous"))
    bench.ask(write_config(base, {"pedal_stop_ms": 250}))

    assert bench.ask(read_bank("previous")) == base
    # In the short frames of a unit that had no HELLO, too.
    default = bench.ask(read_bank("default", mtu=128))
    assert (default.generation, default.parameters) == (0, default_config())


def test_an_outdated_base_is_refused_by_the_unit() -> None:
    bench, base = connected()
    bench.ask(write_config(base, {"pedal_stop_ms": 200}))
    bench.run(3.0)

    with pytest.raises(ConfigConflict):
        bench.ask(write_config(base, {"pedal_stop_ms": 300}))


@pytest.mark.parametrize("lost", range(8))
def test_each_lost_answer_is_repeated_and_the_change_done_once(lost: int) -> None:
    bench, base = connected()
    seen = 0

    def lose_one(data: bytes) -> bytes:
        nonlocal seen
        seen += bool(data)
        return b"" if data and seen - 1 == lost else data

    bench.to_host = lose_one
    after = bench.ask(write_config(base, {"pedal_stop_ms": 200}))

    assert after.generation == base.generation + 1
    assert after.parameters["pedal_stop_ms"] == 200


@pytest.mark.parametrize("seed", range(20))
def test_on_a_bad_line_a_change_is_made_whole_or_not_at_all(seed: int) -> None:
    unit = LockstepUnit(seed=1)
    bench = bench_with(unit, StreamPlan()).connect()
    base = bench.ask(read_config())
    changes: dict[str, Value] = {"pedal_stop_ms": 200, "mode_ratios": [0.0, 0.4, 0.8, 1.2, 1.6]}
    noise = random.Random(seed)

    def harm(data: bytes) -> bytes:
        return b"" if noise.random() < 0.35 else data

    bench.to_unit = bench.to_host = harm
    outcome: list[object] = []
    bench.session.start(write_config(base, changes), outcome.append, outcome.append)
    bench.run_until(lambda: bool(outcome))
    bench.to_unit = bench.to_host = lambda data: data
    bench.run(3.0)
    bench.run_until(lambda: bench.session.state is LinkState.READY)
    held = bench.ask(read_config()).parameters

    assert held in (base.parameters, base.parameters | changes)
    if isinstance(outcome[0], ConfigImage):
        assert held == base.parameters | changes


def test_the_firmware_s_own_description_is_read_and_proven(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(handshake, "SCHEMA_HASH", b"not this")
    schemas: dict[str, bytes] = {}
    bench = Bench(LockstepAsUnit(LockstepUnit(seed=1)), StreamPlan(), schemas).connect()
    bench.run(1.0)

    # What it says of itself means what ours says, so it is a unit like any other.
    assert list(schemas) == [SCHEMA_HASH.hex()]
    assert differences(unpack_schema(schemas[SCHEMA_HASH.hex()], SCHEMA_HASH)) == []
    assert bench.session.state is LinkState.READY
    assert bench.blocks()[0].values.shape == (BATCH_DEFAULT, len(CHANNELS))


def test_the_snapshot_is_what_the_observer_beside_the_bike_sees() -> None:
    unit = LockstepUnit(seed=1)
    bench = bench_with(unit).connect()
    unit.rider("legs", torque_nm=25.0)
    bench.run(8.0)

    values = bench.ask(read_values())

    assert values.channels["speed_kmh"] == pytest.approx(unit.observe()["speed_kmh"], abs=0.3)


def test_rider_and_road_are_set_over_the_wire() -> None:
    bench, _ = connected()

    after = bench.ask(simulation_set({"road": {"grade_deg": 4.58}, "mass_kg": 90.0}))

    assert after["road"]["grade_deg"] == 4.58
    assert bench.ask(simulation_get())["mass_kg"] == 90.0


def test_a_wrong_setting_of_the_simulation_is_refused_in_its_own_words() -> None:
    bench, _ = connected()

    with pytest.raises(InvalidRequest, match="rocket") as caught:
        bench.ask(simulation_set({"rider": {"kind": "rocket"}}))

    assert [fault.field for fault in caught.value.fields] == ["rider.kind"]
    assert "\n" not in caught.value.message


def test_the_firmware_gives_up_a_trial_and_the_host_knows() -> None:
    bench, base = connected()
    bench.ask(write_config(base, {"pedal_stop_ms": 250}, confirm_s=5))
    assert bench.ask(trial_status()).left_s <= 5.0

    bench.run(5.5)

    status = bench.ask(trial_status())
    assert (status.on_trial, status.rollback_cause) == (False, "time_out")
    assert bench.ask(read_config()) == base
    assert bench.session.unit_state.trial_ends_s is None


def test_the_firmware_keeps_what_was_read_back_and_confirmed() -> None:
    bench, base = connected()
    tried = bench.ask(write_config(base, {"pedal_stop_ms": 250}, confirm_s=5))

    kept = bench.ask(confirm_config(base.parameters | {"pedal_stop_ms": 250}))

    bench.run(6.0)
    assert kept == tried == bench.ask(read_config())


def test_what_is_not_what_was_meant_is_not_confirmed() -> None:
    bench, base = connected()
    bench.ask(write_config(base, {"pedal_stop_ms": 250}, confirm_s=5))

    with pytest.raises(PeerProtocolError, match="pedal_stop_ms should be 260"):
        bench.ask(confirm_config(base.parameters | {"pedal_stop_ms": 260}))

    bench.run(5.5)
    assert bench.ask(read_config()) == base


def test_a_trial_survives_a_pulled_cable_and_the_host_finds_it_again() -> None:
    bench, base = connected()
    bench.ask(write_config(base, {"pedal_stop_ms": 250}, confirm_s=60))
    bench.session.port_failed(bench.now_s, LinkError("The cable is out."))
    bench.run(3.0)

    bench.connect()

    ends_s = bench.session.unit_state.trial_ends_s
    assert ends_s is not None
    assert 50.0 < ends_s - bench.now_s < 58.0
    assert bench.ask(rollback_config()) == base


def test_two_writes_in_a_row_wait_for_the_flash() -> None:
    bench, base = connected()
    after = bench.ask(write_config(base, {"pedal_stop_ms": 250}))
    began_s = bench.now_s

    again = bench.ask(write_config(after, {"pedal_stop_ms": 300}))

    assert again.parameters["pedal_stop_ms"] == 300
    assert 1.8 <= bench.now_s - began_s <= 2.5


def test_the_host_learns_the_unit_s_clock_and_the_unit_the_world_s() -> None:
    bench, _ = connected()
    bench.session.wall_offset_us = 1_790_000_000_000_000
    bench.run(60.0)

    estimate = bench.session.clock.estimate
    assert estimate is not None
    # Both clocks are the bench's: the unit's began when the session's stood at 100 s.
    assert estimate.unit_at(160e6) == pytest.approx(60e6, abs=20_000)
    assert abs(estimate.skew_ppm) < 300.0
    told = bench.ask(query(TimSyncRequest(1), TimSyncResponse))
    assert told.unix_us == pytest.approx(1_790_000_000_000_000 + bench.now_s * 1e6, abs=50_000)


@pytest.mark.parametrize("before_us", [0, 1_577_836_830_000_000])
def test_a_unit_is_told_the_time_again_when_its_host_s_clock_was_set(before_us: int) -> None:
    bench, _ = connected()
    bench.session.wall_offset_us = before_us
    bench.run(60.0)
    bench.session.wall_offset_us = 1_795_770_000_000_000
    bench.run(30.0)

    told = bench.ask(query(TimSyncRequest(1), TimSyncResponse))
    assert told.unix_us == pytest.approx(1_795_770_000_000_000 + bench.now_s * 1e6, abs=50_000)


def test_a_fault_comes_with_what_the_bike_did_and_can_be_forgotten() -> None:
    unit = LockstepUnit(seed=1, bike={"battery.soc_pct_start": 20.0})
    bench = bench_with(unit).connect()
    base = bench.ask(read_config())
    too_high = bench.ask(write_config(base, {"battery_voltage_v_min": 40.0}))
    bench.run(2.0)
    (fault,) = bench.ask(fault_frames())
    still = bench.ask(clear_faults())
    bench.ask(write_config(too_high, {"battery_voltage_v_min": 30.0}))
    bench.run(2.0)
    (over,) = bench.ask(fault_frames())

    assert (fault.name, fault.active, fault.count) == ("battery_low", True, 1)
    assert fault.frozen is not None
    voltage_v = fault.frozen.channels["battery_voltage_v"]
    assert voltage_v is not None
    assert voltage_v < 40.0
    assert still == [fault]
    assert (over.active, over.frozen) == (False, fault.frozen)
    assert bench.ask(clear_faults()) == []


def test_an_event_that_did_not_come_is_counted_and_what_it_told_is_asked_for() -> None:
    bench, base = connected(StreamPlan())
    bench.run(1.5)
    bench.to_host = without_events
    bench.ask(write_config(base, {"pedal_stop_ms": 250}))
    assert bench.session.unit_state.config_generation == base.generation

    bench.to_host = lambda data: data
    bench.run(2.5)

    assert bench.session.link_statistics().unit_events_lost > 0
    assert bench.session.unit_state.config_generation == base.generation + 1


def without_events(data: bytes) -> bytes:
    """A line that loses every event and nothing else; frames come whole from the lockstep unit."""
    frames = FrameDecoder().feed(data)
    return b"".join(encode_frame(one) for one in frames if not isinstance(decode(one), Event))
