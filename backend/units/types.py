"""A device as the rest of Spindle and the API see it, and when its unit was last there."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from typing import Literal, cast

from pydantic import Field

from backend.core.api_models import RequestBody
from backend.core.described import described
from backend.core.moments import utc
from backend.device.capability import Capability
from backend.device.ports import DeviceKind, Port
from backend.device.readings import Fault
from backend.device.states import DeviceStatus, Identity

DeviceState = Literal["connecting", "ready", "read_only", "lost", "closed"]
RollbackCause = Literal["asked", "time_out", "restart", "unknown"]


@described
class ConfigStamp:
    """Which configuration is active. A provisional one is given up at `expires_at`."""

    generation: int
    crc32: int
    state: Literal["committed", "provisional"] = "committed"
    expires_at: datetime | None = None
    remaining_s: float | None = None
    """Until a provisional one is given up."""
    rollback_cause: RollbackCause | None = None
    """Why the latest trial was given up; null when none was since the unit's start."""

    @classmethod
    def of(cls, status: DeviceStatus) -> ConfigStamp | None:
        """What a unit reported; None before it did."""
        generation, crc32 = status.config_generation, status.config_crc32
        if generation is None or crc32 is None:
            return None
        cause = status.rollback_cause if status.rollback_cause != "none" else None
        cause = cast(RollbackCause | None, cause)
        ends_us, left_s = status.trial_ends_unix_us, status.trial_left_s
        if ends_us is None or left_s is None:
            return cls(generation, crc32, rollback_cause=cause)
        ends_at = utc(ends_us)
        return cls(generation, crc32, "provisional", ends_at, round(left_s, 1), cause)


@described
class Device:
    """A connection and the unit at its other end.

    `reason` says in a sentence why the state is what it is.
    """

    id: str
    """Of the connection: made of its url, the same after every start. Where a path takes it, it
    takes the unit's serial number and `unit_key` too."""
    url: str
    kind: DeviceKind
    state: DeviceState
    reason: str
    reason_code: str
    """A word for the reason, for programs and translations."""
    identity: Identity | None
    config: ConfigStamp | None
    link: dict[str, int | float | None]
    """Counters of the link since it was added."""
    faults_active: tuple[str, ...]
    family: str
    """The make of the unit: what `?family=` of its url takes."""
    capabilities: tuple[Capability, ...]
    """What this unit can do. A route that needs another answers 409 `capability_missing` and names
    it."""
    name: str | None
    """What its owner calls the unit, as it was added."""
    unit_key: str | None
    """Of the unit, whatever it is connected by: `family:serial`, else `family:name:NAME`, else
    `family:url:URL`. null until it said who it is. Its rides and its revisions have the same."""
    bike_id: int | None
    """The bike the unit is on, made when it was first seen; null for a unit without a serial number
    and without a name."""
    last_seen_at: datetime | None = None
    """When the unit was last there over this connection, now if it is; null if none ever was. Kept
    over a restart, as are `identity` and `unit_key` of a unit that is away."""


@described
class DeviceList:
    items: tuple[Device, ...]
    next: str | None = None


class DeviceRequest(RequestBody):
    url: str = Field(
        min_length=1,
        max_length=400,
        pattern=r"^[^\x00-\x1f\x7f]+$",
        description="`sim`, `sim:NAME?seed=1`, `/dev/ttyUSB0`, `COM3` or `socket://host:port`.",
    )
    name: str | None = Field(
        default=None,
        min_length=1,
        max_length=60,
        pattern=r"^[^\x00-\x20\x7f]([^\x00-\x1f\x7f]*[^\x00-\x20\x7f])?$",
        description="What you call the unit. A unit without a serial number is known by it, and "
        "nothing is written to it before it has one (409 `name_first`): give the same name each "
        "time. Adding the same url again with another name names it anew.",
    )


@described
class PortList:
    items: tuple[Port, ...]
    next: str | None = None


@described
class FaultList:
    items: tuple[Fault, ...]
    next: str | None = None


@dataclass(frozen=True)
class Sighting:
    """When and over which connection a unit was last there, and who it said it was.

    url: of the connection. unit_key: as of core.unit_key. seen_us: Unix time.
    """

    url: str
    unit_key: str
    seen_us: int
    serial_number: str | None = None
    name: str | None = None
    model: str | None = None
    firmware_version: str | None = None

    @property
    def seen_at(self) -> datetime:
        """`seen_us` as a moment in UTC."""
        return utc(self.seen_us)
