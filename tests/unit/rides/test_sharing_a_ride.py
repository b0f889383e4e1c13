"""Goal: from a file that is shared nobody computes where the ride began; a ZIP tells the rest.

Method: a ride from a door, away, by the door again and home; the attacks of the literature are
tried on what is exported: nearest point, circle through the ends, length before the first point.
"""

from __future__ import annotations

import csv
import io
import zipfile
from collections.abc import Iterator
from datetime import UTC, datetime
from itertools import chain
from pathlib import Path

import gpxpy
import numpy as np
import pytest

from backend.core.channels import ChannelSpec
from backend.core.ride import Ride, RideContext, RideRows
from backend.core.sphere import great_circle_m
from backend.errors import InvalidRequest, NotFound
from backend.formats.export.blurred import moved
from backend.formats.formats import read_file
from backend.rides.service import Rides
from backend.store import Store, open_store

pytestmark = pytest.mark.slow

START_S = 1_700_000_000
DOOR = (53.346, -6.262)
M_PER_DEG = 111_194.9
BLUR_M = 200.0
SPEED = ChannelSpec("speed_kmh", "km/h", 0.01)
DISTANCE = ChannelSpec("distance_m", "m", 0.01, wide=True)
HIDDEN = ChannelSpec("home_distance", "", 1.0)
LATITUDE = ChannelSpec("latitude_deg", "deg", 180 / 2**31, wide=True)
LONGITUDE = ChannelSpec("longitude_deg", "deg", 180 / 2**31, wide=True)
TORQUE = ChannelSpec("rider_torque_nm", "Nm", 0.01)
CADENCE = ChannelSpec("cadence_rpm", "rpm", 0.5)
CHANNELS = (SPEED, DISTANCE, HIDDEN, LATITUDE, LONGITUDE)


def there_and_back(bearing: float, times: int = 2, far_m: float = 2000.0) -> np.ndarray:
    """Metres east and north (n, 2), a row each second at 5 m/s, out and home again and again."""
    out = np.arange(0.0, far_m, 5.0)
    away = np.concatenate([np.concatenate([out, out[::-1]]) for _ in range(times)])
    return np.stack([away * np.sin(bearing), away * np.cos(bearing)], axis=1)


def added(store: Store, path_m: np.ndarray, name: str = "From 7 Home Street") -> int:
    rows = len(path_m)
    latitude = DOOR[0] + path_m[:, 1] / M_PER_DEG
    longitude = DOOR[1] + path_m[:, 0] / M_PER_DEG / np.cos(np.radians(DOOR[0]))
    values = {
        "speed_kmh": np.full(rows, 18.0),
        "distance_m": 1_000.0 + 5.0 * np.arange(rows),
        "home_distance": np.arange(rows) % 1000,
        "latitude_deg": latitude,
        "longitude_deg": longitude,
    }
    counts = {c.name: c.to_counts(np.asarray(values[c.name], float)) for c in CHANNELS}
    times_us = np.arange(rows, dtype=np.int64) * 1_000_000
    ride = Ride(
        0, "live", "imported", name, "key under the mat", START_S * 1_000_000, rows, 1_000_000,
        CHANNELS, (), RideContext(),
    )  # fmt: skip
    return store.rides.add(ride, RideRows(CHANNELS, times_us, counts)).id


def exported(store: Store, ride_id: int, file_format: str, blur_m: float | None = BLUR_M) -> bytes:
    return b"".join(Rides(store).export(ride_id, file_format, blur_m).chunks)


def points(gpx: bytes) -> list[tuple[float, float, datetime]]:
    track = gpxpy.parse(gpx.decode()).tracks[0]
    found = [point for segment in track.segments for point in segment.points]
    return [(p.latitude, p.longitude, p.time or datetime.now(UTC)) for p in found]


def away_m(gpx: bytes) -> np.ndarray:
    """How far from the door each point is."""
    found = np.array([(lat, lon) for lat, lon, _ in points(gpx)])
    return great_circle_m(*DOOR, found[:, 0], found[:, 1])


