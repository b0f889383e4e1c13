"""Goal: a ride's figures are physics, and rider, motor and battery are never mixed.

Method: rides whose energy, distance and times can be written down in closed form.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from backend.core.breaks import find_breaks
from backend.core.channels import MISSING_INT16, MISSING_INT32, ChannelSpec, Values
from backend.core.energy import derivable, derive, energy, motor_torque_meaning, sample_seconds
from backend.core.ride import TimesUs, find_gaps, summarise

HOUR_ROWS = 36_000
TENTH_US = 100_000


def regular(rows: int, period_us: int = TENTH_US) -> TimesUs:
    return np.arange(rows, dtype=np.int64) * period_us


def steady(**values: float) -> dict[str, Values]:
    return {name: np.full(HOUR_ROWS, value) for name, value in values.items()}


def test_an_hour_at_20_nm_and_60_rpm_is_125_7_wh_of_the_rider() -> None:
    columns = steady(rider_torque_nm=20.0, cadence_rpm=60.0)

    power_w = derive("rider_power_w", columns, None)
    summary = summarise({**columns, "rider_power_w": power_w}, regular(HOUR_ROWS), TENTH_US)

    assert power_w[0] == pytest.approx(20.0 * 2.0 * math.pi)
    assert summary.rider_wh == pytest.approx(40.0 * math.pi, rel=1e-9)
    assert summary.motor_wh is None
    assert summary.battery_wh is None


def test_a_sine_of_torque_has_the_energy_of_its_mean() -> None:
    times = regular(HOUR_ROWS)
    torque = 30.0 * np.sin(2.0 * math.pi * times / 1e6) ** 2
    columns = {"rider_torque_nm": torque, "cadence_rpm": np.full(HOUR_ROWS, 90.0)}

    seconds = sample_seconds(times, find_breaks({}, times))
    spent = energy(derive("rider_power_w", columns, None), seconds)

    assert spent.wh == pytest.approx(15.0 * 90.0 * 2.0 * math.pi / 60.0, rel=1e-9)


def test_the_motor_s_power_is_mechanical_and_the_battery_s_is_electrical() -> None:
    columns = steady(
        motor_torque_nm=1.0,
        motor_torque_demanded_nm=1.5,
        motor_speed_rpm=2400.0,
        battery_voltage_v=36.0,
        battery_current_a=8.0,
        rider_torque_nm=10.0,
        cadence_rpm=60.0,
    )
    for channel in derivable(columns.keys(), 40.0):
        columns[channel.name] = derive(channel.name, columns, 40.0)

    summary = summarise(columns, regular(HOUR_ROWS), TENTH_US)

    assert summary.motor_wh == pytest.approx(80.0 * math.pi, rel=1e-9)
    assert summary.battery_wh == pytest.approx(288.0, rel=1e-9)
    assert summary.rider_wh == pytest.approx(20.0 * math.pi, rel=1e-9)
    assert columns["motor_torque_crank_nm"][0] == pytest.approx(40.0)
    assert columns["motor_torque_demanded_crank_nm"][0] == pytest.approx(60.0)


def test_what_was_only_asked_of_the_motor_is_no_motor_energy() -> None:
    columns = steady(
        motor_torque_nm=1.0, motor_speed_rpm=2400.0, battery_voltage_v=36.0, battery_current_a=8.0
    )
    for channel in derivable(columns.keys(), 40.0):
        columns[channel.name] = derive(channel.name, columns, 40.0)

    summary = summarise(columns, regular(HOUR_ROWS), TENTH_US)

    assert summary.motor_wh is summary.motor_power_w_mean is summary.motor_excluded_s is None
    assert summary.battery_wh == pytest.approx(288.0, rel=1e-9)
    assert summary.motor_torque_nm_max == 1.0


@pytest.mark.parametrize(
    ("recorded", "meaning"),
    [
        (("speed_kmh", "motor_torque_nm"), "demanded"),
        (("motor_torque_nm", "motor_torque_demanded_nm"), "delivered"),
        (("motor_torque_demanded_nm",), "demanded"),
        (("speed_kmh", "motor_power_w"), None),
    ],
)
def test_a_motor_torque_was_given_only_where_what_was_asked_stands_beside_it(
    recorded: tuple[str, ...], meaning: str | None
) -> None:
    assert motor_torque_meaning(recorded) == meaning


def test_time_without_a_sample_is_left_out_of_the_energy_and_told() -> None:
    columns = steady(rider_torque_nm=20.0, cadence_rpm=60.0)
    columns["cadence_rpm"][: HOUR_ROWS // 4] = np.nan

    power_w = derive("rider_power_w", columns, None)
    summary = summarise({**columns, "rider_power_w": power_w}, regular(HOUR_ROWS), TENTH_US)

    assert summary.rider_wh == pytest.approx(30.0 * math.pi, rel=1e-9)
    assert summary.rider_excluded_s == pytest.approx(900.0)
    assert summary.rider_power_w_mean == pytest.approx(40.0 * math.pi, rel=1e-9)


def test_a_channel_the_ride_lacks_has_no_figure_and_not_a_zero() -> None:
    summary = summarise(steady(heart_rate_bpm=120.0), regular(HOUR_ROWS), TENTH_US)

    assert summary.duration_s == pytest.approx(3599.9)
    assert summary.distance_km is None
    assert summary.rider_wh is None
    assert summary.cadence_rpm_mean is None


def test_distance_is_speed_times_time_and_standing_is_not_moving() -> None:
    speed = np.full(HOUR_ROWS, 18.0)
    speed[: HOUR_ROWS // 2] = 0.0

    summary = summarise({"speed_kmh": speed}, regular(HOUR_ROWS), TENTH_US)

    assert summary.distance_km == pytest.approx(9.0)
    assert summary.moving_s == pytest.approx(1800.0)
    assert summary.speed_kmh_mean == pytest.approx(18.0)


def test_at_exactly_the_bound_a_bike_still_stands() -> None:
    """SPEC 2.5: it moves when it is faster than 1 km/h."""
    speed = np.repeat([1.0, 1.01], HOUR_ROWS // 2)

    summary = summarise({"speed_kmh": speed}, regular(HOUR_ROWS), TENTH_US)

    assert summary.moving_s == pytest.approx(1800.0)


def test_a_pause_of_a_head_unit_is_neither_ridden_nor_powered() -> None:
    before = np.arange(600, dtype=np.int64) * 1_000_000
    times = np.concatenate((before, before + 600_000_000 + 1_800_000_000))
    columns = {"speed_kmh": np.full(1200, 36.0), "rider_power_w": np.full(1200, 180.0)}

    summary = summarise(columns, times, None)
    gaps = find_gaps(times, np.zeros(1200, bool), find_breaks({}, times))

    assert summary.distance_km == pytest.approx(12.0)
    assert summary.rider_wh == pytest.approx(60.0)
    assert [(gap.from_s, gap.to_s) for gap in gaps] == [(599.0, 2400.0)]


def test_mean_cadence_counts_turning_cranks_only() -> None:
    cadence = np.full(HOUR_ROWS, 80.0)
    cadence[::2] = 0.0

    summary = summarise({"cadence_rpm": cadence}, regular(HOUR_ROWS), TENTH_US)

    assert summary.cadence_rpm_mean == pytest.approx(80.0)


def test_a_recorded_power_is_not_derived_again() -> None:
    recorded = ("rider_power_w", "rider_torque_nm", "cadence_rpm", "motor_torque_nm")

    assert derivable(recorded, None) == ()
    assert [channel.name for channel in derivable(recorded, 40.34)] == ["motor_torque_crank_nm"]


@pytest.mark.parametrize(("wide", "missing"), [(False, MISSING_INT16), (True, MISSING_INT32)])
def test_counts_come_back_exactly_and_missing_stays_missing(wide: bool, missing: int) -> None:
    channel = ChannelSpec("rider_torque_nm", "Nm", 0.01, wide)
    counts = np.array([0, 1, -1, 32_767, -32_767, missing], channel.dtype)

    values = channel.to_values(counts)

    assert np.isnan(values[-1])
    assert values[3] == pytest.approx(327.67)
    assert channel.to_counts(values).tolist() == counts.tolist()


def test_what_does_not_fit_a_channel_is_missing_and_not_wrapped() -> None:
    channel = ChannelSpec("rider_torque_nm", "Nm", 0.01)

    counts = channel.to_counts(np.array([400.0, -400.0, np.inf, 1.0]))

    assert counts.tolist() == [MISSING_INT16, MISSING_INT16, MISSING_INT16, 100]


def test_a_track_without_speed_or_odometer_is_as_long_as_the_way_over_the_ground() -> None:
    """A hundredth of a degree along the equator is 1111.95 m, along the parallel at 60 degrees
    half of that. What nobody can ride in the time is not counted, nor what has no position."""
    times_us = np.array([0, 60, 120, 180, 7200, 7260], dtype=np.int64) * 1_000_000
    longitude = np.array([10.0, 10.005, 10.01, np.nan, 50.0, 50.01])

    for latitude_deg, share in ((0.0, 1.0), (60.0, 0.5)):
        latitude = np.where(np.isnan(longitude), np.nan, latitude_deg)
        values = {"latitude_deg": latitude, "longitude_deg": longitude}
        distance_km = summarise(values, times_us, None).distance_km

        assert distance_km == pytest.approx(2 * 1.11195 * share, rel=1e-4)
