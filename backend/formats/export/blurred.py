"""A ride that may be shown to strangers: where it began and ended cannot be derived from it.

Attacks this is made against, and what is done (Hassan, Rahman, Bates 2018, "Analysis of Privacy
Protections in Fitness Tracking Social Networks", USENIX Security):

- Rows within the zone around the ride's first or last position are left out whole, also where the
  ride comes through later, and rows without a position beside such rows: no speed, time, height or
  distance of them is shown.
- A zone centred on the door gives the door away, since tracks end on a circle around it. The middle
  is moved by up to half the blur, in a direction that a secret and the neighbourhood decide: the
  same for every ride from that door, so that many of them cannot be averaged. The radius is one and
  a half blurs, so that nothing within one blur of the door is ever told.
- Distance begins with 0 at the first row that is shown, and a hidden stretch adds nothing: it does
  not tell how far the door is. Time begins there, too. How long a hidden stretch in the middle took
  is shown, since what follows has its true time.
- Only channels whose meaning is known are included: another could be a position, too. No name is.

Who knows the road, or shares the same rides with several blurs, may still narrow the place down.
"""

from __future__ import annotations

import hashlib
import hmac
import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.ride import Ride, RideRows, summarise
from backend.core.sphere import EARTH_M, great_circle_m

Mask = npt.NDArray[np.bool_]
DISTANCE, LATITUDE, LONGITUDE = "distance_m", "latitude_deg", "longitude_deg"
# The middle of a zone is moved by up to so much of the blur; the zone reaches that much further.
MOVED = 0.5
# Homes in one square of so many blurs are moved alike.
NEIGHBOURHOOD = 8.0


@dataclass(frozen=True)
class ShownRide:
    """What is left of a ride: its facts, the rows of its recorded channels, and physical values
    (n,), also of derived ones, as if it were a whole."""

    ride: Ride
    rows: RideRows
    values: dict[str, Values]


def shown_rows(rows: RideRows, blur_m: float, secret: bytes) -> Mask | None:
    """Which rows (n,) may be shown; None where the ride has no position at all."""
    specs = {channel.name: channel for channel in rows.channels}
    if not {LATITUDE, LONGITUDE} <= specs.keys():
        return None
    latitude_deg = specs[LATITUDE].to_values(rows.counts[LATITUDE])
    longitude_deg = specs[LONGITUDE].to_values(rows.counts[LONGITUDE])
    valid = np.isfinite(latitude_deg) & np.isfinite(longitude_deg)
    positioned = np.flatnonzero(valid)
    if not len(positioned):
        return None
    hidden = np.zeros(len(positioned), dtype=bool)
    for end in (positioned[0], positioned[-1]):
        middle = moved(float(latitude_deg[end]), float(longitude_deg[end]), blur_m, secret)
        away_m = great_circle_m(*middle, latitude_deg[positioned], longitude_deg[positioned])
        hidden |= away_m <= (1 + MOVED) * blur_m
    # A row without a position is as hidden as the positions before and behind it.
    at = np.searchsorted(positioned, np.arange(len(valid)))
    walled = np.concatenate(([True], hidden, [True]))
    shown: Mask = ~(walled[at] | walled[at + 1])
    shown[positioned] = ~hidden
    return shown


def moved(
    latitude_deg: float, longitude_deg: float, blur_m: float, secret: bytes
) -> tuple[float, float]:
    """The middle of the zone of a door, in degrees."""
    side_deg = math.degrees(NEIGHBOURHOOD * blur_m / EARTH_M)
    row = math.floor(latitude_deg / side_deg)
    narrow = max(0.01, math.cos(math.radians(row * side_deg)))
    key = f"{blur_m:.3f} {row} {math.floor(longitude_deg * narrow / side_deg)}".encode()
    drawn = hmac.new(secret, key, hashlib.sha256).digest()
    turn = 2 * math.pi * int.from_bytes(drawn[:4], "big") / 2**32
    # The root spreads the middles evenly over the disc.
    step_m = MOVED * blur_m * math.sqrt(int.from_bytes(drawn[4:8], "big") / 2**32)
    step_deg = math.degrees(step_m / EARTH_M)
    return (
        latitude_deg + step_deg * math.cos(turn),
        longitude_deg + step_deg * math.sin(turn) / narrow,
    )


def shown_ride(ride: Ride, rows: RideRows, seconds: Values, shown: Mask) -> ShownRide:
    """The shown rows (n,) of a ride; at least one is shown.

    rows: of channels whose meaning is known, recorded and derived. seconds: how long each holds.
    """
    shown_rows_at = np.flatnonzero(shown)
    begun_us = int(rows.times_us[shown_rows_at[0]])
    counts = {name: column[shown_rows_at] for name, column in rows.counts.items()}
    if DISTANCE in counts:
        spec = next(channel for channel in rows.channels if channel.name == DISTANCE)
        odometer = spec.to_values(counts[DISTANCE])
        counts[DISTANCE] = spec.to_counts(
            joined(odometer, np.diff(shown_rows_at, prepend=shown_rows_at[0]) > 1)
        )
    times_us = rows.times_us[shown_rows_at] - begun_us
    values = {c.name: c.to_values(counts[c.name]) for c in rows.channels}
    recorded = tuple(channel for channel in rows.channels if channel in ride.channels)
    edited = replace(
        ride,
        name="",
        notes="",
        tags=(),
        place=None,
        started_us=ride.started_us + begun_us,
        row_count=len(shown_rows_at),
        channels=recorded,
        derived=tuple(channel for channel in rows.channels if channel not in recorded),
        gaps=(),
        events=(),
        summary=summarise(values, times_us, ride.period_us, seconds[shown_rows_at]),
    )
    return ShownRide(edited, RideRows(recorded, times_us, counts), values)


def joined(distance_m: Values, begins: Mask) -> Values:
    """An odometer (n,) from 0 on; a hidden stretch before each of `begins` adds nothing."""
    valid = np.flatnonzero(np.isfinite(distance_m))
    stretch = np.cumsum(begins)[valid]
    steps = np.diff(distance_m[valid], prepend=distance_m[valid[:1]])
    steps[np.diff(stretch, prepend=stretch[:1]) > 0] = 0.0
    distances: Values = np.full(len(distance_m), np.nan)
    distances[valid] = np.cumsum(steps)
    return distances
