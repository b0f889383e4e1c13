"""A change of a unit's configuration through the service: checked, committed, proven, remembered.

The unit is the small honest one behind a real thread, the revision log one in memory. The real
firmware does the same in tests/simulation.
"""

from __future__ import annotations

import zlib
from dataclasses import replace
from datetime import UTC, datetime

import pytest

from backend.errors import (
    AccessDenied,
    ConfigConflict,
    Conflict,
    InvalidRequest,
    LimitViolation,
    NoAnswer,
    NotStandingStill,
    PeerProtocolError,
    StoreError,
)
from backend.tuning.revisions import ROLLED_BACK_REASON
from backend.tuning.service import Tuning
from backend.tuning.types import etag
from backend.units.service import Devices
from firmware_protocol._generated import PARAMETER_BY_NAME, MessageId
from firmware_protocol.parameters import default_config, pack_image
from tests.fakes.revisions import MemoryRevisions
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import UnitOpener
from tests.unit.tuning.conftest import KEY, NOW_S, URL, Bench


def test_a_change_is_in_the_unit_proven_and_tells_what_changed(bench: Bench) -> None:
    change = bench.tuning.write_config(bench.id, {"motor_torque_nm_max": 1.5}, "for the rain")

    assert bench.held == default_config() | {"motor_torque_nm_max": 1.5}
    assert change.verified
    assert change.state == "committed"
    assert [(one.name, one.old, one.new) for one in change.changed] == [
        ("motor_torque_nm_max", 2.0, 1.5)
    ]


def test_what_the_unit_had_before_is_kept_first(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, "later stop")

    newest, found = bench.tuning.revisions(bench.id)
    assert found.reason == "Found in the unit before a change."
    assert (newest.reason, newest.generation) == ("later stop", 8)
    assert newest.changed == [{"name": "pedal_stop_ms", "old": 150, "new": 200}]
    kept = bench.revisions.kept[KEY]
    assert kept[0].parameters == default_config()


def test_a_known_configuration_is_not_kept_twice(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 250})

    assert [revision.generation for revision in bench.revisions.kept[KEY]] == [7, 8, 9]


def test_a_backup_that_cannot_be_kept_stops_the_write(bench: Bench) -> None:
    bench.revisions.full = True

    with pytest.raises(StoreError):
        bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})

    assert bench.held == default_config()


def test_a_proven_write_that_a_full_disk_did_not_take_keeps_its_author_and_reason(
    bench: Bench,
) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})
    bench.revisions.full = True
    written = bench.tuning.write_config(bench.id, {"pedal_stop_ms": 250}, "the hill", author="Ann")
    with pytest.raises(StoreError):
        bench.tuning.write_config(bench.id, {"pedal_stop_ms": 300}, "more of it", author="Bob")
    assert bench.held["pedal_stop_ms"] == 250

    bench.revisions.full = False
    bench.tuning.note_trial_end(bench.id)

    newest = bench.revisions.kept[KEY][-1]
    assert (newest.crc32, newest.reason, newest.author) == (written.crc32, "the hill", "Ann")


def test_a_write_of_what_is_there_already_changes_nothing(bench: Bench) -> None:
    change = bench.tuning.write_config(bench.id, {"pedal_stop_ms": 150, "gear_ratio": 40.34})

    assert change.changed == ()
    assert change.generation == 7
    assert MessageId.CFG_BEGIN not in bench.unit.executed


def test_every_value_out_of_range_is_named_and_nothing_is_sent(bench: Bench) -> None:
    wrong = {
        "motor_torque_nm_max": 2.5,
        "fuzzy_gain_points": [0.1, 0.2, 0.2, 0.4, 0.5],
        "mode_laws": ["off", "fixed", "TURBO", "fuzzy", "fuzzy"],
    }

    with pytest.raises(LimitViolation) as caught:
        bench.tuning.write_config(bench.id, wrong)

    assert {(fault.field, fault.code) for fault in caught.value.fields} == {
        ("motor_torque_nm_max", "above_max"),
        ("fuzzy_gain_points[2]", "not_increasing"),
        ("mode_laws[2]", "not_a_choice"),
    }
    assert MessageId.CFG_BEGIN not in bench.unit.executed


def test_a_name_that_is_no_parameter_is_refused(bench: Bench) -> None:
    with pytest.raises(InvalidRequest, match="motor_torque is not a parameter"):
        bench.tuning.write_config(bench.id, {"motor_torque": 1.0})


