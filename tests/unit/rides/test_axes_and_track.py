"""Goal: a ride is drawn over time, motion or way with exact extremes, and its track keeps shape.

Method: rides laid out on paper, so that time in motion, way and corners are known; the extremes of
every bin are compared with numpy over the rows between its ends. A distance from the track is
judged by haversine on the sphere, which the views do not use.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.core.channels import ChannelSpec, Values
from backend.errors import InvalidRequest
from backend.rides.traces.axes import Axis, axis_positions
from backend.rides.traces.trace import trace
from backend.rides.traces.track import BENDS, EVEN_POINTS, track
from tests.unit.rides.test_trace_is_exact import PlainReader

SPEED = ChannelSpec("speed_kmh", "km/h", 0.01)
TORQUE = ChannelSpec("rider_torque_nm", "Nm", 0.01)
LATITUDE = ChannelSpec("latitude_deg", "deg", 1e-7, wide=True)
LONGITUDE = ChannelSpec("longitude_deg", "deg", 1e-7, wide=True)
EARTH_M = 6_371_000.0


def ride_of(columns: dict[ChannelSpec, Values], every_s: float | None = 1.0) -> PlainReader:
    """Rows a second apart; None for the 100 Hz of a unit."""
    count = len(next(iter(columns.values())))
    times = None if every_s is None else (np.arange(count) * every_s * 1e6).astype(np.int64)
    return PlainReader({spec: spec.to_counts(v) for spec, v in columns.items()}, times)


def stop_and_go() -> PlainReader:
    """100 Hz: 100 s at 36 km/h, a light of 50 s, a sensor silent for 20 s, 100 s at 18 km/h."""
    speed = np.repeat([36.0, 0.0, np.nan, 18.0], [10_000, 5_000, 2_000, 10_000])
    torque = np.random.default_rng(3).uniform(0.0, 60.0, len(speed))
    return ride_of({SPEED: speed, TORQUE: torque}, None)


def test_motion_and_way_stand_while_the_bike_does() -> None:
    ride = stop_and_go()

    moving, way = axis_positions(ride, "moving"), axis_positions(ride, "distance")

    assert moving is not None
    assert way is not None
    # At the light, before the silence and after it: 100 s of motion and 1000 m.
    assert moving.at[[12_000, 14_999, 16_999]] == pytest.approx(100.0)
    assert way.at[[12_000, 14_999, 16_999]] == pytest.approx(1000.0)
    assert moving.at[-1] == pytest.approx(200.0, abs=0.02)
    assert way.at[-1] == pytest.approx(1500.0, abs=0.1)


@pytest.mark.parametrize("axis", ["moving", "distance"])
@pytest.mark.parametrize("window", [(None, None), (30.0, 180.5), (99.0, 101.0)])
def test_every_bin_of_another_axis_has_the_extremes_of_its_rows(
    axis: Axis, window: tuple[float | None, float | None]
) -> None:
    ride = stop_and_go()
    rows = ride.counts(["rider_torque_nm"], 0, ride.row_count)["rider_torque_nm"]

    shown = trace(ride, ["rider_torque_nm"], *window, pixels=300, axis=axis)

    place = axis_positions(ride, axis)
    assert place is not None
    assert shown.x is not None
    x_first, x_last = shown.x
    first = np.rint(shown.t_first_s * 100).astype(int)
    last = np.rint(shown.t_last_s * 100).astype(int)
    assert (first[1:] == last[:-1] + 1).all()
    for bin_number, (begin, end) in enumerate(zip(first, last, strict=True)):
        inside = rows[begin : end + 1]
        assert shown.minimum["rider_torque_nm"][bin_number] == inside.min()
        assert shown.maximum["rider_torque_nm"][bin_number] == inside.max()
    assert x_first == pytest.approx(place.at[first])
    assert x_last == pytest.approx(place.at[last])
    # No bin is wider than a pixel: the axis' own length over 300, and one row.
    width = (place.at[last[-1]] - place.at[first[0]]) / 300
    step = np.diff(place.at).max()
    assert (x_last - x_first).max() <= width + step


def test_a_silent_sensor_is_a_gap_of_its_own_though_the_way_stands() -> None:
    shown = trace(stop_and_go(), ["speed_kmh"], pixels=100, axis="distance")

    missing = shown.minimum["speed_kmh"] == SPEED.missing
    assert missing.any()
    assert shown.t_first_s[missing].min() == 150.0
    assert shown.t_last_s[missing].max() == pytest.approx(169.99)


def test_a_sparse_channel_is_silent_only_where_it_is_for_long() -> None:
    speed = np.full(60_000, np.nan)
    speed[::100] = 25.0
    speed[20_000:23_000] = np.nan

    place = axis_positions(ride_of({SPEED: speed}, None), "distance")

    # From the first row without a sample to the next one with one, of rows 10 ms apart.
    assert place is not None
    assert place.edges.tolist() == [19_901, 23_000]


class Filled(PlainReader):
    """Of four rows of the ride one came from a log, and holds for all of them."""

    def row_seconds(self) -> Values:
        return np.tile([0.04, 0.0, 0.0, 0.0], self.row_count // 4)


def test_what_a_log_filled_counts_as_long_as_its_samples_hold() -> None:
    speed = np.tile([36.0, np.nan, np.nan, np.nan], 2500)
    ride = Filled({SPEED: SPEED.to_counts(speed)})

    moving, way = axis_positions(ride, "moving"), axis_positions(ride, "distance")
    told = track(ride)

    assert moving is not None
    assert way is not None
    assert (moving.at[-1], way.at[-1]) == (pytest.approx(100.0), pytest.approx(1000.0))
    assert told.distance_m is not None
    assert told.distance_m[-1] == pytest.approx(1000.0)


def test_a_ride_without_speed_has_time_only() -> None:
    ride = ride_of({TORQUE: np.ones(50)})

    assert axis_positions(ride, "moving") is None
    with pytest.raises(InvalidRequest) as refused:
        trace(ride, axis="distance")
    assert refused.value.fields[0].code == "no_axis"


def haversine_m(lat: Values, lon: Values, lat0: float, lon0: float) -> Values:
    a, b, c, d = (np.radians(v) for v in (lat, lon, lat0, lon0))
    half = np.sin((a - c) / 2) ** 2 + np.cos(a) * np.cos(c) * np.sin((b - d) / 2) ** 2
    return np.asarray(2 * EARTH_M * np.arcsin(np.sqrt(half)))


def laps(rows: int = 40_000, centre_deg: float = 11.0) -> dict[ChannelSpec, Values]:
    """Thirty laps of a circle of 200 m around 48 N, at a steady speed."""
    turn = np.linspace(0.0, 2 * np.pi * 30, rows)
    across = 200.0 / (EARTH_M * np.cos(np.radians(48.0)))
    longitude = centre_deg + np.degrees(across) * np.cos(turn)
    return {
        LATITUDE: 48.0 + np.degrees(200.0 / EARTH_M) * np.sin(turn),
        LONGITUDE: (longitude + 180.0) % 360.0 - 180.0,
        SPEED: np.full(rows, 25.0),
    }


@pytest.mark.parametrize("centre_deg", [11.0, 180.0])
def test_thirty_laps_keep_their_shape_in_2000_points(centre_deg: float) -> None:
    found = track(ride_of(laps(centre_deg=centre_deg)))

    assert found.latitude_deg is not None
    assert found.longitude_deg is not None
    assert EVEN_POINTS <= len(found.t_s) <= EVEN_POINTS + BENDS
    around = np.unwrap(found.longitude_deg, period=360.0)
    centre = 11.0 if centre_deg == 11.0 else np.round(around.mean())
    middle_lat = (found.latitude_deg[1:] + found.latitude_deg[:-1]) / 2
    middle_lon = (around[1:] + around[:-1]) / 2
    # A chord between two points leaves the circle by no more than 1 m of its 200.
    assert haversine_m(middle_lat, middle_lon, 48.0, centre) == pytest.approx(200.0, abs=1.0)


def test_a_gap_in_the_positions_stays_open_and_time_goes_on() -> None:
    columns = laps(4000)
    for channel in (LATITUDE, LONGITUDE):
        columns[channel][1000:1100] = np.nan

    found = track(ride_of(columns))

    assert found.latitude_deg is not None
    assert found.distance_m is not None
    open_s = found.t_s[np.isnan(found.latitude_deg)]
    assert open_s.min() > 999
    assert open_s.max() < 1100
    assert (np.diff(found.t_s) > 0).all()
    assert (np.diff(found.distance_m) >= 0).all()
    valid_s = found.t_s[~np.isnan(found.latitude_deg)]
    assert {999.0, 1100.0} <= set(valid_s)


def test_a_pause_of_the_recorder_is_a_gap_too() -> None:
    columns = laps(2000)
    ride = ride_of(columns)
    times = np.arange(2000, dtype=np.int64) * 1_000_000
    times[900:] += 600_000_000
    paused = PlainReader({spec: spec.to_counts(v) for spec, v in columns.items()}, times)

    found = track(paused)

    assert track(ride).latitude_deg is not None
    assert found.latitude_deg is not None
    assert found.t_s[np.isnan(found.latitude_deg)] == pytest.approx([(899 + 1500) / 2])


def test_a_ride_without_positions_tells_its_way_alone() -> None:
    found = track(stop_and_go())

    assert found.latitude_deg is None
    assert found.longitude_deg is None
    assert found.distance_m is not None
    assert found.distance_m[-1] == pytest.approx(1500.0, abs=0.1)
