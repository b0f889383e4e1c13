"""Bikes, their owners and the codes by which they change hands, in SQL."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from sqlalchemy import ColumnElement, Connection, Row, Table, delete, func, insert, select, update

from backend.bikes.types import Bike, BikeDetail, BikeOwner, BikeUnit, Offer
from backend.core.actor import actor_of_person
from backend.core.audit import Action, AuditEntry, Members, differing
from backend.core.moments import utc, utc_or_none
from backend.core.person import Person, Sender
from backend.errors import Conflict, NotFound
from backend.store import audit
from backend.store.bikes import owner_at
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.upload_rows import sent_by
from backend.store.wall_clock import now_us

BIKES_MAX = 20_000
DESCRIBED = ("name", "model", "frame_number", "battery", "mileage_km")


class BikeStore:
    """Every bike there is, from any thread."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def list(self, owner_id: int | None = None) -> tuple[Bike, ...]:
        """Every bike, or this account's, by name."""

        def work(connection: Connection) -> tuple[Bike, ...]:
            query = select(t.bike).order_by(func.lower(t.bike.c.name), t.bike.c.id)
            if owner_id is not None:
                mine = select(t.bike_owner.c.bike_id).where(t.bike_owner.c.account_id == owner_id)
                query = query.where(t.bike.c.id.in_(mine.where(t.bike_owner.c.to_us.is_(None))))
            return bikes_of(connection, connection.execute(query).all(), owner_id)

        return self._database.read(work)

    def get(self, bike_id: int, owner_id: int | None = None) -> BikeDetail:
        """One bike. owner_id: who looks, and sees no earlier owners. Raises NotFound."""

        def work(connection: Connection) -> BikeDetail:
            [bike] = bikes_of(connection, [row_of(connection, bike_id)], owner_id, bike_id)
            owner = t.bike_owner.c
            query = select(t.bike_owner).where(owner.bike_id == bike_id)
            if owner_id is not None:
                query = query.where(owner.account_id == owner_id)
            rows = connection.execute(query.order_by(owner.from_us.desc(), owner.id.desc()))
            return BikeDetail(bike, tuple(owner_of_row(row) for row in rows))

        return self._database.read(work)

    def add(self, values: Mapping[str, Any]) -> int:
        """A bike without a unit; its number. Raises Conflict `bikes_full`, StoreError."""

        def work(connection: Connection) -> int:
            count = connection.execute(select(func.count()).select_from(t.bike)).scalar_one()
            if count >= BIKES_MAX:
                raise Conflict(f"There are {BIKES_MAX} bikes, and no more.", "bikes_full")
            made = insert(t.bike).values(**values, created_us=now_us()).returning(t.bike)
            row = connection.execute(made).one()
            audit.append(connection, of_bike_row(Action.BIKE_ADDED, row, after=facts_of(row)))
            return int(row.id)

        return self._database.write(work)

    def change(self, bike_id: int, values: Mapping[str, Any], unit: Sequence[str | None]) -> None:
        """Describe a bike otherwise. unit: the key of what is on it now, None for no unit; empty
        leaves it as it is. Raises NotFound, StoreError."""

        def work(connection: Connection) -> None:
            row = row_of(connection, bike_id)
            if values:
                mine = t.bike.c.id == bike_id
                connection.execute(update(t.bike).where(mine).values(**values))
            moved = [one for key in unit for one in put_on(connection, bike_id, key, now_us())]
            now = row_of(connection, bike_id)
            old, new = differing(facts_of(row), facts_of(now))
            if new:
                entry = of_bike_row(Action.BIKE_CHANGED, now, before=old, after=new)
                audit.append(connection, entry)
            for entry in moved:
                audit.append(connection, entry)

        self._database.write(work)

    def remove(self, bike_id: int) -> None:
        """Remove a bike that has no unit, ride, calibration, owner or key of its own.

        Raises NotFound; Conflict `bike_in_use`; StoreError.
        """

        def work(connection: Connection) -> None:
            row = row_of(connection, bike_id)
            on_now = (t.bike_unit.c.bike_id == bike_id) & t.bike_unit.c.to_us.is_(None)
            used = [select(t.bike_unit.c.id).where(on_now)]
            used += [
                select(table.c.id).where(table.c.bike_id == bike_id)
                for table in (t.ride, t.calibration, t.visit, t.bike_owner, t.api_key, t.upload)
            ]
            if any(connection.execute(one.limit(1)).first() is not None for one in used):
                message = "It has a unit, rides, files, calibrations, visits, owners or keys."
                raise Conflict(message, "bike_in_use")
            for table in (t.pairing, t.bike_unit):
                connection.execute(delete(table).where(table.c.bike_id == bike_id))
            connection.execute(delete(t.bike).where(t.bike.c.id == bike_id))
            audit.append(connection, of_bike_row(Action.BIKE_REMOVED, row, before=facts_of(row)))

        self._database.write(work)

    def give_rides(self, bike_id: int, ride_ids: Sequence[int]) -> None:
        """Say that rides were made with a bike; those that are nobody's are its owner's of then.

        Raises NotFound; Conflict `somebody_elses` for a ride of another than that owner; then none
        is changed.
        """

        def work(connection: Connection) -> None:
            bike = row_of(connection, bike_id)
            columns = (t.ride.c.id, t.ride.c.started_us, t.ride.c.owner_id)
            rows = connection.execute(select(*columns).where(t.ride.c.id.in_(ride_ids))).all()
            if missing := set(ride_ids) - {row.id for row in rows}:
                raise NotFound(f"There is no ride {min(missing)}.")
            for row in rows:
                owner_id = owner_at(connection, bike_id, row.started_us)
                if row.owner_id not in (None, owner_id):
                    message = f"Ride {row.id} is of somebody whose bike this was not then."
                    raise Conflict(message, "somebody_elses")
                given = {"bike_id": bike_id, "owner_id": owner_id}
                connection.execute(update(t.ride).where(t.ride.c.id == row.id).values(given))
            rides = {"ride_ids": sorted(set(ride_ids))}
            audit.append(connection, of_bike_row(Action.BIKE_RIDES_GIVEN, bike, after=rides))

        self._database.write(work)

    def is_own(self, whose: Sender, kind: str, name: str) -> bool:
        """Whether what an address names is this account's, or was sent with this key. Never raises
        for what is no name."""
        owner_id = whose.owner_id
        if kind == "upload_id":
            query = select(t.upload.c.id).where(t.upload.c.token == name, sent_by(whose))
        elif not (name.isascii() and name.isdecimal() and len(name) < 19):
            return False
        elif kind == "ride_id":
            query = select(t.ride.c.id).where(t.ride.c.id == int(name))
            query = query.where(t.ride.c.owner_id == owner_id)
        elif kind == "bike_id":
            query = select(t.bike_owner.c.id).where(t.bike_owner.c.bike_id == int(name))
            query = query.where(
                t.bike_owner.c.account_id == owner_id, t.bike_owner.c.to_us.is_(None)
            )
        elif kind == "visit_id":
            query = select(t.visit.c.id).join(
                t.bike_owner, t.bike_owner.c.bike_id == t.visit.c.bike_id
            )
            query = query.where(t.visit.c.id == int(name), t.bike_owner.c.to_us.is_(None))
            query = query.where(t.bike_owner.c.account_id == owner_id)
        else:
            return False
        return self._database.read(lambda c: c.execute(query).first()) is not None


