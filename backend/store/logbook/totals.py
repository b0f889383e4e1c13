"""What rides come to: by period, by bike, and the best of them.

A sum tells of how many rides it is: a ride without motor data adds nothing to the motor's energy,
and is counted as lacking. Rider and motor are never added.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from sqlalchemy import Connection, Row, Select, case, func, or_, select

from backend.core.calendar import Period
from backend.core.ride_card import BEST_S
from backend.core.ride_events import FAULT_SET
from backend.store.sql import tables as t

# A mean over less is a sprint, not a ride.
FASTEST_KM_MIN = 5.0
FAULTS_SHOWN = 5
# A run's or a car's best is not the bike's.
CYCLING = ("%cycl%", "%bik%")


@dataclass(frozen=True)
class Totals:
    """Sums over rides; None where none of them has it. with_rider, with_motor: rides that have."""

    rides: int = 0
    with_rider: int = 0
    with_motor: int = 0
    distance_km: float | None = None
    moving_s: float | None = None
    rider_wh: float | None = None
    rider_s: float | None = None
    motor_wh: float | None = None


@dataclass(frozen=True)
class BikeTotals:
    """A bike, and what its rides come to."""

    bike_id: int
    name: str
    last_us: int
    rides: int
    distance_km: float | None


@dataclass(frozen=True)
class Best:
    """The ride that holds a record. kind: `distance_km`, `speed_kmh_mean`, ..."""

    kind: str
    value: float
    ride_id: int
    started_us: int


@dataclass(frozen=True)
class RideFault:
    """Faults that came on a ride, as bits of `fault_flags`."""

    ride_id: int
    at_us: int
    flags: int


class Whose(NamedTuple):
    """Of which bike and which account rides are; None for any."""

    bike_id: int | None = None
    owner_id: int | None = None


def sums() -> tuple[Any, ...]:
    """The columns of Totals, over rides with figures."""
    s = t.ride_summary.c
    rider_s = case((s.rider_power_w_mean > 0, s.rider_wh * 3600.0 / s.rider_power_w_mean))
    return (
        func.count(),
        func.count(s.rider_wh),
        func.count(s.motor_wh),
        func.sum(s.distance_km),
        func.sum(s.moving_s),
        func.sum(s.rider_wh),
        func.sum(rider_s),
        func.sum(s.motor_wh),
    )


def of_rides(query: Select[Any], whose: Whose) -> Select[Any]:
    """Finished rides of these with their figures; of two recordings of one the better."""
    query = query.select_from(t.ride.join(t.ride_summary, t.ride_summary.c.ride_id == t.ride.c.id))
    return narrowed(query.where(t.ride_summary.c.outdone == 0), whose)


def narrowed(query: Select[Any], whose: Whose) -> Select[Any]:
    """A query over rides, of these only."""
    if whose.owner_id is not None:
        query = query.where(t.ride.c.owner_id == whose.owner_id)
    if whose.bike_id is not None:
        # As a sum it is no term of an index: SQLite would gather every ride of the bike by it and
        # sort them, instead of reading from the top of a record or the newest on.
        query = query.where(t.ride.c.bike_id + 0 == whose.bike_id)
    return query


def totals_by(
    connection: Connection, periods: Sequence[Period], whose: Whose
) -> tuple[Totals, ...]:
    """Totals of each of some periods that follow one another."""
    began = t.ride.c.started_us
    which = case(*((began < period.to_us, index) for index, period in enumerate(periods)))
    query = of_rides(select(which, *sums()), whose)
    inside = (began >= periods[0].from_us) & (began < periods[-1].to_us)
    totals = {
        row[0]: Totals(*row[1:]) for row in connection.execute(query.where(inside).group_by(which))
    }
    return tuple(totals.get(index, Totals()) for index in range(len(periods)))


def bikes(connection: Connection, owner_id: int | None = None) -> tuple[BikeTotals, ...]:
    """Every bike that was ridden, if need be by this account, the one ridden last first."""
    # As a sum for the same reason as in `narrowed`.
    bike_id = t.ride.c.bike_id + 0
    query = select(
        bike_id,
        func.max(t.ride.c.started_us),
        func.count(),
        func.sum(t.ride_summary.c.distance_km),
    )
    query = of_rides(query, Whose(owner_id=owner_id)).where(bike_id.is_not(None)).group_by(bike_id)
    rows = connection.execute(query).all()
    names = {row.id: row.name for row in connection.execute(select(t.bike.c.id, t.bike.c.name))}
    totals = [BikeTotals(row[0], names[row[0]], *row[1:]) for row in rows]
    return tuple(sorted(totals, key=lambda bike: -bike.last_us))


def records(connection: Connection, whose: Whose) -> tuple[Best, ...]:
    """The best of each kind that any ride has."""
    summary, card = t.ride_summary.c, t.ride_card.c
    long_enough = summary.distance_km >= FASTEST_KM_MIN
    kinds: list[tuple[str, Any, Any]] = [
        ("distance_km", summary.distance_km, None),
        ("speed_kmh_mean", summary.speed_kmh_mean, long_enough),
        ("ascent_m", card.ascent_m, None),
    ]
    kinds += [(f"power_w_best_{s}s", card[f"power_w_best_{s}s"], None) for s in BEST_S]
    best = []
    for kind, column, also in kinds:
        row = best_by(connection, column, also, whose)
        if row is not None:
            best.append(Best(kind, float(row[0]), row.id, row.started_us))
    return tuple(best)


def best_by(connection: Connection, column: Any, also: Any, whose: Whose) -> Row[Any] | None:
    """Value, id and start of the ride that has most of a figure; None where none has any.

    One that is doubtful has none, nor one that is not judged yet.
    """
    query = of_rides(select(column, t.ride.c.id, t.ride.c.started_us), whose)
    query = query.join(t.ride_card, t.ride_card.c.ride_id == t.ride.c.id)
    query = query.where(t.ride_card.c.open_doubts == 0)
    sport = t.ride.c.sport
    query = query.where(column > 0).where(
        or_(sport.is_(None), *(func.lower(sport).like(word) for word in CYCLING))
    )
    if also is not None:
        query = query.where(also)
    return connection.execute(query.order_by(column.desc()).limit(1)).first()


def last_faults(connection: Connection, whose: Whose) -> tuple[RideFault, ...]:
    """The faults that came last on a ride, the newest first."""
    query = (
        select(t.ride.c.id, t.ride.c.started_us, t.ride.c.events)
        .join(t.ride_card, t.ride_card.c.ride_id == t.ride.c.id)
        .where(t.ride_card.c.notable > 0)
        .order_by(t.ride.c.started_us.desc())
        .limit(4 * FAULTS_SHOWN)
    )
    query = narrowed(query, whose)
    faults = [
        RideFault(row.id, row.started_us + round(event["t_s"] * 1e6), event["value"])
        for row in connection.execute(query)
        for event in row.events
        if event["kind"] == FAULT_SET
    ]
    return tuple(sorted(faults, key=lambda fault: -fault.at_us)[:FAULTS_SHOWN])
