"""Many rides as one ZIP, made while it is sent: a file a ride and format, and a list of them.

    spindle-ride-7.fit ...   what could be made of each ride
    index.csv                last: every ride with its figures and files, and what could not be made

What is cut short on the way has no directory at its end and opens nowhere. A cell that a
spreadsheet would take for a formula begins with an apostrophe (OWASP, "CSV Injection").
"""

from __future__ import annotations

import csv
import io
import time
from collections.abc import Iterator, Sequence
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile, ZipInfo

from backend.core.ride import Ride, iso_utc
from backend.errors import NotFound, SpindleError
from backend.services.rides.export import Export, export
from backend.services.rides.share import share
from backend.store import Store
from backend.store.pipe import Pipe

INDEX = "index.csv"
FIGURES = ("distance_km", "moving_s", "rider_wh", "motor_wh")
# What a spreadsheet begins a formula with, and what it passes over before it looks.
DANGEROUS = ("=", "+", "-", "@", "\t", "\r", "\n")
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
    told = ("started_at", "name", "notes", "tags", *FIGURES) if blur_m is None else ()
    rows.writerow(["ride", *told, "files", "left_out"])
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
            cells = facts(ride) if ride and told else [""] * len(told)
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
    found = ZipInfo(name, time.localtime()[:6])
    found.compress_type = packed
    return found


def facts(ride: Ride) -> list[object]:
    """The cells of a ride; nothing for what nobody knows."""
    words = (ride.name, ride.notes, ", ".join(ride.tags))
    figures = [getattr(ride.summary, name, None) for name in FIGURES]
    numbers = ["" if value is None else round(value, 3) for value in figures]
    return [iso_utc(ride.started_us), *map(guarded, words), *numbers]


def guarded(text: str) -> str:
    """Text that no spreadsheet computes."""
    return f"'{text}" if text.startswith(DANGEROUS) else text
