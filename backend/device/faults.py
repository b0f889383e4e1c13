"""What each fault of a unit means and what to do about it."""

from __future__ import annotations

from firmware_protocol._generated import FAULT_BY_NAME, Severity

UNKNOWN = "This Spindle does not know this fault; the unit's firmware is newer."


def fault_description(name: str) -> str:
    """What the rider reads for a fault's name; one of a newer firmware says that it is unknown."""
    fault = FAULT_BY_NAME.get(name)
    return fault.rider_text if fault else UNKNOWN


def mechanic_text(name: str) -> str:
    """What a mechanic measures and mends, by the fault's name."""
    fault = FAULT_BY_NAME.get(name)
    return fault.mechanic_text if fault else UNKNOWN


def severity(name: str) -> str:
    """`warning`, `assist_off` or `latched`; a fault of a newer firmware counts as latched."""
    fault = FAULT_BY_NAME.get(name)
    return Severity(fault.severity if fault else Severity.LATCHED).name.lower()
