"""A fault of a unit as services and the API see it, with the words for rider and mechanic."""

from __future__ import annotations

from typing import Literal

from backend.core.described import described
from backend.device.live_values import Snapshot

Severity = Literal["warning", "assist_off", "latched"]


@described
class Fault:
    """A fault that is active or was. `frozen` is what the bike did when it came last."""

    name: str
    description: str
    """What the rider reads."""
    active: bool = True
    count: int | None = None
    """How often since the unit's start; null if not known."""
    frozen: Snapshot | None = None
    severity: Severity = "latched"
    """A warning only; no assist while it lasts; no assist until cleared at standstill."""
    mechanic_text: str = ""
    """What a mechanic measures and mends."""
