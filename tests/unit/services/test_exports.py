"""Goal: what leaves as a file is what was ridden, in physical units, and comes back as that ride.

Method: a ride with every kind of channel is exported; CSV, Parquet and FIT are read back by Spindle
or by a reader that is not ours, GPX by an XML parser, and compared with what went in.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from xml.etree import ElementTree

import fitdecode
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from backend.domain.channels import ChannelSpec, Counts
from backend.domain.ride import Ride, RideContext, RideRows
from backend.errors import InvalidRequest
from backend.ingest.formats import read_file
from backend.services.rides.review import Rides
from backend.store import Store, open_store

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
def store(tmp_path: Path) -> Iterator[Store]:
    urls = (f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "objects").as_uri())
    with open_store(*urls) as opened:
        yield opened


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


def test_parquet_holds_physical_units_and_time(store: Store, ride: Ride) -> None:
    table = pq.read_table(io.BytesIO(exported(store, ride, "parquet")))

    assert table.column_names == ["time_utc", "t_s", *(channel.name for channel in CHANNELS)]
    assert table["time_utc"][1].as_py() == datetime.fromtimestamp(START_S + 0.1, UTC)
    assert table["t_s"][-1].as_py() == pytest.approx(SECONDS - 0.1)
    assert table.schema.field("rider_torque_nm").metadata == {b"unit": b"Nm"}
    for channel in CHANNELS:
        column = table[channel.name].combine_chunks()
        assert column.null_count == int(np.isnan(physical(channel.name)).sum())
        found = column.cast(pa.float64()).to_numpy(zero_copy_only=False)
        np.testing.assert_array_equal(found, physical(channel.name))


def test_csv_comes_back_as_the_same_samples(store: Store, ride: Ride) -> None:
    (back,) = read_file("ride.csv", exported(store, ride, "csv")).rides

    assert back.started_us == START_S * 1_000_000
    for channel in CHANNELS[:-2]:
        spec = next(c for c in back.rows.channels if c.name == channel.name)
        found = spec.to_values(back.rows.counts[channel.name])
        np.testing.assert_allclose(found, physical(channel.name), atol=spec.scale)


def records(data: bytes) -> list[dict[str, object]]:
    with fitdecode.FitReader(io.BytesIO(data)) as reader:
        return [
            {one.name: one.value for one in frame.fields}
            for frame in reader
            if isinstance(frame, fitdecode.FitDataMessage) and frame.name == "record"
        ]


def by_second(name: str) -> list[float]:
    """Means of ten samples, of seconds that have one."""
    rows = physical(name).reshape(SECONDS, HZ)
    return [float(np.nanmean(row)) for row in rows if np.isfinite(row).any()]


def test_fit_tells_rider_and_motor_apart_second_by_second(store: Store, ride: Ride) -> None:
    """Power is torque times speed: 20 Nm at 75 rpm are 157 W, 0.25 Nm at 3,000 r/min 78.5 W."""
    found = records(exported(store, ride, "fit"))

    assert len(found) == SECONDS
    seconds = [one for one in found if one["rider_torque"] is not None]
    assert [
        one["rider_torque"] for one in seconds if one["rider_torque"] == one["rider_torque"]
    ] == (pytest.approx(by_second("rider_torque_nm"), abs=1e-5))
    assert found[0]["power"] == pytest.approx(157, abs=1)
    assert found[0]["motor_power"] == pytest.approx(78.5, abs=1)
    assert found[0]["motor_torque"] == pytest.approx(0.25)
    assert found[0]["motor_torque_demanded"] == pytest.approx(0.3)
    assert found[0]["enhanced_speed"] == pytest.approx((18.0 + 0.05 * 0.45) / 3.6, abs=0.001)
    assert found[5]["enhanced_speed"] is None
    assert found[33]["power"] is None


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


def test_gpx_is_a_track_whose_points_are_where_the_ride_was(store: Store, ride: Ride) -> None:
    tree = ElementTree.fromstring(exported(store, ride, "gpx"))

    space = {"g": "http://www.topografix.com/GPX/1/1"}
    points = tree.findall(".//g:trkpt", space)
    assert tree.findtext(".//g:name", namespaces=space) == "Over <the> hill & back"
    assert len(points) == SECONDS - 10
    assert float(points[0].attrib["lat"]) == pytest.approx(48.0 + 4.5e-5 * 0.9, abs=1e-6)
    assert points[0].findtext("g:time", namespaces=space) == "2023-11-14T22:13:20Z"


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
