"""Converts the columns of a track to rides, and reports on the file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, tzinfo
from math import floor

from backend.core.device_metadata import DeviceMetadata, within
from backend.core.intake import Intake
from backend.formats.cells import Growing, as_written, iso_moment, step_of, unix_seconds
from backend.formats.columns import rides_of_columns
from backend.formats.outcome import COMPLETE, PARTIAL, ImportedRide, Outcome, rejected
from backend.formats.own_channels import Column, rules_of
from backend.formats.tracks.walk import TRUNCATED, Texts, UnsafeXml, Walked

ROWS_MAX = 2_000_000
TIME = "unix_s"
# Names of elements, in lower case -> our names of fields, which say the unit. Speed is in m/s and
# the rest as in FIT, by the schemas GPX 1.0, TrackPointExtension v1 and v2, and ActivityExtension.
FIELDS = {
    "lat": "position_lat",
    "lon": "position_long",
    "latitudedegrees": "position_lat",
    "longitudedegrees": "position_long",
    "ele": "altitude",
    "altitudemeters": "altitude",
    "hr": "heart_rate",
    "heartrate": "heart_rate",
    "heartratebpm": "heart_rate",
    "cad": "cadence",
    "atemp": "temperature",
    "temp": "temperature",
    "watts": "power",
    "powerinwatts": "power",
    "distancemeters": "distance",
}
UNITS = {"runcadence": "rpm", "course": "deg", "bearing": "deg", "wtemp": "degC", "depth": "m"}


class Clock:
    """Moments of a file as Unix time. zone: of those that name none."""

    def __init__(self, zone: tzinfo = UTC) -> None:
        self._zone = zone
        self._naive = self._zoned = False

    def unix_s(self, text: str) -> float:
        """Of ISO 8601, NaN for what is none."""
        moment = iso_moment(text)
        if moment is not None and moment.tzinfo is None:
            self._naive = True
            moment = moment.replace(tzinfo=self._zone)
        elif moment is not None:
            self._zoned = True
        return unix_seconds(moment)

    @property
    def lacks_zone(self) -> bool:
        """Whether no moment named a zone: a single one that does not was damaged."""
        return self._naive and not self._zoned

    @property
    def taken_as(self) -> dict[str, str]:
        """What the file does not say of its times, for the intake."""
        return {"time_zone": str(self._zone)} if self._naive else {}


@dataclass
class Track:
    """One ride's points as they come."""

    clock: Clock
    sport: str | None = None
    points: Growing = field(default_factory=Growing)
    metadata: DeviceMetadata = field(default_factory=DeviceMetadata)

    def add(self, texts: Texts) -> float:
        """A point; its Unix time, NaN for none."""
        cells, time_s = {}, float("nan")
        for field_name, text in texts.items():
            name = field_name.lower()
            if name == "time":
                time_s = self.clock.unix_s(text)
                cells[TIME] = repr(time_s)
            else:
                cells.setdefault(FIELDS.get(name, channel_name(name)), text)
        self.points.add(cells)
        return time_s


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
    named = {
        name: Column(values, UNITS.get(name, ""), step_of(values))
        for name, values in columns.items()
    }
    fields = tuple(as_written(rule, columns) for rule in rules_of(named, track.sport))
    rides = rides_of_columns(times, columns, fields, track.sport, track.points.unread)
    return [
        replace(
            ride,
            metadata=within(track.metadata, *ride.span_s),
            intake=replace(ride.intake or Intake(), taken_as=track.clock.taken_as),
        )
        for ride in rides
    ]


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