def test_a_factory_parameter_is_denied(bench: Bench) -> None:
    with pytest.raises(AccessDenied) as caught:
        bench.tuning.write_config(bench.id, {"gear_ratio": 41.0, "pedal_stop_ms": 200})

    assert [fault.field for fault in caught.value.fields] == ["gear_ratio"]
    assert bench.held == default_config()


def test_a_change_made_for_another_configuration_is_a_conflict(bench: Bench) -> None:
    seen = bench.tuning.read_config(bench.id)
    tag = etag(seen.unit_key, seen.generation, seen.crc32)
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, if_match=tag)

    with pytest.raises(ConfigConflict):
        bench.tuning.write_config(bench.id, {"pedal_stop_ms": 300}, if_match=tag)

    assert bench.held["pedal_stop_ms"] == 200


def test_a_moving_bike_is_left_alone(bench: Bench) -> None:
    bench.unit.standing_still = False

    with pytest.raises(NotStandingStill, match="Stop the bike"):
        bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})

    assert bench.held == default_config()


def test_a_change_on_trial_is_proven_and_says_until_when(bench: Bench) -> None:
    change = bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, "try", confirm_s=60)

    assert (change.state, change.verified, change.generation) == ("provisional", True, 8)
    assert change.expires_at is not None
    left_s = (change.expires_at - datetime.fromtimestamp(NOW_S, UTC)).total_seconds()
    assert 50.0 < left_s <= 60.0
    assert bench.tuning.revisions(bench.id)[0].state == "provisional"


def test_a_kept_trial_stays_and_is_remembered_with_its_reason(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, "try", confirm_s=60)

    kept = bench.tuning.confirm_config(bench.id)

    assert (kept.state, kept.verified, kept.generation) == ("committed", True, 8)
    bench.unit.advance(61.0)
    assert bench.held["pedal_stop_ms"] == 200
    newest = bench.tuning.revisions(bench.id)[0]
    assert (newest.state, newest.reason) == ("verified", "Kept after its trial: try")


def test_a_trial_that_is_given_up_brings_back_what_was_there(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, confirm_s=60)

    back = bench.tuning.rollback_config(bench.id)

    assert bench.held == default_config()
    assert [(one.name, one.old, one.new) for one in back.changed] == [("pedal_stop_ms", 200, 150)]
    assert bench.tuning.revisions(bench.id)[0].reason.startswith("Returned to")


def test_nothing_is_kept_that_reads_back_different_from_what_was_meant(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, confirm_s=60)
    crc32 = zlib.crc32(bench.unit.image)
    log = bench.revisions.kept[KEY]
    log[-1] = replace(log[-1], parameters=default_config() | {"pedal_stop_ms": 201})
    assert log[-1].crc32 == crc32

    with pytest.raises(PeerProtocolError, match="pedal_stop_ms should be 201"):
        bench.tuning.confirm_config(bench.id)

    assert MessageId.CFG_CONFIRM not in bench.unit.executed


def test_a_trial_of_another_tool_is_not_kept_unseen(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, confirm_s=60)
    bench.revisions.kept.clear()

    with pytest.raises(Conflict) as caught:
        bench.tuning.confirm_config(bench.id)

    assert caught.value.code == "unknown_trial"


@pytest.mark.parametrize("ending", ["confirm_config", "rollback_config"])
def test_without_a_trial_there_is_nothing_to_end(bench: Bench, ending: str) -> None:
    with pytest.raises(Conflict) as caught:
        getattr(bench.tuning, ending)(bench.id)

    assert caught.value.code == "no_trial"


def test_a_trial_that_ran_out_is_noted_as_given_up_before_the_next_change(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, confirm_s=60)
    bench.unit.give_up_trial()

    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 300})

    reasons = [revision.reason for revision in bench.tuning.revisions(bench.id)]
    assert "not confirmed" in reasons[1]


@pytest.mark.slow
def test_a_commit_too_soon_waits_as_long_as_the_unit_says(bench: Bench) -> None:
    bench.unit.commits_too_soon = 1

    change = bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})

    assert change.verified
    assert bench.unit.executed.count(MessageId.CFG_COMMIT) == 2


def test_a_time_no_unit_can_count_is_refused(bench: Bench) -> None:
    with pytest.raises(InvalidRequest, match="from 0 to 255"):
        bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, confirm_s=256)


