"""ZIP files, opened in the child process: every file within, one after the other, or why not.

Nothing is ever written under a name from the archive, so `../../x`, absolute names and links are
names like any other. Sizes are counted as bytes come out; what the archive says of itself is not
believed. A ZIP within the ZIP is opened, one within that is not. Of a ZIP that was cut every file
is taken that is whole.
"""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import nullcontext, suppress
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import IO

from backend.formats.containers.bulk import Titles, is_summary, left_alone, strava, summaries
from backend.formats.containers.salvage import IN_UTF8, Salvaged
from backend.formats.formats import SNIFFED_BYTES, is_archive, refused_by_head
from backend.formats.outcome import Outcome, rejected

# Bounds: of one file, of all of them, of how often it may be smaller packed, and of their number.
# A Garmin export's inner archives hold years of rides and are files of the outer one.
ENTRY_BYTES_MAX = 128 * 1024 * 1024
INNER_BYTES_MAX = 256 * 1024 * 1024
TOTAL_BYTES_MAX = 4 * 1024 * 1024 * 1024
RATIO_MAX = 200
RATIO_FROM_BYTES = 1024 * 1024
ENTRIES_MAX = 20_000
PIECE_BYTES = 1 << 20
ENCRYPTED_FLAG = 0x1
RESOURCE_FOLDER = "__MACOSX"
VIEW_FILES = {".ds_store", "thumbs.db", "desktop.ini"}
CUT = "The archive was cut: its list of files is gone. What is whole was taken; send it again."
# What zipfile and its decompressors raise on damage or on a method they do not know.
DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    EOFError,
    OSError,
    NotImplementedError,
    RuntimeError,
    ValueError,
    LookupError,
)


@dataclass(frozen=True)
class Entry:
    """A file within a container. data: None where it is refused; then code and detail say why.

    name: unlike any other of the container.
    """

    name: str
    size: int
    data: bytes | None = None
    code: str | None = None
    detail: str | None = None


@dataclass(frozen=True)
class Left:
    """What else is known at the end: what people called their rides, files of no interest, and why
    there are not more files."""

    titles: Titles
    left_alone: int
    error: Outcome | None = None


class Bounds:
    """What has come out of an archive so far."""

    def __init__(self) -> None:
        self.total = 0
        self.count = 0

    def read(self, archive: zipfile.ZipFile, info: zipfile.ZipInfo, size_max: int) -> bytes:
        """The bytes of a file within. Raises Refused, and DAMAGE as the library does."""
        if info.flag_bits & ENCRYPTED_FLAG:
            raise Refused("encrypted", "It is locked with a password: unpack it and send the file.")
        # Grows in its place and gives its bytes away: a file within is never held twice.
        content = io.BytesIO()
        with archive.open(info) as file:
            while piece := file.read(PIECE_BYTES):
                content.write(piece)
                self.total += len(piece)
                packed = max(info.compress_size, 1)
                if content.tell() > max(RATIO_FROM_BYTES, RATIO_MAX * packed):
                    raise Refused(
                        "expands_too_much",
                        f"It becomes more than {RATIO_MAX} times as large as it is packed.",
                    )
                if content.tell() > size_max:
                    raise Refused("too_large", f"It has more than {size_max} bytes.")
                if self.total > TOTAL_BYTES_MAX:
                    raise Refused("too_large", "The archive holds more than can be read at once.")
        return content.getvalue()


class Refused(Exception):
    """A file that is not read. code, detail: as of an outcome."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(detail)
        self.code = code
        self.detail = detail


class BrokenArchive(Exception):
    """An archive of which nothing can be read. outcome: why."""

    def __init__(self, outcome: Outcome) -> None:
        super().__init__(outcome.detail)
        self.outcome = outcome


def entries(source: Path | IO[bytes]) -> Iterator[Entry | Left]:
    """Every file of an archive in its own order, then what is left. Raises BrokenArchive."""
    bounds = Bounds()
    with source.open("rb") if isinstance(source, Path) else nullcontext(source) as file:
        try:
            archive = opened_archive(file)
        except DAMAGE as error:
            sentence = f"The archive cannot be opened: {error}. Send it again."
            raise BrokenArchive(rejected("container_damaged", sentence)) from None
        infos = files_within(archive)
        if len(infos) > ENTRIES_MAX:
            raise BrokenArchive(
                rejected("too_large", f"The archive has {len(infos)} files; {ENTRIES_MAX} at most.")
            )
        titles = titles_of(archive, infos, bounds)
        alone = left_alone([info.filename for info in infos])
        names_read: set[str] = set()
        for info in infos:
            if info.filename not in alone:
                yield from opened(archive, info, bounds, names_read)
        error_at_end = rejected("truncated", CUT) if isinstance(archive, Salvaged) else None
        yield Left(titles, len(alone), error_at_end)


def opened_archive(file: IO[bytes]) -> zipfile.ZipFile:
    """An archive; `Salvaged` where its list of files is gone. Raises DAMAGE."""
    try:
        archive = zipfile.ZipFile(file)
    except DAMAGE:
        return Salvaged(file)
    if min((info.header_offset for info in archive.infolist()), default=0):
        # What was found is the list of an archive within: that of this one is gone.
        return Salvaged(file)
    return archive


def titles_of(archive: zipfile.ZipFile, infos: list[zipfile.ZipInfo], bounds: Bounds) -> Titles:
    """What an export's own tables call its rides, as far as there are any that can be read."""
    by_name: dict[str, tuple[str, str]] = {}
    by_start: list[tuple[int, str, str]] = []
    for info in infos:
        name = info.filename
        is_table = PurePosixPath(name).name == "activities.csv"
        if not (is_table or is_summary(name)):
            continue
        try:
            data = bounds.read(archive, info, ENTRY_BYTES_MAX)
        except (Refused, *DAMAGE):
            continue
        if is_table:
            by_name |= strava(data, name)
        else:
            by_start += summaries(data)
    return Titles(by_name, tuple(by_start))


