"""What is said of a unit on the workbench."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from backend.core.described import described
from backend.device.capability import Capability
from backend.device.readings import Fault, WearCounters
from backend.device.states import Identity
from backend.units.types import ConfigStamp, DeviceState
from backend.visits.checks import UnitCheck


@described
class UnitChecks:
    """What was found, and the readings it was found by."""

    checked_at: datetime
    checks: tuple[UnitCheck, ...]
    channels: dict[str, float | None]
    faults_active: tuple[str, ...]
    wear: WearCounters | None
    """Null for a unit of another make, which does not count."""


@described
class SupportRevision:
    """A configuration that the unit had, without who gave it and why."""

    seq: int
    created_at: datetime
    state: str
    generation: int | None
    crc32: int | None
    changed: tuple[dict[str, Any], ...]


@described
class SupportFile:
    """A unit as it says it is; null is what it could not say now."""

    format: str
    version: int
    spindle_version: str
    made_at: datetime
    left_out: tuple[str, ...]
    family: str
    state: DeviceState
    reason_code: str
    capabilities: tuple[Capability, ...]
    identity: Identity | None
    config: ConfigStamp | None
    link: dict[str, int | float | None]
    faults: tuple[Fault, ...]
    checks: UnitChecks | None
    parameters: dict[str, Any] | None
    """By name, as last read."""
    revisions: tuple[SupportRevision, ...]
    """Newest first."""
