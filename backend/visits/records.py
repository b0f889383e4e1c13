"""Service visits in SQL and as files (`store.visit_files`): what is written is in both once the
call returns.

    file noted as given up  ->  file written  ->  rows, note taken back     (something comes)
    rows, file noted as given up  ->  file unlinked  ->  note deleted       (it goes)

A crash or a refusal at any arrow leaves the note, and the next sweep removes what no visit names
(`store.deletion`). A visit's own file is written in the transaction that changes it: where the
commit fails it is written again as SQL has it; a crash in between leaves it ahead, never behind.

A bike has one open visit at most. What is closed is not changed any more but for the consent.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from typing import Any

from pydantic import ValidationError
from sqlalchemy import Connection, Row, delete, func, insert, select, update

from backend.core.audit import Action, AuditEntry, Members
from backend.core.author import AUTHOR_MAX
from backend.errors import Conflict, NotFound, ObjectDamaged, StoreError
from backend.store import audit
from backend.store.discard import note_discarded, take_back
from backend.store.objects import Objects
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.store import Store
from backend.store.visit_files import photo_key, visit_key
from backend.store.wall_clock import now_us
from backend.visits.files import CONSENT, CONTENT, StoredVisit, file_of, plain, visit_of_file
from backend.visits.types import VISITS_MAX, VisitConsent, VisitContent, VisitPhoto

VISITS_WITH_BIKE = select(t.visit, t.bike.c.name.label("bike_name")).join(
    t.bike, t.bike.c.id == t.visit.c.bike_id
)
Content = Callable[[VisitContent], VisitContent]
# A visit's photographs with their bytes, one after the other.
PhotosOf = Callable[[StoredVisit], Iterable[tuple[VisitPhoto, bytes]]]


class VisitStore:
    """Visits by their number, from any thread."""

    def __init__(self, store: Store) -> None:
        self._database = store.database
        self._objects: Objects = store.objects
        self._deletions = store.deletions

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
            return key, newest_seq(connection, key)

        return self._database.read(work)

    def open(self, bike_id: int, token: str, content: VisitContent, author: str) -> StoredVisit:
        """Begin a visit. Raises NotFound; Conflict `visit_open` where one is open, `visits_full`;
        StoreError."""
        author = author[:AUTHOR_MAX]
        visit = StoredVisit(0, token, bike_id, "", now_us(), author, None, 1, False, content, None)

        def work(connection: Connection) -> StoredVisit:
            require_bike(connection, bike_id)
            if has_open_visit(connection, bike_id):
                raise Conflict("A visit of this bike is open already.", "visit_open")
            added = self._added(connection, visit)
            audit.append(connection, of_visit(Action.VISIT_OPENED, added))
            return added

        with self._bringing([visit_key(token)]):
            return self._database.write(work)

    def change(
        self, visit_id: int, content: Content, version: int | None = None, closes: bool = False
    ) -> StoredVisit:
        """Give an open visit another content, made of the one it has; what that raises changes
        nothing. Photographs that it has no more are removed, now or by a later sweep. version: that
        it must have, and then it gets the next one. closes: it is final.

        Raises NotFound; Conflict `visit_closed`, `visit_changed`; StoreError.
        """
        now = now_us()

        def work(connection: Connection) -> tuple[StoredVisit, set[str]]:
            visit = open_visit(connection, visit_id)
            if version is not None and version != visit.version:
                message = "Somebody else wrote in this visit meanwhile: load it again."
                raise Conflict(message, "visit_changed")
            values: dict[str, Any] = {"body": plain(content(visit.content))}
            if version is not None:
                values["version"] = version + 1
            if closes:
                values |= {"closed_us": now_us(), "open_for": None}
            changed = self._changed(connection, visit_id, values)
            if closes:
                entry = of_visit(Action.VISIT_CLOSED, changed, of_content(changed))
                audit.append(connection, entry)
            gone = photo_keys(visit) - photo_keys(changed)
            note_discarded(connection, sorted(gone), now)
            take_back(connection, photo_keys(changed))
            return changed, gone

        with self._as_in_sql(visit_id):
            changed, gone = self._database.write(work)
        if gone:
            self._sweep(now)
        return changed

    def consent(self, visit_id: int, make: Callable[[StoredVisit], VisitConsent]) -> StoredVisit:
        """Note a consent to a visit, open or closed; what `make` raises changes nothing. Raises
        NotFound, StoreError."""

        def work(connection: Connection) -> StoredVisit:
            consent = make(visit_of(connection, visit_id, for_update=True))
            values = {"consent": CONSENT.dump_python(consent, mode="json")}
            visit = self._changed(connection, visit_id, values)
            after = {"by": consent.by, "content_sha256": consent.content_sha256}
            audit.append(connection, of_visit(Action.VISIT_CONSENTED, visit, after))
            return visit

        with self._as_in_sql(visit_id):
            return self._database.write(work)

    def remove(self, visit_id: int) -> None:
        """Remove an open visit that was begun by mistake. It is gone once this returns; a file that
        cannot go now goes later. Raises NotFound; Conflict `visit_closed`; StoreError."""
        now = now_us()

        def work(connection: Connection) -> None:
            visit = open_visit(connection, visit_id)
            connection.execute(delete(t.visit).where(t.visit.c.id == visit_id))
            audit.append(connection, of_visit(Action.VISIT_REMOVED, visit))
            note_discarded(connection, [visit_key(visit.token), *sorted(photo_keys(visit))], now)

        self._database.write(work)
        self._sweep(now)

    def bike_named(self, bike_id: int) -> dict[str, str | None]:
        """What a bike is called, for a file. Raises NotFound."""
        return self._database.read(lambda connection: bike_named(connection, bike_id))

    def bring_all(self, bike_id: int, visits: Sequence[StoredVisit], photos: PhotosOf) -> int:
        """Add the visits of a history that are not here yet, with their photographs, all or none;
        how many that were. visits: each once. What `photos` raises leaves nothing.

        Raises NotFound; Conflict `visits_full`; StoreError.
        """

        def missing(connection: Connection) -> Sequence[StoredVisit]:
            require_bike(connection, bike_id)
            new = [visit for visit in visits if not is_here(connection, visit.token)]
            require_room(connection, bike_id, len(new))
            return new

        def work(connection: Connection) -> int:
            new = missing(connection)
            for visit in new:
                added = self._added(connection, replace(visit, bike_id=bike_id))
                audit.append(connection, of_visit(Action.VISIT_BROUGHT, added))
            return len(new)

        # They are looked for twice: photographs are written before the transaction.
        new = self._database.read(missing)
        keys = {key for visit in new for key in (visit_key(visit.token), *photo_keys(visit))}
        with self._bringing(sorted(keys)):
            for visit in new:
                for photo, data in photos(visit):
                    self._write_photo(visit.token, photo, data)
            return self._database.write(work)

    def add_photo(
        self, visit_id: int, photo: VisitPhoto, data: bytes, content: Content
    ) -> StoredVisit:
        """Keep a photograph's bytes, and give the visit the content that names it, as `change`
        does. Raises NotFound; Conflict `visit_closed`; StoreError; then its bytes are not kept."""
        token = self.get(visit_id).token
        with self._bringing([photo_key(token, photo.sha256)]):
            self._write_photo(token, photo, data)
            return self.change(visit_id, content)

    def photo(self, token: str, sha256: str) -> bytes:
        """A photograph's bytes. Raises ObjectDamaged for other bytes than were written, StoreError
        where they are lost."""
        path = self._objects.local_path(photo_key(token, sha256))
        try:
            data = path.read_bytes()
        except OSError as error:
            raise StoreError(f"{path} cannot be read: {error}.") from error
        if hashlib.sha256(data).hexdigest() != sha256:
            raise ObjectDamaged(f"{path} is not what was written. Restore it from a backup.")
        return data

    @contextmanager
    def _bringing(self, keys: Sequence[str]) -> Iterator[None]:
        """While files are written that no visit names yet, and the visit that does. What a crash or
        an exception leaves of them goes, now or by a later sweep."""
        now = now_us()
        try:
            with self._objects.holding():
                self._database.write(lambda connection: note_discarded(connection, keys, now))
                yield
        except Exception:
            self._sweep(now)
            raise

    @contextmanager
    def _as_in_sql(self, visit_id: int) -> Iterator[None]:
        """While a visit's file may be written and its row not: then its file is made as the row."""
        try:
            yield
        except StoreError:
            with suppress(StoreError, NotFound):
                self._database.write(lambda c: self._write_file(c, visit_of(c, visit_id)))
            raise

    def _sweep(self, now: int) -> None:
        """Remove what is given up. A later sweep does what this one cannot."""
        with suppress(StoreError):
            self._deletions.sweep(now)

    def _write_photo(self, token: str, photo: VisitPhoto, data: bytes) -> None:
        staged = self._objects.stage()
        try:
            with self._objects.watch.writing("objects", f"{photo.name} was not saved"):
                staged.write_bytes(data)
            self._objects.publish(staged, photo_key(token, photo.sha256))
        finally:
            staged.unlink(missing_ok=True)

    def _added(self, connection: Connection, visit: StoredVisit) -> StoredVisit:
        """Add a visit in SQL and as a file. Raises Conflict `visits_full`, StoreError."""
        require_room(connection, visit.bike_id, 1)
        added = insert_visit(connection, visit)
        self._write_file(connection, added)
        take_back(connection, [visit_key(added.token), *photo_keys(added)])
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
        self._objects.publish_json(visit_key(visit.token), {**file_of(visit), "bike": bike})


