"""What became of a change whose answer was lost: asked for patiently, until the unit answers."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

from backend.device.unit import Unit
from backend.errors import LinkError, NoAnswer, NotFound, RequestRefused
from backend.services.connect import Devices

Result = TypeVar("Result")

# A unit that fell silent in the middle of a change is waited for so long to learn what it did.
SETTLE_S = 20.0
# Between attempts: a dying link looks whole for a moment, and fails at once.
PAUSE_S = 0.2


def settled(
    devices: Devices,
    device_id: str,
    look: Callable[[Unit], Result],
    error: NoAnswer,
) -> Result:
    """Ask what became of a change, until the unit answers.

    look: raises NoAnswer with an outcome where it found one out. Raises what `look` raises;
    `error`, as unknown, when the unit does not come back.
    """
    until_s = time.monotonic() + SETTLE_S
    while (left_s := until_s - time.monotonic()) > 0.0:
        try:
            devices.wait_connected(device_id, left_s)
            unit = devices.writable(device_id)
        except RequestRefused:
            # It was removed, or came back as one whose configuration nobody here understands.
            break
        try:
            return look(unit)
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
