"""TCX (Training Center Database v2): each activity a ride, with its laps and its device.

Positions are optional: a ride on a roller has none. Between two tracks of a lap the timer stood.
Times that name no zone are not read before somebody says it, as a table's. Speed and power are
those of the extension ActivityExtension v2. A course is a plan, not a ride.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import isfinite

import numpy as np

from backend.core.calendar import zone_of
from backend.core.device_metadata import LAPS_MAX, DeviceMetadata, Instrument, Lap
from backend.formats.cells import number
from backend.formats.outcome import NEEDS_MAPPING, Outcome, rejected
from backend.formats.questions import TableAnswer, TableQuestion
from backend.formats.tracks.rides import TIME, Clock, Track, outcome_of, refused
from backend.formats.tracks.walk import Listener, Shape, Texts, UnsafeXml, as_utf8, walk

SHAPE = Shape("Trackpoint", ("Activity", "Course", "Lap", "Track", "Creator"))
SPORTS = {"biking": "cycling", "running": "running", "other": None}
SPORT_LENGTH_MAX = 32
TRIGGERS = {
    "Manual": "manual",
    "Distance": "distance",
    "Location": "position",
    "Time": "time",
    "HeartRate": "other",
}


@dataclass
class RecordedLap:
    """A lap as the file has it. first_row, last_row: of all points, those with a time. first_s,
    last_s: times of its points, once they are known."""

    start_s: float
    texts: dict[str, str] = field(default_factory=dict)
    first_row: int | None = None
    last_row: int | None = None
    first_s: float = float("nan")
    last_s: float = float("nan")


@dataclass
class Activity:
    """One activity as it comes."""

    track: Track
    laps: list[RecordedLap] = field(default_factory=list)
    device: dict[str, str] = field(default_factory=dict)


def read_tcx(data: bytes, answer: TableAnswer | None = None) -> Outcome:
    """A TCX file -> what came of it. Never raises on any bytes. answer: the zone, where asked."""
    zone = zone_of(answer.time_zone) if answer and answer.time_zone else None
    reader = TcxReader(clock := Clock())
    listener = Listener(reader.opened, reader.closed, reader.text_read, reader.point)
    try:
        walked = walk(as_utf8(data), SHAPE, listener)
    except UnsafeXml:
        return refused()
    activities = [one for one in reader.activities if one.track.points.rows]
    if not activities and reader.courses:
        return rejected("no_records", "The file holds a course: a plan, not the record of a ride.")
    question = question_of(activities) if clock.lacks_zone else None
    if question is not None and zone is None:
        detail = f"A {question.kind} that does not say: time_zone. Say it once, and every such "
        return replace(rejected(NEEDS_MAPPING, f"{detail}file is read."), question=question)
    for activity in activities:
        activity.track.zone = zone if question is not None else None
        place_laps(activity)
        activity.track.metadata = DeviceMetadata(
            laps=laps_of(activity), instruments=device_of(activity)
        )
    tracks = [activity.track for activity in activities]
    outcome = outcome_of(tracks, walked, len(data), "points without a time are no ride")
    return replace(outcome, question=question)


class TcxReader:
    """Builds activities of what the walk meets."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self.activities: list[Activity] = []
        self.courses = 0
        self._in_course = self._in_device = self._new_lap = False

    def opened(self, name: str, attributes: Mapping[str, str]) -> None:
        """An activity, a course, a lap or a device begins."""
        if name == "Activity":
            sport = attributes.get("Sport", "").lower()[:SPORT_LENGTH_MAX]
            self.activities.append(Activity(Track(self._clock, SPORTS.get(sport, sport or None))))
            self._in_course = False
        elif name == "Course":
            self.courses += 1
            self._in_course = True
        elif name == "Lap" and not self._in_course:
            start_s = self._clock.unix_s(attributes.get("StartTime", ""))
            laps = self._latest().laps
            if len(laps) < LAPS_MAX:
                laps.append(RecordedLap(start_s))
            self._new_lap = True
        elif name == "Track" and not self._in_course and self.activities:
            # A lap begins without a pause; within it the timer stood between two tracks.
            self.activities[-1].track.interrupt(not self._new_lap)
            self._new_lap = False
        elif name == "Creator":
            self._in_device = True

    def closed(self, name: str) -> None:
        """A course or a device ends."""
        self._in_course &= name != "Course"
        self._in_device &= name != "Creator"

    def text_read(self, parent: str, name: str, text: str) -> None:
        """Of a lap, or of the device."""
        if self._in_course or not self.activities:
            return
        activity = self.activities[-1]
        if self._in_device:
            activity.device.setdefault(name, text[:100])
        elif parent == "Lap" and activity.laps:
            activity.laps[-1].texts.setdefault(name, text[:100])

    def point(self, texts: Texts) -> None:
        """A point of the latest activity."""
        if self._in_course:
            return
        activity = self._latest()
        # What the sensor on the foot is called is no number.
        texts.pop("SensorState", None)
        row = activity.track.points.rows
        time_s = activity.track.add(texts)
        if activity.laps and isfinite(time_s):
            lap = activity.laps[-1]
            lap.first_row = row if lap.first_row is None else lap.first_row
            lap.last_row = row

    def _latest(self) -> Activity:
        if not self.activities:
            self.activities.append(Activity(Track(self._clock)))
        return self.activities[-1]