class PairingStore:
    """Codes that make their taker a bike's owner, once. All times in Unix microseconds."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def add(
        self, bike_id: int, code_sha256: str, owned_from_us: int | None, expires_us: int
    ) -> None:
        """A code for a bike, in place of any that was not taken.

        Raises NotFound; Conflict `was_owned` where the bike was somebody's since owned_from_us.
        """
        created_us = now_us()
        values = {
            "bike_id": bike_id,
            "code_sha256": code_sha256,
            "owned_from_us": owned_from_us,
            "created_us": created_us,
            "expires_us": expires_us,
        }

        def work(connection: Connection) -> None:
            bike = row_of(connection, bike_id)
            require_nobodys(connection, bike_id, owned_from_us)
            over = (t.pairing.c.bike_id == bike_id) | (t.pairing.c.expires_us <= created_us)
            connection.execute(delete(t.pairing).where(over))
            connection.execute(insert(t.pairing).values(values))
            since = None if owned_from_us is None else utc(owned_from_us).isoformat()
            offered = {"owned_from": since, "expires_at": utc(expires_us).isoformat()}
            audit.append(connection, of_bike_row(Action.BIKE_OFFERED, bike, after=offered))

        self._database.write(work)

    def offer(self, code_sha256: str) -> Offer | None:
        """What a code gives; None where it is none, was taken or is over."""
        columns = (t.bike.c.name, t.bike.c.model, t.pairing.c.expires_us)
        query = select(*columns).join(t.bike, t.bike.c.id == t.pairing.c.bike_id)
        row = self._database.read(lambda c: c.execute(query.where(valid(code_sha256))).first())
        return None if row is None else Offer(row.name, row.model, utc(row.expires_us))

    def take(self, code_sha256: str, person: Person) -> int | None:
        """Make somebody the owner by a code; the bike's number, None where the code is none.

        Raises Conflict `yours_already`; StoreError.
        """
        return self._database.write(lambda c: taken(c, code_sha256, person))

    def leave(self, bike_id: int) -> None:
        """End what is owned of a bike. Raises NotFound, also where it is nobody's."""

        def work(connection: Connection) -> None:
            mine = (t.bike_owner.c.bike_id == bike_id) & t.bike_owner.c.to_us.is_(None)
            ended = update(t.bike_owner).where(mine).values(to_us=now_us())
            owner = connection.execute(ended.returning(t.bike_owner.c.name)).scalar()
            if owner is None:
                raise NotFound(f"Bike {bike_id} is nobody's.")
            connection.execute(delete(t.pairing).where(t.pairing.c.bike_id == bike_id))
            bike = row_of(connection, bike_id)
            audit.append(connection, of_bike_row(Action.BIKE_LEFT, bike, before={"owner": owner}))

        self._database.write(work)


