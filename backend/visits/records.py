"""Service visits in SQL and as files: what is written is in both once the call returns.

    visits/<token>.json              a visit, open or closed, from which a lost database gets it
    visits/<token>-<sha256>.jpg      a photograph of it

A bike has one open visit at most. What is closed is not changed any more but for the consent.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from pydantic import TypeAdapter
from sqlalchemy import Connection, Row, delete, func, insert, select, update

from backend.core.audit import Action, AuditEntry, Members
from backend.core.author import AUTHOR_MAX
from backend.core.moments import utc
from backend.errors import Conflict, NotFound, StoreError
from backend.store import audit
from backend.store.objects import VISITS, Objects
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.store import Store
from backend.store.wall_clock import now_us
from backend.visits.types import VisitConsent, VisitContent, VisitPhoto

LOG = logging.getLogger(__name__)
VISITS_MAX = 1_000
"""Of a bike; one a week for twenty years."""
TOKEN, SHA256 = re.compile(r"[0-9a-f]{32}"), re.compile(r"[0-9a-f]{64}")
CONTENT = TypeAdapter(VisitContent)
CONSENT: TypeAdapter[VisitConsent | None] = TypeAdapter(VisitConsent | None)
VISITS_WITH_BIKE = select(t.visit, t.bike.c.name.label("bike_name")).join(
    t.bike, t.bike.c.id == t.visit.c.bike_id
)
Content = Callable[[VisitContent], VisitContent]


@dataclass(frozen=True)
class StoredVisit:
    """A visit as its row has it; `content` without what is worked out while it is open."""

    id: int
    token: str
    bike_id: int
    bike_name: str
    opened_us: int
    opened_by: str
    closed_us: int | None
    version: int
    imported: bool
    content: VisitContent
    consent: VisitConsent | None


class VisitStore:
    """Visits by their number, from any thread."""

    def __init__(self, store: Store) -> None:
        self._database = store.database
        self._objects: Objects = store.objects

    def get(self, visit_id: int) -> StoredVisit:
        """One visit. Raises NotFound, StoreError."""
        return self._database.read(lambda connection: visit_of(connection, visit_id))

    def list(self, bike_id: int) -> tuple[StoredVisit, ...]:
        """The visits of a bike, the newest first. Raises NotFound, StoreError."""

        def work(connection: Connection) -> tuple[StoredVisit, ...]:
            require_bike(connection, bike_id)
            query = VISITS_WITH_BIKE.where(t.visit.c.bike_id == bike_id)
            query = query.order_by(t.visit.c.opened_us.desc(), t.visit.c.id.desc())
            return tuple(map(visit_from, connection.execute(query.limit(VISITS_MAX))))

        return self._database.read(work)

    def newest_revision(self, bike_id: int) -> tuple[str | None, int | None]:
        """The unit that is on a bike, and the number of its newest configuration that is known."""

        def work(connection: Connection) -> tuple[str | None, int | None]:
            on = t.bike_unit.c
            query = select(on.unit_key).where(on.bike_id == bike_id, on.to_us.is_(None))
            key = connection.execute(query).scalar()
            newest = select(func.max(t.revision.c.seq)).where(t.revision.c.unit_key == key)
            return key, connection.execute(newest).scalar()

        return self._database.read(work)

    def open(self, bike_id: int, token: str, content: VisitContent, author: str) -> StoredVisit:
        """Begin a visit. Raises NotFound; Conflict `visit_open` where one is open, `visits_full`;
        StoreError."""
        visit = StoredVisit(0, token, bike_id, "", now_us(), author, None, 1, False, content, None)

        def work(connection: Connection) -> StoredVisit:
            require_bike(connection, bike_id)
            mine = select(t.visit.c.id).where(t.visit.c.open_for == bike_id)
            if connection.execute(mine).first() is not None:
                raise Conflict("A visit of this bike is open already.", "visit_open")
            added = self._added(connection, visit)
            audit.append(connection, of_visit(Action.VISIT_OPENED, added))
            return added

        return self._database.write(work)

    def change(
        self, visit_id: int, content: Content, version: int | None = None, closes: bool = False
    ) -> StoredVisit:
        """Give an open visit another content, made of the one it has; what that raises changes
        nothing. version: that it must have, and then it gets the next one. closes: it is final.

        Raises NotFound; Conflict `visit_closed`, `visit_changed`; StoreError.
        """

        def work(connection: Connection) -> StoredVisit:
            visit = open_visit(connection, visit_id)
            if version is not None and version != visit.version:
                message = "Somebody else wrote in this visit meanwhile: load it again."
                raise Conflict(message, "visit_changed")
            values: dict[str, Any] = {"body": plain(content(visit.content))}
            if version is not None:
                values["version"] = version + 1
            if closes:
                values |= {"closed_us": now_us(), "open_for": None}
            visit = self._changed(connection, visit_id, values)
            if closes:
                audit.append(connection, of_visit(Action.VISIT_CLOSED, visit, of_content(visit)))
            return visit

        return self._database.write(work)

    def consent(self, visit_id: int, make: Callable[[StoredVisit], VisitConsent]) -> StoredVisit:
        """Note a consent to a visit, open or closed; what `make` raises changes nothing. Raises
        NotFound, StoreError."""

        def work(connection: Connection) -> StoredVisit:
            consent = make(visit_of(connection, visit_id))
            values = {"consent": CONSENT.dump_python(consent, mode="json")}
            visit = self._changed(connection, visit_id, values)
            after = {"by": consent.by, "content_sha256": consent.content_sha256}
            audit.append(connection, of_visit(Action.VISIT_CONSENTED, visit, after))
            return visit

        return self._database.write(work)

    def remove(self, visit_id: int) -> None:
        """Remove an open visit that was begun by mistake. Raises NotFound; Conflict `visit_closed`;
        StoreError."""

        def work(connection: Connection) -> StoredVisit:
            visit = open_visit(connection, visit_id)
            connection.execute(delete(t.visit).where(t.visit.c.id == visit_id))
            audit.append(connection, of_visit(Action.VISIT_REMOVED, visit))
            self._objects.remove(file_key(visit.token))
            return visit

        visit = self._database.write(work)
        for photo in visit.content.photos:
            self.forget_photo(visit.token, photo.sha256)

    def bike_named(self, bike_id: int) -> dict[str, str | None]:
        """What a bike is called, for a file. Raises NotFound."""
        return self._database.read(lambda connection: bike_named(connection, bike_id))

    def bring_all(self, bike_id: int, visits: Sequence[StoredVisit]) -> int:
        """Add the visits of a history that are not here yet, all or none; how many that were.

        Raises NotFound; Conflict `visits_full`; StoreError.
        """

        def work(connection: Connection) -> int:
            require_bike(connection, bike_id)
            new = [visit for visit in visits if not is_here(connection, visit.token)]
            for visit in new:
                added = self._added(connection, replace(visit, bike_id=bike_id))
                audit.append(connection, of_visit(Action.VISIT_BROUGHT, added))
            return len(new)

        return self._database.write(work)

    def keep_photo(self, token: str, photo: VisitPhoto, data: bytes) -> None:
        """Write a photograph's file. Raises StoreError."""
        staged = self._objects.stage()
        with self._objects.watch.writing("objects", f"{photo.name} was not saved"):
            staged.write_bytes(data)
        try:
            self._objects.publish(staged, photo_key(token, photo.sha256))
        finally:
            staged.unlink(missing_ok=True)

    def photo(self, token: str, sha256: str) -> bytes:
        """A photograph's file. Raises StoreError where it is lost."""
        return self._objects.local_path(photo_key(token, sha256)).read_bytes()

    def forget_photo(self, token: str, sha256: str) -> None:
        """Remove a photograph that no visit names. What cannot be removed stays, and is no
        visit's."""
        try:
            self._objects.remove(photo_key(token, sha256))
        except StoreError as error:
            LOG.warning("%s", error.message)

    def _added(self, connection: Connection, visit: StoredVisit) -> StoredVisit:
        """Add a visit in SQL and as a file. Raises Conflict `visits_full`, StoreError."""
        count = select(func.count()).where(t.visit.c.bike_id == visit.bike_id)
        if connection.execute(count).scalar_one() >= VISITS_MAX:
            raise Conflict(f"A bike has {VISITS_MAX} visits at most.", "visits_full")
        added = insert_visit(connection, visit)
        self._write_file(connection, added)
        return added

    def _changed(
        self, connection: Connection, visit_id: int, values: Mapping[str, Any]
    ) -> StoredVisit:
        connection.execute(update(t.visit).where(t.visit.c.id == visit_id).values(values))
        visit = visit_of(connection, visit_id)
        self._write_file(connection, visit)
        return visit

    def _write_file(self, connection: Connection, visit: StoredVisit) -> None:
        bike = bike_named(connection, visit.bike_id)
        self._objects.publish_json(file_key(visit.token), {**file_of(visit), "bike": bike})