def place_laps(activity: Activity) -> None:
    """Times of laps as Unix time: each as far off as its first point, or else the one before it."""
    times = activity.track.points.values().get(TIME)
    if times is None:
        return
    in_zone = activity.track.in_its_zone(times)
    shift_s = in_zone - times
    off_s = float(next(iter(shift_s[np.isfinite(shift_s)]), 0.0))
    for lap in activity.laps:
        if lap.first_row is not None and lap.last_row is not None:
            off_s = float(shift_s[lap.first_row])
            own = in_zone[lap.first_row : lap.last_row + 1]
            lap.first_s, lap.last_s = float(np.nanmin(own)), float(np.nanmax(own))
        lap.start_s += off_s


def question_of(activities: Sequence[Activity]) -> TableQuestion:
    """What must be said before; files of one device share the answer."""
    devices = {name for one in activities if (name := one.device.get("Name"))}
    kind = f"TCX file of {min(devices)}" if devices else "TCX file"
    return TableQuestion(hashlib.sha256(kind.encode()).hexdigest(), kind, time_zone=True)


def laps_of(activity: Activity) -> tuple[Lap, ...]:
    """Each lap from its start to the next one's; the last to its last point."""
    recorded = [lap for lap in activity.laps if isfinite(lap.start_s) or isfinite(lap.first_s)]
    starts = [lap.start_s if isfinite(lap.start_s) else lap.first_s for lap in recorded]
    laps = []
    for place, lap in enumerate(recorded):
        timer_s = number_or_none(lap.texts.get("TotalTimeSeconds"))
        end_s = lap.last_s if isfinite(lap.last_s) else starts[place] + (timer_s or 0.0)
        if place + 1 < len(recorded) and starts[place + 1] >= end_s:
            end_s = starts[place + 1]
        if end_s > starts[place]:
            laps.append(
                Lap(
                    starts[place],
                    end_s,
                    TRIGGERS.get(lap.texts.get("TriggerMethod", "")),
                    timer_s,
                    number_or_none(lap.texts.get("DistanceMeters")),
                    number_or_none(lap.texts.get("Calories")),
                )
            )
    return tuple(laps)


def device_of(activity: Activity) -> tuple[Instrument, ...]:
    """The device that recorded; nothing where the file names none."""
    fields = activity.device
    if not fields:
        return ()
    version = [fields[name] for name in ("VersionMajor", "VersionMinor") if name in fields]
    return (
        Instrument(
            "recorder",
            product=fields.get("Name"),
            serial_number=fields.get("UnitId"),
            software_version=".".join(version) or None,
        ),
    )


def number_or_none(text: str | None) -> float | None:
    """A number, None for a missing one and for what is none."""
    value = number(text or "")
    return value if isfinite(value) else None
