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
from os import SEEK_END
from struct import error as StructError
from typing import IO, Any
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile
from zlib import error as ZlibError

from backend.errors import FieldError, InvalidRequest, StoreError
from backend.store.wall_clock import now_us
from backend.visits.files import StoredVisit, file_of, visit_of_file
from backend.visits.photos import require_as_drawn
from backend.visits.types import PHOTOS_MAX, VISITS_MAX, VisitPhoto, VisitWords

FORMAT, VERSION = "spindle-bike-history", 1
MANIFEST = "history.json"
HISTORY_BYTES_MAX = 512 * 1024 * 1024
# Ten times what a thousand visits with all their words take.
MANIFEST_BYTES_MAX = 32 * 1024 * 1024
PHOTO_BYTES_MAX = 4 * 1024 * 1024
# In characters of JSON: everything that a visit may have is a tenth of it.
VISIT_LENGTH_MAX = 1_000_000
# Its list of names, which Python holds as a whole; a thousand visits with every photograph take 3.
DIRECTORY_BYTES_MAX = 4 * 1024 * 1024
DAY_US = 86_400_000_000
# Where a ZIP file ends, without a comment, and the mark of one of more than 4 GiB before that.
END, END_BYTES, END_64, END_64_BYTES = b"PK\x05\x06", 22, b"PK\x06\x07", 20
# What zipfile and its decompressors raise on damage or on a method they do not know.
DAMAGE = (
    BadZipFile,
    ZlibError,
    EOFError,
    OSError,
    NotImplementedError,
    RuntimeError,
    ValueError,
    LookupError,
    StructError,
)

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
        require_short_directory(file)
        try:
            self._archive = ZipFile(file)
        except DAMAGE as error:
            raise refused(f"This is no ZIP file: {error}.") from error
        self._photo_bytes = 0
        try:
            body = json.loads(self._read(MANIFEST, MANIFEST_BYTES_MAX))
        except (ValueError, RecursionError) as error:
            raise refused(f"{MANIFEST} cannot be read: {error}.") from error
        if not isinstance(body, dict) or body.get("format") != FORMAT:
            raise refused("This is no history of a bike.")
        if body.get("version") != VERSION:
            raise refused("This history is of another version of Spindle.", "other_version")
        visits = body.get("visits")
        if not isinstance(visits, list) or not all(isinstance(one, dict) for one in visits):
            raise refused(f"{MANIFEST} has no list of visits.")
        if len(visits) > VISITS_MAX:
            raise refused(f"A bike has {VISITS_MAX} visits at most.", "visits_full")
        self.visits: list[dict[str, Any]] = visits

    def photos(self, photos: Sequence[VisitPhoto]) -> Iterator[tuple[VisitPhoto, bytes]]:
        """The photographs that a visit names, each checked to be the one that it names."""
        for photo in photos:
            data = self._read(photo_name(photo.sha256), PHOTO_BYTES_MAX)
            require_as_drawn(data, photo)
            # Each visit has its own, also of one that stands in the file once.
            self._photo_bytes += len(data)
            if self._photo_bytes > HISTORY_BYTES_MAX:
                raise refused("Its photographs become more than it may have.", "too_large")
            yield photo, data

    def _read(self, name: str, bytes_max: int) -> bytes:
        """One entry. Its length is what comes out, whatever the file says of it."""
        try:
            with self._archive.open(name) as entry:
                data = entry.read(bytes_max + 1)
        except DAMAGE as error:
            raise refused(f"{name} cannot be read: {error}.") from error
        if len(data) > bytes_max:
            raise refused(f"{name} is larger than {bytes_max} bytes.")
        return data


def incoming(file: Mapping[str, Any]) -> StoredVisit:
    """A visit of a history, without names. Raises InvalidRequest for one that is none, is open, or
    has what nobody could have written here."""
    try:
        visit = visit_of_file(file)
        content: Mapping[str, Any] = file["content"]
        names = VisitWords.model_fields.keys() & content.keys()
        VisitWords.model_validate({name: content[name] for name in names})
    except StoreError as error:
        raise refused(error.message) from error
    except ValueError as error:
        raise refused(f"A visit has what nobody writes: {error!r:.300}.") from error
    if len(visit.content.photos) > PHOTOS_MAX:
        raise refused(f"A visit has {PHOTOS_MAX} photographs at most.")
    now = now_us()
    if visit.closed_us is None or not 0 < visit.opened_us <= visit.closed_us <= now + DAY_US:
        raise refused("A visit of a history is closed, and not in the future.")
    if len(json.dumps(file)) > VISIT_LENGTH_MAX:
        raise refused(f"A visit has at most {VISIT_LENGTH_MAX} characters.")
    return without_names(replace(visit, imported=True))


def require_each_once(visits: Sequence[StoredVisit]) -> None:
    """Raises InvalidRequest for a history that has a visit twice."""
    if len({visit.token for visit in visits}) < len(visits):
        raise refused("The file has a visit twice.")


def require_short_directory(file: IO[bytes]) -> None:
    """A ZIP of bounded size may list ten million names, a gigabyte for zipfile. Raises
    InvalidRequest for one that does, and for what does not end as a ZIP does."""
    size = file.seek(0, SEEK_END)
    file.seek(max(0, size - END_BYTES - END_64_BYTES))
    tail = file.read()
    end = tail[-END_BYTES:]
    if len(end) < END_BYTES or not end.startswith(END) or end[-2:] != bytes(2):
        raise refused("This is no ZIP file.")
    if tail.startswith(END_64) or int.from_bytes(end[12:16], "little") > DIRECTORY_BYTES_MAX:
        raise refused("The file lists more than a history has.", "too_large")


def refused(message: str, code: str = "no_history") -> InvalidRequest:
    """A history that is not taken, and why."""
    return InvalidRequest(message, code, [FieldError("file", code, message)])
