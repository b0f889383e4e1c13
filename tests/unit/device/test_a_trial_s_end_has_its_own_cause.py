"""Goal: nobody is told that a trial ended for the reason of the trial before it.

The unit's event says that a configuration was rolled back, not why; between the event and the
answer to the question nothing is known.
"""

from __future__ import annotations

from backend.device.configuration import TrialStatus
from backend.device.ebl.session.unit_state import UnitState
from backend.device.statistics import LinkStatistics
from firmware_protocol._generated import ConfigProvisionalEvent, ConfigRolledBackEvent
from firmware_protocol._generated import Event as EventCode
from firmware_protocol.codec import Event
from firmware_protocol.layout import Message


def hear(state: UnitState, seq: int, code: EventCode, message: Message) -> None:
    state.take(Event(seq, code, 1_000_000 * seq, message), LinkStatistics(), float(seq))


def test_a_rollback_has_no_cause_until_the_unit_was_asked() -> None:
    state = UnitState()
    state.refresh(0, TrialStatus(False, 7, 111, 0.0, "time_out", 8), 0.0)

    hear(state, 1, EventCode.CONFIG_PROVISIONAL, ConfigProvisionalEvent(9, 222, 60))
    assert state.trial_ends_s is not None
    hear(state, 2, EventCode.CONFIG_ROLLED_BACK, ConfigRolledBackEvent(10, 111))
    assert state.trial_ends_s is None
    assert state.rollback_cause is None

    state.refresh(0, TrialStatus(False, 10, 111, 0.0, "asked", 9), 3.0)
    assert state.rollback_cause == "asked"
