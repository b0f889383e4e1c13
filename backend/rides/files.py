"""Rides as files: verified before the first byte, in physical units, or as they were uploaded.

For strangers: FIT, GPX or CSV of `formats.export.blurred`. Many rides are one ZIP, made while it is
sent: a file a ride and format, and a list of them.

    spindle-ride-7.fit ...   what could be made of each ride
    index.csv                last: every ride with its figures and files, and what could not be made

What is cut short on the way has no directory at its end and opens nowhere.
"""

from __future__ import annotations

import csv
import io
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import BinaryIO
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile, ZipInfo

import numpy as np

from backend.core.ride import Ride, RideRows, iso_utc
from backend.core.spreadsheet import guarded
from backend.errors import FieldError, InvalidRequest, NotFound, SpindleError
from backend.formats.export import fit, gpx
from backend.formats.export.blurred import ShownRide, shown_ride, shown_rows
from backend.formats.export.csv import csv_chunks, export_names
from backend.formats.export.seconds import BySecond, by_second
from backend.store import RideReader, Store
from backend.store.facts import facts_of
from backend.store.parquet import ROW_GROUP_ROWS, physical_chunks
from backend.store.pipe import Pipe

PIECE_BYTES = 1 << 16
CSV_ROWS = 4096


MEDIA_TYPES = {
    "csv": "text/csv; charset=utf-8",
    "parquet": "application/vnd.apache.parquet",
    "fit": "application/vnd.ant.fit",
    "gpx": "application/gpx+xml",
    "original": "application/octet-stream",
}


@dataclass(frozen=True)
class Export:
    """A ride as a file; `chunks` is read once. size_bytes: where it is known before."""

    file_name: str
    media_type: str
    chunks: Iterator[bytes]
    size_bytes: int | None = None


def export(store: Store, ride: Ride, file_format: str) -> Export:
    """The ride in a format of FORMATS.

    Raises NotFound, ObjectDamaged; InvalidRequest for an unknown format and for a ride that has
    nothing the format could hold.
    """
    make = FORMATS.get(file_format)
    if make is None:
        raise InvalidRequest(
            f"A ride cannot be exported as {file_format}; it can as {', '.join(FORMATS)}.",
            code="unsupported_format",
        )
    return make(store, ride)


def as_csv(store: Store, ride: Ride) -> Export:
    """Every recorded row and channel as text."""
    rows = verified(store, ride).chunks(list(export_names(ride)), CSV_ROWS)
    return Export(f"{stem(ride)}.csv", MEDIA_TYPES["csv"], csv_chunks(ride, rows))


def as_parquet(store: Store, ride: Ride) -> Export:
    """Every recorded row and channel as doubles in their units."""
    names = export_names(ride)
    rows = verified(store, ride).chunks(list(names), ROW_GROUP_ROWS)
    chunks = physical_chunks(ride.started_us, names, facts_of(ride), rows)
    return Export(f"{stem(ride)}.parquet", MEDIA_TYPES["parquet"], chunks)


def as_fit(store: Store, ride: Ride) -> Export:
    """A record a second, for other sites. Raises InvalidRequest for a ride without a sample."""
    ridden = second_by_second(store, ride, fit.CHANNELS)
    if not len(ridden):
        raise InvalidRequest(
            f"Ride {ride.id} has no sample yet that a FIT file could hold.", code="no_rows"
        )
    return as_file(f"{stem(ride)}.fit", MEDIA_TYPES["fit"], fit.fit_file(ride, ridden))


def as_gpx(store: Store, ride: Ride) -> Export:
    """The track. Raises InvalidRequest for a ride without a position."""
    ridden = second_by_second(store, ride, gpx.CHANNELS)
    if not gpx.has_track(ridden):
        raise InvalidRequest(
            f"Ride {ride.id} has no position, and a GPX file is a track.", code="no_positions"
        )
    return as_file(f"{stem(ride)}.gpx", MEDIA_TYPES["gpx"], gpx.gpx_file(ride, ridden))


