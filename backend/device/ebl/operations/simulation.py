"""The controls of a simulated unit: rider, road and clock as JSON over the same wire."""

from __future__ import annotations

import json
import zlib
from collections.abc import Mapping
from typing import Any

from backend.device.ebl.session.operation import Operation, attempt, expect, query
from backend.errors import FieldError, InvalidRequest, PeerProtocolError
from firmware_protocol._generated import (
    SimGetRequest,
    SimGetResponse,
    SimSetRequest,
    SimSetResponse,
    Status,
)

PLAIN_BYTES_MAX = 500
"""A frame of 544 bytes holds some 530; longer text goes deflated, as it comes."""

TEXT_BYTES_MAX = 16_384
"""A frame of half a kilobyte cannot mean more; a hostile one shall not."""


def simulation_get() -> Operation[dict[str, Any]]:
    """What rider, road and clock do now."""
    answer = yield from query(SimGetRequest(), SimGetResponse)
    return _object(answer.text)


def simulation_set(changes: Mapping[str, Any]) -> Operation[dict[str, Any]]:
    """Change what is named; what they do then. Raises InvalidRequest in the simulator's words."""
    text = json.dumps(changes, separators=(",", ":")).encode()
    request = SimSetRequest(text if len(text) <= PLAIN_BYTES_MAX else zlib.compress(text))
    response = yield from attempt(request)
    if response.status == Status.RANGE:
        raise _refusal(response.payload.decode("utf-8", "replace"))
    return _object(expect(request, response, SimSetResponse).text)


def _refusal(text: str) -> InvalidRequest:
    """The simulator's refusal: the field at fault, empty where there is none, a line break, why."""
    field, _, words = text.partition("\n")
    message = words or field or "The simulated unit refuses these values."
    faults = [FieldError(field, "not_accepted", message)] if field and words else []
    return InvalidRequest(message, fields=faults)


def _inflated(text: bytes) -> bytes:
    inflator = zlib.decompressobj()
    try:
        return inflator.decompress(text, TEXT_BYTES_MAX)
    except zlib.error:
        return text


def _object(text: bytes) -> dict[str, Any]:
    try:
        # What does not fit a frame as it is comes deflated.
        document = json.loads(text if text.startswith(b"{") else _inflated(text))
    except ValueError as error:
        raise PeerProtocolError(f"The simulated unit does not answer in JSON ({error}).") from error
    if not isinstance(document, dict):
        raise PeerProtocolError("The simulated unit does not answer with an object.")
    return document
