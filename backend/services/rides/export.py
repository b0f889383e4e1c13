"""A ride as a file: verified before its first byte, in physical units, or as it was uploaded."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import BinaryIO

from backend.core.ride import Ride
from backend.errors import InvalidRequest, NotFound
from backend.formats.export import fit, gpx
from backend.formats.export.csv import csv_chunks
from backend.formats.export.names import told_names
from backend.formats.export.seconds import BySecond, by_second
from backend.store import RideReader, Store
from backend.store.facts import facts_of
from backend.store.parquet import ROW_GROUP_ROWS, physical_chunks

PIECE_BYTES = 1 << 16
CSV_ROWS = 4096


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
    rows = verified(store, ride).chunks(list(told_names(ride)), CSV_ROWS)
    return Export(f"{stem(ride)}.csv", "text/csv; charset=utf-8", csv_chunks(ride, rows))


def as_parquet(store: Store, ride: Ride) -> Export:
    """Every recorded row and channel as doubles in their units."""
    names = told_names(ride)
    rows = verified(store, ride).chunks(list(names), ROW_GROUP_ROWS)
    media_type = "application/vnd.apache.parquet"
    chunks = physical_chunks(ride.started_us, names, facts_of(ride), rows)
    return Export(f"{stem(ride)}.parquet", media_type, chunks)


def as_fit(store: Store, ride: Ride) -> Export:
    """A record a second, for other sites. Raises InvalidRequest for a ride without a sample."""
    ridden = second_by_second(store, ride, fit.CHANNELS)
    if not len(ridden):
        raise InvalidRequest(
            f"Ride {ride.id} has no sample yet that a FIT file could hold.", code="no_rows"
        )
    return whole(f"{stem(ride)}.fit", "application/vnd.ant.fit", fit.fit_file(ride, ridden))


def as_gpx(store: Store, ride: Ride) -> Export:
    """The track. Raises InvalidRequest for a ride without a position."""
    ridden = second_by_second(store, ride, gpx.CHANNELS)
    if not gpx.has_track(ridden):
        raise InvalidRequest(
            f"Ride {ride.id} has no position, and a GPX file is a track.", code="no_positions"
        )
    return whole(f"{stem(ride)}.gpx", "application/gpx+xml", gpx.gpx_file(ride, ridden))


def as_original(store: Store, ride: Ride) -> Export:
    """The file that was uploaded, byte by byte. Raises NotFound for a ride that came from none."""
    if ride.upload_id is None:
        raise NotFound(f"Ride {ride.id} was recorded here: there is no original file.")
    upload = store.uploads.get(ride.upload_id)
    if upload.object_key is None:
        raise NotFound(f"The original file of ride {ride.id} is not here.")
    file = store.soundness.open_original(ride, upload.name, upload.object_key, upload.length)
    media_type = "application/octet-stream"
    return Export(safe_name(upload.name), media_type, file_chunks(file), upload.length)


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


def whole(file_name: str, media_type: str, data: bytes) -> Export:
    """A file that is made at once."""
    return Export(file_name, media_type, iter([data]), len(data))


def stem(ride: Ride) -> str:
    """The name of a ride's files without their ending."""
    return f"spindle-ride-{ride.id}"


def safe_name(name: str) -> str:
    """A file name without anything a header or a file system could take for more than a name."""
    last = name.replace("\\", "/").rsplit("/", 1)[-1]
    kept = "".join(c if c.isascii() and (c.isalnum() or c in "._- ") else "_" for c in last)
    return kept.strip(". ")[:120] or "ride"


def file_chunks(file: BinaryIO) -> Iterator[bytes]:
    """An open file in pieces; it is closed behind them."""
    with file:
        while piece := file.read(PIECE_BYTES):
            yield piece
