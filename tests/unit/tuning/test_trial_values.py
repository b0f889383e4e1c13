"""Goal: a value can be tried while the bike runs, is what the law uses, and is gone in time.

Method: the real firmware behind a real thread, in virtual time; what is tried is read back from
the unit itself. What it knows of its wear is asked of the same unit.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime

import pytest

from backend.errors import AccessDenied, Conflict, InvalidRequest, LimitViolation
from backend.tuning.service import Tuning
from backend.tuning.trial_values import TrialTuning, TrialValues
from backend.units.inspection import Inspection
from backend.units.service import Devices
from firmware_protocol.parameters import default_config
from sim_device.lockstep import LockstepUnit
from tests.fakes.revisions import MemoryRevisions
from tests.fakes.server import eventually
from tests.fakes.simulated_unit import LockstepAsUnit
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import UnitOpener

NOW_S = 1_700_000_000.0
NOTHING = TrialValues({}, None, None)


@dataclass
class Bench:
    devices: Devices
    trial: TrialTuning
    tuning: Tuning
    id: str


@pytest.fixture
def bench() -> Iterator[Bench]:
    unit = LockstepAsUnit(LockstepUnit(seed=1, scenario=None))
    devices = Devices(opener=lambda url: UnitOpener(unit, url))
    device = devices.add("socket://bench:1")
    tuning = Tuning(devices, MemoryRevisions())
    yield Bench(devices, TrialTuning(devices, lambda: NOW_S), tuning, device.id)
    devices.close()


def test_a_choice_is_tried_in_any_case_and_told_in_lower(bench: Bench) -> None:
    tried = bench.trial.set(bench.id, {"fuzzy_inference": "WEIGHTED_AVERAGE"}, 60)

    assert tried.parameters == {"fuzzy_inference": "weighted_average"}


def test_a_value_is_tried_over_the_configuration_and_leaves_it_alone(bench: Bench) -> None:
    before = bench.tuning.read_config(bench.id)

    tried = bench.trial.set(bench.id, {"pedal_stop_ms": 220, "torque_filter_s": 0.7}, 60)

    assert tried.parameters == pytest.approx({"pedal_stop_ms": 220, "torque_filter_s": 0.7})
    assert tried.remaining_s is not None
    assert 0.0 < tried.remaining_s <= 60.0
    assert tried.expires_at == datetime.fromtimestamp(NOW_S + tried.remaining_s, UTC)
    assert bench.trial.read(bench.id).parameters == tried.parameters
    assert bench.tuning.read_config(bench.id) == before


def test_a_second_try_is_on_top_of_the_first_and_ending_it_ends_both(bench: Bench) -> None:
    bench.trial.set(bench.id, {"pedal_stop_ms": 220}, 60)
    both = bench.trial.set(bench.id, {"motor_torque_nm_max": 1.5}, 60)

    assert set(both.parameters) == {"pedal_stop_ms", "motor_torque_nm_max"}
    assert bench.trial.end(bench.id) == NOTHING
    assert bench.trial.end(bench.id) == NOTHING


@pytest.mark.slow
def test_what_is_tried_ends_by_itself(bench: Bench) -> None:
    bench.trial.set(bench.id, {"pedal_stop_ms": 220}, 1)

    assert eventually(lambda: bench.trial.read(bench.id), lambda view: view == NOTHING) == NOTHING


def test_a_commit_ends_what_is_tried(bench: Bench) -> None:
    bench.trial.set(bench.id, {"pedal_stop_ms": 220}, 250)

    bench.tuning.write_config(bench.id, {"torque_filter_s": 0.9})

    assert bench.trial.read(bench.id) == NOTHING


def test_what_cannot_be_tried_is_named_and_changes_nothing(bench: Bench) -> None:
    with pytest.raises(LimitViolation) as beyond:
        bench.trial.set(bench.id, {"pedal_stop_ms": 60_000}, 10)
    with pytest.raises(InvalidRequest) as unknown:
        bench.trial.set(bench.id, {"moon_phase": 1}, 10)
    for ttl_s in (0, 256):
        with pytest.raises(InvalidRequest) as when:
            bench.trial.set(bench.id, {"pedal_stop_ms": 220}, ttl_s)

    assert [fault.field for fault in beyond.value.fields] == ["pedal_stop_ms"]
    assert [fault.field for fault in unknown.value.fields] == ["moon_phase"]
    assert [fault.field for fault in when.value.fields] == ["ttl_s"]
    assert bench.trial.read(bench.id) == NOTHING


def test_a_limit_the_maker_protects_cannot_be_raised_by_trying(bench: Bench) -> None:
    lower = default_config()["assist_cutoff_kmh"]
    assert isinstance(lower, float)
    bench.tuning.write_config(bench.id, {"assist_cutoff_kmh": lower - 5.0})

    with pytest.raises(AccessDenied):
        bench.trial.set(bench.id, {"assist_cutoff_kmh": lower}, 10)

    assert bench.trial.read(bench.id) == NOTHING


def test_a_unit_of_another_firmware_is_not_tried_on() -> None:
    unit = FakeUnit()
    unit.schema_hash = b"another1"
    devices = Devices(opener=lambda url: UnitOpener(unit, url))
    device = devices.add("socket://bench:2")

    for ask in (TrialTuning(devices).read, Inspection(devices).wear_counters):
        with pytest.raises(Conflict) as caught:
            ask(device.id)
        assert caught.value.code == "read_only"
        assert "could not be read" in caught.value.message
    devices.close()


def test_a_unit_tells_its_wear(bench: Bench) -> None:
    new = Inspection(bench.devices).wear_counters(bench.id)
    bench.tuning.write_config(bench.id, {"torque_filter_s": 0.9})
    written = Inspection(bench.devices).wear_counters(bench.id)

    assert new.distance_m == 0
    assert written.operating_s >= new.operating_s
    assert [slot.active for slot in written.config_slots].count(True) == 1
    (active,) = [slot for slot in written.config_slots if slot.active]
    assert active.state == "confirmed"
    assert active.generation == bench.tuning.read_config(bench.id).generation
    assert not written.runs_on_default
