"""Reading a unit's configuration whole, and changing it all or not at all.

A change is a transaction on a named base: if anybody moved the configuration meanwhile, the unit
refuses. The host computes the checksum of the image it means, the unit commits only that image,
and what counts in the end is the image read back and compared field by field.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Mapping

from backend.device.configuration import ConfigImage, Value
from backend.device.ebl.operations.parameters import unit_violations
from backend.device.ebl.operations.unlock import access_refused, show_token
from backend.device.ebl.session.operation import (
    Operation,
    OrphanLeft,
    attempt,
    attempt_patiently,
    expect,
    query,
    query_all,
)
from backend.device.ebl.session.refusals import refused
from backend.errors import (
    ConfigConflict,
    DeviceRefused,
    FieldError,
    LimitViolation,
    LinkError,
    NoAnswer,
    NotFound,
    NotStandingStill,
    PeerProtocolError,
    SpindleError,
)
from firmware_protocol._generated import (
    IMAGE_LENGTH,
    MTU,
    MTU_BEFORE_HELLO,
    PARAMETERS,
    Bank,
    CfgAbortRequest,
    CfgBeginRequest,
    CfgBeginResponse,
    CfgCommitRequest,
    CfgCommitResponse,
    CfgInfoRequest,
    CfgInfoResponse,
    CfgReadRequest,
    CfgReadResponse,
    CfgSetRequest,
    CfgSetResponse,
    CfgValidateRequest,
    CfgWearRequest,
    CfgWearResponse,
    CommitFlags,
    Status,
)
from firmware_protocol.codec import Response
from firmware_protocol.parameters import pack_image, set_items, unpack_image
from firmware_protocol.unlock_token import Token

# Bytes of a CFG_READ answer or CFG_SET request that are not data: header, CRC, fields, rounded up.
MESSAGE_OVERHEAD_BYTES = 24
# Somebody else may commit between our reading of generation and image; thrice is no accident.
READ_ATTEMPTS = 3
MS_PER_S, S_PER_MIN = 1000.0, 60
# A unit that rebooted, or that another tool took over, in the middle of a commit no longer knows
# the transaction when the commit is repeated, whether it was carried out or not.
TRANSACTION_GONE = (Status.STATE, Status.SESSION)


class CommitUnanswered(NoAnswer):
    """The commit was sent and nobody said what became of it; only reading again can tell."""

    default_code = "commit_unanswered"

    def __init__(self, message: str) -> None:
        super().__init__(message, outcome="unknown")


def read_config(mtu: int = MTU) -> Operation[ConfigImage]:
    """Read the active configuration whole. Raises PeerProtocolError when it contradicts itself."""
    for _ in range(READ_ATTEMPTS):
        info = yield from query(CfgInfoRequest(), CfgInfoResponse)
        if info.image_length != IMAGE_LENGTH:
            raise PeerProtocolError(
                f"The unit's configuration has {info.image_length} bytes where its description "
                f"says {IMAGE_LENGTH}; its firmware is damaged."
            )
        generation, image = yield from _read_image(Bank.ACTIVE, mtu)
        if image is not None and (generation, zlib.crc32(image)) == (info.generation, info.crc32):
            return ConfigImage(info.generation, info.crc32, unpack_image(image))
        if image is None:
            # A unit that restarted since HELLO answers in short frames until the next HELLO.
            mtu = MTU_BEFORE_HELLO
    raise PeerProtocolError(
        "The configuration the unit sends does not have the checksum it names, "
        f"{READ_ATTEMPTS} times over. Read it again; if it stays so, the unit is defective."
    )


def read_bank(name: str, mtu: int = MTU) -> Operation[ConfigImage]:
    """Read another bank whole, `previous` or `default`; the default has generation 0.

    Raises NotFound for a unit that has had no other configuration, PeerProtocolError.
    """
    bank = Bank[name.upper()]
    for _ in range(READ_ATTEMPTS):
        try:
            generation, image = yield from _read_image(bank, mtu)
        except DeviceRefused as error:
            if error.status != Status.NOT_FOUND.name:
                raise
            raise NotFound(
                f"The unit has no {name} configuration: nothing else was ever "
                "committed in it, or its flash does not hold it any more."
            ) from None
        if image is not None:
            return ConfigImage(generation, zlib.crc32(image), unpack_image(image))
        mtu = MTU_BEFORE_HELLO
    raise PeerProtocolError(
        f"The unit's {name} configuration changed while it was read, {READ_ATTEMPTS} "
        "times over. Read it again."
    )


def _read_image(bank: Bank, mtu: int) -> Operation[tuple[int, bytes | None]]:
    """Generation and image; None where the pieces do not make one of a single generation."""
    piece = mtu - MESSAGE_OVERHEAD_BYTES
    requests = [
        CfgReadRequest(bank, at, min(piece, IMAGE_LENGTH - at))
        for at in range(0, IMAGE_LENGTH, piece)
    ]
    parts = yield from query_all(requests, CfgReadResponse)
    image = b"".join(part.data for part in parts)
    is_complete = all(
        len(part.data) == one.length for one, part in zip(requests, parts, strict=True)
    )
    same = len({part.generation for part in parts}) == 1
    return parts[0].generation, image if is_complete and same else None


def write_config(
    base: ConfigImage,
    changes: Mapping[str, Value],
    mtu: int = MTU,
    confirm_s: int = 0,
    token: Token | None = None,
) -> Operation[ConfigImage]:
    """Change parameters on top of `base`, read everything back, compare, return what is active.

    changes: checked values by registry name. confirm_s: 0 for good, else the unit returns to `base`
    by itself after so many seconds unless the change is confirmed. token: the maker's, for what the
    unit protects. Raises ConfigConflict, LimitViolation, TokenNeeded, AccessDenied,
    NotStandingStill, DeviceRefused, NoAnswer with the unit unchanged; CommitUnanswered when that is
    unknown; PeerProtocolError naming each field that reads back different.
    """
    image = pack_image({**base.parameters, **changes})
    yield from _commit(base, changes, image, mtu, confirm_s, token)
    try:
        read_back = yield from read_config(mtu)
    except PeerProtocolError:
        raise
    except SpindleError as error:
        raise CommitUnanswered(
            f"The unit took the change and could not be read back: {error.message} What it holds "
            "is not known until it answers."
        ) from error
    compare(unpack_image(image), read_back.parameters)
    return read_back


def compare(intended: Mapping[str, Value], read_back: Mapping[str, Value]) -> None:
    """Raise PeerProtocolError naming every parameter whose value is not the intended one."""
    wrong = [
        FieldError(
            row.name,
            "read_back_differs",
            f"{row.name} should be {intended[row.name]} and reads back {read_back[row.name]}.",
        )
        for row in PARAMETERS
        if intended[row.name] != read_back[row.name]
    ]
    if wrong:
        raise PeerProtocolError(
            "The unit confirmed the change, but what it holds is something else: "
            + " ".join(error.message for error in wrong)
            + " Do not ride; write again or restore a backup.",
            code="read_back_differs",
            fields=wrong,
        )


def _commit(
    base: ConfigImage,
    changes: Mapping[str, Value],
    image: bytes,
    mtu: int,
    confirm_s: int,
    token: Token | None,
) -> Operation[None]:
    begin = yield from _begin(base)
    try:
        for items in set_items(changes, mtu - MESSAGE_OVERHEAD_BYTES):
            yield from query(CfgSetRequest(begin.transaction, items), CfgSetResponse)
        yield from _validate(begin.transaction)
        if token is not None:
            yield from show_token(begin.transaction, token)
        yield from _finish(begin.transaction, zlib.crc32(image), confirm_s)
    except CommitUnanswered:
        raise
    except SpindleError as error:
        if not (yield from _abort(begin.transaction)):
            left = _explained(error)
            raise OrphanLeft(left.message, fields=left.fields) from error
        if isinstance(error, DeviceRefused) and error.status == Status.ACCESS.name:
            denied = yield from access_refused(error.detail, base.parameters, changes, image)
            raise denied from error
        raise _explained(error) from error


def _begin(base: ConfigImage) -> Operation[CfgBeginResponse]:
    request = CfgBeginRequest(base.generation, base.crc32)
    try:
        response = yield from attempt(request)
    except NoAnswer as error:
        # It may have been heard: then a transaction is open whose number we do not know.
        raise OrphanLeft(_explained(error).message) from error
    if response.status == Status.STALE_BASE:
        raise ConfigConflict(
            f"The unit's configuration is no longer generation {base.generation}: somebody else "
            "changed it. Read it again, look at the difference, and write once more."
        )
    if response.status == Status.BUSY:
        raise DeviceRefused(
            "Another change is open or on trial in the unit. "
            f"It ends by itself in {response.detail} s, or when what is on trial is kept or "
            "reverted; write once more then. Nothing was changed.",
            status=Status.BUSY.name,
            detail=response.detail,
        )
    return expect(request, response, CfgBeginResponse)


def _validate(transaction: int) -> Operation[None]:
    request = CfgValidateRequest(transaction)
    response = yield from attempt(request)
    if response.status == Status.INVALID_CONFIG:
        fields = unit_violations(response.payload)
        raise LimitViolation(
            "The unit refuses these values: " + " ".join(error.message for error in fields),
            fields=fields,
        )
    if response.status != Status.OK:
        raise refused(request, response)


def _finish(transaction: int, crc32: int, confirm_s: int) -> Operation[None]:
    flags = CommitFlags.PROVISIONAL if confirm_s else 0
    request = CfgCommitRequest(transaction, crc32, flags, confirm_s)
    try:
        response = yield from attempt_patiently(request)
    except LinkError as error:
        raise CommitUnanswered(
            f"{error.message} Whether the change was made is not known until it answers."
        ) from error
    if response.status == Status.RATE_LIMIT:
        raise (yield from _spared(response))
    if response.status in TRANSACTION_GONE:
        raise CommitUnanswered(
            f"{refused(request, response).message} It was restarted or taken over while it "
            "committed; whether the change was made is not known until it is read again."
        )
    done = expect(request, response, CfgCommitResponse)
    if done.crc32 != crc32:
        raise PeerProtocolError(
            f"The unit committed a configuration with checksum {done.crc32:08x} where "
            f"{crc32:08x} was meant. Read it again before riding."
        )


def _spared(response: Response) -> Operation[DeviceRefused]:
    """The refusal of a unit whose flash was written too often, with the time to wait."""
    answer = yield from attempt(CfgWearRequest())
    wait_s: float = response.detail / MS_PER_S
    if isinstance(answer.message, CfgWearResponse):
        wait_s = max(wait_s, answer.message.wait_s)
    minutes = math.ceil(wait_s / S_PER_MIN)
    return DeviceRefused(
        "The unit spares its memory, which was written very often: the next write is possible "
        f"after {minutes // 60} h {minutes % 60:02} min of operation. Nothing was changed.",
        status=Status.RATE_LIMIT.name,
        detail=response.detail,
    )


def _abort(transaction: int) -> Operation[bool]:
    """Drop what is staged; False when the unit did not answer."""
    try:
        yield from attempt(CfgAbortRequest(transaction))
    except SpindleError:
        return False
    return True


def _explained(error: SpindleError) -> SpindleError:
    """The error as people meet it; in every case here the active configuration is untouched."""
    if isinstance(error, NoAnswer):
        message = f"{error.message} The unit's configuration is unchanged."
        return NoAnswer(message, error.code, outcome="unchanged")
    if not isinstance(error, DeviceRefused):
        return error
    if error.status == Status.NOT_STOPPED.name:
        return NotStandingStill(
            "The unit refuses to change its configuration while wheel or motor turn. Stop the "
            "bike and write again; nothing was changed."
        )
    if error.status in (Status.RANGE.name, Status.TYPE.name, Status.UNKNOWN_ID.name):
        fields = [_named_by_id(error.detail, error.status)]
        return LimitViolation(f"The unit refuses: {fields[0].message}", fields=fields)
    return error


def _named_by_id(parameter_id: int, status: str) -> FieldError:
    """The field a unit's status names by the id in its detail."""
    names = {row.id: row.name for row in PARAMETERS}
    name = names.get(parameter_id, f"parameter {parameter_id:#06x}")
    return FieldError(name, status.lower(), f"{name} was refused by the unit ({status}).")
