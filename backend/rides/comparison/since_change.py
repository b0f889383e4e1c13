"""Since this change: the rides after a kept configuration beside the rides before it.

Nobody rode the same road twice, and the wind was another; a handful of rides tells little. So the
figures are given with how many rides they are of, and whether every ride after lies on one side of
every ride before. A ride on which it was changed is on neither side.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import datetime
from typing import Literal

from backend.core._generated import STANDING_S
from backend.core.described import described
from backend.core.energy import SECONDS_PER_HOUR
from backend.core.revision import Revision
from backend.core.ride import Ride
from backend.errors import NotFound
from backend.store import Sought, Store

RIDES_MAX = 20
RIDES_FEW = 3
"""With fewer on a side all of them may lie on one side of the others by chance alone."""
DISTANCE_KM_MIN = 0.5
"""Of a shorter ride work by distance says nothing: it is one start, or standing."""
MEANING = (
    "The latest rides with this unit before and since the change. They were other roads, another"
    " wind and another day: what moved may be theirs."
)

Trend = Literal["more", "less", "mixed", "too_few"]
RevisionsOf = Callable[[str], Sequence[Revision]]


@described
class RidesTogether:
    """What some rides of a unit come to together; null where none of them tells it.

    Rider and motor energy are never added up: `assist_ratio` is the motor's over the rider's.
    """

    ride_ids: list[int]
    """Newest first; at most 20, each of 500 m and more."""
    distance_km: float
    speed_kmh_mean: float | None
    """While moving."""
    motor_rides: int
    """Of the rides those whose motor work was measured."""
    motor_wh_per_km: float | None
    """Work at the motor's shaft."""
    motor_wh_per_km_least: float | None
    """Of one ride."""
    motor_wh_per_km_most: float | None
    rider_wh_per_km: float | None
    battery_wh_per_km: float | None
    assist_ratio: float | None


@described
class SinceChange:
    """The rides since a change beside those before it."""

    seq: int
    created_at: datetime
    meaning: str
    """What it cannot tell, in English."""
    before: RidesTogether
    after: RidesTogether
    motor_wh_per_km_after: Trend
    """`more`, `less`: every ride since took more, or less, than every ride before. `mixed`: they
    overlap. `too_few`: fewer than 3 on a side."""
    during_ids: list[int]
    """Rides on which the change was made: they are on neither side."""
    other_changes: int
    """How many other configurations the unit got between the first and the last of these rides:
    what moved may be theirs."""


class RidesSinceChange:
    """Rides of a unit on either side of a change. Safe from any thread.

    revisions_of: of a device that is connected or was, newest first; raises NotFound.
    """

    def __init__(self, store: Store, revisions_of: RevisionsOf) -> None:
        self._store = store
        self._revisions_of = revisions_of

    def __call__(self, device_id: str, seq: int) -> SinceChange:
        """The comparison. Raises NotFound for an unknown revision."""
        revisions = self._revisions_of(device_id)
        change = next((revision for revision in revisions if revision.seq == seq), None)
        if change is None:
            raise NotFound(f"Unit {device_id} has no configuration {seq} in its history.")
        before = self._rides(change.unit_key, to_us=change.created_us)
        after = self._rides(change.unit_key, from_us=change.created_us)
        during = [ride for ride in before[:1] if rode_on(ride, change.crc32)]
        before = before[len(during) :]
        return SinceChange(
            seq=seq,
            created_at=change.created_at,
            meaning=MEANING,
            before=figures(before),
            after=figures(after),
            motor_wh_per_km_after=moved(before, after),
            during_ids=[ride.id for ride in during],
            other_changes=other_changes(revisions, change, [*before, *after]),
        )

    def _rides(
        self, unit_key: str, from_us: int | None = None, to_us: int | None = None
    ) -> list[Ride]:
        """The latest that are over and went somewhere."""
        page = self._store.rides.list(Sought(from_us, to_us, unit_key), RIDES_MAX)
        return [ride for ride in page.items if ride.state == "done" and distance_km(ride) > 0.0]