def bring_back_visit(database: Database, objects: Objects, file: Mapping[str, Any]) -> bool:
    """Add a visit of a file to a database that lost it; False where it is there already. An open
    one has the photographs that are there: of one that was not saved, its file may tell.

    Raises StoreError for a file of no visit.
    """
    visit = visit_of_file(file)
    if visit.closed_us is None:
        photos = tuple(one for one in visit.content.photos if is_stored(objects, visit.token, one))
        visit = replace(visit, content=replace(visit.content, photos=photos))
    named = file.get("bike")
    bike = {
        name: text
        for name, text in (named.items() if isinstance(named, Mapping) else ())
        if name in ("name", "model", "frame_number") and isinstance(text, str)
    }

    def work(connection: Connection) -> bool:
        if is_here(connection, visit.token):
            return False
        content = visit.content
        if visit.closed_us is None and content.revision_seq is not None:
            # Configurations are numbered anew where the database is lost.
            seq = newest_seq(connection, content.unit_key)
            content = replace(content, revision_seq=seq)
        bike_id = bike_of_file(connection, visit, bike)
        insert_visit(connection, replace(visit, bike_id=bike_id, content=content))
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


def is_here(connection: Connection, token: str) -> bool:
    """Whether a visit is in the database."""
    known = select(t.visit.c.id).where(t.visit.c.token == token)
    return connection.execute(known).first() is not None