def taken(connection: Connection, code_sha256: str, person: Person) -> int | None:
    """As `PairingStore.take`, in a transaction that may do more."""
    used = delete(t.pairing).where(valid(code_sha256))
    returned = used.returning(t.pairing.c.bike_id, t.pairing.c.owned_from_us)
    row = connection.execute(returned).first()
    if row is None:
        return None
    taken_us = now_us()
    owner = t.bike_owner.c
    still = (owner.bike_id == row.bike_id) & owner.to_us.is_(None)
    before = connection.execute(select(t.bike_owner).where(still)).first()
    if before is not None and before.account_id == person.id:
        raise Conflict("This bike is yours already.", "yours_already")
    require_nobodys(connection, row.bike_id, row.owned_from_us)
    connection.execute(update(t.bike_owner).where(still).values(to_us=taken_us))
    from_us = taken_us if row.owned_from_us is None else row.owned_from_us
    values = {"bike_id": row.bike_id, "account_id": person.id, "name": person.name}
    connection.execute(insert(t.bike_owner).values(**values, from_us=from_us))
    theirs = (t.ride.c.bike_id == row.bike_id) & (t.ride.c.started_us >= from_us)
    theirs &= t.ride.c.owner_id.is_(None)
    connection.execute(update(t.ride).where(theirs).values(owner_id=person.id))
    old = {"owner": None if before is None else before.name}
    new = {"owner": person.name, "since": utc(from_us).isoformat()}
    bike = row_of(connection, row.bike_id)
    entry = of_bike_row(Action.BIKE_TAKEN, bike, before=old, after=new)
    audit.append(connection, entry, actor_of_person(person))
    return int(row.bike_id)


