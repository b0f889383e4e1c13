"""The sentences that say why a device stands where it stands, and what to do."""

from __future__ import annotations

from backend.device.handshake import VersionRefused, version_text
from backend.device.identity import Identity
from backend.errors import NoAnswer


def ready_reason(identity: Identity) -> str:
    """Acquainted: who it is."""
    return (
        f"Connected to {identity.model} {identity.serial_number}, "
        f"firmware {identity.firmware_version}."
    )


def silent_reason(port_name: str) -> str:
    """It was there and is silent."""
    return (
        f"The unit on {port_name} stopped answering. Check battery and cable; it is taken up "
        "again by itself."
    )


def deaf_reason(port_name: str) -> str:
    """It talks and does not hear us."""
    return (
        f"The unit on {port_name} is heard and answers nothing. Check the cable and its plug: one "
        "direction seems broken. Spindle keeps trying."
    )


def restarted_reason() -> str:
    """It says it started again."""
    return "The unit was restarted; asking who it is again."


def greeting_reason(port_name: str, rates: str, error: BaseException) -> str:
    """Nobody answered HELLO, or not as the protocol wants."""
    at = f"{port_name} at {rates} baud" if rates else port_name
    if isinstance(error, NoAnswer):
        return (
            f"No drive unit answers on {at}. Is it switched on, and is this its port? "
            "Spindle keeps trying."
        )
    return f"What answers on {at} is no drive unit Spindle understands: {error}"


def newer_version(major: int) -> VersionRefused:
    """Its frames are of another major version of the protocol."""
    return VersionRefused(version_text(str(major)))


def forgotten_reason() -> str:
    """It knows nothing of the stream that was renewed."""
    return "The unit forgot the live stream; asking who it is again."


def orphan_reason() -> str:
    """A change broke off and may still be open in the unit."""
    return "A change got no answer; asking the unit who it is again, so that it drops the change."
