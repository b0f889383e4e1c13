"""The closed visits of a bike as one file that goes on with it: to its owner, or another workshop.

    history.json            {format, version, bike, visits}; a visit as its own file has it
    photos/<sha256>.jpg     photographs that visits name

Who brought the bike, and who signed, stays where it was written. What comes back in is read by the
names above alone, and nothing is unpacked to a folder.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import IO, Any
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile

from backend.errors import FieldError, InvalidRequest, StoreError
from backend.store.wall_clock import now_us
from backend.visits.photos import require_jpeg
from backend.visits.records import StoredVisit, file_of, visit_of_file
from backend.visits.types import PHOTOS_MAX, VisitPhoto

FORMAT, VERSION = "spindle-bike-history", 1
MANIFEST = "history.json"
HISTORY_BYTES_MAX = 512 * 1024 * 1024
# Ten times what a thousand visits with all their words take.
MANIFEST_BYTES_MAX = 32 * 1024 * 1024
PHOTO_BYTES_MAX = 4 * 1024 * 1024
# In characters of JSON: everything that a visit may have is a tenth of it.
VISIT_LENGTH_MAX = 1_000_000
DAY_US = 86_400_000_000

Photo = Callable[[str, str], bytes]


def write_history(
    file: IO[bytes], bike: Mapping[str, Any], visits: Sequence[StoredVisit], photo: Photo
) -> None:
    """Write the history of a bike. photo: the JPEG of a visit's token and a photograph's hash.

    Raises StoreError where one is lost.
    """
    body = {
        "format": FORMAT,
        "version": VERSION,
        "bike": dict(bike),
        "visits": [file_of(without_names(visit)) for visit in visits],
    }
    with ZipFile(file, "w") as archive:
        text = json.dumps(body, sort_keys=True, ensure_ascii=False, indent=1)
        archive.writestr(MANIFEST, text, ZIP_DEFLATED)
        written: set[str] = set()
        for visit in visits:
            for one in visit.content.photos:
                if one.sha256 not in written:
                    data = photo(visit.token, one.sha256)
                    archive.writestr(photo_name(one.sha256), data, ZIP_STORED)
                    written.add(one.sha256)


def without_names(visit: StoredVisit) -> StoredVisit:
    """A visit without who brought the bike and who signed."""
    consent = visit.consent and replace(visit.consent, name=None, person_id=None, strokes=())
    return replace(visit, content=replace(visit.content, customer=""), consent=consent)


def photo_name(sha256: str) -> str:
    """A photograph's place in the file."""
    return f"photos/{sha256}.jpg"


class HistoryFile:
    """A history that came in. Raises InvalidRequest for a file that is none, at any step."""

    def __init__(self, file: IO[bytes]) -> None:
        try:
            self._archive = ZipFile(file)
        except (BadZipFile, OSError, ValueError) as error:
            raise refused(f"This is no ZIP file: {error}.") from error
        try:
            body = json.loads(self._read(MANIFEST, MANIFEST_BYTES_MAX))
        except ValueError as error:
            raise refused(f"{MANIFEST} cannot be read: {error}.") from error
        if not isinstance(body, dict) or body.get("format") != FORMAT:
            raise refused("This is no history of a bike.")
        if body.get("version") != VERSION:
            raise refused("This history is of another version of Spindle.", "other_version")
        visits = body.get("visits")
        if not isinstance(visits, list) or not all(isinstance(one, dict) for one in visits):
            raise refused(f"{MANIFEST} has no list of visits.")
        self.visits: list[dict[str, Any]] = visits

    def photos(self, photos: Sequence[VisitPhoto]) -> Iterator[tuple[VisitPhoto, bytes]]:
        """The photographs that a visit names, each checked against its hash."""
        if len(photos) > PHOTOS_MAX:
            raise refused(f"A visit has {PHOTOS_MAX} photographs at most.")
        for photo in photos:
            data = self._read(photo_name(photo.sha256), PHOTO_BYTES_MAX)
            require_jpeg(data, photo)
            yield photo, data

    def _read(self, name: str, bytes_max: int) -> bytes:
        """One entry. Its length is what comes out, whatever the file says of it."""
        try:
            with self._archive.open(name) as entry:
                data = entry.read(bytes_max + 1)
        except (KeyError, BadZipFile, OSError, ValueError, NotImplementedError, RuntimeError) as e:
            raise refused(f"{name} cannot be read: {e}.") from e
        if len(data) > bytes_max:
            raise refused(f"{name} is larger than {bytes_max} bytes.")
        return data


def incoming(file: Mapping[str, Any]) -> StoredVisit:
    """A visit of a history. Raises InvalidRequest for one that is none, or is open."""
    try:
        visit = visit_of_file(file)
    except StoreError as error:
        raise refused(error.message) from error
    now = now_us()
    if visit.closed_us is None or not 0 < visit.opened_us <= visit.closed_us <= now + DAY_US:
        raise refused("A visit of a history is closed, and not in the future.")
    if len(json.dumps(file)) > VISIT_LENGTH_MAX:
        raise refused(f"A visit has at most {VISIT_LENGTH_MAX} characters.")
    return replace(visit, imported=True)


def refused(message: str, code: str = "no_history") -> InvalidRequest:
    """A history that is not taken, and why."""
    return InvalidRequest(message, code, [FieldError("file", code, message)])