def as_original(store: Store, ride: Ride) -> Export:
    """The file that was uploaded, byte by byte. Raises NotFound for a ride that came from none."""
    if ride.upload_id is None:
        raise NotFound(f"Ride {ride.id} was recorded here: there is no original file.")
    upload = store.uploads.get(ride.upload_id)
    if upload.object_key is None:
        raise NotFound(f"The original file of ride {ride.id} is not here.")
    file = store.soundness.open_original(ride, upload.name, upload.object_key, upload.length)
    name = safe_name(upload.name)
    return Export(name, MEDIA_TYPES["original"], file_chunks(file), upload.length)


FORMATS: dict[str, Callable[[Store, Ride], Export]] = {
    "csv": as_csv,
    "parquet": as_parquet,
    "fit": as_fit,
    "gpx": as_gpx,
    "original": as_original,
}


def verified(store: Store, ride: Ride) -> RideReader:
    """A reader of rows whose file is as it was written. Raises ObjectDamaged."""
    reader = store.rides.reader(ride.id)
    if ride.object_key is not None:
        store.soundness.open_ride(ride).close()
    return reader


def second_by_second(store: Store, ride: Ride, channels: tuple[str, ...]) -> BySecond:
    """Those of the channels that a ride has."""
    reader = verified(store, ride)
    times_us = reader.times_us(0, reader.row_count)
    return by_second(ride.started_us, times_us, reader.values(channels))


def as_file(file_name: str, media_type: str, data: bytes) -> Export:
    """A file that is made at once."""
    return Export(file_name, media_type, iter([data]), len(data))


def stem(ride: Ride) -> str:
    """The name of a ride's files without their ending."""
    return f"spindle-ride-{ride.id}"


def safe_name(name: str) -> str:
    """A file name without anything a header or a file system could take for more than a name."""
    last = name.replace("\\", "/").rsplit("/", 1)[-1]
    safe = "".join(c if c.isascii() and (c.isalnum() or c in "._- ") else "_" for c in last)
    return safe.strip(". ")[:120] or "ride"


def file_chunks(file: BinaryIO) -> Iterator[bytes]:
    """An open file in pieces; it is closed behind them."""
    with file:
        while piece := file.read(PIECE_BYTES):
            yield piece


KNOWN = frozenset(fit.CHANNELS)
SHARED = ("fit", "gpx", "csv")


def share(store: Store, ride: Ride, file_format: str, blur_m: float) -> Export:
    """The ride without what is near its start and end.

    Raises NotFound, ObjectDamaged; InvalidRequest for another format, for a ride without a position
    (`no_positions`) and for one of which nothing is left (`nothing_to_share`).
    """
    if file_format not in SHARED:
        message = f"Start and end can be blurred in {', '.join(SHARED)}, not in {file_format}."
        error = FieldError("format", "unsupported_format", message)
        raise InvalidRequest(message, code="unsupported_format", fields=[error])
    shown = what_is_shown(store, ride, blur_m)
    name = f"{stem(ride)}-shared.{file_format}"
    if file_format == "csv":
        chunks = (part(shown.rows, at) for at in range(0, shown.ride.row_count, CSV_ROWS))
        return Export(name, "text/csv; charset=utf-8", csv_chunks(shown.ride, chunks))
    ridden = by_second(shown.ride.started_us, shown.rows.times_us, shown.values)
    if file_format == "gpx":
        return as_file(name, "application/gpx+xml", gpx.gpx_file(shown.ride, ridden))
    return as_file(name, "application/vnd.ant.fit", fit.fit_file(shown.ride, ridden))