@pytest.mark.slow
def test_a_silent_unit_is_no_answer_and_unchanged(bench: Bench) -> None:
    bench.unit.silent = True

    with pytest.raises(NoAnswer):
        bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})

    assert bench.held == default_config()


def falls_silent_at_commit(unit: FakeUnit, does_it: bool, for_requests: int) -> None:
    """The commit is done or not, its answer and the next requests' are not given."""
    honest = unit._respond

    def respond(request: object) -> bytes:
        message_id = request.message.MESSAGE_ID  # type: ignore[attr-defined]
        if message_id is MessageId.CFG_COMMIT and not unit.executed.count(message_id):
            if does_it:
                honest(request)  # type: ignore[arg-type]
            unit.executed.append(message_id)
            respond.left = for_requests  # type: ignore[attr-defined]
        if respond.left > 0:  # type: ignore[attr-defined]
            respond.left -= 1  # type: ignore[attr-defined]
            return b"\x01"  # no frame of the protocol
        return honest(request)  # type: ignore[arg-type]

    respond.left = 0  # type: ignore[attr-defined]
    unit._respond = respond  # type: ignore[method-assign, assignment]


@pytest.mark.slow
def test_a_commit_nobody_acknowledged_is_found_done_when_it_was(bench: Bench) -> None:
    falls_silent_at_commit(bench.unit, does_it=True, for_requests=1)

    change = bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})

    assert change.verified
    assert bench.held["pedal_stop_ms"] == 200


@pytest.mark.slow
def test_a_commit_nobody_acknowledged_is_told_undone_when_it_was_not(bench: Bench) -> None:
    falls_silent_at_commit(bench.unit, does_it=False, for_requests=1)

    with pytest.raises(NoAnswer, match="unchanged"):
        bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})

    assert bench.held == default_config()


@pytest.mark.slow
def test_a_commit_nobody_acknowledged_is_not_believed_when_something_else_is_there(
    bench: Bench,
) -> None:
    falls_silent_at_commit(bench.unit, does_it=True, for_requests=1)
    lie = pack_image(default_config() | {"pedal_stop_ms": 999})
    bench.unit.lies = lambda image: lie if bench.unit.generation > 7 else image

    with pytest.raises(PeerProtocolError, match="pedal_stop_ms should be 200"):
        bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})


def test_a_unit_that_lies_when_read_back_is_not_called_verified(bench: Bench) -> None:
    lie = pack_image(default_config() | {"pedal_stop_ms": 999})
    bench.unit.lies = lambda image: lie if bench.unit.generation > 7 else image

    with pytest.raises(PeerProtocolError, match="pedal_stop_ms should be 200") as caught:
        bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200})

    assert [fault.field for fault in caught.value.fields] == ["pedal_stop_ms"]


def test_a_read_only_unit_says_why_it_is_not_tuned() -> None:
    unit = FakeUnit()
    unit.schema_hash = b"another1"
    devices = Devices(opener=lambda url: UnitOpener(unit, url))
    device = devices.add(URL)

    with pytest.raises(Conflict) as caught:
        Tuning(devices, MemoryRevisions()).read_config(device.id)

    assert caught.value.code == "read_only"
    devices.close()


def test_parameters_come_with_bounds_meaning_and_value(bench: Bench) -> None:
    rows = {row.name: row for row in bench.tuning.parameters(bench.id)}

    torque = rows["motor_torque_nm_max"]
    assert (torque.min, torque.max, torque.unit, torque.value) == (0.0, 2.0, "Nm", 2.0)
    assert rows["mode_laws"].choices == ("off", "fixed", "fuzzy")
    assert rows["gear_ratio"].access == "factory"
    assert list(rows) == list(PARAMETER_BY_NAME)


def test_a_trial_that_is_over_is_noted_at_once_and_only_once(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, "try", confirm_s=30)
    bench.tuning.note_trial_end(bench.id)
    assert len(bench.tuning.revisions(bench.id)) == 2, "it still runs"
    bench.unit.give_up_trial()

    bench.tuning.note_trial_end(bench.id)
    bench.tuning.note_trial_end(bench.id)

    newest, *older = bench.tuning.revisions(bench.id)
    assert newest.reason == ROLLED_BACK_REASON
    assert newest.generation == 7
    assert len(older) == 2
