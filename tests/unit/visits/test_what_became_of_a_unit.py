"""Goal: a visit tells the settings that are otherwise than before it, and the faults that came and
went.

Method: configurations and faults as a unit's log and a unit tell them.
"""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import Any

from backend.core.revision import Revision
from backend.device.readings import Fault
from backend.visits.changes import changes_since, seen_faults
from backend.visits.types import VisitFault

T0 = datetime(2026, 5, 1, 9, 0, tzinfo=UTC)
NAME = "motor_torque_nm_max"


def revision(seq: int, *changed: tuple[str, Any, Any]) -> Revision:
    """A configuration, an hour after the one before it."""
    return Revision(
        seq=seq,
        created_us=1_777_626_000_000_000 + seq * 3_600_000_000,
        author=f"author {seq}",
        reason=f"reason {seq}",
        state="verified",
        generation=seq,
        crc32=seq,
        parameters={},
        unit_key="ebl:SP-1",
        changed=tuple({"name": n, "old": old, "new": new} for n, old, new in changed),
    )


def test_a_setting_goes_from_what_it_was_before_to_what_it_is_by_whoever_changed_it_last() -> None:
    log = [
        revision(4, (NAME, 1.5, 1.25)),
        revision(3, (NAME, 2.0, 1.5), ("pedal_stop_ms", 400, 420)),
        revision(2, ("pedal_stop_ms", 380, 400)),
    ]

    torque, stop = changes_since(log, 2)

    assert (torque.parameter, torque.old, torque.new) == (NAME, 2.0, 1.25)
    assert (torque.author, torque.reason) == ("author 4", "reason 4")
    assert torque.changed_at == T0 + timedelta(hours=4)
    assert (stop.old, stop.new) == (400, 420)


def test_what_was_taken_back_is_no_change() -> None:
    log = [revision(4, (NAME, 1.5, 2.0)), revision(3, (NAME, 2.0, 1.5)), revision(2)]

    assert changes_since(log, 2) == ()


def test_nothing_is_a_change_of_what_nobody_knew() -> None:
    found = revision(1, (NAME, None, 2.0))

    assert changes_since([], None) == ()
    assert changes_since([], 3) == ()
    assert changes_since([found], None) == ()
    # The first that was found is what it was before.
    [change] = changes_since([revision(2, (NAME, 2.0, 1.5)), found], None)
    assert (change.old, change.new) == (2.0, 1.5)
    assert changes_since([found], 1) == ()


def fault(name: str, active: bool, count: int | None = 1) -> Fault:
    return Fault(name, "", active, count)


def test_a_fault_that_goes_is_over_and_one_that_comes_again_is_there_again() -> None:
    at = [T0 + timedelta(minutes=minute) for minute in range(4)]
    first = seen_faults((), [fault("TORQUE_DRIFT", True)], at[0])
    gone = seen_faults(first, [fault("TORQUE_DRIFT", False)], at[1])
    away = seen_faults(gone, [], at[2])
    again = seen_faults(away, [fault("TORQUE_DRIFT", True, 2)], at[3])

    assert first == (VisitFault("TORQUE_DRIFT", 1, at[0], None),)
    assert gone == away == (VisitFault("TORQUE_DRIFT", 1, at[0], at[1]),)
    assert again == (VisitFault("TORQUE_DRIFT", 2, at[0], None),)


def test_a_fault_that_is_only_remembered_is_in_it_as_over() -> None:
    assert seen_faults((), [fault("OVERCURRENT", False, None)], T0) == (
        VisitFault("OVERCURRENT", None, T0, T0),
    )
