"""A ride as a file for strangers: FIT, GPX or CSV of `views.export.blurred`."""

from __future__ import annotations

import numpy as np

from backend.core.ride import Ride, RideRows
from backend.errors import FieldError, InvalidRequest
from backend.formats.export import fit, gpx
from backend.formats.export.blurred import ShownRide, shown_ride, shown_rows
from backend.formats.export.csv import csv_chunks
from backend.formats.export.seconds import by_second
from backend.services.rides.export import CSV_ROWS, Export, stem, verified, whole
from backend.store import Store

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
        pieces = (part(shown.rows, at) for at in range(0, shown.ride.row_count, CSV_ROWS))
        return Export(name, "text/csv; charset=utf-8", csv_chunks(shown.ride, pieces))
    ridden = by_second(shown.ride.started_us, shown.rows.times_us, shown.values)
    if file_format == "gpx":
        return whole(name, "application/gpx+xml", gpx.gpx_file(shown.ride, ridden))
    return whole(name, "application/vnd.ant.fit", fit.fit_file(shown.ride, ridden))


def what_is_shown(store: Store, ride: Ride, blur_m: float) -> ShownRide:
    """The rows that may be told, of the channels that a stranger's format knows."""
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
