"""Whether a ride from a file is one that is here already: recorded live, or fetched before.

A unit's log and the live recording of the same ride differ in every byte. What they share is the
unit, its start and the unit's clock: enough to tell one ride from every other.
"""

from __future__ import annotations

from collections.abc import Iterator

from backend.domain.ride import Ride
from backend.ingest import ImportedRide
from backend.store import RideStore

# So much of a log must be in rides that are here for it to be one of them. What is missing at its
# ends is the recorder's lead-in and the last block of a log.
SAME_SHARE = 0.9
PAGE = 200
# Rides of one unit that are looked through; more than a season of them.
PAGES_MAX = 25


def same_ride(rides: RideStore, imported: ImportedRide, upload_id: str | None) -> Ride | None:
    """The ride that has most of what `imported` has, None when no rides here have 90 % of it.

    upload_id: rides of this upload do not count.
    """
    context = imported.context
    if context.device_serial is None or context.boot_id is None or context.unit_t0_us is None:
        return None
    start_us = context.unit_t0_us
    stop_us = start_us + int(imported.rows.times_us[-1]) + (imported.period_us or 0)
    best: Ride | None = None
    best_us = covered_us = 0.0
    for ride in rides_of_boot(rides, context.device_serial, context.boot_id):
        if ride.upload_id is not None and ride.upload_id == upload_id:
            continue
        shared_us = shared(ride, start_us, stop_us)
        covered_us += shared_us
        if shared_us > best_us:
            best, best_us = ride, shared_us
    return best if covered_us >= SAME_SHARE * (stop_us - start_us) else None


def rides_of_boot(rides: RideStore, serial: str, boot_id: int) -> Iterator[Ride]:
    """Rides of one start of a unit, the newest first."""
    cursor: str | None = None
    for _ in range(PAGES_MAX):
        page = rides.list(device=serial, limit=PAGE, cursor=cursor)
        yield from (ride for ride in page.items if ride.context.boot_id == boot_id)
        cursor = page.next
        if cursor is None:
            return


def shared(ride: Ride, start_us: int, stop_us: int) -> float:
    """Microseconds of [start_us, stop_us) of unit time for which a ride has samples."""
    began_us = ride.context.unit_t0_us
    if began_us is None or ride.period_us is None:
        return 0.0
    ended_us = began_us + ride.row_count * ride.period_us
    total = overlap(start_us, stop_us, began_us, ended_us)
    for gap in ride.gaps:
        gap_us = (began_us + gap.from_s * 1e6, began_us + gap.to_s * 1e6)
        total -= overlap(start_us, stop_us, *gap_us)
    return max(0.0, total)


def overlap(start: float, stop: float, other_start: float, other_stop: float) -> float:
    """Length of what two stretches share."""
    return max(0.0, min(stop, other_stop) - max(start, other_start))
