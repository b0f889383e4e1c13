"""Whether a file's ride is here already, from another file or recorded live.

By time, track and what was measured: both rides are laid over each other second by second. The same
recording, saved again or in another format, has the same samples in the same seconds, up to what a
format rounds off. Two devices on one handlebar have the same time and nearly the same track, but
never the same samples: receivers differ by metres. Times that do not overlap are two rides, however
alike: a commute is ridden every day.

By the unit's clock: a unit's log and the live recording of the same ride differ in every byte. What
they share is the unit, its start and the unit's clock: enough to tell one ride from every other.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from backend.core.breaks import is_reachable, track_steps_m
from backend.core.energy import KMH_PER_MS
from backend.core.intake import Intake
from backend.core.ride import Ride
from backend.core.sphere import EARTH_M
from backend.formats import ImportedRide
from backend.formats.export.seconds import BySecond, by_second
from backend.store import RideStore, Sought

LATITUDE, LONGITUDE = "latitude_deg", "longitude_deg"
# What tells a recording from another, and what formats round off: TCX has whole watts, GPX 7 digits
# of a degree (1 cm), CSV of head units a tenth of a km/h.
TOLERANCES = {
    "speed_kmh": 0.15,
    "distance_m": 1.5,
    "cadence_rpm": 1.0,
    "heart_rate_bpm": 1.0,
    "rider_power_w": 1.0,
    "rider_torque_nm": 0.1,
    "motor_torque_nm": 0.1,
}
# Receivers side by side differ by 2 to 5 m; what a format rounds off is far below this.
SAME_PLACE_M = 1.0
# Two devices of one ride, with the error of both receivers and the seconds between their clocks.
SAME_ROAD_M = 50.0
AGREE_SHARE = 0.95
# A ride lies within another when so many of its seconds are there.
WITHIN_SHARE = 0.98
OVERLAP_SHARE = 0.5
# Nobody rides for longer without a break that makes two rides.
LONGEST_US = 48 * 3600 * 1_000_000
PAGE = 100
METRES_PER_DEG = math.radians(EARTH_M)
# Channels that a reader may work out from others: having one more of them is no more ride.
WORKED_OUT = frozenset({"speed_kmh", "distance_m", "grade_pct", "altitude_m"})

Seconds = npt.NDArray[np.int64]


class Kind(Enum):
    """How a file's ride is to one that is here.

    EXISTING: all of it is here. FULLER: it has that and more, or less that cannot be.
    OTHER_DEVICE: the same ride by another device. PARTLY: the same recording, each with something
    that the other lacks.
    """

    EXISTING = "known"
    FULLER = "fuller"
    OTHER_DEVICE = "other_device"
    PARTLY = "partly"


@dataclass(frozen=True)
class DuplicateMatch:
    """A ride that is here, and how the file's ride is to it."""

    kind: Kind
    ride: Ride


def find_duplicate(
    rides: RideStore,
    imported: ImportedRide,
    is_complete: bool,
    upload_id: str | None,
    owner_id: int | None = None,
) -> DuplicateMatch | None:
    """The ride that a file's ride is, or is beside of; None for a new one.

    is_complete: nothing of it is missing in its file. upload_id: rides of this upload do not count.
    owner_id: a rider, who learns of no ride but their own.
    """
    if not imported.start_known:
        return None
    start_us = imported.started_us
    stop_us = start_us + int(imported.rows.times_us[-1])
    sought = Sought(from_us=start_us - LONGEST_US, to_us=stop_us + 1, owner_id=owner_id)
    names = (LATITUDE, LONGITUDE, *TOLERANCES)
    theirs: BySecond | None = None
    matches: list[DuplicateMatch] = []
    for ride in rides.list(sought, limit=PAGE).items:
        duration_s = ride.summary.duration_s if ride.summary else 0.0
        over = ride.started_us + duration_s * 1e6 < start_us
        own = upload_id is not None and ride.upload_id == upload_id
        if ride.state != "done" or over or own or separated_by_clock(ride, imported):
            continue
        if theirs is None:
            values = imported_values(imported, names)
            theirs = by_second(start_us, imported.rows.times_us, values)
        reader = rides.reader(ride.id)
        times_us = reader.times_us(0, reader.row_count)
        ours = by_second(ride.started_us, times_us, reader.values(names))
        if (kind := judged(ride, ours, imported, theirs, is_complete)) is not None:
            matches.append(DuplicateMatch(kind, ride))
    order = list(Kind)
    return min(matches, key=lambda kin: order.index(kin.kind), default=None)


def imported_values(
    imported: ImportedRide, names: tuple[str, ...]
) -> dict[str, npt.NDArray[np.float64]]:
    """Values of those of the channels that a file's ride has, missing as NaN."""
    rows = imported.rows
    return {
        channel.name: channel.to_values(rows.counts[channel.name])
        for channel in rows.channels
        if channel.name in names
    }


