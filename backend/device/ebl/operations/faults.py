"""What each fault of a unit means and what to do about it."""

from __future__ import annotations

from firmware_protocol._generated import FAULT_BY_NAME, FaultFlags, Severity

FAULT_BITS = 32
KNOWN = {flag.bit_length() - 1: flag.name for flag in FaultFlags}

UNKNOWN = "This Spindle does not know this fault; the unit's firmware is newer."


def fault_name(bit: int) -> str:
    """The fault of a bit; one of a newer firmware is `FAULT_n`."""
    return KNOWN.get(bit) or f"FAULT_{bit}"


def fault_names(flags: int) -> tuple[str, ...]:
    """The faults of a set of flags, by their bit."""
    return tuple(fault_name(bit) for bit in range(FAULT_BITS) if flags >> bit & 1)


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
