"""Calibration jobs in SQL and as files: what is captured is in both once the call returns.

One job is open for a unit at a time. Nothing is removed: a capture that is taken back is struck
out and stays.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from sqlalchemy import Connection, Row, Select, func, insert, select, update

from backend.calibration.files import (
    Body,
    StoredCalibration,
    StoredCapture,
    captures_in,
    document_of,
    forget_open,
    write_open,
)
from backend.core.audit import Action, AuditEntry
from backend.core.author import proof_of
from backend.core.canonical_json import canonical_text, sha256_of
from backend.errors import Conflict, NotFound, ObjectDamaged
from backend.store import audit
from backend.store.bikes import bike_of_unit
from backend.store.discard import calibration_key
from backend.store.soundness import WORDS, Expected
from backend.store.sql import tables as t
from backend.store.store import Store
from backend.store.wall_clock import now_us

JOBS_MAX = 1000
CAPTURES_MAX = 500
"""Of one job, struck ones too: three times what the largest plan asks for."""

JOBS = select(t.calibration, t.bike.c.name.label("bike")).outerjoin_from(
    t.calibration, t.bike, t.bike.c.id == t.calibration.c.bike_id
)


class CalibrationStore:
    """Jobs by their number, from any thread."""

    def __init__(self, store: Store) -> None:
        self._database = store.database
        self._objects = store.objects
        self._soundness = store.soundness

    # ------------------------------------------------------------------ jobs

    def open(
        self, unit_key: str, model: str | None, body: Body, author: str
    ) -> tuple[StoredCalibration, bool]:
        """The open job of a unit, and whether it was made now. Raises StoreError."""

        def work(connection: Connection) -> tuple[int, bool]:
            mine = select(t.calibration.c.id).where(t.calibration.c.open_for == unit_key)
            existing = connection.execute(mine).scalar()
            if existing is not None:
                return int(existing), False
            values = {
                "unit_key": unit_key,
                "bike_id": bike_of_unit(connection, unit_key),
                "model": model,
                "open_for": unit_key,
                "body": dict(body),
                "author": str(author),
                "author_proof": proof_of(author),
                "opened_us": now_us(),
            }
            made = insert(t.calibration).values(values).returning(t.calibration.c.id)
            job_id = int(connection.execute(made).scalar_one())
            self._write_file(connection, job_id)
            entry = AuditEntry(Action.CALIBRATION_OPENED, job_id, unit_key=unit_key)
            audit.append(connection, entry)
            return job_id, True

        job_id, is_new = self._database.write(work)
        return self.get(job_id), is_new

    def get(self, job_id: int) -> StoredCalibration:
        """One job. Raises NotFound."""
        return self._database.read(lambda connection: job_of(connection, job_id))

    def list(
        self, unit_key: str | None = None, bike_id: int | None = None, model: str | None = None
    ) -> tuple[StoredCalibration, ...]:
        """Jobs, newest first; of a unit, a bike or a model where it is named."""
        query = JOBS
        for column, value in (
            (t.calibration.c.unit_key, unit_key),
            (t.calibration.c.bike_id, bike_id),
            (t.calibration.c.model, model),
        ):
            query = query if value is None else query.where(column == value)
        query = query.order_by(t.calibration.c.opened_us.desc(), t.calibration.c.id.desc())
        rows = self._database.read(lambda c: c.execute(query.limit(JOBS_MAX)).all())
        return tuple(map(job_from, rows))

    def change(
        self, job_id: int, work: Callable[[Body], Body], entry: AuditEntry | None = None
    ) -> StoredCalibration:
        """Give an open job another body, made of the one it has; what `work` raises changes
        nothing. entry: what that is for the audit, None for nothing. Raises NotFound, Conflict for
        a closed one, StoreError."""

        def changed(connection: Connection) -> StoredCalibration:
            job = open_job(connection, job_id)
            body = dict(work(job.body))
            set_body(connection, job_id, body)
            self._write_file(connection, job_id)
            if entry is not None:
                audit.append(connection, entry)
            return replace(job, body=body)

        return self._database.write(changed)

    def redate(
        self,
        work: Callable[
            [StoredCalibration, Sequence[StoredCapture]],
            tuple[StoredCalibration, Sequence[StoredCapture]] | None,
        ],
    ) -> None:
        """Give open jobs and their captures other dates: all of them or none.

        work: a job and its captures as they shall be, None for one that stays. Raises StoreError.
        """

        def done(connection: Connection) -> None:
            is_open = select(t.calibration.c.id).where(t.calibration.c.closed_us.is_(None))
            for job_id in connection.execute(is_open.order_by(t.calibration.c.id)).scalars().all():
                made = work(job_of(connection, job_id), captures_of(connection, job_id))
                if made is not None:
                    set_dates(connection, *made)
                    self._write_file(connection, job_id)

        self._database.write(done)

    # ------------------------------------------------------------------ captures

    def captures(self, job_id: int) -> tuple[StoredCapture, ...]:
        """All of a job by number, struck ones too."""
        return self._database.read(lambda connection: captures_of(connection, job_id))

    def capture(self, job_id: int, make: Callable[[int, Body], tuple[Body, Body]]) -> StoredCapture:
        """Add a capture and change the job with it, both or none. make: from the capture's number
        and the job's body, the capture and the job's body.

        Raises NotFound, Conflict for a closed job or one with too many captures, StoreError.
        """
        captures = t.calibration_capture

        def added(connection: Connection) -> StoredCapture:
            job = open_job(connection, job_id)
            newest = select(func.max(captures.c.number)).where(captures.c.calibration_id == job_id)
            number = int(connection.execute(newest).scalar() or 0) + 1
            if number > CAPTURES_MAX:
                message = f"A calibration holds {CAPTURES_MAX} captures, struck ones too."
                raise Conflict(message, "too_many_captures")
            body, changed = make(number, job.body)
            values = {"calibration_id": job_id, "number": number, "body": dict(body)}
            connection.execute(insert(captures).values(values))
            set_body(connection, job_id, changed)
            self._write_file(connection, job_id)
            return StoredCapture(number, body)

        return self._database.write(added)

    def strike(
        self, job_id: int, number: int, struck: Body, work: Callable[[Body], Body]
    ) -> StoredCapture:
        """Strike a capture out and change the job with it. Once is enough: the first word stays.

        Raises NotFound, Conflict for a closed job, StoreError.
        """

        def done(connection: Connection) -> StoredCapture:
            job = open_job(connection, job_id)
            capture = {one.number: one for one in captures_of(connection, job_id)}.get(number)
            if capture is None:
                raise NotFound(f"Calibration {job_id} has no capture {number}.")
            if capture.struck is not None:
                return capture
            row = t.calibration_capture.c
            mine = (row.calibration_id == job_id) & (row.number == number)
            changed = update(t.calibration_capture).where(mine).values(struck=dict(struck))
            connection.execute(changed)
            set_body(connection, job_id, work(job.body))
            self._write_file(connection, job_id)
            return replace(capture, struck=struck)

        return self._database.write(done)

    # ------------------------------------------------------------------ closed jobs

    def close(
        self, job_id: int, work: Callable[[Body], Body], certificate: Body | None
    ) -> StoredCalibration:
        """Close a job: its file is there first, then SQL says so; after a crash between the two it
        is closed again. certificate: plain JSON with the captures that count, None without a fit.

        Raises NotFound, Conflict for a closed one, StoreError.
        """
        job = self._database.read(lambda connection: open_job(connection, job_id))
        captures = self.captures(job_id)
        counted = {one["number"] for one in captures_in(certificate or {})}
        job = replace(job, body=dict(work(job.body)), closed_us=now_us())
        uncounted = tuple(
            one for one in captures if one.struck is not None or one.number not in counted
        )
        document = document_of(job, uncounted, certificate)
        sha256 = sha256_of(document)
        with self._objects.holding():
            self._publish(calibration_key(sha256), document)

            def closed(connection: Connection) -> None:
                open_job(connection, job_id)
                values = {
                    "body": dict(job.body),
                    "closed_us": job.closed_us,
                    "sha256": sha256,
                    "open_for": None,
                }
                mine = t.calibration.c.id == job_id
                connection.execute(update(t.calibration).where(mine).values(values))
                after = {"sha256": sha256}
                action, key = Action.CALIBRATION_CLOSED, job.unit_key
                audit.append(connection, AuditEntry(action, job_id, after=after, unit_key=key))

            self._database.write(closed)
        forget_open(self._objects, job.unit_key)
        return replace(job, sha256=sha256)

    def file(self, job: StoredCalibration) -> bytes:
        """A closed job's file, every byte verified. Raises ObjectDamaged, Conflict."""
        if job.sha256 is None:
            raise Conflict(f"Calibration {job.id} is open: it has no file yet.", "still_open")
        key = calibration_key(job.sha256)
        file, damage = self._soundness.opened(Expected(key, None))
        if file is None:
            raise ObjectDamaged(
                f"The file of calibration {job.id} is damaged: {WORDS[damage or 'missing']} "
                f"({key}). Restore it from a backup."
            )
        with file:
            return file.read()

    def _write_file(self, connection: Connection, job_id: int) -> None:
        """The last step of a transaction that changes an open job."""
        write_open(self._objects, job_of(connection, job_id), captures_of(connection, job_id))

    def _publish(self, key: str, document: Mapping[str, Any]) -> None:
        staged = self._objects.stage()
        with self._objects.watch.writing("objects", f"The object {key} was not saved"):
            staged.write_text(canonical_text(document), encoding="ascii")
        try:
            self._objects.publish(staged, key)
        finally:
            staged.unlink(missing_ok=True)


