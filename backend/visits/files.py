"""A visit as plain JSON: what its file has, and a bike's history of it."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import TypeAdapter

from backend.core.author import AUTHOR_MAX
from backend.errors import StoreError
from backend.store.inspect_schema import TIME_MAX_US
from backend.store.visit_files import SHA256, TOKEN
from backend.visits.types import VisitConsent, VisitContent

CONTENT = TypeAdapter(VisitContent)
CONSENT: TypeAdapter[VisitConsent | None] = TypeAdapter(VisitConsent | None)
# What SQL can count to.
VERSION_MAX = 2**31 - 1
# Lists and objects within each other: of a visit 6, the rest is for what a setting may be.
DEPTH_MAX = 32


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


def visit_of_file(file: Mapping[str, Any]) -> StoredVisit:
    """A visit as its file has it, of no bike yet. Raises StoreError for a file of none."""
    try:
        require_depth(file)
        closed_us = file["closed_us"]
        visit = StoredVisit(
            id=0,
            token=str(file["token"]),
            bike_id=0,
            bike_name="",
            opened_us=integer(file["opened_us"], 1, TIME_MAX_US),
            opened_by=author_in(file["opened_by"]),
            closed_us=None if closed_us is None else integer(closed_us, 1, TIME_MAX_US),
            version=integer(file["version"], 1, VERSION_MAX),
            imported=bool(file["imported"]),
            content=CONTENT.validate_json(text_of(file["content"]), strict=True),
            consent=CONSENT.validate_json(text_of(file["consent"]), strict=True),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise StoreError(f"This is no file of a visit: {error!r:.300}.") from error
    # They are parts of the names of files.
    names = [visit.token, *(photo.sha256 for photo in visit.content.photos)]
    if not (TOKEN.fullmatch(names[0]) and all(map(SHA256.fullmatch, names[1:]))):
        raise StoreError("This is no file of a visit: it has no such names.")
    return visit


def text_of(body: object) -> str:
    """JSON that any reader takes. Raises ValueError for a number that is none."""
    return json.dumps(body, allow_nan=False)


def integer(value: object, least: int, most: int) -> int:
    """Raises TypeError for what is no integer, ValueError for one that is out of bounds."""
    if not isinstance(value, int) or isinstance(value, bool):
        raise TypeError(f"{value!r:.40} is no integer")
    if not least <= value <= most:
        raise ValueError(f"{value} is not from {least} to {most}")
    return value


def author_in(value: object) -> str:
    """A name as it may stand in a column. Raises ValueError."""
    name = str(value)
    if len(name) > AUTHOR_MAX or not name.isprintable():
        raise ValueError("that is no author's name")
    return name


def require_depth(body: object) -> None:
    """Raises ValueError for JSON that has more within each other than its readers take."""
    level, depth = [body], 0
    while level:
        depth += 1
        if depth > DEPTH_MAX:
            raise ValueError("it has too much within each other")
        level = [one for each in level for one in parts_of(each)]


def parts_of(value: object) -> list[Any]:
    """What a list or an object holds that may hold more."""
    inner: Iterable[Any] = ()
    if isinstance(value, Mapping):
        inner = value.values()
    elif isinstance(value, list):
        inner = value
    return [one for one in inner if isinstance(one, (Mapping, list))]
