"""Goal: what leaves as a file is what was ridden, in physical units, and comes back as that ride.

Method: a ride with every kind of channel is exported and read back: by Spindle, and each format by
two readers that are not ours (Parquet and CSV: DuckDB, Polars; FIT: fitdecode, fit-tool; GPX:
gpxpy, gpx). What they read is compared with what went in, within the format's resolution.
"""

from __future__ import annotations

import io
import math
from collections.abc import Callable
from datetime import UTC, datetime
from itertools import chain
from pathlib import Path
from typing import Any

import duckdb
import fitdecode
import gpx
import gpxpy
import numpy as np
import polars
import pyarrow.parquet as pq
import pytest
from fit_tool.fit_file import FitFile

from backend.core.channels import ChannelSpec, Counts
from backend.core.ride import Ride, RideContext, RideRows
from backend.errors import InvalidRequest
from backend.formats.formats import read_file
from backend.rides.service import Rides
from backend.store import Store

Reader = Callable[[Path], dict[str, list[float | None]]]
Messages = list[tuple[str, dict[str, Any]]]
FitReader = Callable[[bytes], Messages]
Track = tuple[str, list[list[tuple[float, float, datetime]]]]

NO_SPEED = (2**32 - 1) / 1000

START_S = 1_700_000_000
SECONDS, HZ = 60, 10
GAP = slice(300, 400)
CHANNELS = (
    ChannelSpec("speed_kmh", "km/h", 0.01),
    ChannelSpec("cadence_rpm", "rpm", 0.01),
    ChannelSpec("rider_torque_nm", "Nm", 0.01),
    ChannelSpec("motor_torque_nm", "Nm", 0.0001),
    ChannelSpec("motor_torque_demanded_nm", "Nm", 0.0001),
    ChannelSpec("motor_speed_rpm", "r/min", 1.0),
    ChannelSpec("battery_voltage_v", "V", 0.002),
    ChannelSpec("battery_soc_pct", "%", 0.01),
    ChannelSpec("latitude_deg", "deg", 180.0 / 2**31, wide=True),
    ChannelSpec("longitude_deg", "deg", 180.0 / 2**31, wide=True),
)


def ridden() -> dict[str, Counts]:
    """A minute at 10 Hz: pedalled in strokes, ten seconds without samples, one without a speed."""
    t_s = np.arange(SECONDS * HZ) / HZ
    physical = {
        "speed_kmh": 18.0 + 0.05 * t_s,
        "cadence_rpm": np.full(len(t_s), 75.0),
        "rider_torque_nm": 20.0 + 12.0 * np.sin(2 * math.pi * 2.0 * t_s),
        "motor_torque_nm": np.full(len(t_s), 0.25),
        "motor_torque_demanded_nm": np.full(len(t_s), 0.3),
        "motor_speed_rpm": np.full(len(t_s), 3000.0),
        "battery_voltage_v": 40.0 - 0.01 * t_s,
        "battery_soc_pct": np.full(len(t_s), 81.0),
        "latitude_deg": 48.0 + 4.5e-6 * t_s * 10,
        "longitude_deg": np.full(len(t_s), 11.0),
    }
    physical["speed_kmh"][50:60] = np.nan
    for values in physical.values():
        values[GAP] = np.nan
    return {channel.name: channel.to_counts(physical[channel.name]) for channel in CHANNELS}


