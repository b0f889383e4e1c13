"""Where the files of service visits are among the objects, and whether one is needed.

    visits/<token>.json              a visit, open or closed, from which a lost database gets it
    visits/<token>-<sha256>.jpg      a photograph of it

Their names are no row's: a visit names them by its token and its photographs' hashes.
"""

from __future__ import annotations

import re
from pathlib import PurePosixPath

from sqlalchemy import Connection, select

from backend.store.objects import VISITS
from backend.store.sql import tables as t

TOKEN, SHA256 = re.compile(r"[0-9a-f]{32}"), re.compile(r"[0-9a-f]{64}")


def visit_key(token: str) -> str:
    """A visit's file."""
    return f"{VISITS}/{token}.json"


def photo_key(token: str, sha256: str) -> str:
    """A photograph's file."""
    return f"{VISITS}/{token}-{sha256}.jpg"


def is_of_visits(key: str) -> bool:
    """Whether an object is a visit's file, or a photograph's."""
    return key.startswith(f"{VISITS}/")


def is_named_by_visit(connection: Connection, key: str) -> bool:
    """Whether a visit has this file. Of a damaged row every photograph is needed."""
    token, _, sha256 = PurePosixPath(key).stem.partition("-")
    row = connection.execute(select(t.visit.c.body).where(t.visit.c.token == token)).first()
    if row is None or not sha256:
        return row is not None
    try:
        return any(photo["sha256"] == sha256 for photo in row.body["photos"])
    except (TypeError, KeyError):
        return True
