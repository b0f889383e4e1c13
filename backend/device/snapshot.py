"""Where a device stands at one moment, copied for other threads."""

from __future__ import annotations

from dataclasses import dataclass

from backend.device.identity import Identity
from backend.device.states import LinkState
from backend.device.statistics import LinkStatistics
from backend.device.stream import StreamBlock, StreamStarted


@dataclass(frozen=True)
class DeviceStatus:
    """A conversation's state, copied.

    trial_ends_unix_us: when the configuration on trial is given up; None while none is on trial.
    trial_left_s: how long until then. rollback_cause: why
    the latest trial was given up, as in TrialStatus; None while that is not known.
    """

    state: LinkState
    reason: str
    identity: Identity | None
    config_generation: int | None
    config_crc32: int | None
    trial_ends_unix_us: int | None
    trial_left_s: float | None
    rollback_cause: str | None
    faults_active: tuple[str, ...]
    streaming: StreamStarted | None
    last_block: StreamBlock | None
    statistics: LinkStatistics
