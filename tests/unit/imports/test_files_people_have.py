"""Goal: files as people have them, after public reports of other programs, give the right numbers.

Method: each file in `reported/` through the real reader and store. The right answers were worked
out from the numbers that made each file, or by an independent reader; none is from this code.
"""

from __future__ import annotations

import gzip
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

from backend.core.ride import Ride, iso_utc
from backend.imports.mapping import TableMapping
from backend.imports.service import Uploads
from backend.rides.insight.service import RideEnergy
from backend.store import Store
from tests.unit.imports.conftest import reader

REPORTED = Path(__file__).parent / "reported"
HERE = {"time_zone": "Europe/Berlin"}


@dataclass(frozen=True)
class Right:
    """What is right of a file. says: what its owner answers, None where nothing may be asked.
    figures: of the summary, None for what nobody knows."""

    name: str
    km: float | None = None
    rider_wh: float | None = None
    rows: int | None = None
    start: str | None = None
    says: dict[str, object] | None = None
    figures: dict[str, float | None] = field(default_factory=dict)


LATE_SUMMER = {
    "km": 5.41,
    "rider_wh": 41.14,
    "rows": 900,
    "start": "2025-09-05T15:12:01.000Z",
    "says": HERE,
}
RIGHT = (
    Right("c01_2024_10_12_17_03_48.csv", 5.41, 41.14, figures={"battery_wh": 53.13}),
    Right(
        "c02_float_control_2026-03-14_09-30-00.csv",
        5.41,
        says=HERE,
        figures={"battery_wh": 123.46, "motor_temperature_degc_max": 40.0, "rider_wh": None},
    ),
    Right(
        "c03_wheellog.csv",
        7.23,
        start="2025-05-10T12:03:22.000Z",
        says=HERE,
        figures={"battery_wh": 249.6, "rider_wh": None, "motor_wh": None},
    ),
    Right("c05_stages_2015-02-24.csv", 9.67, 46.46, says=HERE),
    Right("c06_decimal_comma.gpx", 3.71),
    Right("c07b_taveuni_beyond180.gpx", 6.31),
    Right("c08a_lon_single.gpx", 5.41),
    Right("c09b_new_both_opentracks.gpx", 7.23),
    Right("c10_dst_end_local.csv", 28.90, 214.95, 4800, "2025-10-26T00:30:00.000Z", HERE),
    Right("c11b_laps_reset.tcx", 19.26, rows=3200),
    Right("c12b_short_pause_two_tracks.tcx", rider_wh=81.59),
    Right("c14a_swap.fit", 43.20, figures={"battery_soc_pct_used": 109.0}),
    Right(
        "c15a_dev_ebike_native_numbers.fit",
        figures={"motor_wh": 93.15, "battery_soc_pct_used": 17.0},
    ),
    Right(
        "c15b_dev_ebike_no_native.fit", figures={"motor_wh": 93.15, "battery_soc_pct_used": 17.0}
    ),
    Right("c18a_german_excel_words.csv", **LATE_SUMMER),
    Right("c18b_german_excel_dates.csv", **LATE_SUMMER),
    Right("c18d_us_ampm.csv", **LATE_SUMMER | {"says": {**HERE, "date_order": "month_first"}}),
    Right("c18e_excel_serial.csv", **LATE_SUMMER),
    Right("c18f_date_and_time_columns.csv", **LATE_SUMMER),
    Right(
        "c19_logger_restarts_2025-06-01_10-00-00.csv",
        9.12,
        68.41,
        1500,
        "2025-06-01T08:00:00.000Z",
        HERE,
    ),
    Right("c22b_garmin_smart.gpx", 50.31),
    Right(
        "c24_vesc_reversed_2025-07-01_10-00-00.csv",
        says=HERE,
        figures={"speed_kmh_max": 29.5, "battery_wh": 49.87},
    ),
    Right("c26b_comma_sep_quoted_decimal_comma.csv", 5.41, 41.14, figures={"speed_kmh_max": 29.5}),
    Right("c27b_unix_us.csv", 5.41, 41.14, 900),
    Right("c32_assist_modes_0_to_3.fit", figures={"motor_wh": 75.0}),
    Right("c39a_thousands_point.csv", 5.41, 41.14),
    Right("c39b_thousands_comma_quoted.csv", 5.41, 41.14),
)


def no_config(_ride: Ride, _t_s: float = 0.0) -> tuple[dict[str, object], str]:
    """Of a file from elsewhere no configuration is kept."""
    return {}, "defaults"


@pytest.fixture
def uploads(store: Store) -> Uploads:
    return Uploads(store, reader=reader)


def ride_of(
    store: Store, uploads: Uploads, name: str, says: dict[str, object] | None = None
) -> Ride:
    """The one ride of a reported file."""
    upload = uploads.receive_file(name, gzip.decompress((REPORTED / f"{name}.gz").read_bytes()))
    if says is not None:
        assert upload.code == "needs_mapping", upload.detail
        upload = TableMapping(store, uploads).say(upload.id, says)
    assert upload.state == "complete", upload.detail
    (ride_id,) = upload.ride_ids
    return store.rides.get(ride_id)