def test_no_point_is_near_the_door_not_on_a_later_pass_either(store: Store) -> None:
    ride_id = added(store, there_and_back(0.7, times=3))

    assert away_m(exported(store, ride_id, "gpx", None)).min() < 1.0
    shared = away_m(exported(store, ride_id, "gpx"))

    assert shared.min() >= BLUR_M
    assert shared.max() > 1900.0


def test_the_ends_of_many_tracks_lie_on_no_circle_around_the_door(store: Store) -> None:
    ends = []
    for bearing in np.linspace(0.0, 2 * np.pi, 8, endpoint=False):
        latitude, longitude, _ = points(
            exported(store, added(store, there_and_back(bearing, 1)), "gpx")
        )[0]
        ends.append(
            (
                (longitude - DOOR[1]) * M_PER_DEG * np.cos(np.radians(DOOR[0])),
                (latitude - DOOR[0]) * M_PER_DEG,
            )
        )

    # Kasa's fit of a circle through all first points: its middle is what an attacker takes.
    x, y = np.array(ends).T
    (a, b, _), *_ = np.linalg.lstsq(np.stack([x, y, np.ones(8)], 1), x**2 + y**2, rcond=None)
    assert (a / 2, b / 2) == pytest.approx(moved_m(store), abs=10.0)
    assert np.hypot(*moved_m(store)) > 0.0


def moved_m(store: Store) -> tuple[float, float]:
    """How far the middle of the zone is moved, east and north."""
    secret = (store.objects.identity() or "").encode()
    latitude, longitude = moved(*DOOR, BLUR_M, secret)
    east = (longitude - DOOR[1]) * M_PER_DEG * np.cos(np.radians(DOOR[0]))
    return east, (latitude - DOOR[0]) * M_PER_DEG


def test_another_store_moves_the_zone_elsewhere(store: Store, tmp_path: Path) -> None:
    other = open_store(f"sqlite:///{tmp_path}/other", f"file://{tmp_path}/others")
    try:
        assert moved_m(store) != pytest.approx(moved_m(other), abs=0.1)
        assert np.hypot(*moved_m(store)) <= BLUR_M / 2
    finally:
        other.close()


@pytest.mark.parametrize("file_format", ["fit", "csv"])
def test_distance_and_time_begin_behind_the_zone(
    store: Store, tmp_path: Path, file_format: str
) -> None:
    ride_id = added(store, there_and_back(0.7))
    file = tmp_path / f"shared.{file_format}"
    file.write_bytes(exported(store, ride_id, file_format))
    first = points(exported(store, ride_id, "gpx"))[0][2]

    if file_format == "csv":
        lines = list(csv.DictReader(io.StringIO(file.read_text())))
        distances = np.array([float(line["distance_m"]) for line in lines])
        assert set(lines[0]) == {
            "time_utc", "t_s", "speed_kmh", "distance_m", "latitude_deg", "longitude_deg",
        }  # fmt: skip
        assert float(lines[0]["t_s"]) == 0.0
        assert datetime.fromisoformat(lines[0]["time_utc"]) == first
    else:
        (ride,) = read_file(file.name, file.read_bytes()).rides
        distances = ride.rows.counts["distance_m"] * next(
            c.scale for c in ride.rows.channels if c.name == "distance_m"
        )
        assert ride.started_us == int(first.timestamp()) * 1_000_000
    assert distances[0] == 0.0
    # The middle pass is hidden: no step is longer than what a second brings.
    assert np.diff(distances).max() == pytest.approx(5.0, abs=0.1)


def test_no_word_or_unknown_channel_is_told(store: Store) -> None:
    ride_id = added(store, there_and_back(0.7))

    for file_format in ("gpx", "csv", "fit"):
        body = exported(store, ride_id, file_format)
        assert b"Home Street" not in body
        assert b"mat" not in body.replace(b"format", b"")
        assert b"home_distance" not in body


