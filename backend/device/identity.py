"""Who a unit says it is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Identity:
    """A unit's identity in words and hexadecimal; None for what a unit does not tell, never "".

    serial_number: lasts as long as the unit. boot_id: another one at every start. reset_cause: why
    the unit started, as a word of the registry's reset_cause.
    """

    serial_number: str | None
    model: str
    firmware_version: str | None
    hardware_revision: int | None = None
    protocol_version: str | None = None
    schema_hash: str | None = None
    simulated: bool = False
    boot_id: int | None = None
    reset_cause: str | None = None
