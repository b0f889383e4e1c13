"""A device as the rest of Spindle sees it; mirrors the device JSON of the API."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from backend.core.moments import utc
from backend.device.identity import Identity
from backend.device.snapshot import DeviceStatus
from backend.device.states import code_of


@dataclass(frozen=True)
class ConfigStamp:
    """Which configuration a unit has: its generation and the CRC-32 of its image.

    state: `committed`, or `provisional` until it is confirmed or, at `expires_at`, which is in
    `remaining_s`, given up. rollback_cause: why the latest trial since the unit was switched on was
    given up: asked, time_out or restart; None when none was, or the unit was not asked.
    """

    generation: int
    crc32: int
    state: str = "committed"
    expires_at: datetime | None = None
    remaining_s: float | None = None
    rollback_cause: str | None = None

    @classmethod
    def of(cls, status: DeviceStatus) -> ConfigStamp | None:
        """What a unit told; None before it did."""
        generation, crc32 = status.config_generation, status.config_crc32
        if generation is None or crc32 is None:
            return None
        cause = status.rollback_cause if status.rollback_cause != "none" else None
        ends_us, left_s = status.trial_ends_unix_us, status.trial_left_s
        if ends_us is None or left_s is None:
            return cls(generation, crc32, rollback_cause=cause)
        ends_at = utc(ends_us)
        return cls(generation, crc32, "provisional", ends_at, round(left_s, 1), cause)


@dataclass(frozen=True)
class DeviceView:
    """One device at one moment.

    id: of the connection, from its url: the same after every start. kind: simulated, serial or
    socket. state: connecting, ready, read_only, lost or closed. reason: a sentence for people.
    identity: the last one known, from before the server's start too. link: counters of
    LinkStatistics by name. capabilities: as in backend.device.capability.Capability. name: the
    owner's for the unit. unit_key: as of backend.core.unit_key; None until the unit said who it
    is. bike_id: the bike the unit is on; None for a unit that nobody can tell from another.
    last_seen_at: when the unit was last there over this connection, now if it is; None if none ever
    was. A unit that has not said who it is since the server's start is told as the one before.
    """

    id: str
    url: str
    kind: str
    state: str
    reason: str
    identity: Identity | None
    config: ConfigStamp | None
    link: dict[str, float | None]
    faults_active: tuple[str, ...]
    family: str
    capabilities: tuple[str, ...]
    name: str | None
    unit_key: str | None
    bike_id: int | None
    last_seen_at: datetime | None = None

    @property
    def reason_code(self) -> str:
        """A word for the reason, for other languages than the sentence's."""
        return code_of(self.reason)