def has_open_visit(connection: Connection, bike_id: int) -> bool:
    """Whether a visit of this bike is open."""
    mine = select(t.visit.c.id).where(t.visit.c.open_for == bike_id)
    return connection.execute(mine).first() is not None


def require_room(connection: Connection, bike_id: int, added: int) -> None:
    """Raises Conflict `visits_full` where a bike cannot have so many visits more."""
    count = select(func.count()).where(t.visit.c.bike_id == bike_id)
    if connection.execute(count).scalar_one() + added > VISITS_MAX:
        raise Conflict(f"A bike has {VISITS_MAX} visits at most.", "visits_full")


def newest_seq(connection: Connection, unit_key: str | None) -> int | None:
    """The number of a unit's newest configuration that is known."""
    newest = select(func.max(t.revision.c.seq)).where(t.revision.c.unit_key == unit_key)
    return connection.execute(newest).scalar()


def photo_keys(visit: StoredVisit) -> set[str]:
    """The files of a visit's photographs."""
    return {photo_key(visit.token, photo.sha256) for photo in visit.content.photos}


def is_stored(objects: Objects, token: str, photo: VisitPhoto) -> bool:
    """Whether a photograph's file is there."""
    with suppress(StoreError):
        return objects.local_path(photo_key(token, photo.sha256)).is_file()
    return False


