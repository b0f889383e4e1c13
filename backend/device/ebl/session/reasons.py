"""The sentences that say why a device stands where it stands, and what to do."""

from __future__ import annotations

from backend.device.ebl.session.handshake import VersionRefused, version_text
from backend.device.states import CodedReason, Identity
from backend.errors import LinkError, NoAnswer


def opening_reason() -> CodedReason:
    """Nothing was tried yet."""
    return CodedReason("The port is being opened.", "opening")


def waiting_reason(port_name: str) -> CodedReason:
    """The port is open."""
    return CodedReason(f"{port_name} is open; waiting for the unit to answer.", "greeted")


def port_reason(error: LinkError) -> CodedReason:
    """The port does not open or is gone; the code is the error's."""
    return CodedReason(error.message, error.code)


def removed_reason() -> CodedReason:
    """Somebody took it off the list."""
    return CodedReason("The device was removed.", "removed")


def read_only_reason(why: str) -> CodedReason:
    """Connected, and not to be written: `why`."""
    return CodedReason(why, "read_only")


def no_stream_reason(before: str, error: BaseException) -> CodedReason:
    """As `before`, and the live values are refused."""
    return CodedReason(f"{before} Live values are not available: {error}", "no_stream")


def ready_reason(identity: Identity) -> CodedReason:
    """Connected: who it is."""
    return CodedReason(
        f"Connected to {identity.model} {identity.serial_number}, "
        f"firmware {identity.firmware_version}.",
        "ready",
    )


def rx_timeout_reason(port_name: str) -> CodedReason:
    """It was there and is silent."""
    return CodedReason(
        f"The unit on {port_name} stopped answering. Check battery and cable; it is taken up "
        "again by itself.",
        "silent",
    )


def tx_timeout_reason(port_name: str) -> CodedReason:
    """It talks and does not hear us."""
    return CodedReason(
        f"The unit on {port_name} is heard and answers nothing. Check the cable and its plug: one "
        "direction seems broken. Spindle keeps trying.",
        "deaf",
    )


def restarted_reason() -> CodedReason:
    """It says it started again."""
    return CodedReason("The unit was restarted; asking who it is again.", "restarted")


def handshake_reason(port_name: str, rates: str, error: BaseException) -> CodedReason:
    """Nobody answered HELLO, or not as the protocol wants."""
    at = f"{port_name} at {rates} baud" if rates else port_name
    if isinstance(error, NoAnswer):
        return CodedReason(
            f"No drive unit answers on {at}. Is it switched on, and is this its port? "
            "Spindle keeps trying.",
            "nobody",
        )
    return CodedReason(
        f"What answers on {at} is no drive unit Spindle understands: {error}", "not_understood"
    )


def version_reason(error: BaseException) -> CodedReason:
    """It speaks another version of the protocol."""
    return CodedReason(str(error), "other_version")


def newer_version(major: int) -> VersionRefused:
    """Its frames are of another major version of the protocol."""
    return VersionRefused(version_text(str(major)))


def forgotten_reason() -> CodedReason:
    """It knows nothing of the stream that was renewed."""
    return CodedReason("The unit forgot the live stream; asking who it is again.", "restarted")


def orphan_reason() -> CodedReason:
    """A change broke off and may still be open in the unit."""
    return CodedReason(
        "A change got no answer; asking the unit who it is again, so that it drops the change.",
        "orphan",
    )