def test_a_shared_fit_file_has_the_powers_that_the_whole_one_has(store: Store) -> None:
    path_m = there_and_back(0.7)
    rows = len(path_m)
    columns = {
        LATITUDE: DOOR[0] + path_m[:, 1] / M_PER_DEG,
        LONGITUDE: DOOR[1] + path_m[:, 0] / M_PER_DEG / np.cos(np.radians(DOOR[0])),
        TORQUE: np.full(rows, 30.0),
        CADENCE: np.full(rows, 60.0),
    }
    counts = {spec.name: spec.to_counts(values) for spec, values in columns.items()}
    times_us = np.arange(rows, dtype=np.int64) * 1_000_000
    channels = tuple(columns)
    ride = Ride(
        0, "live", "imported", "", "", START_S * 10**6, rows, 10**6, channels, (), RideContext()
    )
    ride_id = store.rides.add(ride, RideRows(channels, times_us, counts)).id

    (shared,) = read_file("a.fit", exported(store, ride_id, "fit")).rides

    power = next(c for c in shared.rows.channels if c.name == "rider_power_w")
    # 30 Nm at a turn a second.
    assert power.to_values(shared.rows.counts[power.name]) == pytest.approx(188.0, abs=0.5)


def test_what_cannot_be_blurred_is_refused(store: Store) -> None:
    near = added(store, there_and_back(0.7, far_m=150.0))
    rows = 60
    counts = {"speed_kmh": np.full(rows, 1800, np.int16)}
    times_us = np.arange(rows, dtype=np.int64) * 1_000_000
    ride = Ride(0, "live", "imported", "", "", 0, rows, 1_000_000, (SPEED,), (), RideContext())
    nowhere = store.rides.add(ride, RideRows((SPEED,), times_us, counts)).id

    for ride_id, file_format, code in (
        (near, "gpx", "nothing_to_share"),
        (nowhere, "fit", "no_positions"),
        (near, "parquet", "unsupported_format"),
        (near, "original", "unsupported_format"),
    ):
        with pytest.raises(InvalidRequest) as refused:
            exported(store, ride_id, file_format)
        assert refused.value.code == code


def unzipped(chunks: Iterator[bytes]) -> zipfile.ZipFile:
    return zipfile.ZipFile(io.BytesIO(b"".join(chunks)))


def test_a_zip_has_every_ride_and_lists_what_could_not_be_made(store: Store) -> None:
    one = added(store, there_and_back(0.7), name="=1+1")
    two = added(store, there_and_back(0.2), name="plain, with a comma")
    rides = Rides(store)

    zipped = unzipped(rides.archive(["fit", "original"]))

    assert zipped.testzip() is None
    assert zipped.namelist() == [
        f"spindle-ride-{one}.fit", f"spindle-ride-{two}.fit", "index.csv",
    ]  # fmt: skip
    assert zipped.read(f"spindle-ride-{one}.fit") == exported(store, one, "fit", None)
    listed = list(csv.DictReader(io.StringIO(zipped.read("index.csv").decode())))
    assert [row["name"] for row in listed] == ["'=1+1", "plain, with a comma"]
    assert float(listed[0]["distance_km"]) == pytest.approx(8.0, rel=0.01)
    assert listed[0]["motor_wh"] == ""
    assert "no original" in listed[0]["left_out"]


def test_a_zip_of_chosen_rides_and_of_a_kind(store: Store) -> None:
    one = added(store, there_and_back(0.7))
    two = added(store, there_and_back(0.2, times=4))
    rides = Rides(store)

    assert unzipped(rides.archive(["csv"], ride_ids=[one])).namelist()[0].endswith(f"{one}.csv")
    far = unzipped(rides.archive(["csv"], longer_km=10.0)).namelist()
    assert far == [f"spindle-ride-{two}.csv", "index.csv"]
    with pytest.raises(NotFound):
        rides.archive(["csv"], ride_ids=[one, 999])


def test_a_zip_for_strangers_tells_no_word_of_a_ride(store: Store) -> None:
    ride_id = added(store, there_and_back(0.7))

    zipped = unzipped(Rides(store).archive(["gpx", "parquet"], BLUR_M))

    assert zipped.namelist() == [f"spindle-ride-{ride_id}-shared.gpx", "index.csv"]
    whole = b"".join(chain(zipped.read(name) for name in zipped.namelist()))
    assert b"Home Street" not in whole
    assert b"mat" not in whole.replace(b"format", b"")
    first, *_ = csv.DictReader(io.StringIO(zipped.read("index.csv").decode()))
    assert set(first) == {"ride", "files", "left_out"}