def bring_back_visit(database: Database, file: Mapping[str, Any]) -> bool:
    """Add a visit of a file to a database that lost it; False where it is there already.

    Raises StoreError for a file of no visit.
    """
    visit = visit_of_file(file)

    def work(connection: Connection) -> bool:
        if is_here(connection, visit.token):
            return False
        insert_visit(connection, replace(visit, bike_id=bike_of_file(connection, file)))
        return True

    return database.write(work)


def insert_visit(connection: Connection, visit: StoredVisit) -> StoredVisit:
    """Add a visit's row; the visit with its number and its bike's name."""
    row = {
        "token": visit.token,
        "bike_id": visit.bike_id,
        "open_for": visit.bike_id if visit.closed_us is None else None,
        "opened_us": visit.opened_us,
        "opened_by": visit.opened_by,
        "closed_us": visit.closed_us,
        "version": visit.version,
        "imported": int(visit.imported),
        "body": plain(visit.content),
        "consent": CONSENT.dump_python(visit.consent, mode="json"),
    }
    made = insert(t.visit).values(row).returning(t.visit.c.id)
    return visit_of(connection, int(connection.execute(made).scalar_one()))


def visit_of_file(file: Mapping[str, Any]) -> StoredVisit:
    """A visit as its file has it, of no bike yet. Raises StoreError for a file of none."""
    try:
        closed_us = file["closed_us"]
        visit = StoredVisit(
            id=0,
            token=str(file["token"]),
            bike_id=0,
            bike_name="",
            opened_us=int(file["opened_us"]),
            opened_by=str(file["opened_by"])[:AUTHOR_MAX],
            closed_us=None if closed_us is None else int(closed_us),
            version=int(file["version"]),
            imported=bool(file["imported"]),
            content=CONTENT.validate_python(file["content"]),
            consent=CONSENT.validate_python(file["consent"]),
        )
        utc(visit.opened_us)
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise StoreError(f"This is no file of a visit: {error!r:.300}.") from error
    # They are parts of the names of files.
    names = [visit.token, *(photo.sha256 for photo in visit.content.photos)]
    if not (TOKEN.fullmatch(names[0]) and all(map(SHA256.fullmatch, names[1:]))):
        raise StoreError("This is no file of a visit: it has no such names.")
    return visit


