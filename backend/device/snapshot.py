"""Where a device stands at one moment, copied out of its session for other threads."""

from __future__ import annotations

from dataclasses import dataclass

from backend.device.ebl.session.session import Session
from backend.device.identity import Identity
from backend.device.states import LinkState
from backend.device.statistics import LinkStatistics
from backend.device.stream import StreamBlock, StreamStarted


@dataclass(frozen=True)
class DeviceStatus:
    """A session's state, copied. mtu: the largest frame both sides take.

    trial_ends_unix_us: when the configuration on trial is given up; None while none is on trial.
    trial_left_s: how long until then. rollback_cause: as in UnitNotes.
    """

    state: LinkState
    reason: str
    identity: Identity | None
    mtu: int
    config_generation: int | None
    config_crc32: int | None
    trial_ends_unix_us: int | None
    trial_left_s: float | None
    rollback_cause: str | None
    faults_active: tuple[str, ...]
    streaming: StreamStarted | None
    last_block: StreamBlock | None
    statistics: LinkStatistics


def status_of(session: Session) -> DeviceStatus:
    """Copy what other threads may want to know."""
    acquaintance = session.acquaintance
    return DeviceStatus(
        state=session.state,
        reason=session.reason,
        identity=acquaintance.identity if acquaintance else None,
        mtu=session.mtu,
        config_generation=session.notes.config_generation,
        config_crc32=session.notes.config_crc32,
        trial_ends_unix_us=session.trial_ends_unix_us,
        trial_left_s=session.trial_left_s,
        rollback_cause=session.notes.rollback_cause,
        faults_active=session.notes.faults_active,
        streaming=session.streaming,
        last_block=session.last_block,
        statistics=session.link_statistics(),
    )
