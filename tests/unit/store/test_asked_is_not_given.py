"""Goal: a ride says whether its motor torque was asked for or given, and what was only asked is
never added up as the motor's energy, in a database of before either.

Method: rides of a unit of before and of now, finished in a store; then the database is set back to
the schema before, with the figures that version made, and opened again.
"""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from backend.core.channels import ChannelSpec
from backend.core.ride import Ride, RideContext
from backend.formats.tables import read_table
from backend.rides.service import Rides
from backend.store import Store
from tests.unit.store.ride_data import PERIOD_US, STARTED_US

ROWS = 1000
NM, RPM = ChannelSpec("motor_torque_nm", "Nm", 0.0001), ChannelSpec("motor_speed_rpm", "rpm", 0.2)
ASKED = ChannelSpec("motor_torque_demanded_nm", "Nm", 0.0001)
TOLD_W = ChannelSpec("motor_power_w", "W", 1.0)
# 1 Nm at 2,400 r/min for ten seconds.
MOTOR_WH = 80.0 * np.pi * 10.0 / 3600.0
VALUES = {NM: 10_000, RPM: 12_000, ASKED: 15_000, TOLD_W: 200}


def ridden(store: Store, *channels: ChannelSpec) -> Ride:
    context = RideContext(gear_ratio=40.34)
    ride_id = store.rides.start_live(channels, PERIOD_US, STARTED_US, context)
    rows = np.tile(np.array([VALUES[channel] for channel in channels], np.int16), (ROWS, 1))
    store.rides.append_tail(ride_id, 0, rows).result()
    ride = store.rides.finish(ride_id)
    assert ride is not None
    return ride


def motor_figures(ride: Ride) -> tuple[float | None, ...]:
    found = ride.summary
    assert found is not None
    return (
        found.motor_wh,
        found.motor_excluded_s,
        found.motor_power_w_mean,
        found.motor_power_w_max,
    )


def test_what_a_unit_of_before_asked_is_no_energy_and_what_one_of_now_gave_is(
    store: Store,
) -> None:
    before, now = ridden(store, NM, RPM), ridden(store, NM, RPM, ASKED)

    assert (before.motor_torque_meaning, now.motor_torque_meaning) == ("demanded", "delivered")
    assert motor_figures(before) == (None, None, None, None)
    assert motor_figures(now)[0] == pytest.approx(MOTOR_WH, rel=1e-3)
    assert "motor_power_w" not in [channel.name for channel in before.offered]


def test_an_export_names_what_its_motor_torque_is(store: Store, tmp_path: Path) -> None:
    exports = Rides(store)
    told = []
    for channels in ((NM, RPM), (NM, RPM, ASKED)):
        ride = ridden(store, *channels)
        text = b"".join(exports.export(ride.id, "csv").chunks)
        header = next(csv.reader(io.StringIO(text.decode())))
        file = tmp_path / f"{ride.id}.parquet"
        file.write_bytes(b"".join(exports.export(ride.id, "parquet").chunks))
        facts = b"".join(pq.read_metadata(file).metadata.values()).decode()
        (again,) = read_table(text).rides
        names = [channel.name for channel in again.rows.channels]
        told.append((header[2:], names, f'"motor_torque_meaning": "{ride.motor_torque_meaning}"'))
        assert told[-1][2].replace(" ", "") in facts.replace(" ", "")

    assert told[0][0] == told[0][1] == ["motor_torque_demanded_nm", "motor_speed_rpm"]
    assert told[1][0] == told[1][1] == [NM.name, RPM.name, ASKED.name]