@pytest.fixture
def ride(store: Store) -> Ride:
    times_us = np.arange(SECONDS * HZ, dtype=np.int64) * (1_000_000 // HZ)
    one = Ride(
        id=0,
        state="live",
        origin="imported",
        name="Over <the> hill & back",
        notes="",
        started_us=START_S * 1_000_000,
        row_count=len(times_us),
        period_us=1_000_000 // HZ,
        channels=CHANNELS,
        derived=(),
        context=RideContext(gear_ratio=40.0),
    )
    return store.rides.add(one, RideRows(CHANNELS, times_us, ridden()), None)


def exported(store: Store, ride: Ride, file_format: str) -> bytes:
    return b"".join(Rides(store).export(ride.id, file_format).chunks)


def physical(name: str) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    channel = next(channel for channel in CHANNELS if channel.name == name)
    values: np.ndarray[tuple[int], np.dtype[np.float64]] = channel.to_values(ridden()[name])
    return values


def by_duckdb(path: Path) -> dict[str, list[float | None]]:
    """The columns of a table, times as seconds since 1970."""
    times = "epoch(time_utc) AS time_utc"
    with duckdb.connect() as connection:
        found = connection.execute(f"SELECT * REPLACE ({times}) FROM '{path}'")
        names = [one[0] for one in found.description or ()]
        return dict(zip(names, map(list, zip(*found.fetchall(), strict=True)), strict=True))


def by_polars(path: Path) -> dict[str, list[float | None]]:
    """The columns of a table, times as seconds since 1970."""
    parquet = path.suffix == ".parquet"
    table = polars.read_parquet(path) if parquet else polars.read_csv(path, try_parse_dates=True)
    seconds = polars.col("time_utc").dt.timestamp("us") / 1e6
    return table.with_columns(seconds).to_dict(as_series=False)


@pytest.mark.parametrize("reader", [by_duckdb, by_polars])
@pytest.mark.parametrize("file_format", ["parquet", "csv"])
def test_tables_hold_physical_units_and_time(
    store: Store, ride: Ride, tmp_path: Path, file_format: str, reader: Reader
) -> None:
    path = tmp_path / f"ride.{file_format}"
    path.write_bytes(exported(store, ride, file_format))
    found = reader(path)

    assert list(found)[:2] == ["time_utc", "t_s"]
    assert found["time_utc"][1] == pytest.approx(START_S + 0.1, abs=1e-6)
    assert found["t_s"][-1] == pytest.approx(SECONDS - 0.1)
    assert set(found) >= {channel.name for channel in CHANNELS}
    for channel in CHANNELS:
        values = np.array(found[channel.name], np.float64)
        least = 0.0 if file_format == "parquet" else channel.scale / 2
        np.testing.assert_allclose(values, physical(channel.name), atol=least, rtol=1e-12)


def test_a_column_of_parquet_tells_its_unit(store: Store, ride: Ride) -> None:
    schema = pq.read_schema(io.BytesIO(exported(store, ride, "parquet")))

    assert schema.field("rider_torque_nm").metadata == {b"unit": b"Nm"}


def test_csv_comes_back_as_the_same_samples(store: Store, ride: Ride) -> None:
    (back,) = read_file("ride.csv", exported(store, ride, "csv")).rides

    assert back.started_us == START_S * 1_000_000
    for channel in CHANNELS[:-2]:
        spec = next(c for c in back.rows.channels if c.name == channel.name)
        found = spec.to_values(back.rows.counts[channel.name])
        np.testing.assert_allclose(found, physical(channel.name), atol=spec.scale)


def by_fitdecode(data: bytes) -> Messages:
    """Name of the message and its fields by name."""
    with fitdecode.FitReader(io.BytesIO(data)) as reader:
        return [
            (frame.name, {one.name: one.value for one in frame.fields})
            for frame in reader
            if isinstance(frame, fitdecode.FitDataMessage)
        ]


def by_fit_tool(data: bytes) -> Messages:
    """The same, by another reader."""
    found = []
    for record in FitFile.from_bytes(data).records:
        if not record.is_definition:
            told = record.message
            fields = [*told.fields, *told.developer_fields]
            cells = {one.name: one.get_value() for one in fields if one.is_valid()}
            # It hands out a field's "no value" where that field has a scale.
            found.append((told.name, {k: v for k, v in cells.items() if v != NO_SPEED}))
    return found


def by_second(name: str) -> list[float]:
    """Means of ten samples, of seconds that have one."""
    rows = physical(name).reshape(SECONDS, HZ)
    return [float(np.nanmean(row)) for row in rows if np.isfinite(row).any()]


# Field of a record -> what it holds, and half of the least it can tell apart (and a rounding).
FIT_FIELDS: dict[str, tuple[Callable[[], list[float]], float]] = {
    "enhanced_speed": (lambda: [v / 3.6 for v in by_second("speed_kmh")], 0.00051),
    "cadence": (lambda: by_second("cadence_rpm"), 0.5),
    # Torque times angular speed: 20 Nm at 75 rpm are 157 W, 0.25 Nm at 3,000 r/min 78.5 W.
    "power": (lambda: [20.0 * 75.0 * math.pi / 30.0] * 50, 0.6),
    "motor_power": (lambda: [0.25 * 3000.0 * math.pi / 30.0] * 50, 0.6),
    "ebike_battery_level": (lambda: by_second("battery_soc_pct"), 0.5),
    "rider_torque": (lambda: by_second("rider_torque_nm"), 1e-5),
    "motor_torque": (lambda: by_second("motor_torque_nm"), 1e-5),
    "motor_torque_demanded": (lambda: by_second("motor_torque_demanded_nm"), 1e-5),
    "battery_voltage": (lambda: by_second("battery_voltage_v"), 1e-5),
}


@pytest.mark.parametrize("reader", [by_fitdecode, by_fit_tool])
@pytest.mark.parametrize("field", FIT_FIELDS)
def test_fit_tells_rider_and_motor_apart_second_by_second(
    store: Store, ride: Ride, reader: FitReader, field: str
) -> None:
    found = [cells for name, cells in reader(exported(store, ride, "fit")) if name == "record"]
    told, resolution = FIT_FIELDS[field]

    values = [one[field] for one in found if one.get(field) is not None]
    assert len(found) == SECONDS - 10
    assert values == pytest.approx(told(), abs=resolution)


def test_a_gap_stops_the_timer_instead_of_records_without_values(store: Store, ride: Ride) -> None:
    """Samples end at 30 s and go on at 40 s: the last second with one is the 29th."""
    told = by_fitdecode(exported(store, ride, "fit"))

    def since_start(cells: dict[str, Any]) -> float:
        return float(cells["timestamp"].timestamp()) - START_S

    events = [(cells["event_type"], since_start(cells)) for name, cells in told if name == "event"]
    assert events == [("start", 0), ("stop_all", 29), ("start", 40), ("stop_all", 59)]
    seconds = [since_start(cells) for name, cells in told if name == "record"]
    assert seconds == [*range(30), *range(40, 60)]
    (session,) = [cells for name, cells in told if name == "session"]
    assert (session["total_elapsed_time"], session["total_timer_time"]) == (60, 50)


def test_fit_comes_back_as_the_same_ride(store: Store, ride: Ride) -> None:
    outcome = read_file("ride.fit", exported(store, ride, "fit"))

    (back,) = outcome.rides
    assert (outcome.state, back.sport, back.started_us) == (
        "complete",
        "cycling",
        START_S * 1_000_000,
    )
    names = {channel.name for channel in back.rows.channels}
    assert {"rider_torque_nm", "motor_torque_nm", "motor_torque_demanded_nm"} <= names
    torque = next(c for c in back.rows.channels if c.name == "rider_torque_nm")
    values = torque.to_values(back.rows.counts["rider_torque_nm"])
    assert values[np.isfinite(values)].tolist() == pytest.approx(
        by_second("rider_torque_nm"), abs=torque.scale
    )


def by_gpxpy(data: bytes) -> Track:
    """Name, and the points of each segment: latitude, longitude, time."""
    (track,) = gpxpy.parse(data).tracks
    return track.name, [
        [(p.latitude, p.longitude, p.time) for p in segment.points] for segment in track.segments
    ]


def by_gpx(data: bytes) -> Track:
    """The same, by another reader."""
    (track,) = gpx.from_string(data.decode()).trk
    return track.name, [
        [(float(p.lat), float(p.lon), p.time) for p in segment.trkpt] for segment in track.trkseg
    ]


@pytest.mark.parametrize("reader", [by_gpxpy, by_gpx])
def test_gpx_is_a_track_whose_points_are_where_the_ride_was(
    store: Store, ride: Ride, reader: Callable[[bytes], Track]
) -> None:
    name, segments = reader(exported(store, ride, "gpx"))

    assert name == "Over <the> hill & back"
    assert [len(points) for points in segments] == [30, 20]
    seconds = [*range(30), *range(40, 60)]
    for (latitude, longitude, at), second in zip(chain(*segments), seconds, strict=True):
        # A second's position is its last; 7 decimals are told.
        assert latitude == pytest.approx(48.0 + 4.5e-5 * (second + 0.9), abs=1.5e-7)
        assert longitude == pytest.approx(11.0, abs=1.5e-7)
        assert at == datetime.fromtimestamp(START_S + second, UTC)


def test_a_gpx_file_comes_back_as_the_track_it_was(store: Store, ride: Ride) -> None:
    (back,) = read_file("track", exported(store, ride, "gpx")).rides

    assert back.started_us == START_S * 1_000_000
    assert len(back.rows.times_us) == SECONDS - 10
    latitude = next(c for c in back.rows.channels if c.name == "latitude_deg")
    told = latitude.to_values(back.rows.counts["latitude_deg"])
    assert told[0] == pytest.approx(48.0 + 4.5e-5 * 0.9, abs=1e-6)


def test_a_ride_without_a_position_is_no_track(store: Store, ride: Ride) -> None:
    times_us = np.arange(10, dtype=np.int64) * 1_000_000
    counts = {"speed_kmh": np.full(10, 1800, np.int16)}
    indoors = store.rides.add(
        Ride(0, "live", "imported", "", "", START_S * 1_000_000, 10, 1_000_000, CHANNELS[:1], (),
             RideContext()),
        RideRows(CHANNELS[:1], times_us, counts),
        None,
    )  # fmt: skip

    with pytest.raises(InvalidRequest, match="no position"):
        exported(store, indoors, "gpx")
