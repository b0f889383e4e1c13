"""Goal: nothing is counted that cannot have been ridden, and all is that was: jumps of a receiver,
counts that begin anew, signs, breaks that were ridden, elements of two namespaces.

Method: tracks along a meridian, where a degree is 111.195 km (WGS 84's mean radius), at 6 m/s.
"""

from __future__ import annotations

import gzip
from collections.abc import Sequence

import numpy as np
import pytest

from backend.core.ride import RideSummary, summarise
from backend.formats.formats import read_file
from backend.formats.outcome import ImportedRide
from tests.fakes.fit_file import fit_file

DEG_M = 111_195.0
STEP_M = 6.0
POINTS = 600
BEGAN = 1_751_000_400
Point = tuple[float, float, float]


def ridden(count: int = POINTS, step_s: int = 1) -> list[Point]:
    """Unix time, latitude and longitude of each point."""
    return [(BEGAN + n * step_s, 48.0 + n * step_s * STEP_M / DEG_M, 11.0) for n in range(count)]


def gpx(points: Sequence[Point], more: Sequence[str] | None = None, head: str = "") -> bytes:
    stamps = np.array([round(at * 1000) for at, _, _ in points], "datetime64[ms]")
    extra = more or [""] * len(points)
    body = "".join(
        f'<trkpt lat="{lat:.7f}" lon="{lon:.7f}"><time>{stamp}Z</time>{text}</trkpt>'
        for (_, lat, lon), stamp, text in zip(points, stamps, extra, strict=True)
    )
    return f'<gpx version="1.1" {head}><trk><trkseg>{body}</trkseg></trk></gpx>'.encode()


def ride_of(data: bytes, name: str = "ride.gpx") -> ImportedRide:
    outcome = read_file(name, data)
    assert outcome.state == "complete", outcome
    (ride,) = outcome.rides
    return ride


def summary_of(ride: ImportedRide) -> RideSummary:
    values = {c.name: c.to_values(ride.rows.counts[c.name]) for c in ride.rows.channels}
    return summarise(values, ride.rows.times_us, ride.period_us)


def moved(points: list[Point], rows: slice, north_deg: float, east_deg: float) -> list[Point]:
    shifted = [(at, lat + north_deg, lon + east_deg) for at, lat, lon in points[rows]]
    points[rows] = shifted
    return points


@pytest.mark.parametrize(
    ("rows", "north_deg", "east_deg"),
    [
        (slice(300, 301), 1.0, 0.0),
        (slice(300, 301), 0.0, -90.0),
        (slice(300, 340), 0.02, 0.02),
        (slice(0, 1), 0.0, 10.0),
        (slice(0, 30), -3.0, 0.0),
        (slice(590, 600), 0.0, 10.0),
        (slice(599, 600), 0.01, 0.0),
    ],
)
def test_what_nobody_could_reach_has_no_length_and_is_counted(
    rows: slice, north_deg: float, east_deg: float
) -> None:
    ride = ride_of(gpx(moved(ridden(), rows, north_deg, east_deg)))

    distance_km = summary_of(ride).distance_km
    wrong = len(range(*rows.indices(POINTS)))
    assert ride.intake is not None
    assert ride.intake.values_dropped == {"latitude_deg": wrong, "longitude_deg": wrong}
    # What lies beside them at the ends is not known, in the middle it was ridden.
    assert distance_km == pytest.approx(
        (POINTS - 1) * STEP_M / 1000, abs=(wrong + 1) * STEP_M / 1000
    )


def test_a_train_between_two_rides_of_a_file_is_no_distance_and_no_error() -> None:
    """40 km by train in an hour: neither half is out of reach of the other."""
    there = ridden()
    back = [(at + 3600, lat + 0.36, lon) for at, lat, lon in ridden()]

    ride = ride_of(gpx(there + back))

    assert ride.intake is not None
    assert not ride.intake.values_dropped
    assert summary_of(ride).distance_km == pytest.approx(2 * (POINTS - 1) * STEP_M / 1000, rel=0.01)


@pytest.mark.parametrize("step_s", [20, 45, 90])
def test_points_far_apart_in_a_ride_are_a_ride(step_s: int) -> None:
    """A device that writes a point where the road bends: every fourth so many seconds later."""
    points, at = [], 0
    for n in range(400):
        at += step_s if n % 4 == 0 else 1
        points.append((BEGAN + at, 48.0 + at * STEP_M / DEG_M, 11.0))

    ride = ride_of(gpx(points))

    ridden_s = points[-1][0] - points[0][0]
    assert summary_of(ride).distance_km == pytest.approx(ridden_s * STEP_M / 1000, rel=0.01)


