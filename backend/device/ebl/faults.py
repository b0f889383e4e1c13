"""What each fault of a unit means and what to do about it."""

from __future__ import annotations

from backend.device.faults import UnitFault
from backend.device.live_values import LiveValues
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


def described(
    name: str, active: bool = True, count: int | None = None, frozen: LiveValues | None = None
) -> UnitFault:
    """A fault by its name with its words; one of a newer firmware says that it is unknown, and
    counts as latched."""
    fault = FAULT_BY_NAME.get(name)
    return UnitFault(
        name,
        fault.rider_text if fault else UNKNOWN,
        active,
        count,
        frozen,
        Severity(fault.severity if fault else Severity.LATCHED).name.lower(),
        fault.mechanic_text if fault else UNKNOWN,
    )
