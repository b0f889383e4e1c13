"""What a unit's refusal means in words, and which of our errors it is."""

from __future__ import annotations

from backend.errors import DeviceRefused
from firmware_protocol._generated import Status
from firmware_protocol.codec import Response
from firmware_protocol.layout import Message

MEANING = {
    Status.UNKNOWN_MSG: "it does not know this request; its firmware may be older than Spindle",
    Status.LENGTH: "the request had the wrong length",
    Status.VERSION: "it speaks another version of the protocol",
    Status.BUSY: "it is busy with another change; try again in a moment",
    Status.STATE: "it is not in a state that allows this; start again",
    Status.RANGE: "a value is outside what the unit allows",
    Status.TYPE: "a value has the wrong type",
    Status.UNKNOWN_ID: "it does not know this parameter or channel",
    Status.ACCESS: "this needs a higher access level",
    Status.STALE_BASE: "its configuration was changed meanwhile; read it again",
    Status.CRC_MISMATCH: "the configuration it collected is not the one that was meant",
    Status.INVALID_CONFIG: "the values do not fit together",
    Status.NOT_STOPPED: "wheel or motor still turn; stop the bike first",
    Status.FLASH_FAIL: "its memory could not be written",
    Status.VERIFY_FAIL: "its memory did not keep what was written",
    Status.NO_SPACE: "it has no room left",
    Status.BANDWIDTH: "the line is too slow for this",
    Status.NOT_FOUND: "there is no such thing",
    Status.EXPIRED: "too much time went by; start again",
    Status.AUTH_BAD: "the token is not for this unit and this change",
    Status.AUTH_DELAY: "a wrong token came before; wait",
    Status.RATE_LIMIT: "its memory was written a moment ago; it says when it may be written again",
    Status.UNSUPPORTED: "its firmware does not support this yet",
    Status.SESSION: "it was restarted meanwhile",
    Status.ABORTED: "the change was given up",
    Status.UNDERVOLTAGE: "its battery is too low for this",
    Status.INTERNAL: "it met an error of its own",
}


def status_name(status: int) -> str:
    """`RANGE` for 7; a status of a newer firmware stays a number."""
    return Status(status).name if status in set(Status) else f"STATUS_{status}"


def refused(message: Message, response: Response) -> DeviceRefused:
    """The error for a response that is not OK: what was asked, the unit's reason, the detail."""
    name = status_name(response.status)
    status = Status(response.status) if response.status in set(Status) else None
    meaning = (
        MEANING.get(status, "a reason this Spindle does not know")
        if status
        else ("a reason this Spindle does not know")
    )
    request_name = type(message).__name__.removesuffix("Request")
    return DeviceRefused(
        f"The unit refused {request_name} ({name}, {response.detail}): {meaning}.",
        status=name,
        detail=response.detail,
    )
