"""A ride's track as GPX 1.1, a point a second; a gap begins a new segment."""

from __future__ import annotations

from datetime import UTC, datetime
from xml.sax.saxutils import escape

import numpy as np

from backend.core.ride import Ride
from backend.formats.export.fit import pauses
from backend.formats.export.seconds import BySecond

CHANNELS = (
    "latitude_deg",
    "longitude_deg",
    "altitude_m",
    "heart_rate_bpm",
    "cadence_rpm",
    "temperature_degc",
)
HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="Spindle" xmlns="http://www.topografix.com/GPX/1/1"
 xmlns:gpxtpx="http://www.garmin.com/xmlschemas/TrackPointExtension/v1">
<trk><name>{name}</name><trkseg>
"""
BETWEEN = "</trkseg><trkseg>\n"
FOOT = "</trkseg></trk>\n</gpx>\n"
# Elements of a point's extension, in the order of its schema.
EXTENSION = {"temperature_degc": "atemp", "heart_rate_bpm": "hr", "cadence_rpm": "cad"}


def has_track(ridden: BySecond) -> bool:
    """Whether a ride has a position at all."""
    return bool((np.isfinite(ridden["latitude_deg"]) & np.isfinite(ridden["longitude_deg"])).any())


def gpx_file(ride: Ride, ridden: BySecond) -> bytes:
    """The ride's positions. ridden: of those of CHANNELS the ride has."""
    breaks = set(pauses(ride, ridden))
    valid = np.isfinite(ridden["latitude_deg"]) & np.isfinite(ridden["longitude_deg"])
    lines, open_segment = [HEAD.format(name=escape(ride.name or "Ride"))], False
    for at in range(len(ridden)):
        if at in breaks and open_segment:
            lines.append(BETWEEN)
            open_segment = False
        if valid[at]:
            lines.append(point(ridden, at))
            open_segment = True
    return "".join([*lines, FOOT]).encode()


def point(ridden: BySecond, at: int) -> str:
    """One point: 7 decimals of a degree are a centimetre."""
    latitude, longitude = ridden["latitude_deg"][at], ridden["longitude_deg"][at]
    moment = datetime.fromtimestamp(int(ridden.unix_s[at]), UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    height = ridden["altitude_m"][at]
    elevation = f"<ele>{height:.1f}</ele>" if np.isfinite(height) else ""
    more = "".join(
        f"<gpxtpx:{name}>{ridden[channel][at]:.0f}</gpxtpx:{name}>"
        for channel, name in EXTENSION.items()
        if np.isfinite(ridden[channel][at])
    )
    if more:
        more = (
            "<extensions><gpxtpx:TrackPointExtension>"
            f"{more}</gpxtpx:TrackPointExtension></extensions>"
        )
    return (
        f'<trkpt lat="{latitude:.7f}" lon="{longitude:.7f}">'
        f"{elevation}<time>{moment}</time>{more}</trkpt>\n"
    )