def judged(
    ride: Ride, ours: BySecond, imported: ImportedRide, theirs: BySecond, is_complete: bool
) -> Kind | None:
    """How two rides are to each other; None when they are two."""
    shared, our_rows, their_rows = np.intersect1d(ours.unix_s, theirs.unix_s, return_indices=True)
    shorter = min(len(ours), len(theirs))
    if not shorter:
        return None  # nothing was measured that could tell
    if len(shared) >= OVERLAP_SHARE * shorter and may_be_one(ride, imported):
        ours_shared, theirs_shared = taken(ours, our_rows), taken(theirs, their_rows)
        if is_same_recording(ours_shared, theirs_shared):
            within = (len(shared) / len(ours), len(shared) / len(theirs))
            worse = impossible(ride.intake, ours) - impossible(imported.intake, theirs)
            return of_one_recording(ride, imported, within, is_complete, worse > 0)
    span = min(ours.unix_s[-1], theirs.unix_s[-1]) - max(ours.unix_s[0], theirs.unix_s[0])
    length = min(np.ptp(ours.unix_s), np.ptp(theirs.unix_s))
    if span < max(1, OVERLAP_SHARE * length):
        return None
    return Kind.OTHER_DEVICE if is_same_road(ours, theirs) else None


def separated_by_clock(ride: Ride, imported: ImportedRide) -> bool:
    """Whether a unit's own clock has told the two apart already (`same_ride`)."""
    return ride.context.boot_id is not None and imported.context.boot_id is not None


def may_be_one(ride: Ride, imported: ImportedRide) -> bool:
    """Whether one device may have made both: two serial numbers are two devices."""
    serials = {ride.context.device_serial, imported.context.device_serial} - {None}
    return len(serials) < 2


def of_one_recording(
    ride: Ride,
    imported: ImportedRide,
    within: tuple[float, float],
    is_complete: bool,
    is_worse: bool,
) -> Kind:
    """Which of two of one recording has more. within: share of ours in theirs, theirs in ours.

    is_worse: ours has more that cannot be.
    """
    ours = {channel.name for channel in ride.channels} | WORKED_OUT
    offered = {channel.name for channel in ride.offered} | WORKED_OUT
    theirs = {channel.name for channel in imported.rows.channels} | WORKED_OUT
    ours_in_theirs, theirs_in_ours = (share >= WITHIN_SHARE for share in within)
    mends = ride.completeness is not None and ride.completeness < 1.0 and is_complete
    is_better = not theirs_in_ours or mends or is_worse or not theirs <= offered
    may_replace = ride.origin == "imported" and not ride.filled
    if may_replace and ours_in_theirs and ours <= theirs and is_better:
        return Kind.FULLER
    if theirs_in_ours and (theirs <= offered or ride.origin == "recorded"):
        return Kind.EXISTING
    return Kind.PARTLY


def impossible(intake: Intake | None, ride: BySecond) -> int:
    """How much of a ride cannot be: what was left out of it, and positions nobody could reach."""
    valid = np.isfinite(ride[LATITUDE]) & np.isfinite(ride[LONGITUDE])
    steps_m = track_steps_m(ride[LATITUDE][valid], ride[LONGITUDE][valid])
    far = ~is_reachable(steps_m, np.diff(ride.unix_s[valid]).astype(np.float64))
    return int(far.sum()) + (sum(intake.values_dropped.values()) if intake else 0)


def taken(ride: BySecond, rows: npt.NDArray[np.intp]) -> BySecond:
    """Those seconds of a ride."""
    return BySecond(ride.unix_s[rows], {name: v[rows] for name, v in ride.values.items()})


def is_same_recording(ours: BySecond, theirs: BySecond) -> bool:
    """Whether two rides have the same samples. Both: the seconds they share.

    Positions decide where both have them; else everything that both have must agree.
    """
    distances_m = separation_m(ours, theirs)
    if distances_m is not None:
        return bool(np.mean(distances_m <= SAME_PLACE_M) >= AGREE_SHARE)
    shares = []
    for name, tolerance in TOLERANCES.items():
        one, other = ours[name], theirs[name]
        valid = np.isfinite(one) & np.isfinite(other)
        if valid.sum() < OVERLAP_SHARE * len(ours):
            continue
        off = one[valid] - other[valid]
        if name == "distance_m":
            # One counts from the ride's start, the other perhaps from the device's.
            off = off - np.median(off)
        shares.append(float(np.mean(np.abs(off) <= tolerance * 1.001)))
    return bool(shares) and min(shares) >= AGREE_SHARE


