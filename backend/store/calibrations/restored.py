"""Closed jobs brought back into an empty database from their files."""

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
    document = objects.read_json(key) or {}
    sha256 = PurePosixPath(key).stem
    try:
        job = job_row(document)
        captures = capture_rows(document)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise StoreError(f"{key} tells of no calibration: {error!r}.") from error

    def work(connection: Connection) -> bool:
        known = select(t.calibration.c.id).where(t.calibration.c.sha256 == sha256)
        if connection.execute(known).first() is not None:
            return False
        bike_id = known_unit(connection, job["unit_key"])
        made = insert(t.calibration).values(**job, sha256=sha256, bike_id=bike_id)
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
        "closed_us": int(job["closed_us"]),
    }


def capture_rows(document: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Every capture of a file: those of its certificate, and those it leaves out."""
    told = [{"number": one["number"], "body": one} for one in told_captures(document)]
    apart = document[JOB]["captures"]
    return told + [{name: one[name] for name in ("number", "body", "struck")} for one in apart]