def what_is_shown(store: Store, ride: Ride, blur_m: float) -> ShownRide:
    """The rows that may be shown, of the channels that a stranger's format knows."""
    reader = verified(store, ride)
    channels = tuple(channel for channel in ride.offered if channel.name in KNOWN)
    count = reader.row_count
    counts = reader.counts([channel.name for channel in channels], 0, count)
    rows = RideRows(channels, reader.times_us(0, count), counts)
    secret = (store.objects.identity() or "").encode()
    shown = shown_rows(rows, blur_m, secret)
    if shown is None:
        raise InvalidRequest(
            f"Ride {ride.id} has no position: there is nothing to blur.", code="no_positions"
        )
    if not shown.any():
        raise InvalidRequest(
            f"Ride {ride.id} never left the {blur_m:.0f} m around its start and end: nothing of it "
            "can be shared.",
            code="nothing_to_share",
        )
    return shown_ride(ride, rows, np.asarray(reader.row_seconds()), shown)


def part(rows: RideRows, start: int) -> RideRows:
    """Some rows from `start` on."""
    stop = start + CSV_ROWS
    counts = {name: column[start:stop] for name, column in rows.counts.items()}
    return RideRows(rows.channels, rows.times_us[start:stop], counts)


INDEX = "index.csv"
FIGURES = ("distance_km", "moving_s", "rider_wh", "motor_wh")
# These are packed already.
PACKED = ("parquet", "original")


def archive(
    store: Store, ride_ids: Sequence[int], formats: Sequence[str], blur_m: float | None
) -> Iterator[bytes]:
    """The ZIP, piece by piece. A ride that goes meanwhile is listed as gone.

    blur_m: start and end of every ride are blurred, and the list tells numbers and files only.
    """
    pipe = Pipe()
    listed = io.StringIO(newline="")
    rows = csv.writer(listed)
    fields = ("started_at", "name", "notes", "tags", *FIGURES) if blur_m is None else ()
    rows.writerow(["ride", *fields, "files", "left_out"])
    with ZipFile(pipe, "w") as zipped:
        for ride_id in ride_ids:
            files: list[str] = []
            left_out: list[str] = []
            ride = None
            try:
                ride = store.rides.get(ride_id)
            except NotFound as error:
                left_out.append(error.message)
            for file_format in formats if ride else ():
                made = made_of(store, ride, file_format, blur_m) if ride else ""
                if isinstance(made, str):
                    left_out.append(made)
                    continue
                packed = ZIP_STORED if file_format in PACKED else ZIP_DEFLATED
                name = made.file_name
                if file_format == "original":
                    name = f"spindle-ride-{ride_id}-{name}"
                yield from added(zipped, pipe, name, made, packed)
                files.append(name)
            cells = facts(ride) if ride and fields else [""] * len(fields)
            rows.writerow([ride_id, *cells, "; ".join(files), guarded(" ".join(left_out))])
        zipped.writestr(member(INDEX, ZIP_DEFLATED), listed.getvalue())
    yield pipe.taken()


def made_of(store: Store, ride: Ride, file_format: str, blur_m: float | None) -> Export | str:
    """The ride as a file, or why there is none."""
    try:
        if blur_m is not None:
            return share(store, ride, file_format, blur_m)
        return export(store, ride, file_format)
    except SpindleError as error:
        return error.message


def added(zipped: ZipFile, pipe: Pipe, name: str, made: Export, packed: int) -> Iterator[bytes]:
    """Adds one file."""
    with zipped.open(member(name, packed), "w", force_zip64=True) as target:
        for piece in made.chunks:
            target.write(piece)
            yield pipe.taken()


def member(name: str, packed: int) -> ZipInfo:
    """A file of the ZIP, made now."""
    info = ZipInfo(name, time.localtime()[:6])
    info.compress_type = packed
    return info


def facts(ride: Ride) -> list[object]:
    """The cells of a ride; empty for what is unknown."""
    words = (ride.name, ride.notes, ", ".join(ride.tags))
    figures = [getattr(ride.summary, name, None) for name in FIGURES]
    numbers = ["" if value is None else round(value, 3) for value in figures]
    return [iso_utc(ride.started_us), *map(guarded, words), *numbers]