def require_nobodys(connection: Connection, bike_id: int, from_us: int | None) -> None:
    """Raises Conflict `was_owned` where a bike was somebody's at or after a moment in the past."""
    if from_us is None:
        return
    owner = t.bike_owner.c
    since = owner.to_us.is_(None) | (owner.to_us > from_us)
    query = select(owner.id).where(owner.bike_id == bike_id, since).limit(1)
    if connection.execute(query).first() is not None:
        message = "Somebody else had the bike then: it can be theirs from now on only."
        raise Conflict(message, "was_owned")


def valid(code_sha256: str) -> Any:
    """Of a pairing: it has this code and is not over."""
    return (t.pairing.c.code_sha256 == code_sha256) & (t.pairing.c.expires_us > now_us())


def put_on(
    connection: Connection, bike_id: int, unit_key: str | None, at_us: int
) -> Sequence[AuditEntry]:
    """Say that a unit is on a bike from now on, and what was on it no more; None for no unit.

    What that is for the audit, of each bike that has another unit now. Raises NotFound for a unit
    that was never seen.
    """
    of = t.bike_unit.c
    if unit_key is not None:
        known = select(t.unit.c.key).where(t.unit.c.key == unit_key)
        if connection.execute(known).first() is None:
            raise NotFound(f"There is no unit {unit_key}.")
    ends = ((of.bike_id == bike_id) | (of.unit_key == unit_key)) & of.to_us.is_(None)
    columns = (of.bike_id, of.unit_key)
    before = {row.bike_id: row.unit_key for row in connection.execute(select(*columns).where(ends))}
    if before.get(bike_id) == unit_key:
        return ()
    connection.execute(update(t.bike_unit).where(ends).values(to_us=at_us))
    if unit_key is not None:
        values = {"bike_id": bike_id, "unit_key": unit_key, "from_us": at_us}
        connection.execute(insert(t.bike_unit).values(values))
    now = dict.fromkeys(before) | {bike_id: unit_key}
    return tuple(
        replace(
            of_bike_row(Action.BIKE_UNIT_CHANGED, row_of(connection, one)),
            before={"unit_key": before.get(one)},
            after={"unit_key": now[one]},
            unit_key=now[one] or before.get(one),
        )
        for one in sorted(now)
    )


def facts_of(row: Row[Any]) -> Members:
    """What the audit tells of a bike: what people say of it."""
    said = {name: getattr(row, name) for name in DESCRIBED}
    return {name: value for name, value in said.items() if value is not None} | {
        "lost": row.lost_us is not None
    }


def of_bike_row(
    action: Action, row: Row[Any], before: Members | None = None, after: Members | None = None
) -> AuditEntry:
    """Something that was done to a bike."""
    return AuditEntry(action, row.id, row.name, before, after, bike_id=row.id)


def row_of(connection: Connection, bike_id: int) -> Row[Any]:
    """One bike's row. Raises NotFound."""
    row = connection.execute(select(t.bike).where(t.bike.c.id == bike_id)).first()
    if row is None:
        raise NotFound(f"There is no bike {bike_id}.")
    return row


def bikes_of(
    connection: Connection,
    rows: Sequence[Row[Any]],
    owner_id: int | None,
    only: int | None = None,
) -> tuple[Bike, ...]:
    """Rows of `bike` with what other tables have of them.

    owner_id: whose rides count. only: the number of the bike, where it is one.
    """
    units, owners = units_now(connection, only), owners_now(connection, only)
    rides = rides_by_bike(connection, owner_id, only)
    settings = settings_now(connection, only)

    def bike_of(row: Row[Any]) -> Bike:
        unit, ridden = units.get(row.id), rides.get(row.id)
        known = settings.get(unit.key, {}) if unit else {}
        return Bike(
            id=row.id,
            name=row.name,
            model=row.model,
            frame_number=row.frame_number,
            battery=row.battery,
            mileage_km=row.mileage_km,
            mileage_at=utc_or_none(row.mileage_us),
            lost_at=utc_or_none(row.lost_us),
            created_at=utc(row.created_us),
            unit=unit,
            market=known.get("market"),
            wheel_circumference_m=known.get("wheel_circumference_m"),
            owner=owners.get(row.id),
            rides=ridden.rides if ridden else 0,
            distance_km=ridden.distance_km if ridden else None,
            last_ride_at=utc(ridden.last_us) if ridden else None,
        )

    return tuple(bike_of(row) for row in rows)