def bike_named(connection: Connection, bike_id: int) -> dict[str, str | None]:
    """What a bike is called. Raises NotFound."""
    bike = connection.execute(select(t.bike).where(t.bike.c.id == bike_id)).first()
    if bike is None:
        raise NotFound(f"There is no bike {bike_id}.")
    return {"name": bike.name, "model": bike.model, "frame_number": bike.frame_number}


def visit_of(connection: Connection, visit_id: int, for_update: bool = False) -> StoredVisit:
    """for_update: no other transaction changes it before this one ends. Raises NotFound."""
    query = VISITS_WITH_BIKE.where(t.visit.c.id == visit_id)
    if for_update:
        query = query.with_for_update(of=t.visit)
    row = connection.execute(query).first()
    if row is None:
        raise NotFound(f"There is no visit {visit_id}.")
    return visit_from(row)


def open_visit(connection: Connection, visit_id: int) -> StoredVisit:
    """A visit that is about to be changed. Raises NotFound; Conflict for a closed one."""
    visit = visit_of(connection, visit_id, for_update=True)
    if visit.closed_us is not None:
        raise Conflict("This visit is closed: what was done then stays.", "visit_closed")
    return visit


def require_bike(connection: Connection, bike_id: int) -> None:
    """Raises NotFound."""
    bike_named(connection, bike_id)


def bike_of_file(connection: Connection, visit: StoredVisit, bike: Mapping[str, str]) -> int:
    """The bike of a visit that a rebuild brings back: the one that its unit is on, else one with
    its frame number or name, else one that is made. Of an open visit one that has none."""
    taken = select(t.visit.c.open_for).where(t.visit.c.open_for.is_not(None))
    free = t.bike.c.id.not_in(taken) if visit.closed_us is None else t.bike.c.id.is_not(None)
    on = t.bike_unit.c
    query = select(t.bike.c.id).join(t.bike_unit, on.bike_id == t.bike.c.id)
    query = query.where(on.unit_key == visit.content.unit_key, on.to_us.is_(None), free)
    found = connection.execute(query).scalar()
    frame = t.bike.c.frame_number
    same_frame = frame == bike.get("frame_number")
    # One of a fleet has the name of the others, and a frame of its own.
    same_name = t.bike.c.name == bike.get("name")
    if bike.get("frame_number"):
        same_name &= frame.is_(None)
    for same in (same_frame, same_name):
        if found is None:
            query = select(t.bike.c.id).where(same, free).order_by(t.bike.c.id).limit(1)
            found = connection.execute(query).scalar()
    if found is not None:
        return int(found)
    values = {key: bike.get(key) for key in ("model", "frame_number")}
    made = insert(t.bike).values(**values, name=bike.get("name") or "?", created_us=now_us())
    return int(connection.execute(made.returning(t.bike.c.id)).scalar_one())


def visit_from(row: Row[Any]) -> StoredVisit:
    """A row of `visit` with its bike's name. Raises StoreError for one that is damaged."""
    try:
        content = CONTENT.validate_python(row.body)
        consent = CONSENT.validate_python(row.consent)
    except ValidationError as error:
        message = f"The visit {row.id} is damaged in the database: restore it from a backup."
        raise StoreError(message) from error
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
        content=content,
        consent=consent,
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
