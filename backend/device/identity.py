"""Who a unit says it is."""

from __future__ import annotations

from backend.core.described import described


@described
class Identity:
    """Who a unit says it is, in words and hexadecimal; null for what it does not say, never ""."""

    serial_number: str | None
    """Lasts as long as the unit."""
    model: str
    firmware_version: str | None
    hardware_revision: int | None = None
    protocol_version: str | None = None
    schema_hash: str | None = None
    simulated: bool = False
    boot_id: int | None = None
    """Another one at every start of the unit."""
    reset_cause: str | None = None
    """Why the unit started: `power_on`, `brown_out`, `watchdog`, `fault_handler`, `deadline` or
    `software`; null where its firmware cannot tell."""
