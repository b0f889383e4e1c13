"""Looking at rides: lists, figures, traces, notes, exports and replays."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any, BinaryIO

import numpy as np

from backend.domain.channels import ChannelSpec, Values
from backend.domain.energy import DEMANDED, MOTOR_TORQUE, MOTOR_TORQUE_DEMANDED
from backend.domain.ride import Ride, iso_utc
from backend.errors import InvalidRequest, NotFound
from backend.store import RideReader, Store, expected_of
from backend.views.figure import figure
from backend.views.trace import Trace, trace

PIECE_BYTES = 1 << 16
CSV_ROWS = 4096
FORMATS = ("csv", "parquet", "original")

# (the ride, what is changed) -> the API's answer
Replay = Callable[..., Any]


@dataclass(frozen=True)
class Export:
    """A ride as a file, verified; `chunks` is read once. size_bytes: where it is known before."""

    file_name: str
    media_type: str
    chunks: Iterator[bytes]
    size_bytes: int | None = None


class Rides:
    """The rides' use cases; safe to call from any thread.

    unit_at: the key of the unit that a device has now; None for one that is not there.
    """

    def __init__(
        self,
        store: Store,
        replay: Replay | None = None,
        unit_at: Callable[[str], str | None] = lambda device_id: None,
    ) -> None:
        self._store = store
        self._replay = replay
        self._unit_at = unit_at

    def list(
        self,
        begin: datetime | None = None,
        end: datetime | None = None,
        device: str | None = None,
        limit: int = 50,
        cursor: str | None = None,
    ) -> dict[str, object]:
        """One page, newest first: {items, next}.

        device: a unit's key or serial number, or the id of a device that is connected now.
        """
        unit = None if device is None else self._unit_at(device) or device
        page = self._store.rides.list(microseconds(begin), microseconds(end), unit, limit, cursor)
        return {"items": [self._told(ride) for ride in page.items], "next": page.next}

    def get(self, ride_id: int) -> dict[str, object]:
        """One ride. Raises NotFound."""
        return self._told(self._store.rides.get(ride_id))

    def patch(
        self, ride_id: int, name: str | None = None, notes: str | None = None
    ) -> dict[str, object]:
        """Change what people wrote about a ride. Raises NotFound, InvalidRequest."""
        return self._told(self._store.rides.patch(ride_id, name, notes))

    def delete(self, ride_id: int) -> None:
        """Delete a ride; with the last ride of an original file this goes too, on the disk as well.

        Raises NotFound, Conflict while the ride is being recorded.
        """
        with self._store.deciding:
            self._store.rides.delete(ride_id)

    def series(
        self,
        ride_id: int,
        channels: Sequence[str] | None = None,
        from_s: float | None = None,
        to_s: float | None = None,
        pixels: int = 1000,
    ) -> Trace:
        """Exact minimum and maximum for each pixel of a window; see `backend.views.trace`."""
        return trace(self._store.rides.reader(ride_id), channels, from_s, to_s, pixels)

    def figure(
        self, ride_id: int, channels: Sequence[str] | None = None, pixels: int = 1000
    ) -> dict[str, object]:
        """The ride as a Plotly figure; see `backend.views.figure`."""
        return figure(self._store.rides.reader(ride_id), channels, pixels)

    def export(self, ride_id: int, file_format: str) -> Export:
        """The ride as a file. Raises NotFound, InvalidRequest for what cannot be made of it."""
        ride = self._store.rides.get(ride_id)
        stem = f"spindle-ride-{ride.id}"
        if file_format == "csv":
            reader = self._store.rides.reader(ride_id)
            if ride.object_key is not None:
                self._store.soundness.open_ride(ride).close()
            rows = csv_chunks(reader, ride)
            return Export(f"{stem}.csv", "text/csv; charset=utf-8", rows)
        if file_format == "parquet":
            if ride.object_key is None:
                raise InvalidRequest(f"Ride {ride_id} is being recorded: export it when it ended.")
            file = self._store.soundness.open_ride(ride)
            return Export(
                f"{stem}.parquet",
                "application/vnd.apache.parquet",
                file_chunks(file),
                ride.object_bytes,
            )
        if file_format == "original":
            return self._original(ride)
        raise InvalidRequest(
            f"A ride cannot be exported as {file_format}; it can as {', '.join(FORMATS)}.",
            code="unsupported_format",
        )

    def replay(self, ride_id: int, **changes: Mapping[str, Any] | None) -> Any:
        """What the motor would have done with other settings, as of `changed_config`."""
        if self._replay is None:
            raise InvalidRequest("This server cannot replay rides.", code="unsupported")
        return self._replay(self._store.rides.reader(ride_id), **changes)

    def _original(self, ride: Ride) -> Export:
        if ride.upload_id is None:
            raise NotFound(f"Ride {ride.id} was recorded here: there is no original file.")
        upload = self._store.uploads.get(ride.upload_id)
        if upload.object_key is None:
            raise NotFound(f"The original file of ride {ride.id} is not here.")
        file = self._store.soundness.open_original(
            ride, upload.name, upload.object_key, upload.length
        )
        media_type = "application/octet-stream"
        return Export(safe_name(upload.name), media_type, file_chunks(file), upload.length)

    def _told(self, ride: Ride) -> dict[str, object]:
        """A ride as the API tells it, with what is known to be wrong with its samples."""
        damage = None
        if ride.object_key is not None:
            damage = self._store.soundness.known_damage(expected_of(ride))
        return {**ride.as_json(), "damage": damage}


def microseconds(moment: datetime | None) -> int | None:
    """A time as microseconds since 1970; without a zone it is taken as UTC."""
    if moment is None:
        return None
    aware = moment if moment.tzinfo else moment.replace(tzinfo=UTC)
    return int(aware.timestamp() * 1e6)


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


def csv_chunks(reader: RideReader, ride: Ride) -> Iterator[bytes]:
    """The ride as CSV: ISO time, seconds, then every recorded channel; missing is empty.

    A motor torque that was only asked for is named so.
    """
    names = [channel.name for channel in ride.channels]
    asked = {MOTOR_TORQUE: MOTOR_TORQUE_DEMANDED} if ride.motor_torque_meaning == DEMANDED else {}
    header = [asked.get(name, name) for name in names]
    yield (",".join(["time_utc", "t_s", *header]) + "\r\n").encode()
    for rows in reader.chunks(names, CSV_ROWS):
        seconds = (rows.times_us / 1e6).tolist()
        columns = [texts(c, c.to_values(rows.counts[c.name])) for c in rows.channels]
        lines = (
            ",".join(
                (
                    iso_utc(ride.started_us + int(t * 1e6)),
                    f"{t:.6f}".rstrip("0").rstrip("."),
                    *cells,
                )
            )
            for t, *cells in zip(seconds, *columns, strict=True)
        )
        yield ("\r\n".join(lines) + "\r\n").encode()


def texts(channel: ChannelSpec, values: Values) -> list[str]:
    """Values as decimal text, as many digits as the scale carries."""
    digits = max(0, int(np.ceil(-np.log10(channel.scale))))
    exact = np.isclose(channel.scale * 10**digits, round(channel.scale * 10**digits))
    places = digits if exact else digits + 3
    return ["" if np.isnan(v) else f"{v:.{places}f}" for v in values.tolist()]
