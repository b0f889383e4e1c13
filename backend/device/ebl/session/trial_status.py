"""Where a unit's active configuration stands: for good, or on trial and until when."""

from __future__ import annotations

from backend.device.configuration import TrialStatus
from backend.device.ebl.session.operation import Operation, query
from firmware_protocol._generated import (
    CfgStatusRequest,
    CfgStatusResponse,
    ConfigState,
    RollbackCause,
)
from firmware_protocol.spelling import word_of


def trial_status() -> Operation[TrialStatus]:
    """Ask the unit. Raises NoAnswer, DeviceRefused."""
    status = yield from query(CfgStatusRequest(), CfgStatusResponse)
    return trial_status_of(status)


def trial_status_of(status: CfgStatusResponse) -> TrialStatus:
    """The unit's answer in our words."""
    is_listed = status.rollback_cause in set(RollbackCause)
    cause = word_of(RollbackCause(status.rollback_cause).name) if is_listed else "unknown"
    return TrialStatus(
        on_trial=status.state == ConfigState.PROVISIONAL,
        generation=status.generation,
        crc32=status.crc32,
        left_s=status.confirm_left_ms / 1000.0,
        rollback_cause=cause,
        rolled_back_generation=status.rolled_back_generation,
    )
