"""What became of a change whose answer was lost: asked for patiently, until the unit answers."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from backend.device.ebl.session.operation import Operation
from backend.errors import LinkError, NoAnswer, NotFound, RequestRefused
from backend.services.config_view import Change
from backend.services.connect import Devices

Result = TypeVar("Result")

# A unit that fell silent in the middle of a change is waited for so long to learn what it did.
SETTLE_S = 20.0
# Between attempts: a dying link looks whole for a moment, and fails at once.
PAUSE_S = 0.2


@dataclass(frozen=True)
class Unsettled:
    """A write nobody knows the outcome of: what it would be in the log, once it is found done."""

    crc32: int
    changed: Sequence[Change]
    reason: str
    author: str
    state: str


def settled(
    devices: Devices,
    device_id: str,
    operation: Callable[[int], Operation[Result]],
    error: NoAnswer,
) -> Result:
    """Ask what became of a change, until the unit answers.

    operation: made with the unit's mtu; raises NoAnswer with an outcome where it found one out.
    Raises what the operation raises; `error`, as unknown, when the unit does not come back.
    """
    until_s = time.monotonic() + SETTLE_S
    while (left_s := until_s - time.monotonic()) > 0.0:
        try:
            devices.wait_connected(device_id, left_s)
            mtu = devices.writable(device_id).mtu
        except RequestRefused:
            # It was removed, or came back as one whose configuration nobody here understands.
            break
        try:
            return devices.run(device_id, operation(mtu))
        except NoAnswer as silent:
            if silent.outcome is not None:
                raise silent from error
        except NotFound:
            break
        except LinkError:
            pass
        time.sleep(PAUSE_S)
    error.outcome = "unknown"
    raise error