def test_a_break_with_a_stop_in_it_is_a_pause() -> None:
    there = ridden(300)
    # Ten minutes for 60 m: somebody stood.
    back = [(at + 900, lat + (300 + 10) * STEP_M / DEG_M, lon) for at, lat, lon in ridden(300)]

    summary = summary_of(ride_of(gpx(there + back)))

    assert summary.distance_km == pytest.approx(2 * 299 * STEP_M / 1000, rel=0.001)


def test_longitudes_go_on_beyond_the_date_line() -> None:
    points = [(at, 0.0, 179.99 + n * STEP_M / DEG_M) for n, (at, _, _) in enumerate(ridden())]
    assert points[-1][2] > 180.0

    ride = ride_of(gpx(points))

    assert summary_of(ride).distance_km == pytest.approx((POINTS - 1) * STEP_M / 1000, rel=0.001)


def distances(texts: Sequence[str], head: str = "") -> RideSummary:
    return summary_of(ride_of(gpx(ridden(), texts, head)))


@pytest.mark.parametrize("begins", [0.0, 40.0, 1_234_567.0])
def test_a_distance_is_a_sum_or_a_step_by_its_values_not_by_its_first(begins: float) -> None:
    head = 'xmlns:o="http://opentracksapp.com/xmlschemas/v1"'
    sums = [f"<extensions><distance>{begins + n * STEP_M}</distance></extensions>"
            for n in range(POINTS)]  # fmt: skip
    steps = [
        f"<extensions><o:distance>{STEP_M + (-1) ** n}</o:distance></extensions>"
        for n in range(POINTS)
    ]

    assert distances(sums).distance_km == pytest.approx(3.594, abs=0.01)
    assert distances(steps, head).distance_km == pytest.approx(3.594, abs=0.01)


def test_elements_of_two_namespaces_are_two_whatever_their_prefix() -> None:
    head = (
        'xmlns:a="http://www.cluetrust.com/XML/GPXDATA/1/0"'
        ' xmlns:b="http://opentracksapp.com/xmlschemas/v1"'
    )
    both = [
        f"<extensions><b:distance>{STEP_M}</b:distance><a:distance>{n * STEP_M}</a:distance>"
        "</extensions>"
        for n in range(POINTS)
    ]

    assert distances(both, head).distance_km == pytest.approx(3.594, abs=0.01)


def test_bpm_and_rpm_are_heart_rate_and_cadence() -> None:
    texts = ["<extensions><bpm>131</bpm><rpm>80</rpm></extensions>"] * POINTS

    names = {channel.name for channel in ride_of(gpx(ridden(), texts)).rows.channels}

    assert {"heart_rate_bpm", "cadence_rpm"} <= names


def fit_ride(metres: Sequence[float | None], speed_ms: Sequence[float] | None = None) -> bytes:
    speeds = speed_ms or [STEP_M] * len(metres)
    return fit_file(
        [
            {"timestamp": BEGAN + n, "distance": at, "speed": speed, "power": 150}
            for n, (at, speed) in enumerate(zip(metres, speeds, strict=True))
        ]
    )


def test_a_count_that_begins_anew_goes_on_in_any_file() -> None:
    laps = [(n % 200 + 1) * STEP_M for n in range(POINTS)]

    ride = ride_of(fit_ride(laps), "laps.fit")

    assert summary_of(ride).distance_km == pytest.approx((POINTS - 1) * STEP_M / 1000, rel=0.01)
    assert ride.intake is not None
    assert ride.intake.restarts == {"distance_m": 2}


def test_the_first_reading_of_an_odometer_was_ridden_before() -> None:
    odometer = [4_321_000.0 + n * STEP_M for n in range(POINTS)]

    assert summary_of(ride_of(fit_ride(odometer), "ride.fit")).distance_km == pytest.approx(3.594)


def test_a_gzipped_track_is_the_same_track() -> None:
    ride = ride_of(gzip.compress(gpx(ridden())), "ride.gpx.gz")

    assert summary_of(ride).distance_km == pytest.approx(3.594, rel=0.001)