def is_here(connection: Connection, token: str) -> bool:
    """Whether a visit is in the database."""
    known = select(t.visit.c.id).where(t.visit.c.token == token)
    return connection.execute(known).first() is not None


def bike_named(connection: Connection, bike_id: int) -> dict[str, str | None]:
    """What a bike is called. Raises NotFound."""
    bike = connection.execute(select(t.bike).where(t.bike.c.id == bike_id)).first()
    if bike is None:
        raise NotFound(f"There is no bike {bike_id}.")
    return {"name": bike.name, "model": bike.model, "frame_number": bike.frame_number}


def file_of(visit: StoredVisit) -> dict[str, Any]:
    """A visit as plain JSON, all of it."""
    return {
        "token": visit.token,
        "opened_us": visit.opened_us,
        "opened_by": visit.opened_by,
        "closed_us": visit.closed_us,
        "version": visit.version,
        "imported": visit.imported,
        "content": plain(visit.content),
        "consent": CONSENT.dump_python(visit.consent, mode="json"),
    }


def plain(content: VisitContent) -> dict[str, Any]:
    """A content as plain JSON."""
    body: dict[str, Any] = CONTENT.dump_python(content, mode="json")
    return body


def file_key(token: str) -> str:
    """Where a visit's file is among the objects."""
    return f"{VISITS}/{token}.json"


