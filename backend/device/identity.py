"""Who the unit says it is, from its HELLO."""

from __future__ import annotations

from dataclasses import dataclass

from firmware_protocol._generated import DeviceClass, HelloResponse

SIMULATED_BIT = 0x80


@dataclass(frozen=True)
class Identity:
    """A unit's identity in words and hexadecimal; boot_id and session_id change at every start.

    serial_number: the 12 bytes of the chip's unique id as 24 hexadecimal digits. reset_cause: why
    the unit started, as a word of the registry's reset_cause; None for a unit that cannot tell.
    """

    serial_number: str
    model: str
    hardware_revision: int
    firmware_version: str
    protocol_version: str
    schema_hash: str
    simulated: bool
    boot_id: int
    session_id: int
    reset_cause: str | None = None

    @classmethod
    def from_hello(cls, hello: HelloResponse, reset_cause: str | None = None) -> Identity:
        """Read the identity out of a HELLO's answer."""
        return cls(
            serial_number=hello.uid.hex(),
            model=_model(hello.device_class),
            hardware_revision=hello.hardware_revision,
            firmware_version=".".join(str(part) for part in hello.firmware_version),
            protocol_version=f"{hello.major}.{hello.minor}",
            schema_hash=hello.schema_hash.hex(),
            simulated=bool(hello.device_class & SIMULATED_BIT),
            boot_id=hello.boot_id,
            session_id=hello.session_id,
            reset_cause=reset_cause,
        )


def _model(device_class: int) -> str:
    if device_class in set(DeviceClass):
        words = DeviceClass(device_class).name.lower().replace("_", " ")
        return words.replace(" simulated", " (simulated)")
    return f"unknown class {device_class}"
