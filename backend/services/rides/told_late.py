"""What is known of a ride only after it began to be recorded: its right date, what its unit is."""

from __future__ import annotations

import logging
from contextlib import suppress
from dataclasses import dataclass, replace

from backend.core.moments import set_by_us
from backend.core.ride import RideContext
from backend.core.ride_events import CLOCK_SET, RideEvent
from backend.errors import StoreError
from backend.store import RideStore

LOG = logging.getLogger(__name__)


@dataclass
class RideClock:
    """By which clock a ride is dated. offset_us: Unix time minus the host's steady time as its
    start is told by. heard_us: that steady time when its newest rows came."""

    offset_us: int
    heard_us: int


def tell_clock(
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


def tell_context(rides: RideStore, ride_id: int, began: RideContext, now: RideContext) -> None:
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
