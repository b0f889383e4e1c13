"""Rows of the table `ride` and what hangs on them: how a ride is written to SQL and read back."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict, fields
from typing import Any

from sqlalchemy import Connection, Row, Select, delete, insert, select, update

from backend.core.channels import ChannelSpec, channel_to_json
from backend.core.device_metadata import metadata_from_json, metadata_to_json
from backend.core.doubts import Doubt
from backend.core.energy import derivable
from backend.core.filled import Filled
from backend.core.intake import Intake
from backend.core.person import ANYBODY, Sender
from backend.core.ride import (
    BAD,
    ORIGINS,
    STATES,
    SUMMARY_METHOD,
    Gap,
    Ride,
    RideContext,
    RidePlace,
    RideSummary,
    iso_utc,
    readable_name,
)
from backend.core.ride_card import line_kmh
from backend.core.ride_events import KINDS, RideEvent
from backend.errors import FieldError, InvalidRequest
from backend.store.bikes import whose_ride
from backend.store.discard import named_objects, take_back, with_sidecar
from backend.store.finish import WrittenObject
from backend.store.sql import tables as t
from backend.store.sql.blobs import channel_list, encode_level
from backend.store.sql.sound_rows import NOT_AS_WRITTEN, is_sound

NAME_LENGTH_MAX = 200
# Columns that a ride keeps when its rows become others.
STAYS = frozenset(
    {"state", "origin", "name", "notes", "created_us", "row_count", "gaps", "accepted_doubts"}
)
# The largest whole number SQL holds.
INTEGER_MAX = 2**63 - 1
CARD = ("place", "country", "zone", "is_loop", "speed_line", "doubts")


def full_ride_query() -> Select[Any]:
    """Rides with their figures and the upload they came with."""
    return (
        select(
            t.ride,
            t.upload.c.token.label("upload_token"),
            t.upload.c.sha256.label("source_sha256"),
            *(t.ride_summary.c[field.name] for field in fields(RideSummary)),
            t.ride_summary.c.outdone,
            *(t.ride_card.c[name] for name in CARD),
        )
        .outerjoin(t.ride_summary, t.ride_summary.c.ride_id == t.ride.c.id)
        .outerjoin(t.upload, t.upload.c.id == t.ride.c.upload_id)
        .outerjoin(t.ride_card, t.ride_card.c.ride_id == t.ride.c.id)
    )


def rides_by_ids(connection: Connection, ride_ids: Sequence[int]) -> tuple[Ride, ...]:
    """Rides by their ids, in that order; those that are not there are left out.

    One whose row is damaged has the state `bad`, and of it what can still be read.
    """
    query = full_ride_query().where(t.ride.c.id.in_(ride_ids))
    try:
        rows: Sequence[Row[Any]] = connection.execute(query).all()
    except NOT_AS_WRITTEN:
        rows = [row for ride_id in ride_ids if (row := lone_row(connection, ride_id)) is not None]
    tags = tags_of(connection, ride_ids)
    rides = {row.id: ride_from_row(row, tags.get(row.id, ())) for row in rows}
    return tuple(rides[ride_id] for ride_id in ride_ids if ride_id in rides)


def damaged_rows(connection: Connection, ride_ids: Sequence[int]) -> list[int]:
    """Those of some rides whose rows are damaged."""
    return [ride.id for ride in rides_by_ids(connection, ride_ids) if ride.state == BAD]


def tags_of(connection: Connection, ride_ids: Sequence[int]) -> dict[int, tuple[str, ...]]:
    """The tags of those rides that have any."""
    query = select(t.ride_tag).where(t.ride_tag.c.ride_id.in_(ride_ids)).order_by(t.ride_tag.c.tag)
    tags: dict[int, tuple[str, ...]] = {}
    for row in connection.execute(query):
        tags[row.ride_id] = (*tags.get(row.ride_id, ()), row.tag)
    return tags


def lone_row(connection: Connection, ride_id: int) -> Row[Any] | None:
    """One ride's row; of a damaged one its own columns, where the rest cannot be read either."""
    mine = t.ride.c.id == ride_id
    for query in (full_ride_query().where(mine), select(t.ride).where(mine)):
        with suppress(*NOT_AS_WRITTEN):
            return connection.execute(query).first()
    return None


def ride_from_row(row: Row[Any], tags: tuple[str, ...]) -> Ride:
    """A row of `full_ride_query` -> ride; a damaged row -> a ride in the state `bad`."""
    with suppress(*NOT_AS_WRITTEN):
        named = named_objects(row.object_key, row.object_sha256)
        if is_sound(row, t.ride.c) and len(named) < 2:
            ride = sound_ride(row, tags)
            kinds_known = all(event.kind in KINDS for event in ride.events)
            # A number that is no time, or a value that JSON cannot have, shows here.
            if kinds_known and ride.state in STATES and ride.origin in ORIGINS and ride.as_json():
                return ride
    return damaged_ride(row, tags)


