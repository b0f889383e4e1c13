"""Who the unit says it is, from its HELLO."""

from __future__ import annotations

from backend.device.states import Identity
from firmware_protocol._generated import DeviceClass, HelloResponse

SIMULATED_BIT = 0x80


def identity_of(hello: HelloResponse, reset_cause: str | None = None) -> Identity:
    """Read the identity out of a HELLO's answer."""
    return Identity(
        serial_number=hello.uid.hex(),
        model=_model(hello.device_class),
        hardware_revision=hello.hardware_revision,
        firmware_version=".".join(str(part) for part in hello.firmware_version),
        protocol_version=f"{hello.major}.{hello.minor}",
        schema_hash=hello.schema_hash.hex(),
        simulated=bool(hello.device_class & SIMULATED_BIT),
        boot_id=hello.boot_id,
        reset_cause=reset_cause,
    )


def _model(device_class: int) -> str:
    if device_class in set(DeviceClass):
        words = DeviceClass(device_class).name.lower().replace("_", " ")
        return words.replace(" simulated", " (simulated)")
    return f"unknown class {device_class}"
