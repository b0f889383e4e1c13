"""What is known of a ride only after it began, its right date and what its unit is; and rides that
are over become objects on the store's own thread, again and again until one does."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, replace

from backend.core.moments import set_by_us
from backend.core.ride import Ride, RideContext
from backend.core.ride_events import CLOCK_SET, RideEvent
from backend.errors import StoreError
from backend.store import RideStore

LOG = logging.getLogger(__name__)

# How often a ride that could not be finished is tried again.
FINISH_AGAIN_S = 10.0


class Finishing:
    """For any thread. unfinished: rides of a server that died, to be finished from now on."""

    def __init__(self, rides: RideStore, unfinished: Sequence[int] = ()) -> None:
        self._rides = rides
        # Rides that could not be finished: when to try again (Unix time), and how they ended.
        self._unfinished = dict.fromkeys(unfinished, (0, True))

    def finish(self, ride_id: int, cut_short: bool) -> Future[Ride | None]:
        """Finish a ride; tried again, by `tick`, as long as that fails.

        cut_short: the bike moved when the recording ended.
        """

        def done(future: Future[Ride | None]) -> None:
            if future.exception() is None:
                self._unfinished.pop(ride_id, None)
            elif ride_id not in self._unfinished:
                self._unfinished[ride_id] = 0, cut_short
                log_failure(ride_id, future)

        finished: Future[Ride | None] = self._rides.finish_later(ride_id, cut_short)
        finished.add_done_callback(done)
        return finished

    def tick(self, now_us: int) -> None:
        """Try again what is due; now_us: Unix time."""
        later_us = now_us + round(FINISH_AGAIN_S * 1e6)
        for ride_id, (due_us, cut_short) in list(self._unfinished.items()):
            # What is due later than that was noted before the clock was set back.
            if not now_us < due_us <= later_us:
                self._unfinished[ride_id] = later_us, cut_short
                self.finish(ride_id, cut_short)


def log_failure(ride_id: int, future: Future[Ride | None]) -> None:
    """Say in the log when a ride could not be finished."""
    error = future.exception()
    if isinstance(error, StoreError):
        LOG.warning("Ride %d is kept but not finished: %s", ride_id, error.message)
    elif error is not None:
        LOG.error("Ride %d was not finished.", ride_id, exc_info=error)


@dataclass
class RideClock:
    """By which clock a ride is dated. offset_us: Unix time minus the host's steady time as its
    start is given by. last_rows_us: that steady time when its newest rows came."""

    offset_us: int
    last_rows_us: int


def redate_after_clock_set(
    rides: RideStore, ride_id: int, clock: RideClock, offset_us: int, t_s: float
) -> bool:
    """Date a ride anew where the host's clock was set since, and mark it; True once that is done.

    offset_us: of now. t_s: now, after the ride's start. A store that refuses it has told so
    elsewhere; then it is to be tried again, and the ride must not be finished before.
    """
    by_us = set_by_us(clock.offset_us, offset_us)
    if by_us == 0:
        return True
    with suppress(StoreError):
        rides.redate(ride_id, by_us, RideEvent(t_s, CLOCK_SET, round(by_us / 1000)))
        LOG.warning("Ride %d is dated anew: the clock was set by %.0f s.", ride_id, by_us / 1e6)
        clock.offset_us = offset_us
        return True
    return False


def complete_context(rides: RideStore, ride_id: int, began: RideContext, now: RideContext) -> None:
    """Say what the unit told of itself only after the bike began to move.

    The configuration that was in force at the start stays the ride's.
    """
    if began.gear_ratio is not None or now.gear_ratio is None:
        return
    if (crc32 := began.config_crc32) is not None:
        now = replace(now, config_generation=began.config_generation, config_crc32=crc32)
    try:
        rides.set_context(ride_id, now)
    except StoreError as error:
        LOG.warning("Ride %d does not know its gear ratio: %s", ride_id, error.message)
