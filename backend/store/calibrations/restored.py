"""Jobs brought back into an empty database from their files: closed ones, and those still open."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePosixPath
from typing import Any

from sqlalchemy import Connection, insert, select

from backend.errors import StoreError
from backend.store.calibrations.jobs import KIND
from backend.store.calibrations.kept import JOB, told_captures
from backend.store.objects import FileObjects
from backend.store.sql import tables as t
from backend.store.sql.database import Database
from backend.store.units import known_unit


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
        bike_id = known_unit(connection, job["unit_key"])
        made = insert(t.calibration).values(**job, bike_id=bike_id)
        job_id = connection.execute(made.returning(t.calibration.c.id)).scalar_one()
        for row in captures:
            connection.execute(insert(t.calibration_capture).values(calibration_id=job_id, **row))
        return True

    return database.write(work)


def is_calibration(key: str) -> bool:
    """Whether an object is the file of a closed job."""
    return key.startswith(f"{KIND}/")


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
    told = [{"number": one["number"], "body": one} for one in told_captures(document)]
    apart = document[JOB]["captures"]
    return told + [{name: one[name] for name in ("number", "body", "struck")} for one in apart]
