"""What became of a change whose answer was lost: read again until it is known.

The line keeps its order, and a request that went unanswered is not sent again: whatever of the
change can still reach the unit is there before what is asked here.
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping

from backend.device.configuration import NO_TRIAL, ConfigImage, Value
from backend.device.ebl.operations.config_transaction import compare, read_config
from backend.device.ebl.session.operation import Operation
from backend.device.ebl.session.trial_status import trial_status
from backend.errors import ConfigConflict, Conflict, NoAnswer, PeerProtocolError
from firmware_protocol._generated import MTU
from firmware_protocol.parameters import pack_image


def outcome_of_write(
    base: ConfigImage, intended: Mapping[str, Value], mtu: int = MTU
) -> Operation[ConfigImage]:
    """What the unit has, if it is what was meant.

    Raises NoAnswer with the outcome `unchanged` when it has `base`, ConfigConflict when it has
    neither, PeerProtocolError naming fields when it made something else of the change, NoAnswer
    without an outcome when it is silent.
    """
    current = yield from _read(mtu)
    if (current.generation, current.crc32) == (base.generation, base.crc32):
        raise NoAnswer(
            "The unit did not answer the change. It was read again since: its configuration "
            "is unchanged. Write once more.",
            outcome="unchanged",
        )
    if current.generation != base.generation + 1:
        raise ConfigConflict(
            "The unit did not answer the change and has another configuration now. Read it "
            "again and look at the difference."
        )
    if current.crc32 != zlib.crc32(pack_image(intended)):
        compare(intended, current.parameters)
    return current


def outcome_of_confirm(tried: ConfigImage) -> Operation[ConfigImage]:
    """What was on trial, if it is kept.

    Raises NoAnswer with the outcome `unchanged` while it is still on trial, Conflict when it was
    given up, NoAnswer without an outcome when the unit is silent.
    """
    status = yield from trial_status()
    if (status.generation, status.crc32) != (tried.generation, tried.crc32):
        raise Conflict(NO_TRIAL, "no_trial")
    if status.on_trial:
        raise NoAnswer(
            "The unit did not answer. It was asked again since: the change is still on trial. "
            "Keep it once more.",
            outcome="unchanged",
        )
    return tried


def outcome_of_rollback(tried: ConfigImage, mtu: int = MTU) -> Operation[ConfigImage]:
    """What the unit has, if what was on trial is given up.

    Raises NoAnswer with the outcome `unchanged` while it is still on trial, Conflict when it was
    kept, NoAnswer without an outcome when the unit is silent.
    """
    status = yield from trial_status()
    if (status.generation, status.crc32) == (tried.generation, tried.crc32):
        if not status.on_trial:
            raise Conflict(NO_TRIAL, "no_trial")
        raise NoAnswer(
            "The unit did not answer. It was asked again since: the change is still on trial. "
            "Give it up once more.",
            outcome="unchanged",
        )
    return (yield from _read(mtu))


def _read(mtu: int) -> Operation[ConfigImage]:
    """A configuration that contradicts itself tells nothing: it is as good as no answer."""
    try:
        return (yield from read_config(mtu))
    except PeerProtocolError as error:
        raise NoAnswer(error.message) from error
