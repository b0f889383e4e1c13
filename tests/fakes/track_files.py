"""Writes small GPX and TCX files for tests, after the schemas of Topografix and Garmin.

Nothing is shared with the readers under test.
"""

from __future__ import annotations

from datetime import UTC, datetime

START_S = 1_700_000_000
GPX_HEAD = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<gpx version="1.1" creator="Test 1" xmlns="http://www.topografix.com/GPX/1/1" '
    'xmlns:gpxtpx="http://www.garmin.com/xmlschemas/TrackPointExtension/v2">\n'
    "<metadata><name>a ride</name><time>2023-11-14T22:13:20Z</time></metadata>\n"
)
TCX_HEAD = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    "<TrainingCenterDatabase "
    'xmlns="http://www.garmin.com/xmlschemas/TrainingCenterDatabase/v2" '
    'xmlns:ns3="http://www.garmin.com/xmlschemas/ActivityExtension/v2"><Activities>\n'
)


def iso(second: float) -> str:
    """A second after the start, as both formats write times."""
    return datetime.fromtimestamp(START_S + second, UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def gpx_point(second: int) -> str:
    """18 km/h north, 150 W and a little more each second; Garmin's extension and Strava's power."""
    return (
        f'<trkpt lat="{48.0 + second * 4.5e-5:.7f}" lon="11.5000000">'
        f"<ele>{520.2 + 0.1 * second:.1f}</ele><time>{iso(second)}</time>"
        f"<extensions><power>{150 + second}</power><gpxtpx:TrackPointExtension>"
        f"<gpxtpx:atemp>21</gpxtpx:atemp><gpxtpx:hr>{100 + second % 60}</gpxtpx:hr>"
        f"<gpxtpx:cad>75</gpxtpx:cad><gpxtpx:speed>5.125</gpxtpx:speed>"
        "</gpxtpx:TrackPointExtension></extensions></trkpt>\n"
    )


def gpx_segment(first: int, behind: int) -> str:
    return "<trkseg>" + "".join(gpx_point(s) for s in range(first, behind)) + "</trkseg>"


def gpx_track(*segments: tuple[int, int], kind: str = "cycling") -> str:
    body = "".join(gpx_segment(*segment) for segment in segments)
    return f"<trk><name>t</name><type>{kind}</type>{body}</trk>\n"


def gpx_file(*tracks: str) -> bytes:
    return (GPX_HEAD + "".join(tracks) + "</gpx>\n").encode()


def tcx_point(second: int, position: bool = True) -> str:
    """As `gpx_point`, with the extension's speed and watts."""
    place = (
        f"<Position><LatitudeDegrees>{48.0 + second * 4.5e-5:.7f}</LatitudeDegrees>"
        "<LongitudeDegrees>11.5</LongitudeDegrees></Position>"
        if position
        else ""
    )
    return (
        f"<Trackpoint><Time>{iso(second)}</Time>{place}"
        f"<AltitudeMeters>{520.2 + 0.1 * second:.1f}</AltitudeMeters>"
        f"<DistanceMeters>{5.125 * second:.3f}</DistanceMeters>"
        f"<HeartRateBpm><Value>{100 + second % 60}</Value></HeartRateBpm><Cadence>75</Cadence>"
        "<Extensions><ns3:TPX><ns3:Speed>5.125</ns3:Speed>"
        f"<ns3:Watts>{150 + second}</ns3:Watts></ns3:TPX></Extensions></Trackpoint>\n"
    )


def tcx_lap(first: int, behind: int, position: bool = True) -> str:
    points = "".join(tcx_point(second, position) for second in range(first, behind))
    return (
        f'<Lap StartTime="{iso(first)}"><TotalTimeSeconds>{behind - first}.0</TotalTimeSeconds>'
        f"<DistanceMeters>{5.125 * (behind - first):.3f}</DistanceMeters><Calories>12</Calories>"
        "<Intensity>Active</Intensity><TriggerMethod>Manual</TriggerMethod>"
        f"<Track>{points}</Track></Lap>\n"
    )


def tcx_activity(*laps: str, sport: str = "Biking") -> str:
    device = (
        "<Creator><Name>Edge 530</Name><UnitId>3900001</UnitId><ProductID>3121</ProductID>"
        "<Version><VersionMajor>9</VersionMajor><VersionMinor>75</VersionMinor></Version></Creator>"
    )
    return f'<Activity Sport="{sport}"><Id>{iso(0)}</Id>{"".join(laps)}{device}</Activity>\n'


def tcx_file(*activities: str) -> bytes:
    return (TCX_HEAD + "".join(activities) + "</Activities></TrainingCenterDatabase>\n").encode()