def damaged_ride(row: Row[Any], tags: tuple[str, ...]) -> Ride:
    """What can still be read of a ride's damaged row: which one, when, and how it is called."""
    body = row._mapping
    started_us = body["started_us"]
    try:
        iso_utc(started_us)
    except NOT_AS_WRITTEN:
        started_us = 0
    return Ride(
        id=body["id"],
        state=BAD,
        origin=body["origin"] if body["origin"] in ORIGINS else ORIGINS[0],
        name=readable_name(body["name"]) if isinstance(body["name"], str) else "",
        notes=body["notes"] if isinstance(body["notes"], str) else "",
        started_us=started_us,
        row_count=body["row_count"] if isinstance(body["row_count"], int) else 0,
        period_us=None,
        channels=(),
        derived=(),
        context=RideContext(),
        tags=tags,
    )


def sound_ride(row: Row[Any], tags: tuple[str, ...]) -> Ride:
    """A row of `full_ride_query` -> ride. Raises one of `NOT_AS_WRITTEN` where it makes no ride."""
    body = row._mapping
    place = RidePlace(body["place"], body["country"], body["zone"], body["is_loop"])
    channels = channel_list(body["channels"])
    context = RideContext(**body["context"] | {"unit_key": body["unit_key"]})
    figures = {field.name: body[field.name] for field in fields(RideSummary)}
    return Ride(
        id=body["id"],
        state=body["state"],
        origin=body["origin"],
        name=readable_name(body["name"]),
        notes=body["notes"],
        started_us=body["started_us"],
        row_count=body["row_count"],
        period_us=body["period_us"],
        channels=channels,
        derived=derivable([channel.name for channel in channels], context.gear_ratio),
        context=context,
        gaps=tuple(Gap(**gap) for gap in body["gaps"]),
        filled=tuple(Filled(**span) for span in body["filled"]),
        events=tuple(RideEvent(**event) for event in body["events"]),
        completeness=body["completeness"],
        upload_id=body["upload_token"],
        source_sha256=body["source_sha256"],
        object_key=body["object_key"],
        object_bytes=body["object_bytes"],
        summary=RideSummary(**figures) if figures["duration_s"] is not None else None,
        cut_short=bool(body["cut_short"]),
        bike_id=body["bike_id"],
        owner_id=body["owner_id"],
        sport=body["sport"],
        intake=Intake(**body["intake"]) if body["intake"] else None,
        metadata=metadata_from_json(body["noted"]),
        same_ride_as=body["same_ride_as"],
        tags=tags,
        place=None if place == RidePlace() else place,
        speed_line_kmh=line_kmh(body["speed_line"] or b""),
        doubts=tuple(Doubt(**doubt) for doubt in body["doubts"] or ()),
        accepted_doubts=tuple(body["accepted_doubts"]),
        outdone=bool(body["outdone"]),
    )


def cursor_parts(cursor: str) -> tuple[int, int]:
    """A cursor -> start and id of the last ride of the page before. Raises InvalidRequest."""
    started, _, ride_id = cursor.partition(".")
    try:
        parts = int(started), int(ride_id)
    except ValueError:
        parts = (INTEGER_MAX, INTEGER_MAX)
    if not all(-INTEGER_MAX < part < INTEGER_MAX for part in parts):
        message = "cursor must be the `next` of an earlier page."
        raise InvalidRequest(message, fields=[FieldError("cursor", "not_a_cursor", message)])
    return parts


def ride_row(
    origin: str,
    channels: Sequence[ChannelSpec],
    period_us: int | None,
    started_us: int,
    context: RideContext,
    name: str,
) -> dict[str, object]:
    """A new row of the table `ride`, live until `finish_row`."""
    return {
        "state": "live",
        "origin": origin,
        "name": name[:NAME_LENGTH_MAX],
        "notes": "",
        **whose(context),
        "started_us": started_us,
        "row_count": 0,
        "period_us": period_us,
        "channels": [channel_to_json(channel) for channel in channels],
        "gaps": [],
        "created_us": time.time_ns() // 1000,
    }


def row_of(ride: Ride) -> dict[str, object]:
    """A new row for a ride whose rows are all there, but for what `finish_row` adds."""
    row = ride_row(
        ride.origin, ride.channels, ride.period_us, ride.started_us, ride.context, ride.name
    )
    return row | {
        "notes": ride.notes,
        "filled": [asdict(span) for span in ride.filled],
        "cut_short": ride.cut_short,
        "sport": ride.sport,
        "intake": asdict(ride.intake) if ride.intake else None,
        "noted": metadata_to_json(ride.metadata),
        "same_ride_as": ride.same_ride_as,
        "accepted_doubts": list(ride.accepted_doubts),
    }


def whose(context: RideContext) -> dict[str, object]:
    """The columns that say what was true of the bike, and by which a unit's rides are found."""
    return {
        "context": asdict(context),
        "device_serial": context.device_serial,
        "unit_key": context.unit_key,
    }


