"""Uploads as the tables have them: a row, the rides it became, and what is within it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from sqlalchemy import ColumnElement, Connection, Row, func, select, true, union_all

from backend.core.described import described
from backend.core.person import Sender
from backend.core.ride import iso_utc
from backend.store.deletion import MADE
from backend.store.sql import tables as t

REJECTED = "rejected"
# Databases take only so many values in one question.
ROWS_AT_ONCE = 500
# Of a table that a version before read its header is not known.
TABLE_NAMES = (".csv", ".tsv", ".txt")


@described
class UploadParts:
    """How many of the files within a container are in which state."""

    waiting: int = 0
    complete: int = 0
    partial: int = 0
    rejected: int = 0
    here: int = 0
    """Rides that were known before the container came."""


@dataclass(frozen=True)
class Upload:
    """One upload. state: `receiving`, `queued`, `complete`, `partial` or `rejected`.

    ride_ids: the rides it became; of a duplicate, the ride that was there before. part_of: the
    container it is within. parts: of a container, how many files within became what.
    doubtful_rides: how many of its rides have doubts that nobody accepted. has_columns: whether its
    owner can say what it leaves open. owner_id: the rider who sent it; None for others.
    """

    id: str
    name: str
    length: int
    received: int
    state: str
    declared_sha256: str | None
    sha256: str | None
    code: str | None
    detail: str | None
    completeness: float | None
    duplicate_of: int | None
    object_key: str | None
    created_us: int
    expires_us: int | None
    ride_ids: tuple[int, ...]
    part_of: str | None = None
    parts: UploadParts | None = None
    has_columns: bool = False
    doubtful_rides: int = 0
    owner_id: int | None = None

    @property
    def expires_at(self) -> str | None:
        """When it goes by itself, as ISO 8601 in UTC; None when it does not."""
        return None if self.expires_us is None else iso_utc(self.expires_us)


def sent_by(whose: Sender) -> ColumnElement[bool]:
    """Of an upload: this rider sent it, with this key; what is None does not matter."""
    upload = t.upload.c
    mine: ColumnElement[bool] = true()
    for column, number in ((upload.owner_id, whose.owner_id), (upload.key_id, whose.key_id)):
        if number is not None:
            mine &= column == number
    return mine


def uploads_of(connection: Connection, rows: Sequence[Row[Any]]) -> tuple[Upload, ...]:
    """Rows of the table as uploads, in their order; a few questions for many of them."""
    uploads: list[Upload] = []
    for start in range(0, len(rows), ROWS_AT_ONCE):
        some = rows[start : start + ROWS_AT_ONCE]
        rides, parts = rides_by(connection, some), parts_by(connection, [row.id for row in some])
        wholes = {row.part_of for row in some} - {None}
        query = select(t.upload.c.id, t.upload.c.token).where(t.upload.c.id.in_(wholes))
        tokens: dict[int, str] = {row.id: row.token for row in connection.execute(query)}
        doubtful = doubtful_rides(connection, set().union(*rides.values()))
        for row in some:
            mine = rides.get(row.id, set())
            upload = upload_from_row(
                row, tuple(sorted(mine)), tokens.get(row.part_of), parts.get(row.id)
            )
            uploads.append(replace(upload, doubtful_rides=len(mine & doubtful)))
    return tuple(uploads)


def rides_by(connection: Connection, rows: Sequence[Row[Any]]) -> dict[int, set[int]]:
    """Rides that uploads became or are of, by the upload's row id."""
    keys = [row.id for row in rows]
    link = t.ride_source.c
    made = select(link.upload_id, link.ride_id).where(link.upload_id.in_(keys), link.part == MADE)
    first = select(t.ride.c.upload_id, t.ride.c.id).where(t.ride.c.upload_id.in_(keys))
    ride_ids: dict[int, set[int]] = {}
    for key, ride_id in connection.execute(union_all(made, first)):
        ride_ids.setdefault(key, set()).add(ride_id)
    twins = {row.duplicate_of for row in rows} - {None}
    here = set(connection.execute(select(t.ride.c.id).where(t.ride.c.id.in_(twins))).scalars())
    for row in rows:
        if row.duplicate_of in here:
            ride_ids.setdefault(row.id, set()).add(row.duplicate_of)
    return ride_ids


def doubtful_rides(connection: Connection, ride_ids: set[int]) -> set[int]:
    """Those of some rides that have doubts which nobody accepted."""
    card = t.ride_card.c
    query = select(card.ride_id).where(card.ride_id.in_(ride_ids), card.open_doubts > 0)
    return set(connection.execute(query).scalars())


def parts_by(connection: Connection, keys: Sequence[int]) -> dict[int, UploadParts]:
    """What became of the files within those uploads that have some, by the upload's row id."""
    here = t.upload.c.code.in_(("duplicate", "filled"))
    container, state = t.upload.c.part_of, t.upload.c.state
    query = select(container, state, here, func.count()).where(container.in_(keys))
    counted: dict[int, dict[str, int]] = {}
    for key, state_now, is_here, count in connection.execute(
        query.group_by(container, state, here)
    ):
        judged = state_now if state_now in ("complete", "partial", REJECTED) else "waiting"
        name = "here" if is_here else judged
        mine = counted.setdefault(key, {})
        mine[name] = mine.get(name, 0) + count
    return {key: UploadParts(**mine) for key, mine in counted.items()}


def upload_from_row(
    row: Row[Any], ride_ids: tuple[int, ...], part_of: str | None, parts: UploadParts | None
) -> Upload:
    """A row of the table, its rides, and what is within -> upload."""
    return Upload(
        id=row.token,
        name=row.name,
        length=row.length,
        received=row.received,
        state=row.state,
        declared_sha256=row.declared_sha256,
        sha256=row.sha256,
        code=row.code,
        detail=row.detail,
        completeness=row.completeness,
        duplicate_of=row.duplicate_of,
        object_key=row.object_key,
        created_us=row.created_us,
        expires_us=row.expires_us,
        ride_ids=ride_ids,
        part_of=part_of,
        parts=parts,
        owner_id=row.owner_id,
        has_columns=row.asks_sha256 is not None or row.name.lower().endswith(TABLE_NAMES),
    )