def distance_km(ride: Ride) -> float:
    """Of a ride that is long enough to be counted; 0 for one that is not."""
    km = ride.summary.distance_km if ride.summary else None
    return km if km is not None and km >= DISTANCE_KM_MIN else 0.0


def rode_on(ride: Ride, crc32: int | None) -> bool:
    """Whether a configuration came into force on the ride and the bike moved after that. A
    recording goes on until the bike has stood for a while."""
    lasted_s = ride.summary.duration_s if ride.summary else 0.0
    stood_s = STANDING_S if ride.origin == "recorded" and not ride.cut_short else 0.0
    return any(
        0.0 < from_s < lasted_s - stood_s
        for from_s, in_force in ride.settings_spans()
        if crc32 is not None and in_force == crc32
    )


def figures(rides: Sequence[Ride]) -> RidesTogether:
    """What some rides come to together; None where no ride tells it. Rider and motor are never
    added up, so the share of either is given as their ratio."""
    moving_s = total(rides, "moving_s")
    km = sum(distance_km(ride) for ride in rides)
    each = per_km(rides)
    with_both = [ride for ride in rides if knows(ride, "motor_wh") and knows(ride, "rider_wh")]
    rider_wh = total(with_both, "rider_wh")
    return RidesTogether(
        ride_ids=[ride.id for ride in rides],
        distance_km=km,
        speed_kmh_mean=km / (moving_s / SECONDS_PER_HOUR) if moving_s else None,
        motor_rides=len(each),
        motor_wh_per_km=by_km(rides, "motor_wh"),
        motor_wh_per_km_least=min(each, default=None),
        motor_wh_per_km_most=max(each, default=None),
        rider_wh_per_km=by_km(rides, "rider_wh"),
        battery_wh_per_km=by_km(rides, "battery_wh"),
        assist_ratio=(total(with_both, "motor_wh") or 0.0) / rider_wh if rider_wh else None,
    )


def knows(ride: Ride, name: str) -> bool:
    """Whether a ride has a figure. Motor work is of torque that was delivered, else unknown."""
    return getattr(ride.summary, name) is not None


def total(rides: Sequence[Ride], name: str) -> float | None:
    """Sum of a figure over the rides that have it; None if none has."""
    values = [getattr(ride.summary, name) for ride in rides]
    present = [float(value) for value in values if value is not None]
    return sum(present) if present else None


def by_km(rides: Sequence[Ride], name: str) -> float | None:
    """A figure for a kilometre, over the rides that have it."""
    present = [ride for ride in rides if knows(ride, name)]
    sum_wh = total(present, name)
    return None if sum_wh is None else sum_wh / sum(distance_km(ride) for ride in present)


def per_km(rides: Sequence[Ride]) -> list[float]:
    """Work of the motor for a kilometre, of each ride that has it."""
    each = [by_km([ride], "motor_wh") for ride in rides]
    return [wh_per_km for wh_per_km in each if wh_per_km is not None]


def moved(before: Sequence[Ride], after: Sequence[Ride]) -> Trend:
    """`more` or `less` where every ride after took that than every ride before; `mixed` where they
    overlap, `too_few` where there are not enough to tell."""
    then, now = per_km(before), per_km(after)
    if min(len(then), len(now)) < RIDES_FEW:
        return "too_few"
    if min(now) > max(then):
        return "more"
    return "less" if max(now) < min(then) else "mixed"


def other_changes(revisions: Sequence[Revision], change: Revision, rides: Sequence[Ride]) -> int:
    """How many other configurations the unit got between the first and the last of the rides."""
    if not rides:
        return 0
    starts = [ride.started_us for ride in rides]
    return sum(
        min(starts) < revision.created_us <= max(starts) and revision.crc32 != change.crc32
        for revision in revisions
    )