def of_bike(table: Table, only: int | None) -> ColumnElement[bool]:
    """Rows that have a bike; only: this one."""
    bike_id = table.c.bike_id
    return bike_id.is_not(None) if only is None else bike_id == only


def units_now(connection: Connection, only: int | None) -> dict[int, BikeUnit]:
    """The unit that is on each bike, or on one."""
    on = t.unit.c.key == t.bike_unit.c.unit_key
    query = select(t.bike_unit.c.bike_id, t.unit).join(t.unit, on)
    query = query.where(t.bike_unit.c.to_us.is_(None), of_bike(t.bike_unit, only))
    rows = connection.execute(query)
    return {
        row.bike_id: BikeUnit(
            row.key, row.model, row.serial_number, row.firmware_version, utc(row.last_seen_us)
        )
        for row in rows
    }


def owners_now(connection: Connection, only: int | None) -> dict[int, BikeOwner]:
    """The owner of each bike, or of one, that is somebody's."""
    still = t.bike_owner.c.to_us.is_(None) & of_bike(t.bike_owner, only)
    rows = connection.execute(select(t.bike_owner).where(still))
    return {row.bike_id: owner_of_row(row) for row in rows}


def owner_of_row(row: Row[Any]) -> BikeOwner:
    """A row of `bike_owner`."""
    return BikeOwner(row.account_id, row.name, utc(row.from_us), utc_or_none(row.to_us))


class Ridden(NamedTuple):
    """What the rides of a bike come to."""

    bike_id: int
    rides: int
    distance_km: float | None
    last_us: int


def rides_by_bike(
    connection: Connection, owner_id: int | None, only: int | None
) -> dict[int, Ridden]:
    """Of each bike, or of one: how many rides, how far, when last; of two recordings the better."""
    ride, summary = t.ride.c, t.ride_summary.c
    columns = (ride.bike_id, func.count(), func.sum(summary.distance_km), func.max(ride.started_us))
    query = select(*columns).join(t.ride_summary, summary.ride_id == ride.id)
    query = query.where(summary.outdone == 0, of_bike(t.ride, only))
    if owner_id is not None:
        query = query.where(ride.owner_id == owner_id)
    rows = connection.execute(query.group_by(ride.bike_id))
    return {row[0]: Ridden(*row) for row in rows}


def settings_now(connection: Connection, only: int | None) -> dict[str, dict[str, Any]]:
    """The last configuration that is known of each unit that is on a bike, or on one."""
    on_now = t.bike_unit.c.to_us.is_(None) & of_bike(t.bike_unit, only)
    here = t.revision.c.unit_key.in_(select(t.bike_unit.c.unit_key).where(on_now))
    newest = select(func.max(t.revision.c.id)).where(here).group_by(t.revision.c.unit_key)
    query = select(t.revision.c.unit_key, t.revision.c.body).where(t.revision.c.id.in_(newest))
    return {row.unit_key: row.body for row in connection.execute(query)}


def taker(code_sha256: str) -> Callable[[Connection, Person], int]:
    """What makes a new account a bike's owner in the transaction that makes the account."""

    def take(connection: Connection, person: Person) -> int:
        bike_id = taken(connection, code_sha256, person)
        if bike_id is None:
            raise NotFound("This code was taken just now.", "no_pairing")
        return bike_id

    return take
