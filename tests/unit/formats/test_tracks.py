"""Goal: every cell of a GPX or TCX file is what a reader that is not ours reads; damage costs the
points it hit; a file that was written to harm is refused.

Method: files written here; gpxpy and tcxreader are the other readers. Damage is done to every place
of a small file.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from pathlib import Path

import gpxpy
import numpy as np
import pytest
from tcxreader.tcxreader import TCXReader

from backend.core.device_metadata import Instrument, Pause
from backend.formats.formats import read_file
from backend.formats.outcome import COMPLETE, PARTIAL, REJECTED, ImportedRide
from backend.formats.questions import TableAnswer
from tests.fakes.kept_rides import values_of
from tests.fakes.track_files import (
    GPX_HEAD,
    START_S,
    TCX_HEAD,
    gpx_file,
    gpx_point,
    gpx_segment,
    gpx_track,
    tcx_activity,
    tcx_file,
    tcx_lap,
    tcx_point,
)

GPX = gpx_file(gpx_track((0, 30), (40, 60)))
TCX = tcx_file(tcx_activity(tcx_lap(0, 30), tcx_lap(30, 60)))


def only_ride(file: bytes, name: str = "ride") -> ImportedRide:
    outcome = read_file(name, file)
    assert outcome.state == COMPLETE, outcome.detail
    (ride,) = outcome.rides
    return ride


def test_every_cell_of_a_gpx_file_is_what_gpxpy_reads() -> None:
    ride = only_ride(GPX)

    points = [p for t in gpxpy.parse(io.BytesIO(GPX)).tracks for s in t.segments for p in s.points]
    assert ride.started_us / 1e6 + ride.rows.times_us / 1e6 == pytest.approx(
        [point.time.timestamp() for point in points if point.time]
    )
    assert values_of(ride, "latitude_deg") == pytest.approx([p.latitude for p in points], abs=1e-9)
    assert values_of(ride, "longitude_deg") == pytest.approx(
        [p.longitude for p in points], abs=1e-9
    )
    assert values_of(ride, "altitude_m") == pytest.approx([p.elevation for p in points], abs=1e-9)
    told = [[*p.extensions[1], p.extensions[0]] for p in points]
    for place, (name, factor) in enumerate(
        [
            ("temperature_degc", 1.0),
            ("heart_rate_bpm", 1.0),
            ("cadence_rpm", 1.0),
            ("speed_kmh", 3.6),
            ("rider_power_w", 1.0),
        ]
    ):
        theirs = [factor * float(leaves[place].text or "nan") for leaves in told]
        assert values_of(ride, name) == pytest.approx(theirs, abs=1e-9), name


def test_every_cell_of_a_tcx_file_is_what_tcxreader_reads(tmp_path: Path) -> None:
    path = tmp_path / "ride.tcx"
    path.write_bytes(TCX)

    ride = only_ride(TCX)

    points = TCXReader().read(str(path), only_gps=False).trackpoints
    assert len(points) == len(ride.rows.times_us) == 60
    for name, theirs in (
        ("latitude_deg", [point.latitude for point in points]),
        ("altitude_m", [point.elevation for point in points]),
        ("distance_m", [point.distance for point in points]),
        ("heart_rate_bpm", [point.hr_value for point in points]),
        ("cadence_rpm", [point.cadence for point in points]),
        ("speed_kmh", [3.6 * point.tpx_ext["Speed"] for point in points]),
        ("rider_power_w", [point.tpx_ext["Watts"] for point in points]),
    ):
        assert values_of(ride, name) == pytest.approx(theirs, abs=1e-9), name


def test_between_segments_a_track_pauses_and_its_file_names_its_maker() -> None:
    noted = only_ride(GPX).metadata

    assert noted.pauses == (Pause(29.0, 40.0),)
    assert noted.instruments == (Instrument("recorder", product="Test 1"),)


def test_laps_and_the_device_of_a_tcx_file_are_kept() -> None:
    ride = only_ride(TCX)

    first, second = ride.metadata.laps
    assert (first.from_s, first.to_s, first.trigger) == (0.0, 30.0, "manual")
    assert (first.timer_s, first.distance_m, first.calories_kcal) == (30.0, 153.75, 12.0)
    assert (second.from_s, second.to_s) == (30.0, 59.0)
    assert ride.metadata.instruments == (
        Instrument(
            "recorder", product="Edge 530", serial_number="3900001", software_version="9.75"
        ),
    )
    assert ride.sport == "cycling"


def naive(file: bytes) -> bytes:
    return re.sub(rb"(T\d\d:\d\d:\d\d(?:\.\d+)?)Z", rb"\1", file)


def test_a_tcx_file_without_a_zone_is_asked_about_and_read_as_is_said() -> None:
    asked = read_file("ride", naive(TCX))

    assert (asked.state, asked.code, asked.rides) == (REJECTED, "needs_mapping", ())
    assert asked.question is not None
    assert (asked.question.kind, asked.question.time_zone) == ("TCX file of Edge 530", True)

    (ride,) = read_file("ride", naive(TCX), TableAnswer("Asia/Kolkata")).rides

    # Half past five earlier than the same clock in London.
    assert ride.started_us == (START_S - 19_800) * 1_000_000
    assert [lap.from_s for lap in ride.metadata.laps] == [0.0, 30.0]
    assert ride.intake is not None
    assert ride.intake.taken_as == {"time_zone": "Asia/Kolkata"}


def test_a_gpx_file_without_a_zone_is_in_utc_by_its_schema_and_says_so() -> None:
    ride, told = only_ride(naive(GPX)), only_ride(GPX)

    assert ride.started_us == told.started_us
    assert ride.intake is not None
    assert told.intake is not None
    assert (ride.intake.taken_as, told.intake.taken_as) == ({"time_zone": "UTC"}, {})


def test_each_track_and_each_activity_is_a_ride() -> None:
    """tcxreader reads nothing of a file of two activities."""
    two_tracks = gpx_file(gpx_track((0, 30)), gpx_track((1000, 1020), kind="Run"))
    two_activities = tcx_file(
        tcx_activity(tcx_lap(0, 30)), tcx_activity(tcx_lap(1000, 1020), sport="Running")
    )

    for file in (two_tracks, two_activities):
        rides = read_file("rides", file).rides

        assert [(r.sport, len(r.rows.times_us)) for r in rides] == [
            ("cycling", 30),
            ("running", 20),
        ]
        # Power on foot is no power at the pedals.
        assert "rider_power_w" not in {channel.name for channel in rides[1].rows.channels}


def test_a_ride_on_a_roller_needs_no_position() -> None:
    ride = only_ride(tcx_file(tcx_activity(tcx_lap(0, 30, position=False))))

    assert len(ride.rows.times_us) == 30
    assert "latitude_deg" not in {channel.name for channel in ride.rows.channels}


def test_gpx_1_0_has_speed_in_the_point_itself() -> None:
    text = (
        '<gpx version="1.0" creator="GPSBabel" xmlns="http://www.topografix.com/GPX/1/0"><trk>'
        '<trkseg><trkpt lat="48" lon="11"><ele>500</ele><time>2023-11-14T22:13:20Z</time>'
        "<course>90.5</course><speed>5</speed></trkpt></trkseg></trk></gpx>"
    )

    ride = only_ride(text.encode())

    assert values_of(ride, "speed_kmh").tolist() == [18.0]
    assert values_of(ride, "course").tolist() == [90.5]


@pytest.mark.parametrize(
    "dressed",
    [
        lambda text: b"   \r\n\n" + text,
        lambda text: b"\xef\xbb\xbf" + text,
        lambda text: text.replace(b"\n", b"\r\n"),
        lambda text: text.decode().encode("utf-16"),
        lambda text: text.replace(b"UTF-8", b"ISO-8859-1").replace(b"Test 1", "Gerät".encode("l1")),
        lambda text: text.replace(b"Test 1", "Gerät".encode("l1")).replace(b"Edge", b"\xfcber"),
        lambda text: text.replace(b"gpxtpx:", b"ns7:").replace(b"ns3:", b"x:"),
    ],
    ids=["spaces", "mark", "crlf", "utf-16", "latin-1", "not what it declares", "other prefixes"],
)
@pytest.mark.parametrize("file", [GPX, TCX], ids=["gpx", "tcx"])
def test_how_the_text_is_dressed_makes_no_difference(
    file: bytes, dressed: Callable[[bytes], bytes]
) -> None:
    plain, other = only_ride(file), only_ride(dressed(file))

    assert other.rows.times_us.tolist() == plain.rows.times_us.tolist()
    for name, counts in plain.rows.counts.items():
        assert other.rows.counts[name].tolist() == counts.tolist(), name


@pytest.mark.parametrize("file", [GPX, TCX], ids=["gpx", "tcx"])
def test_a_file_cut_anywhere_keeps_every_whole_point(file: bytes) -> None:
    close = b"</trkpt>" if file is GPX else b"</Trackpoint>"
    times = (START_S + np.r_[0:30, 40:60] if file is GPX else START_S + np.arange(60)).tolist()
    last = file.rindex(b"</gpx>" if file is GPX else b"</TrainingCenterDatabase>")

    for length in range(600, last, 61):
        cut = file[:length]
        whole = cut.count(close)
        outcome = read_file("ride", cut)

        if not whole:
            assert outcome.state == REJECTED
            continue
        (ride,) = outcome.rides
        assert (outcome.state, outcome.code) == (PARTIAL, "truncated"), length
        assert (ride.started_us // 10**6 + ride.rows.times_us // 10**6).tolist() == times[:whole]


@pytest.mark.parametrize("file", [GPX, TCX], ids=["gpx", "tcx"])
def test_one_damaged_byte_costs_one_point_at_most(file: bytes) -> None:
    """A zero byte is never XML, wherever it is."""
    first = file.index(b"<trkpt" if file is GPX else b"<Trackpoint>")
    plain = only_ride(file)
    times = (plain.started_us // 10**6 + plain.rows.times_us // 10**6).tolist()

    for place in range(first, len(file) - 200, 37):
        damaged = file[:place] + b"\0" + file[place + 1 :]
        outcome = read_file("ride", damaged)

        found = [
            ride.started_us // 10**6 + int(at) // 10**6
            for ride in outcome.rides
            for at in ride.rows.times_us
        ]
        assert (outcome.state, outcome.code) == (PARTIAL, "damaged")
        assert len(found) >= len(times) - 1, place
        assert set(found) <= set(times)


def test_a_bomb_and_a_file_that_reads_others_are_refused() -> None:
    declares = '<!DOCTYPE gpx [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>'
    reads = '<!DOCTYPE gpx [<!ENTITY a SYSTEM "file:///etc/hostname">]>'

    for trap in (declares, reads):
        for head, body in ((GPX_HEAD, gpx_segment(0, 5)), (TCX_HEAD, tcx_point(0))):
            declaration, rest = head.split("?>", 1)
            outcome = read_file("ride", f"{declaration}?>{trap}{rest}&b;{body}".encode())

            assert (outcome.state, outcome.code) == (REJECTED, "unsafe_content")


def test_a_route_and_a_course_are_no_rides_and_say_so() -> None:
    route = GPX_HEAD + gpx_point(0).replace("<time>2023-11-14T22:13:20Z</time>", "") + "</gpx>"
    course = TCX_HEAD.replace("Activities", "Courses") + f"<Course><Track>{tcx_point(0)}"

    outcome = read_file("a.gpx", route.encode())
    assert (outcome.state, outcome.code) == (REJECTED, "no_valid_time")
    assert "route" in (outcome.detail or "")
    outcome = read_file("a.tcx", (course + "</Track></Course></Courses>").encode())
    assert (outcome.state, outcome.code) == (REJECTED, "no_records")
    assert "course" in (outcome.detail or "")


def test_what_is_no_number_is_counted_and_every_point_is_accounted_for() -> None:
    text = GPX.replace(b"<gpxtpx:hr>105<", b"<gpxtpx:hr>fast<").replace(b"22:13:30Z", b"noon")

    intake = only_ride(text).intake

    assert intake is not None
    assert intake.fields_unread == {"heart_rate": 1, "unix_s": 1}
    assert (intake.rows_read, intake.rows_kept) == (50, 49)
    assert intake.rows_dropped == {"no_time": 1}
