"""Uploads in the store: bytes that arrive in pieces, and what became of them.

The offset a client may rely on is written to SQL only after the bytes are flushed to the disk, and
the file is cut back to that offset before anything is added: so a crash or a cut line in the
middle of a piece never leaves bytes that nobody counted.
"""

from __future__ import annotations

import os
import re
import secrets
import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Select, insert, select, update

from backend.core.audit import Action, AuditEntry
from backend.core.person import ANYBODY, Sender
from backend.errors import BadFile, Conflict, NotFound, StoreError
from backend.store import audit
from backend.store.deletion import MADE, RELATED, Deletions, forget_upload, join_source
from backend.store.objects import Objects, content_key, file_sha256
from backend.store.ride_table import sender_of, upload_key
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.upload_rows import REJECTED, Upload, sent_by, uploads_of

RECEIVING = "receiving"
TOKEN = re.compile(r"[0-9a-f]{32}")


@dataclass(frozen=True)
class Verdict:
    """What became of an upload. expires_us: when it goes, if no ride keeps it.

    asks_sha256: header of the table of which its owner can say more, or must before it is read.
    """

    state: str
    code: str | None = None
    detail: str | None = None
    completeness: float | None = None
    duplicate_of: int | None = None
    expires_us: int | None = None
    asks_sha256: str | None = None


# The spool's name among the parts of the store that may refuse to be written.
PART = "uploads"
# More than a fleet sends at once; each has a file in the spool until it has arrived or expires.
UNFINISHED_MAX = 2_000