def is_same_road(ours: BySecond, theirs: BySecond) -> bool:
    """Whether two devices were on one road at one time: within sight, or as far in as long."""
    seconds = np.union1d(ours.unix_s, theirs.unix_s)
    first = max(ours.unix_s[0], theirs.unix_s[0])
    last = min(ours.unix_s[-1], theirs.unix_s[-1])
    seconds = seconds[(seconds >= first) & (seconds <= last)]
    distances_m = separation_m(at(ours, seconds), at(theirs, seconds))
    if distances_m is not None:
        return bool(np.median(distances_m) <= SAME_ROAD_M)
    ridden = [distance_m(ride, first, last) for ride in (ours, theirs)]
    finite = [metres for metres in ridden if metres is not None]
    return len(finite) == 2 and abs(finite[0] - finite[1]) <= 0.05 * max(*finite, 1.0)


def at(ride: BySecond, seconds: Seconds) -> BySecond:
    """A ride's positions at other seconds, on the straight between its own."""
    values = {}
    for name in (LATITUDE, LONGITUDE):
        valid = np.isfinite(ride[name])
        if valid.sum() > 1:
            values[name] = np.interp(seconds, ride.unix_s[valid], ride[name][valid])
    return BySecond(seconds, values)


def separation_m(ours: BySecond, theirs: BySecond) -> npt.NDArray[np.float64] | None:
    """How far two rides are apart in each second; None where one has hardly any position."""
    north = ours[LATITUDE] - theirs[LATITUDE]
    east = (ours[LONGITUDE] - theirs[LONGITUDE]) * np.cos(np.radians(ours[LATITUDE]))
    separation = np.hypot(north, east) * METRES_PER_DEG
    valid = np.isfinite(separation)
    enough = len(separation) > 0 and valid.sum() >= OVERLAP_SHARE * len(separation)
    return separation[valid] if enough else None


def distance_m(ride: BySecond, first: int, last: int) -> float | None:
    """How far a ride went between two seconds; None where it is unknown."""
    inside = (ride.unix_s >= first) & (ride.unix_s <= last)
    odometer = ride["distance_m"][inside]
    odometer = odometer[np.isfinite(odometer)]
    if len(odometer) > 1:
        return float(odometer[-1] - odometer[0])
    speed = ride["speed_kmh"][inside]
    valid = np.isfinite(speed)
    if not valid.any():
        return None
    return float(np.trapezoid(speed[valid] / KMH_PER_MS, ride.unix_s[inside][valid]))


# A log and a recording that have so much of the unit's time in common, or half of the log, are of
# one ride. Less is the end of the ride before, which a recorder may end a little later.
SHARED_US = 5_000_000
RIDES_AT_ONCE = 200
# Rides of one unit that are looked through; more than a season of them.
PAGES_MAX = 25


def same_rides(
    rides: RideStore,
    imported: ImportedRide,
    upload_id: str | None,
    owner_id: int | None = None,
) -> list[Ride]:
    """The rides that share unit time with `imported`, in order of time; empty when it is new.

    A link that was lost for long makes several rides of one log. upload_id: rides of this upload do
    not count. owner_id: a rider, whose own alone do.
    """
    context = imported.context
    if context.unit_key is None or context.boot_id is None or context.unit_t0_us is None:
        return []
    start_us = context.unit_t0_us
    stop_us = start_us + int(imported.rows.times_us[-1]) + (imported.period_us or 0)
    enough_us = min(SHARED_US, (stop_us - start_us) / 2)
    matching = [
        ride
        for ride in rides_of_boot(rides, context.unit_key, context.boot_id, owner_id)
        if (ride.upload_id is None or ride.upload_id != upload_id)
        and overlap_us((start_us, stop_us), ride_span_us(ride)) >= max(enough_us, 1.0)
    ]
    return sorted(matching, key=ride_span_us)


def rides_of_boot(
    rides: RideStore, key: str, boot_id: int, owner_id: int | None = None
) -> Iterator[Ride]:
    """Rides of one start of a unit, the newest first."""
    cursor: str | None = None
    for _ in range(PAGES_MAX):
        sought = Sought(device=key, owner_id=owner_id)
        page = rides.list(sought, limit=RIDES_AT_ONCE, cursor=cursor)
        yield from (ride for ride in page.items if ride.context.boot_id == boot_id)
        cursor = page.next
        if cursor is None:
            return


def ride_span_us(ride: Ride) -> tuple[int, int]:
    """Unit time from a ride's first row to behind its last; nothing where it is unknown."""
    began_us = ride.context.unit_t0_us
    if began_us is None or ride.period_us is None:
        return 0, 0
    return began_us, began_us + ride.row_count * ride.period_us


def overlap_us(one: tuple[int, int], other: tuple[int, int]) -> int:
    """Length of what two stretches share."""
    return max(0, min(one[1], other[1]) - max(one[0], other[0]))
