"""What each fault of a unit means and what to do about it."""

from __future__ import annotations

from firmware_protocol._generated import FaultFlags

FAULT_DESCRIPTIONS: dict[str, str] = {
    FaultFlags.TORQUE_SENSOR.name or "": (
        "The torque sensor's reading is at its end stop or missing. There is no assist; check the "
        "sensor's cable, then its offset."
    ),
    FaultFlags.SPEED_SENSOR.name or "": (
        "The speed is implausible or missing. There is no assist; check the magnet and the cable."
    ),
    FaultFlags.BATTERY_LOW.name or "": (
        "The battery is below the voltage at which assist ends. Charge it."
    ),
    FaultFlags.CONFIG_DEFAULTED.name or "": (
        "The unit found no good configuration and runs on factory values. Restore a backup."
    ),
}


def fault_description(name: str) -> str:
    """A sentence for a fault's name; one of a newer firmware says that it is unknown."""
    unknown = "This Spindle does not know this fault; the unit's firmware is newer."
    return FAULT_DESCRIPTIONS.get(name, unknown)
