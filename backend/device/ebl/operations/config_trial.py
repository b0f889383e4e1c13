"""A configuration on trial, from the host's side: where it stands, keeping it, giving it up.

It is kept only after it was read back whole and every field compared with what was meant.
"""

from __future__ import annotations

from collections.abc import Mapping

from backend.device.configuration import NO_TRIAL, ConfigImage, Value
from backend.device.ebl.operations.config_transaction import CommitUnanswered, compare, read_config
from backend.device.ebl.session.operation import Operation, attempt, expect
from backend.device.ebl.session.trial_status import trial_status
from backend.errors import Conflict, LinkError, NoAnswer
from firmware_protocol._generated import (
    MTU,
    CfgConfirmRequest,
    CfgConfirmResponse,
    CfgRollbackRequest,
    CfgRollbackResponse,
    Status,
)
from firmware_protocol.codec import Response


def confirm_config(intended: Mapping[str, Value], mtu: int = MTU) -> Operation[ConfigImage]:
    """Read back what is on trial, compare every field with `intended`, keep it, and look again.

    Raises Conflict when nothing is on trial (any more), PeerProtocolError naming each field that
    differs, with the trial still running out, NoAnswer, DeviceRefused, CommitUnanswered when nobody
    said whether it is kept.
    """
    status = yield from trial_status()
    if not status.on_trial:
        raise Conflict(NO_TRIAL, "no_trial")
    current = yield from read_config(mtu)
    compare(intended, current.parameters)
    request = CfgConfirmRequest(current.generation, current.crc32)
    response = yield from _decided(request, "kept")
    if response.status in (Status.STALE_BASE, Status.CRC_MISMATCH):
        raise Conflict(NO_TRIAL, "no_trial")
    expect(request, response, CfgConfirmResponse)
    try:
        status = yield from trial_status()
    except NoAnswer as error:
        raise CommitUnanswered(f"{error.message} {_unsure('kept')}") from error
    if (status.generation, status.crc32) != (current.generation, current.crc32) or status.on_trial:
        raise Conflict(
            "The unit did not keep the change: its time ran out meanwhile. Write it again.",
            "no_trial",
        )
    return current


def rollback_config(mtu: int = MTU) -> Operation[ConfigImage]:
    """Give up what is on trial; what is active then, read back.

    Raises Conflict without a trial, CommitUnanswered when nobody said whether it is given up.
    """
    request = CfgRollbackRequest()
    response = yield from _decided(request, "given up")
    if response.status == Status.STATE:
        raise Conflict(NO_TRIAL, "no_trial")
    expect(request, response, CfgRollbackResponse)
    try:
        return (yield from read_config(mtu))
    except NoAnswer as error:
        raise CommitUnanswered(f"{error.message} {_unsure('given up')}") from error


def _decided(request: CfgConfirmRequest | CfgRollbackRequest, done: str) -> Operation[Response]:
    """The answer to the word that ends a trial. Raises CommitUnanswered without one."""
    try:
        response = yield from attempt(request)
    except LinkError as error:
        raise CommitUnanswered(f"{error.message} {_unsure(done)}") from error
    if response.status == Status.SESSION:
        raise CommitUnanswered(f"The unit was restarted meanwhile. {_unsure(done)}")
    return response


def _unsure(done: str) -> str:
    return f"Whether the change was {done} is not known until it answers."