def photo_key(token: str, sha256: str) -> str:
    """Where a photograph is among the objects."""
    return f"{VISITS}/{token}-{sha256}.jpg"


def visit_of(connection: Connection, visit_id: int) -> StoredVisit:
    """Raises NotFound."""
    row = connection.execute(VISITS_WITH_BIKE.where(t.visit.c.id == visit_id)).first()
    if row is None:
        raise NotFound(f"There is no visit {visit_id}.")
    return visit_from(row)


def open_visit(connection: Connection, visit_id: int) -> StoredVisit:
    """Raises NotFound; Conflict for a closed one."""
    visit = visit_of(connection, visit_id)
    if visit.closed_us is not None:
        raise Conflict("This visit is closed: what was done then stays.", "visit_closed")
    return visit


def require_bike(connection: Connection, bike_id: int) -> None:
    """Raises NotFound."""
    bike_named(connection, bike_id)


def bike_of_file(connection: Connection, file: Mapping[str, Any]) -> int:
    """The bike of a visit that a rebuild brings back: the one that its unit is on, else one with
    its frame number or name, else one that is made."""
    key = file["content"]["unit_key"]
    on = t.bike_unit.c
    query = select(on.bike_id).where(on.unit_key == key, on.to_us.is_(None))
    found = connection.execute(query).scalar()
    bike = file.get("bike") or {}
    names: tuple[Literal["frame_number", "name"], ...] = ("frame_number", "name")
    for name in names:
        if found is None and bike.get(name):
            same = select(t.bike.c.id).where(t.bike.c[name] == bike[name])
            found = connection.execute(same.order_by(t.bike.c.id).limit(1)).scalar()
    if found is not None:
        return int(found)
    values = {key: bike.get(key) for key in ("model", "frame_number")}
    made = insert(t.bike).values(**values, name=bike.get("name") or "?", created_us=now_us())
    return int(connection.execute(made.returning(t.bike.c.id)).scalar_one())


def visit_from(row: Row[Any]) -> StoredVisit:
    """A row of `visit` with its bike's name."""
    return StoredVisit(
        id=row.id,
        token=row.token,
        bike_id=row.bike_id,
        bike_name=row.bike_name,
        opened_us=row.opened_us,
        opened_by=row.opened_by,
        closed_us=row.closed_us,
        version=row.version,
        imported=bool(row.imported),
        content=CONTENT.validate_python(row.body),
        consent=CONSENT.validate_python(row.consent),
    )


def of_visit(action: Action, visit: StoredVisit, after: Members | None = None) -> AuditEntry:
    """Something that was done to a visit."""
    key, bike_id = visit.content.unit_key, visit.bike_id
    return AuditEntry(action, visit.id, visit.bike_name, None, after, "", key, bike_id)


def of_content(visit: StoredVisit) -> Members:
    """What the audit has of a closed visit: no word that somebody wrote."""
    content = visit.content
    return {
        "changes": [one.parameter for one in content.changes],
        "faults": [one.name for one in content.faults],
        "parts": len(content.parts),
        "photos": len(content.photos),
    }
