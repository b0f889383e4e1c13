"""Values on trial in a unit's memory alone: set for some seconds, read, ended.

They are over the active configuration for the law, in no flash and in no checksum, moving or not;
the unit ends them by itself, and with every change of its configuration.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from backend.device.configuration import Value, ValuesOnTrial
from backend.device.ebl.operations.config_transaction import MESSAGE_OVERHEAD_BYTES, read_config
from backend.device.ebl.operations.parameters import unit_violations
from backend.device.ebl.session.operation import Operation, attempt, query, query_all
from backend.device.ebl.session.refusals import refused
from backend.errors import AccessDenied, FieldError, LimitViolation, NoAnswer, PeerProtocolError
from firmware_protocol._generated import (
    IMAGE_LENGTH,
    MTU,
    PARAMETER_BY_ID,
    PARAMETERS,
    CfgStatusRequest,
    CfgStatusResponse,
    LiveSetRequest,
    ParamGetRequest,
    ParamGetResponse,
    Status,
)
from firmware_protocol.layout import Parameter
from firmware_protocol.parameters import ITEM_HEAD, set_items, unpack_image


def read_trial_values(mtu: int = MTU) -> Operation[ValuesOnTrial]:
    """What is on trial, read from the unit. Raises NoAnswer, DeviceRefused, PeerProtocolError."""
    status = yield from query(CfgStatusRequest(), CfgStatusResponse)
    if status.live_left_ms == 0:
        return ValuesOnTrial({}, 0.0)
    config = yield from read_config(mtu)
    in_force = yield from values_in_force(mtu)
    tried = {name: in_force[name] for name in in_force if in_force[name] != config.parameters[name]}
    return ValuesOnTrial(tried, status.live_left_ms / 1000.0)


def values_in_force(mtu: int = MTU) -> Operation[dict[str, Value]]:
    """Every parameter as the law uses it now. Raises PeerProtocolError for items that are none."""
    groups = _groups(mtu - MESSAGE_OVERHEAD_BYTES)
    requests = [
        ParamGetRequest(b"".join(row.id.to_bytes(2, "little") for row in rows)) for rows in groups
    ]
    answers = yield from query_all(requests, ParamGetResponse)
    image = bytearray(IMAGE_LENGTH)
    missing = {row.id for row in PARAMETERS}
    for row, data in _items(b"".join(answer.items for answer in answers)):
        image[row.image_offset : row.image_offset + row.size] = data
        missing.discard(row.id)
    if missing:
        raise PeerProtocolError("The unit left parameters out that it was asked for.")
    return unpack_image(bytes(image))


def set_trial_values(
    changes: Mapping[str, Value], ttl_s: int, mtu: int = MTU
) -> Operation[ValuesOnTrial]:
    """Put values on trial for `ttl_s` seconds over what is in force, and read them back.

    changes: checked values by registry name. Raises LimitViolation, AccessDenied, DeviceRefused
    with nothing more on trial than before, PeerProtocolError naming what reads back different.
    """
    for items in set_items(changes, mtu - MESSAGE_OVERHEAD_BYTES):
        request = LiveSetRequest(ttl_s, items)
        response = yield from attempt(request)
        if response.status == Status.INVALID_CONFIG:
            fields = unit_violations(response.payload)
            words = " ".join(field.message for field in fields)
            raise LimitViolation(f"The unit refuses these values: {words}", fields=fields)
        if response.status == Status.ACCESS:
            raise AccessDenied(
                "What the maker protects cannot be put on trial: it needs a token, and a token "
                "allows a whole configuration. Write it as a change instead."
            )
        if response.status != Status.OK:
            raise refused(request, response)
    in_force = yield from values_in_force(mtu)
    wrong = [
        FieldError(name, "read_back_differs", f"{name} should be {value}, is {in_force[name]}.")
        for name, value in changes.items()
        if in_force[name] != value
    ]
    if wrong:
        words = " ".join(field.message for field in wrong)
        message = f"The unit has something else on trial than it was sent: {words}"
        raise PeerProtocolError(message, "read_back_differs", wrong)
    return (yield from read_trial_values(mtu))


def outcome_of_trial_values(
    before: Mapping[str, Value], values: Mapping[str, Value], mtu: int = MTU
) -> Operation[ValuesOnTrial]:
    """What is on trial, if all of `values` are in force. before: these before they were sent.

    Raises NoAnswer with the outcome: `unchanged` when none of them is, `changed` when some are.
    """
    in_force = yield from values_in_force(mtu)
    taken = [name for name in values if in_force[name] == values[name]]
    if len(taken) == len(values):
        return (yield from read_trial_values(mtu))
    if all(in_force[name] == before[name] for name in values):
        raise NoAnswer(
            "The unit did not answer. It was asked again since: nothing of this is on trial.",
            outcome="unchanged",
        )
    raise NoAnswer(
        "The unit did not answer all of it. It was asked again since: of what was sent only "
        f"{', '.join(taken) or 'something else'} is on trial. End it, or send it once more.",
        outcome="changed",
    )


def outcome_of_trial_values_end(mtu: int = MTU) -> Operation[ValuesOnTrial]:
    """What is on trial, if that is nothing. Raises NoAnswer, with `unchanged` when it still is."""
    state = yield from read_trial_values(mtu)
    if state.left_s > 0.0:
        raise NoAnswer(
            "The unit did not answer. It was asked again since: the values are still on trial.",
            outcome="unchanged",
        )
    return state


def end_trial_values() -> Operation[None]:
    """End what is on trial; nothing happens where nothing is."""
    request = LiveSetRequest(0, b"")
    response = yield from attempt(request)
    if response.status != Status.OK:
        raise refused(request, response)


def _groups(length_max: int) -> Iterable[list[Parameter]]:
    """Parameters whose items fit into one answer together."""
    groups: list[list[Parameter]] = [[]]
    length = 0
    for row in PARAMETERS:
        size = ITEM_HEAD.size + row.size
        if groups[-1] and length + size > length_max:
            groups.append([])
            length = 0
        groups[-1].append(row)
        length += size
    return groups


def _items(data: bytes) -> Iterator[tuple[Parameter, bytes]]:
    """Whole parameters in PARAM_GET's items. Raises PeerProtocolError."""
    at = 0
    while at < len(data):
        row = None
        if len(data) - at >= ITEM_HEAD.size:
            identity, first, count = ITEM_HEAD.unpack_from(data, at)
            row = PARAMETER_BY_ID.get(identity)
        at += ITEM_HEAD.size
        if row is None or (first, count) != (0, row.count) or len(data) - at < row.size:
            raise PeerProtocolError("The unit's values in force cannot be read: an item is cut.")
        yield row, data[at : at + row.size]
        at += row.size