def files_within(archive: zipfile.ZipFile) -> list[zipfile.ZipInfo]:
    """Its files under their right names, but for folders and what systems put beside files."""
    for info in archive.infolist():
        info.filename = right_name(info)
    return [
        info
        for info in archive.infolist()
        if not info.filename.endswith("/") and not is_side_file(info.filename)
    ]


def right_name(info: zipfile.ZipInfo) -> str:
    """Some programs write names in UTF-8 and do not say so, some with the separators of Windows."""
    name = info.filename
    if not info.flag_bits & IN_UTF8:
        with suppress(UnicodeError):
            name = name.encode("cp437").decode()
    return name if "/" in name else name.replace("\\", "/")


def is_side_file(name: str) -> bool:
    """Whether a system, not a person, put a file there: attributes and views of folders."""
    *folders, last = name.split("/")
    return RESOURCE_FOLDER in folders or last.startswith("._") or last.lower() in VIEW_FILES


def opened(
    archive: zipfile.ZipFile,
    info: zipfile.ZipInfo,
    bounds: Bounds,
    names_read: set[str],
    within: str = "",
) -> Iterator[Entry]:
    """A file of an archive, or those of the archive that it is. within: name of that archive."""
    name = unlike(f"{within}{info.filename or 'unnamed'}"[-200:], names_read)
    bounds.count += 1
    if bounds.count > ENTRIES_MAX:
        yield Entry(name, info.file_size, None, "too_large", f"More than {ENTRIES_MAX} files.")
        return
    is_inner = info.filename.lower().endswith(".zip")
    try:
        data = bounds.read(archive, info, INNER_BYTES_MAX if is_inner else ENTRY_BYTES_MAX)
    except Refused as refused:
        yield Entry(name, info.file_size, None, refused.code, refused.detail)
    except DAMAGE as error:
        detail = f"It is damaged within the archive: {error}."
        yield Entry(name, info.file_size, None, "container_damaged", detail)
    else:
        if is_archive(data):
            yield from nested(data, name, bounds, names_read, deep=bool(within))
        else:
            yield judged(name, data)


def nested(
    data: bytes, name: str, bounds: Bounds, names_read: set[str], deep: bool
) -> Iterator[Entry]:
    """The files of an archive within an archive."""
    if deep:
        sentence = "An archive within an archive within an archive is not opened: unpack it first."
        yield Entry(name, len(data), None, "nested_too_deep", sentence)
        return
    try:
        inner = opened_archive(io.BytesIO(data))
    except DAMAGE as error:
        sentence = f"The archive within cannot be opened: {error}."
        yield Entry(name, len(data), None, "container_damaged", sentence)
        return
    with inner:
        for info in files_within(inner):
            yield from opened(inner, info, bounds, names_read, within=f"{name}/")
        if isinstance(inner, Salvaged):
            yield Entry(name, len(data), None, "truncated", CUT)


def judged(name: str, data: bytes) -> Entry:
    """A file within, refused here where its first bytes say that it is no ride."""
    if not data:
        return Entry(name, 0, None, "empty_file", "The file is empty.")
    refused = refused_by_head(name, data[:SNIFFED_BYTES])
    if refused is None:
        return Entry(name, len(data), data)
    return Entry(name, len(data), None, refused.code, refused.detail)


def unlike(name: str, names_read: set[str]) -> str:
    """The name, with a number where another file of the container has it too."""
    free, number = name, 1
    while free in names_read:
        number += 1
        free = f"{name} ({number})"
    names_read.add(free)
    return free
