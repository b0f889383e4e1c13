"""What became of a change: told with every NoAnswer that a caller gets, or found out."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from backend.device.driver import NEVER_SENT
from backend.device.unit import Unit
from backend.errors import LinkError, NoAnswer, NotFound, OtherUnit, Outcome, RequestRefused
from backend.units.service import Devices

Result = TypeVar("Result")

# A unit that fell silent in the middle of a change is waited for so long to learn what it did.
OUTCOME_WAIT_S = 20.0
# Between attempts: a dying link looks whole for a moment, and fails at once.
PAUSE_S = 0.2


@contextmanager
def telling(outcome: Outcome) -> Iterator[None]:
    """Let a NoAnswer from in here say what became of the change, unless it does by itself."""
    try:
        yield
    except NoAnswer as error:
        if error.outcome is None:
            error.outcome = "unchanged" if error.code in NEVER_SENT else outcome
        raise


def find_outcome(
    devices: Devices,
    device_id: str,
    unit_key: str,
    read: Callable[[Unit], Result],
    error: NoAnswer,
) -> Result:
    """Ask what became of a change, until the unit answers.

    unit_key: of the unit that was to change: another one in its place knows nothing. read: raises
    NoAnswer with an outcome where it found one out. Raises what `read` raises; `error`, as unknown,
    when the unit does not come back.
    """
    until_s = time.monotonic() + OUTCOME_WAIT_S
    while (left_s := until_s - time.monotonic()) > 0.0:
        try:
            devices.wait_connected(device_id, left_s)
            _, unit = devices.own(device_id, unit_key)
        except RequestRefused:
            # It was removed, another one has its place, or nobody here understands it any more.
            break
        except NoAnswer:
            continue
        try:
            return read(unit)
        except OtherUnit:
            break
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