def open_job(connection: Connection, job_id: int) -> StoredCalibration:
    """A job that may be changed. Raises NotFound, Conflict for a closed one."""
    job = job_of(connection, job_id)
    if job.closed_us is not None:
        raise Conflict(f"Calibration {job_id} is closed; open another one.", "calibration_closed")
    return job


def job_of(connection: Connection, job_id: int) -> StoredCalibration:
    row = connection.execute(JOBS.where(t.calibration.c.id == job_id)).first()
    if row is None:
        raise NotFound(f"There is no calibration {job_id}.")
    return job_from(row)


def job_from(row: Row[Any]) -> StoredCalibration:
    return StoredCalibration(
        id=row.id,
        unit_key=row.unit_key,
        bike_id=row.bike_id,
        model=row.model,
        body=row.body,
        author=row.author,
        author_proof=row.author_proof,
        opened_us=row.opened_us,
        closed_us=row.closed_us,
        sha256=row.sha256,
        bike=row.bike,
    )


def captures_of(connection: Connection, job_id: int) -> tuple[StoredCapture, ...]:
    mine: Select[Any] = select(t.calibration_capture).where(
        t.calibration_capture.c.calibration_id == job_id
    )
    rows = connection.execute(mine.order_by(t.calibration_capture.c.number)).all()
    return tuple(StoredCapture(row.number, row.body, row.struck) for row in rows)


def set_body(connection: Connection, job_id: int, body: Body) -> None:
    mine = t.calibration.c.id == job_id
    connection.execute(update(t.calibration).where(mine).values(body=dict(body)))


def set_dates(
    connection: Connection, job: StoredCalibration, captures: Sequence[StoredCapture]
) -> None:
    mine = t.calibration.c.id == job.id
    connection.execute(update(t.calibration).where(mine).values(opened_us=job.opened_us))
    set_body(connection, job.id, job.body)
    row = t.calibration_capture.c
    for one in captures:
        which = (row.calibration_id == job.id) & (row.number == one.number)
        values = {"body": dict(one.body), "struck": one.struck}
        connection.execute(update(t.calibration_capture).where(which).values(values))
