"""A device as the rest of Spindle sees it; mirrors the device JSON of the API."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime

from backend.device.identity import Identity
from backend.device.live_values import LiveValues


@dataclass(frozen=True)
class ConfigStamp:
    """Which configuration a unit has: its generation and the CRC-32 of its image.

    state: `committed`, or `provisional` until it is confirmed or, at `expires_at`, given up.
    """

    generation: int
    crc32: int
    state: str = "committed"
    expires_at: datetime | None = None

    @classmethod
    def until(cls, generation: int, crc32: int, ends_unix_us: int | None) -> ConfigStamp:
        """A stamp; ends_unix_us: when it is given up, None when it is not on trial."""
        if ends_unix_us is None:
            return cls(generation, crc32)
        return cls(
            generation, crc32, "provisional", datetime.fromtimestamp(ends_unix_us / 1e6, UTC)
        )


@dataclass(frozen=True)
class FaultView:
    """A fault that is active or was, and what to do about it.

    count: how often it came since the unit's start, None when the unit is not there to be asked.
    frozen: every channel when it came last.
    """

    name: str
    description: str
    active: bool = True
    count: int | None = None
    frozen: LiveValues | None = None


@dataclass(frozen=True)
class DeviceView:
    """One device at one moment.

    id: stable as long as the device is here. kind: simulated, serial or socket. state: connecting,
    ready, read_only, lost or closed. reason: a sentence for people. identity: the last one known.
    link: counters of LinkStatistics by name.
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
