"""Which rides a file's ride belongs to that are here already: recorded live, or fetched before.

A unit's log and the live recording of the same ride differ in every byte. What they share is the
unit, its start and the unit's clock: enough to tell one ride from every other.
"""

from __future__ import annotations

from collections.abc import Iterator

from backend.core.ride import Ride
from backend.formats import ImportedRide
from backend.store import RideStore, Sought

# A log and a recording that have so much of the unit's time in common, or half of the log, are of
# one ride. Less is the end of the ride before, which a recorder may end a little later.
SHARED_US = 5_000_000
PAGE = 200
# Rides of one unit that are looked through; more than a season of them.
PAGES_MAX = 25


def same_rides(rides: RideStore, imported: ImportedRide, upload_id: str | None) -> list[Ride]:
    """The rides that share unit time with `imported`, in order of time; empty when it is new.

    A link that was lost for long makes several rides of one log. upload_id: rides of this upload do
    not count.
    """
    context = imported.context
    if context.unit_key is None or context.boot_id is None or context.unit_t0_us is None:
        return []
    start_us = context.unit_t0_us
    stop_us = start_us + int(imported.rows.times_us[-1]) + (imported.period_us or 0)
    enough_us = min(SHARED_US, (stop_us - start_us) / 2)
    found = [
        ride
        for ride in rides_of_boot(rides, context.unit_key, context.boot_id)
        if (ride.upload_id is None or ride.upload_id != upload_id)
        and overlap_us((start_us, stop_us), ride_span_us(ride)) >= max(enough_us, 1.0)
    ]
    return sorted(found, key=ride_span_us)


def rides_of_boot(rides: RideStore, key: str, boot_id: int) -> Iterator[Ride]:
    """Rides of one start of a unit, the newest first."""
    cursor: str | None = None
    for _ in range(PAGES_MAX):
        page = rides.list(Sought(device=key), limit=PAGE, cursor=cursor)
        yield from (ride for ride in page.items if ride.context.boot_id == boot_id)
        cursor = page.next
        if cursor is None:
            return


def ride_span_us(ride: Ride) -> tuple[int, int]:
    """Unit time from a ride's first row to behind its last; nothing where nobody knows it."""
    began_us = ride.context.unit_t0_us
    if began_us is None or ride.period_us is None:
        return 0, 0
    return began_us, began_us + ride.row_count * ride.period_us


def overlap_us(one: tuple[int, int], other: tuple[int, int]) -> int:
    """Length of what two stretches share."""
    return max(0, min(one[1], other[1]) - max(one[0], other[0]))
