"""GPX 1.0 and 1.1: each track a ride, with the extensions of head units and services.

A track without times is a route somebody drew, not a ride. Times are UTC by the schema, also where
they name no zone; the intake says so then. Between two segments of a track the
receiver was off, or had no reception: a pause.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from backend.core.device_metadata import INSTRUMENTS_MAX, Instrument
from backend.formats.outcome import Outcome
from backend.formats.tracks.rides import Clock, Track, outcome_of, refused
from backend.formats.tracks.walk import Listener, Shape, Texts, UnsafeXml, as_utf8, walk

SHAPE = Shape("trkpt", ("gpx", "trk", "trkseg"))
# What services and devices call the kinds of a track; Strava wrote numbers once.
SPORTS = {
    "1": "cycling",
    "9": "running",
    "biking": "cycling",
    "ride": "cycling",
    "road_biking": "cycling",
    "run": "running",
    "e_bike_ride": "e_biking",
    "ebikeride": "e_biking",
}
SPORT_LENGTH_MAX = 32


def read_gpx(data: bytes) -> Outcome:
    """A GPX file -> what came of it. Never raises on any bytes."""
    reader = GpxReader()
    listener = Listener(reader.opened, reader.closed, reader.text_read, reader.point)
    try:
        walked = walk(as_utf8(data), SHAPE, listener)
    except UnsafeXml:
        return refused()
    for track in reader.tracks:
        track.metadata = replace(track.metadata, instruments=reader.instruments)
    tracks = [track for track in reader.tracks if track.points.rows]
    return outcome_of(tracks, walked, len(data), "a route, not the record of a ride")


class GpxReader:
    """Builds tracks of what the walk meets."""

    def __init__(self) -> None:
        self.tracks: list[Track] = []
        self._clock = Clock()
        self.instruments: tuple[Instrument, ...] = ()

    def opened(self, name: str, attributes: Mapping[str, str]) -> None:
        """A file, a track or a segment begins."""
        if name == "gpx" and attributes.get("creator") and len(self.instruments) < INSTRUMENTS_MAX:
            recorder = Instrument("recorder", product=attributes["creator"][:100])
            self.instruments = (*self.instruments, recorder)
        elif name == "trk":
            self.tracks.append(Track(self._clock))
        elif name == "trkseg" and self.tracks:
            self.tracks[-1].interrupt()

    def closed(self, name: str) -> None:
        """Nothing is known only then."""

    def text_read(self, parent: str, name: str, text: str) -> None:
        """What kind of ride a track is."""
        if name == "type" and parent == "trk" and self.tracks:
            word = text.lower().replace(" ", "_").replace("-", "_")[:SPORT_LENGTH_MAX]
            self.tracks[-1].sport = SPORTS.get(word, word)

    def point(self, texts: Texts) -> None:
        """A point of the latest track."""
        if not self.tracks:
            self.tracks.append(Track(self._clock))
        self.tracks[-1].add(texts)
