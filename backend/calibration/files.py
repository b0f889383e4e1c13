"""Calibrations as files: of each closed job, and of an open one, from which a lost database gets
them back.

An open job is `calibrating/<hash of the unit's key>.json`. It is written in the transaction that
changes the job, so that SQL and file say the same. Once the job is closed its own file tells all,
and this one goes.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from hashlib import sha256
from pathlib import PurePosixPath
from typing import Any

from sqlalchemy import Connection, insert, select

from backend.core.author import AuthorProof
from backend.errors import StoreError
from backend.store.bikes import bike_of_unit
from backend.store.objects import CALIBRATING, FileObjects, Objects
from backend.store.sql import tables as t
from backend.store.sql.database import Database

Body = Mapping[str, Any]

DOCUMENT, JOB = "document", "job"


@dataclass(frozen=True)
class StoredCapture:
    """One capture. number: from 1 in its calibration, never used again. body: plain JSON.

    struck: why, by whom and when it was struck out; None while it counts.
    """

    number: int
    body: Body
    struck: Body | None = None


@dataclass(frozen=True)
class StoredCalibration:
    """A job. body: all that is known of it but its captures, plain JSON. model: of the unit.

    closed_us: None while it is open. sha256: of the bytes of the closed one's file. bike: its name
    now.
    """

    id: int
    unit_key: str
    bike_id: int | None
    model: str | None
    body: Body
    author: str
    author_proof: AuthorProof | None
    opened_us: int
    closed_us: int | None = None
    sha256: str | None = None
    bike: str | None = None


def document_of(
    job: StoredCalibration, uncounted: tuple[StoredCapture, ...], certificate: Body | None
) -> dict[str, Any]:
    """A closed job's file: the certificate, if there is one, and what brings the job back.

    certificate: as calibration.describe makes it; its document holds the captures that count.
    uncounted: the captures that are not in it.
    """
    return {
        **({DOCUMENT: None} if certificate is None else certificate),
        JOB: {
            "unit_key": job.unit_key,
            "model": job.model,
            "body": dict(job.body),
            "author": job.author,
            "author_proof": job.author_proof,
            "opened_us": job.opened_us,
            "closed_us": job.closed_us,
            "captures": [asdict(capture) for capture in uncounted],
        },
    }


def captures_in(file: Body) -> Sequence[Body]:
    """The captures in the document of a file or certificate."""
    captures: Sequence[Body] = (file.get(DOCUMENT) or {"captures": ()})["captures"]
    return captures


LOG = logging.getLogger(__name__)


def open_key(unit_key: str) -> str:
    """Key of the file of a unit's open job; a unit has one at most."""
    return f"{CALIBRATING}/{sha256(unit_key.encode()).hexdigest()}.json"


def write_open(
    objects: Objects, job: StoredCalibration, captures: tuple[StoredCapture, ...]
) -> None:
    """Write an open job with all its captures, in place of what was there. Raises StoreError."""
    objects.publish_json(open_key(job.unit_key), document_of(job, captures, None))


def forget_open(objects: Objects, unit_key: str) -> None:
    """A job is closed. A file that cannot be removed is passed over by a rebuild."""
    try:
        objects.remove(open_key(unit_key))
    except StoreError as error:
        LOG.warning("%s", error.message)


def bring_back_calibration(database: Database, objects: FileObjects, key: str) -> bool:
    """Add the job of a whole file; False where it was there already.

    Raises StoreError for a file that tells of none.
    """
    try:
        document = objects.read_json(key) or {}
        job = job_row(document)
        captures = capture_rows(document)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise StoreError(f"{key} tells of no calibration: {error!r}.") from error
    closed = job["closed_us"] is not None
    if closed is not is_calibration(key):
        raise StoreError(f"{key} tells of a calibration that is {'closed' if closed else 'open'}.")
    if closed:
        job["sha256"] = PurePosixPath(key).stem
        same = t.calibration.c.sha256 == job["sha256"]
    else:
        job["open_for"] = job["unit_key"]
        mine = t.calibration.c.unit_key == job["unit_key"]
        # Closed since: its file was there, and this one could not be removed.
        same = mine & (t.calibration.c.opened_us == job["opened_us"])
        same |= t.calibration.c.open_for == job["unit_key"]

    def work(connection: Connection) -> bool:
        if connection.execute(select(t.calibration.c.id).where(same)).first() is not None:
            return False
        bike_id = bike_of_unit(connection, job["unit_key"])
        made = insert(t.calibration).values(**job, bike_id=bike_id)
        job_id = connection.execute(made.returning(t.calibration.c.id)).scalar_one()
        for row in captures:
            connection.execute(insert(t.calibration_capture).values(calibration_id=job_id, **row))
        return True

    return database.write(work)


def is_calibration(key: str) -> bool:
    """Whether an object is the file of a closed job."""
    return key.startswith("calibrations/")


def job_row(document: Mapping[str, Any]) -> dict[str, Any]:
    """What a file says of its job."""
    job = document[JOB]
    return {
        "unit_key": str(job["unit_key"]),
        "model": job["model"],
        "body": dict(job["body"]),
        "author": str(job["author"]),
        "author_proof": job["author_proof"],
        "opened_us": int(job["opened_us"]),
        "closed_us": None if job["closed_us"] is None else int(job["closed_us"]),
    }


def capture_rows(document: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Every capture of a file: those of its certificate, and those it leaves out."""
    counted = [{"number": one["number"], "body": one} for one in captures_in(document)]
    uncounted = document[JOB]["captures"]
    return counted + [
        {name: one[name] for name in ("number", "body", "struck")} for one in uncounted
    ]