class UploadStore:
    """Every upload there is, and the spool folder of those that still arrive."""

    def __init__(
        self, database: Database, objects: Objects, spool: Path, deletions: Deletions
    ) -> None:
        self._database = database
        self._objects = objects
        self._deletions = deletions
        self._spool = spool
        # Two clients with the same piece must not write over one another.
        self._appending = threading.Lock()
        spool.mkdir(parents=True, exist_ok=True)

    def create(
        self,
        name: str,
        size: int,
        declared_sha256: str | None,
        expires_s: int,
        part_of: str | None = None,
        sender: Sender = ANYBODY,
    ) -> Upload:
        """Begin an upload of `size` bytes; nothing has arrived yet, and all must in `expires_s`.

        sender: who sends it; of what is in a container, who sent that.
        Raises Conflict `uploads_full` where too many have begun and not arrived.
        """
        if part_of is None and sum(1 for _ in self._spool.iterdir()) >= UNFINISHED_MAX:
            raise Conflict(
                f"{UNFINISHED_MAX} files have begun to arrive and are not complete: finish or "
                "remove some, or wait until they expire.",
                code="uploads_full",
            )
        token = secrets.token_hex(16)
        with (
            self._objects.watch.writing(PART, "The upload was not begun"),
            self._path(token).open("wb") as file,
        ):
            os.fsync(file.fileno())
        now_us = time.time_ns() // 1000
        values = {
            "token": token,
            "name": name,
            "length": size,
            "received": 0,
            "declared_sha256": declared_sha256,
            "state": RECEIVING,
            "created_us": now_us,
            "expires_us": now_us + expires_s * 1_000_000,
        }

        def work(connection: Connection) -> None:
            container = upload_key(connection, part_of)
            whose = sender if container is None else sender_of(connection, container)
            more = {"part_of": container, **asdict(whose)}
            connection.execute(insert(t.upload).values(values | more))

        self._database.write(work)
        return self.get(token)

    def append(self, token: str, offset: int, data: bytes) -> Upload:
        """Add bytes at `offset`; they are on the disk when this returns.

        Raises Conflict when the offset is not where the upload stands or the bytes are too many,
        BadFile when it was refused by its first bytes, StoreError when the disk refuses; then the
        upload stands where it stood.
        """
        with self._appending:
            return self._append(token, offset, data)

    def _append(self, token: str, offset: int, data: bytes) -> Upload:
        upload = self.get(token)
        if upload.state == REJECTED and upload.received < upload.length:
            raise BadFile(upload.detail or "It is no ride.", code=upload.code)
        if upload.state != RECEIVING or offset != upload.received:
            raise Conflict(
                f"Upload {token} stands at byte {upload.received}, not at {offset}.",
                code="offset_mismatch",
            )
        if offset + len(data) > upload.length:
            raise Conflict(
                f"Upload {token} has {upload.length} bytes: {len(data)} more from {offset} on "
                "are too many.",
                code="too_long",
            )
        with (
            self._objects.watch.writing(PART, f"Upload {token} was not saved"),
            self._path(token).open("r+b") as file,
        ):
            file.truncate(offset)
            file.seek(offset)
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        received = offset + len(data)
        self._set(token, received=received)
        return replace(upload, received=received)

    def head(self, token: str, size: int) -> bytes:
        """The first bytes of an upload that is still arriving. Raises StoreError."""
        with (
            self._objects.watch.writing(PART, f"Upload {token} was not looked at"),
            self._path(token).open("rb") as file,
        ):
            return file.read(size)

    def store_original(self, token: str) -> Upload:
        """Move the whole file among the objects, and note its hash.

        It stays as long as a ride that comes from it; without one it goes with its upload.
        """
        upload = self.get(token)
        if upload.object_key is not None:
            return upload
        staged = self._path(token)
        with self._objects.holding():
            if staged.exists():
                with staged.open("r+b") as file:
                    file.truncate(upload.received)
                sha256 = file_sha256(staged)
                # The hash is known before the file moves: a crash in between is made good from it.
                self._set(token, sha256=sha256)
                self._objects.publish(staged, content_key("originals", sha256))
            elif upload.sha256 is None:
                raise StoreError(f"The bytes of upload {token} are gone: send the file again.")
            else:
                sha256 = upload.sha256
            key = content_key("originals", sha256)
            self._objects.local_path(key)
            self._set(token, sha256=sha256, object_key=key, state="queued")
        return self.get(token)

    def conclude(
        self,
        token: str,
        verdict: Verdict,
        related: Sequence[int] = (),
        made: Sequence[int] = (),
    ) -> Upload:
        """Say what became of an upload, which rides were made from it, and which it is beside of.

        One without any ride to live with goes by itself when its time is over.
        """

        def work(connection: Connection) -> None:
            mine = t.upload.c.token == token
            key = connection.execute(select(t.upload.c.id).where(mine)).scalar()
            if key is None:
                raise NotFound(f"There is no upload {token}.")
            for rides, part in ((related, RELATED), (made, MADE)):
                existing = select(t.ride.c.id).where(t.ride.c.id.in_(rides))
                for ride_id in connection.execute(existing).scalars().all():
                    join_source(connection, ride_id, key, part)
            links = select(t.ride_source.c.id).where(t.ride_source.c.upload_id == key).limit(1)
            stays = connection.execute(links).first() is not None or verdict.state == "queued"
            body = {
                field.name: getattr(verdict, field.name)
                for field in fields(Verdict)
                if field.name != "expires_us"
            }
            body["expires_us"] = None if stays else verdict.expires_us
            connection.execute(update(t.upload).where(mine).values(body))

        self._database.write(work)
        return self.get(token)

    def get(self, token: str) -> Upload:
        """One upload by its id. Raises NotFound."""

        rows = self._uploads_where(select(t.upload).where(t.upload.c.token == token))
        if not rows:
            raise NotFound(f"There is no upload {token}.")
        return rows[0]

    def parts(self, token: str) -> tuple[Upload, ...]:
        """The files within a container, in its order."""
        container = select(t.upload.c.id).where(t.upload.c.token == token).scalar_subquery()
        return self._uploads_where(
            select(t.upload).where(t.upload.c.part_of == container).order_by(t.upload.c.id)
        )

    def first_with(self, sha256: str, owner_id: int | None = None) -> Upload | None:
        """The first upload of the same bytes that became rides, None when there is none.

        owner_id: rides of this account only.
        """
        query = (
            select(t.upload)
            .join(t.ride, t.ride.c.upload_id == t.upload.c.id)
            .where(t.upload.c.sha256 == sha256)
            .order_by(t.upload.c.id)
            .limit(1)
        )
        if owner_id is not None:
            query = query.where(t.ride.c.owner_id == owner_id)
        return next(iter(self._uploads_where(query)), None)

    def waiting(self) -> tuple[Upload, ...]:
        """Uploads that have arrived and whose contents nobody has looked at yet."""
        arrived = (t.upload.c.state == RECEIVING) & (t.upload.c.received == t.upload.c.length)
        mine = (t.upload.c.state == "queued") | arrived
        return self._uploads_where(select(t.upload).where(mine).order_by(t.upload.c.id))

    def asking(self, code: str, header_sha256: str, owner_id: int | None = None) -> Sequence[str]:
        """Ids of the uploads rejected with `code` that wait for what is said of a header, the first
        first; also those that a version before concluded, of which it is not known.

        owner_id: sent by this rider; None for those that are not sent by any.
        """
        mine = (t.upload.c.state == REJECTED) & (t.upload.c.code == code)
        mine &= t.upload.c.owner_id.is_not_distinct_from(owner_id)
        header = t.upload.c.asks_sha256
        mine &= (header == header_sha256) | header.is_(None)
        query = select(t.upload.c.token).where(mine).order_by(t.upload.c.id)
        return self._database.read(lambda c: c.execute(query).scalars().all())

    def read_by(self, header_sha256: str, owner_id: int | None = None) -> Sequence[str]:
        """Ids of the uploads that became rides by what is known of a header, the first first;
        owner_id as of `asking`."""
        mine = t.upload.c.asks_sha256 == header_sha256
        mine &= t.upload.c.owner_id.is_not_distinct_from(owner_id)
        mine &= t.upload.c.id.in_(select(t.ride.c.upload_id))
        query = select(t.upload.c.token).where(mine).order_by(t.upload.c.id)
        return self._database.read(lambda c: c.execute(query).scalars().all())

    def answer_of(self, owner_id: int, header_sha256: str) -> dict[str, Any] | None:
        """What a rider said last of a table with this header; None for nothing."""
        upload = t.upload.c
        mine = (upload.owner_id == owner_id) & (upload.asks_sha256 == header_sha256)
        query = select(upload.answer).where(mine & upload.answer.is_not(None))
        last = query.order_by(upload.id.desc()).limit(1)
        return self._database.read(lambda c: c.execute(last).scalar())

    def keep_answer(self, token: str, header_sha256: str, answer: dict[str, Any]) -> None:
        """Keep what a rider says of the table they sent, for their own with this header."""

        def work(connection: Connection) -> None:
            of = select(t.upload.c.owner_id).where(t.upload.c.token == token).scalar_subquery()
            like = (t.upload.c.owner_id == of) & (t.upload.c.asks_sha256 == header_sha256)
            connection.execute(update(t.upload).where(like).values(answer=None))
            said = {"asks_sha256": header_sha256, "answer": answer}
            connection.execute(update(t.upload).where(t.upload.c.token == token).values(said))

        self._database.write(work)

    def wait_again(self, token: str, code: str | None) -> None:
        """An upload that was concluded waits to be read once more. code: why."""
        self._set(token, state="queued", code=code, detail=None, expires_us=None)

    def remove(self, token: str, now_us: int, audited: bool = False) -> None:
        """Forget an upload that no ride came from, and its bytes. audited: somebody asked for it.

        Raises NotFound; Conflict, naming the rides, when there are some.
        """

        def work(connection: Connection) -> None:
            mine = t.upload.c.token == token
            columns = (t.upload.c.id, t.upload.c.length, t.upload.c.sha256)
            row = connection.execute(select(*columns).where(mine)).first()
            if row is None:
                raise NotFound(f"There is no upload {token}.")
            key = row.id
            link = t.ride_source.c
            query = select(link.ride_id).where(link.upload_id == key, link.part != RELATED)
            rides = connection.execute(query.order_by(link.ride_id)).scalars().all()
            if rides:
                raise Conflict(rides_sentence(token, rides), code="has_rides")
            forget_upload(connection, key, now_us)
            if audited:
                # Not its name: that is a word of its owner's, and goes.
                facts = {"bytes": row.length, "sha256": row.sha256}
                audit.append(connection, AuditEntry(Action.UPLOAD_DELETED, token, before=facts))

        self._database.write(work)
        self._deletions.sweep(now_us)

    def remove_expired(self, now_us: int) -> int:
        """Forget uploads whose time is over at `now_us`; returns how many."""
        with_rides = select(t.ride_source.c.upload_id)
        arrived = (t.upload.c.state == RECEIVING) & (t.upload.c.received == t.upload.c.length)
        query = select(t.upload.c.token).where(
            t.upload.c.state != "queued",
            ~arrived,
            t.upload.c.expires_us < now_us,
            t.upload.c.id.not_in(with_rides),
        )
        tokens = self._database.read(lambda c: c.execute(query).scalars().all())
        removed = 0
        for token in tokens:
            with suppress(NotFound, Conflict):
                self.remove(token, now_us)
                removed += 1
        return removed

    def list(
        self,
        limit: int = 50,
        before: str | None = None,
        part_of: str | None = None,
        sha256: str | None = None,
        whose: Sender = ANYBODY,
    ) -> tuple[Upload, ...]:
        """Uploads, the latest first, from the one before `before` on. Raises NotFound.

        part_of: those within this one, else those within none. sha256: of these bytes only, also
        those of which they are declared and arrive still. whose: sent by these only.
        """
        query = select(t.upload).order_by(t.upload.c.id.desc()).limit(limit)
        query = query.where(sent_by(whose))
        if part_of is not None:
            container = self._database.read(lambda c: upload_key(c, part_of))
            query = query.where(t.upload.c.part_of == container)
        elif sha256 is None:
            query = query.where(t.upload.c.part_of.is_(None))
        if sha256 is not None:
            arrives = (t.upload.c.state == RECEIVING) & (t.upload.c.declared_sha256 == sha256)
            query = query.where((t.upload.c.sha256 == sha256) | arrives)
        if before is not None:
            last = select(t.upload.c.id).where(t.upload.c.token == before)
            key = self._database.read(lambda c: c.execute(last).scalar())
            if key is None:
                raise NotFound(f"There is no upload {before}.")
            query = query.where(t.upload.c.id < key)
        return self._uploads_where(query)

    def unknown_spooled(self) -> Sequence[Path]:
        """Spooled files that no upload knows; empty ones, which a crash leaves, are removed."""
        query = select(t.upload.c.token).where(t.upload.c.object_key.is_(None))
        tokens = set(self._database.read(lambda c: c.execute(query).scalars().all()))
        unknown = []
        for path in self._spool.iterdir():
            if path.name in tokens or not TOKEN.fullmatch(path.name):
                continue
            if path.stat().st_size:
                unknown.append(path)
            else:
                path.unlink(missing_ok=True)
        return unknown

    def _uploads_where(self, query: Select[Any]) -> tuple[Upload, ...]:
        return self._database.read(lambda c: uploads_of(c, c.execute(query).all()))

    def _path(self, token: str) -> Path:
        return self._spool / token

    def _set(self, token: str, **values: object) -> None:
        self._database.write(
            lambda c: c.execute(update(t.upload).where(t.upload.c.token == token).values(values))
        )


def rides_sentence(token: str, rides: Sequence[int]) -> str:
    """Why an upload stays, in words."""
    if len(rides) == 1:
        return (
            f"Ride {rides[0]} came from upload {token}: delete the ride, and the file goes with it."
        )
    named = ", ".join(str(ride) for ride in rides)
    return f"Rides {named} came from upload {token}: delete them, and the file goes with the last."
