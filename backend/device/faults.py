"""A fault of a unit as services see it, with the words for rider and mechanic."""

from __future__ import annotations

from dataclasses import dataclass

from backend.device.live_values import LiveValues


@dataclass(frozen=True)
class UnitFault:
    """A fault that is active or was, and what to do about it.

    description: what the rider reads. mechanic_text: what to measure and mend.
    severity: warning, assist_off (while it lasts) or latched (until cleared at standstill).
    count: how often it came since the unit's start, None when the unit is not there to be asked.
    frozen: every channel when it came last, None when nothing was kept.
    """

    name: str
    description: str
    active: bool = True
    count: int | None = None
    frozen: LiveValues | None = None
    severity: str = "latched"
    mechanic_text: str = ""
