"""What each fault of a unit means and what to do about it."""

from __future__ import annotations

from typing import cast

from backend.device.readings import Fault, Snapshot
from backend.device.readings import Severity as SeverityWord
from firmware_protocol._generated import FAULTS, Severity
from firmware_protocol.spelling import word_of

FAULT_BITS = 32
NAME_OF_BIT = {fault.bit: word_of(fault.name) for fault in FAULTS}
FAULT_BY_WORD = {word_of(fault.name): fault for fault in FAULTS}

UNKNOWN = "This Spindle does not know this fault; the unit's firmware is newer."


def fault_name(bit: int) -> str:
    """The fault of a bit; one of a newer firmware is `fault_n`."""
    return NAME_OF_BIT.get(bit) or f"fault_{bit}"


def fault_names(flags: int) -> tuple[str, ...]:
    """The faults of a set of flags, by their bit."""
    return tuple(fault_name(bit) for bit in range(FAULT_BITS) if flags >> bit & 1)


def described(
    name: str, active: bool = True, count: int | None = None, frozen: Snapshot | None = None
) -> Fault:
    """A fault by its name with its words; one of a newer firmware says that it is unknown, and
    counts as latched."""
    fault = FAULT_BY_WORD.get(name)
    return Fault(
        name,
        fault.rider_text if fault else UNKNOWN,
        active,
        count,
        frozen,
        cast(SeverityWord, word_of(Severity(fault.severity if fault else Severity.LATCHED).name)),
        fault.mechanic_text if fault else UNKNOWN,
    )