@pytest.mark.parametrize("right", RIGHT, ids=lambda right: right.name)
def test_the_numbers_are_right(store: Store, uploads: Uploads, right: Right) -> None:
    ride = ride_of(store, uploads, right.name, right.says)

    summary = ride.summary
    assert summary is not None
    if right.km is not None:
        assert summary.distance_km == pytest.approx(right.km, abs=0.01)
    if right.rider_wh is not None:
        assert summary.rider_wh == pytest.approx(right.rider_wh, abs=0.01)
    if right.rows is not None:
        assert ride.row_count == right.rows
    if right.start is not None:
        assert iso_utc(ride.started_us) == right.start
    for name, figure in right.figures.items():
        shown = getattr(summary, name)
        assert shown == (None if figure is None else pytest.approx(figure, rel=5e-4)), name


def test_every_file_is_looked_at() -> None:
    named = {right.name for right in RIGHT}

    assert {path.name.removesuffix(".gz") for path in REPORTED.glob("*.gz")} == named


def test_the_doubled_hour_lasts_as_long_as_it_did(store: Store, uploads: Uploads) -> None:
    ride = ride_of(store, uploads, "c10_dst_end_local.csv", HERE)

    assert ride.summary is not None
    assert ride.summary.duration_s == 4799.0


def test_a_battery_that_was_changed_is_two_and_its_range_is_of_both(
    store: Store, uploads: Uploads
) -> None:
    ride = ride_of(store, uploads, "c14a_swap.fit")

    charge = RideEnergy(store, no_config)(ride.id)["charge"]
    assert [(jump.from_pct, jump.to_pct) for jump in charge.jumps] == [(12.0, 100.0)]
    assert charge.used_pct == pytest.approx(109.0)
    assert charge.full_range_km == pytest.approx(43.20 / 1.09, rel=1e-3)


def test_modes_are_counted_as_the_file_counts_them(store: Store, uploads: Uploads) -> None:
    ride = ride_of(store, uploads, "c32_assist_modes_0_to_3.fit")

    modes = RideEnergy(store, no_config)(ride.id)["modes"]

    assert [one["mode"] for one in modes] == [0, 1, 2, 3]
    assert [one["motor_wh"] for one in modes] == pytest.approx([0.0, 10.0, 23.3, 41.7], abs=0.05)


def test_what_a_motor_gives_back_is_no_work_of_the_battery(store: Store, uploads: Uploads) -> None:
    """129.82 Wh went out of the battery, 6.36 Wh came back."""
    ride = ride_of(store, uploads, "c02_float_control_2026-03-14_09-30-00.csv", HERE)
    reader = store.rides.reader(ride.id)
    power_w = reader.values(["battery_power_w"])["battery_power_w"]

    work_wh = power_w * reader.row_seconds() / 3600.0
    assert np.nansum(np.maximum(work_wh, 0.0)) == pytest.approx(129.82, abs=0.1)
    assert np.nansum(np.minimum(work_wh, 0.0)) == pytest.approx(-6.36, abs=0.1)


def test_a_pause_within_a_lap_is_one_and_its_length_is_known(
    store: Store, uploads: Uploads
) -> None:
    ride = ride_of(store, uploads, "c12b_short_pause_two_tracks.tcx")

    (pause,) = ride.metadata.pauses
    assert pause.to_s - pause.from_s == 9.0
    assert [(gap.to_s - gap.from_s) for gap in ride.gaps] == [9.0]


def test_a_controller_mounted_the_other_way_round_is_said(store: Store, uploads: Uploads) -> None:
    ride = ride_of(store, uploads, "c24_vesc_reversed_2025-07-01_10-00-00.csv", HERE)

    assert ride.intake is not None
    assert "speed_kmh" in ride.intake.turned


def test_what_nobody_could_reach_is_left_out_and_said(store: Store, uploads: Uploads) -> None:
    ride = ride_of(store, uploads, "c08a_lon_single.gpx")

    assert ride.intake is not None
    assert ride.intake.values_dropped == {"latitude_deg": 1, "longitude_deg": 1}


def test_counts_that_began_anew_are_said(store: Store, uploads: Uploads) -> None:
    laps = ride_of(store, uploads, "c11b_laps_reset.tcx")
    logger = ride_of(store, uploads, "c19_logger_restarts_2025-06-01_10-00-00.csv", HERE)

    assert laps.intake is not None
    assert logger.intake is not None
    assert laps.intake.restarts["distance_m"] == len(laps.metadata.laps) - 1
    assert logger.intake.restarts["time"] >= 1


@pytest.mark.parametrize(
    ("name", "titles"),
    [
        ("c17b_mac.zip", {"Überm Schönbuch", "晨骑"}),
        ("c17c_windows_backslash.zip", {"Überm Schönbuch – früh", "晨骑 莫干山"}),
        ("c17e_utf8_name_noflag.zip", {"晨骑"}),
    ],
)
def test_an_archive_keeps_its_names_and_counts_no_side_files(
    store: Store, uploads: Uploads, name: str, titles: set[str]
) -> None:
    upload = uploads.receive_file(name, (REPORTED / name).read_bytes())

    assert (upload.state, upload.code) == ("complete", None), upload.detail
    assert {store.rides.get(ride_id).name for ride_id in upload.ride_ids} == titles