def inserted(connection: Connection, body: dict[str, object], context: RideContext) -> int:
    """Insert a ride and return its id, which no other ride ever had.

    Its unit, and the bike this is on, are made where they are not known.
    """
    started_us = int(str(body["started_us"]))
    sender = sender_of(connection, body.get("upload_id"))
    body = body | whose_ride(connection, context, started_us, sender)
    # Another's recording of the same ride is not beside it: it would count in its place.
    twin = select(t.ride.c.id).where(t.ride.c.id == body.get("same_ride_as"))
    twin = twin.where(t.ride.c.owner_id.is_not_distinct_from(body["owner_id"]))
    body["same_ride_as"] = connection.execute(twin).scalar()
    made = insert(t.ride).values(body).returning(t.ride.c.id)
    return int(connection.execute(made).scalar_one())


def correct(
    connection: Connection, ride_id: int, context: RideContext | None = None, by_us: int = 0
) -> None:
    """Say of a ride that has begun what is known only now: what was true of its bike, and by how
    much its start is off. Its bike is the one of then."""
    mine = t.ride.c.id == ride_id
    began = select(t.ride.c.started_us, t.ride.c.context, t.ride.c.unit_key).where(mine)
    row = connection.execute(began).first()
    if row is None:
        return
    context = context or RideContext(**row.context | {"unit_key": row.unit_key})
    started_us = row.started_us + by_us
    of = whose_ride(connection, context, started_us)
    values = whose(context) | of | {"started_us": started_us}
    connection.execute(update(t.ride).where(mine).values(values))


def upload_key(connection: Connection, token: str | None) -> int | None:
    """The row id of an upload by its public token."""
    if token is None:
        return None
    return connection.execute(select(t.upload.c.id).where(t.upload.c.token == token)).scalar()


def sender_of(connection: Connection, upload_id: object) -> Sender:
    """Who sent an upload, by its row id; anybody where it is none."""
    columns = (t.upload.c.owner_id, t.upload.c.key_id, t.upload.c.bike_id)
    row = connection.execute(select(*columns).where(t.upload.c.id == upload_id)).first()
    return ANYBODY if row is None else Sender(*row)


def upload_file(connection: Connection, token: str | None) -> dict[str, object] | None:
    """Hash and name of the file that an upload brought, which rider sent it, and the container
    that it came in.

    With the sender in it, the same file of two riders makes two objects.
    """
    columns = (t.upload.c.sha256, t.upload.c.name, t.upload.c.part_of, t.upload.c.owner_id)
    row = connection.execute(select(*columns).where(t.upload.c.token == token)).first()
    if row is None or row.sha256 is None:
        return None
    file: dict[str, object] = {"sha256": row.sha256, "name": row.name}
    if row.owner_id is not None:
        file["sender_id"] = row.owner_id
    if row.part_of is not None:
        container = select(t.upload.c.token).where(t.upload.c.id == row.part_of)
        file["container"] = upload_file(connection, connection.execute(container).scalar())
    return file


def finish_row(connection: Connection, ride_id: int, written: WrittenObject) -> None:
    """Make a ride `done`, with everything that belongs to a finished one."""
    take_back(connection, with_sidecar(written.key))
    connection.execute(
        update(t.ride)
        .where(t.ride.c.id == ride_id)
        .values(
            state="done",
            row_count=written.row_count,
            object_key=written.key,
            object_sha256=written.sha256,
            object_bytes=written.size_bytes,
            gaps=[asdict(gap) for gap in written.digest.gaps],
            events=[asdict(event) for event in written.digest.events],
            completeness=written.completeness,
        )
    )
    save_summary(connection, ride_id, written.digest.summary)
    connection.execute(delete(t.ride_lod).where(t.ride_lod.c.ride_id == ride_id))
    connection.execute(
        insert(t.ride_lod),
        [
            {"ride_id": ride_id, "step": level.step, "payload": encode_level(level)}
            for level in written.digest.levels
        ],
    )


def save_summary(connection: Connection, ride_id: int, summary: RideSummary) -> None:
    """Keep the figures of a ride, by today's method."""
    connection.execute(delete(t.ride_summary).where(t.ride_summary.c.ride_id == ride_id))
    values = {"ride_id": ride_id, "method": SUMMARY_METHOD, **asdict(summary)}
    connection.execute(insert(t.ride_summary).values(values))


def refill_row(
    connection: Connection, ride: Ride, object_key: str, upload_id: int | None = None
) -> bool:
    """Note what a ride is now; False when it has another object. upload_id: what it is made of now.

    What people wrote stays, and what `finish_row` says.
    """
    stated = {key: value for key, value in row_of(ride).items() if key not in STAYS}
    if upload_id is not None:
        stated["upload_id"] = upload_id
    changed = connection.execute(
        update(t.ride)
        .where(t.ride.c.id == ride.id, t.ride.c.object_key == object_key)
        .values(stated)
    )
    return changed.rowcount == 1


def remove_ride(connection: Connection, ride_id: int) -> None:
    """Delete a ride and all that hangs on it."""
    hanging = (t.ride_tail, t.ride_lod, t.ride_summary, t.ride_card, t.ride_zero, t.ride_tag)
    for table in hanging:
        connection.execute(delete(table).where(table.c.ride_id == ride_id))
    connection.execute(delete(t.ride).where(t.ride.c.id == ride_id))
