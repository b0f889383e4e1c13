"""Who a unit says it is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Identity:
    """A unit's identity in words and hexadecimal; boot_id and session_id change at every start.

    serial_number: lasts as long as the unit; None for one that has none (never ""). reset_cause:
    why the unit started, as a word of the registry's reset_cause; None for a unit that cannot tell.
    """

    serial_number: str | None
    model: str
    hardware_revision: int
    firmware_version: str
    protocol_version: str
    schema_hash: str
    simulated: bool
    boot_id: int
    session_id: int
    reset_cause: str | None = None
