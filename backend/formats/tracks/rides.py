"""Converts the columns of a track to rides, and reports on the file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, tzinfo
from math import floor, isfinite

import numpy as np

from backend.core.channels import Values
from backend.core.device_metadata import PAUSES_MAX, DeviceMetadata, Pause, within
from backend.core.intake import Intake
from backend.formats.cells import Growing, as_written, iso_moment, step_of, unix_seconds
from backend.formats.columns import rides_of_columns
from backend.formats.local_times import in_zone
from backend.formats.outcome import COMPLETE, PARTIAL, ImportedRide, Outcome, rejected
from backend.formats.own_channels import Column, rules_of
from backend.formats.tracks.walk import TRUNCATED, Texts, UnsafeXml, Walked

ROWS_MAX = 2_000_000
TIME = "unix_s"
# Elements, in lower case, by name or `namespace:name` -> our names of fields, which state the unit.
# Speed is in m/s and the rest as in FIT, by the schemas GPX 1.0, TrackPointExtension v1 and v2,
# ActivityExtension, and gpxdata of Cluetrust. OpenTracks writes the metres since the point before.
FIELDS = {
    "lat": "position_lat",
    "lon": "position_long",
    "latitudedegrees": "position_lat",
    "longitudedegrees": "position_long",
    "ele": "altitude",
    "altitudemeters": "altitude",
    "hr": "heart_rate",
    "bpm": "heart_rate",
    "heartrate": "heart_rate",
    "heartratebpm": "heart_rate",
    "cad": "cadence",
    "rpm": "cadence",
    "atemp": "temperature",
    "temp": "temperature",
    "watts": "power",
    "powerinwatts": "power",
    "distancemeters": "distance",
    "opentracks:distance": "opentracks_distance",
}
STEPS = "opentracks_distance"
# A sum falls between so few rows: where it begins anew, or by the noise of positions.
FALLS_SHARE = 0.05
UNITS = {"runcadence": "rpm", "course": "deg", "bearing": "deg", "wtemp": "degC", "depth": "m"}


class Clock:
    """Moments of a file as Unix time; those that name no zone as though they were in UTC."""

    def __init__(self) -> None:
        self._naive = self._zoned = False

    def unix_s(self, text: str) -> float:
        """Of ISO 8601, NaN for what is none."""
        moment = iso_moment(text)
        if moment is not None and moment.tzinfo is None:
            self._naive = True
            moment = moment.replace(tzinfo=UTC)
        elif moment is not None:
            self._zoned = True
        return unix_seconds(moment)

    @property
    def lacks_zone(self) -> bool:
        """Whether no moment named a zone: a single one that does not was damaged."""
        return self._naive and not self._zoned

    @property
    def names_none(self) -> bool:
        """Whether a moment named no zone."""
        return self._naive


@dataclass
class Track:
    """One ride's points as they come. zone: of times that were read as UTC and name none.

    pauses: rows before and behind each interruption.
    """

    clock: Clock
    sport: str | None = None
    zone: tzinfo | None = None
    points: Growing = field(default_factory=Growing)
    names: dict[str, str] = field(default_factory=dict)
    metadata: DeviceMetadata = field(default_factory=DeviceMetadata)
    pauses: list[tuple[int, int]] = field(default_factory=list)
    _last_row: int | None = None
    _interrupted: bool = False

    def interrupt(self, by_pause: bool = True) -> None:
        """The next point is behind a pause, or it is not in spite of what was told before."""
        self._interrupted = by_pause

    def add(self, texts: Texts) -> float:
        """A point; its Unix time, NaN for none."""
        cells, time_s = {}, float("nan")
        for field_name, text in texts.items():
            if field_name.lower() == "time":
                time_s = self.clock.unix_s(text)
                cells[TIME] = repr(time_s)
            else:
                cells.setdefault(self._column(field_name), text)
        row = self.points.rows
        self.points.add(cells)
        if isfinite(time_s):
            if self._interrupted and self._last_row is not None and len(self.pauses) < PAUSES_MAX:
                self.pauses.append((self._last_row, row))
            self._interrupted, self._last_row = False, row
        return time_s

    def in_its_zone(self, seconds: Values) -> Values:
        """Times (n,) of rows, read as UTC, as Unix time."""
        return seconds if self.zone is None else in_zone(seconds, self.zone)

    def _column(self, field_name: str) -> str:
        """The column of an element: those of two namespaces are two, whatever they are called."""
        column = self.names.get(field_name)
        if column is None:
            namespace, _, name = field_name.lower().rpartition(":")
            column = FIELDS.get(field_name.lower()) or FIELDS.get(name) or channel_name(name)
            if column in self.names.values():
                column = channel_name(f"{namespace}_{name}")
            self.names[field_name] = column
        return column


def channel_name(field_name: str) -> str:
    """A name as our channels have them."""
    name = "".join(c if c.isascii() and c.isalnum() else "_" for c in field_name.lower()).strip("_")
    return name[:40] if name[:1].isalpha() else f"field_{name}"[:40]


def rides_of(track: Track) -> list[ImportedRide]:
    """The rides of a track: one, unless it breaks off for hours."""
    columns = track.points.values()
    times = columns.pop(TIME, None)
    if times is None:
        return []
    times = track.in_its_zone(times)
    pauses = [Pause(*times[list(rows)].tolist()) for rows in track.pauses]
    metadata = replace(track.metadata, pauses=tuple(p for p in pauses if p.from_s < p.to_s))
    add_distance(columns)
    named = {
        name: Column(values, UNITS.get(name, ""), step_of(values))
        for name, values in columns.items()
    }
    fields = tuple(as_written(rule, columns) for rule in rules_of(named, track.sport))
    rides = rides_of_columns(times, columns, fields, track.sport, track.points.unread)
    return [
        replace(
            ride,
            metadata=within(metadata, *ride.span_s),
            intake=replace(ride.intake or Intake(), taken_as=taken_as(track)),
        )
        for ride in rides
    ]


def taken_as(track: Track) -> dict[str, str]:
    """What the file does not state of its times, for the intake."""
    return {"time_zone": str(track.zone or UTC)} if track.clock.names_none else {}


def add_distance(columns: dict[str, Values]) -> None:
    """The distance ridden so far, where a file has metres from point to point instead.

    Whether a column is a sum or such steps its values decide: a sum does not fall.
    """
    if "distance" in columns and is_sum(columns["distance"]):
        return
    for name in ("distance", STEPS):
        if name in columns:
            columns["distance"] = np.nancumsum(columns[name])
            return


def is_sum(values: Values) -> bool:
    """Whether numbers (n,) add up something: they hardly ever fall, as steps do all the time."""
    steps = np.diff(values[np.isfinite(values)])
    return not len(steps) or bool(np.mean(steps < 0) <= FALLS_SHARE)


def outcome_of(tracks: Sequence[Track], walked: Walked, length: int, what: str) -> Outcome:
    """Rides, reason and completeness. what: how people call the file, without a time it is none."""
    rows = sum(track.points.rows for track in tracks)
    if rows > ROWS_MAX:
        return rejected("too_many_rows", f"{rows} points; at most {ROWS_MAX} are read.")
    rides = tuple(ride for track in tracks for ride in rides_of(track))
    where = "" if walked.offset is None else f" at byte {walked.offset} of {length}"
    reason = "The file ends in the middle" if walked.error == TRUNCATED else "No XML"
    if not rides:
        if rows:
            sentence = f"None of the {rows} points has a believable time and a value: {what}."
            return rejected("no_valid_time", sentence, walked.offset)
        sentence = f"{reason}{where}, and no" if walked.error else "There is no"
        return rejected("no_records", f"{sentence} point of a track was found.", walked.offset)
    if walked.error is None:
        return Outcome(COMPLETE, rides, completeness=1.0)
    share = walked.points / max(walked.points_begun, walked.points, 1)
    about = f"{floor(1000.0 * share) / 10.0} % of the points"
    detail = f"{reason}{where}. {walked.points} points were saved, {about}."
    return Outcome(PARTIAL, rides, walked.error, detail, walked.offset, share)


def refused() -> Outcome:
    """A file that was written to harm."""
    return rejected(
        "unsafe_content",
        "The file declares XML entities, which no track has: it was not read.",
        0,
    )


__all__ = ["Clock", "Track", "UnsafeXml", "outcome_of", "refused", "rides_of"]
