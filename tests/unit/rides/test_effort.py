"""Goal: zones, bands and best powers are those that an independent count finds.

Method: rides second by second and at 100 Hz whose time in each zone is known; the power curve
against a search through every begin and end, on rows of uneven length with gaps.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.rides.insight.effort import (
    Seconds,
    by_seconds,
    cadence_time,
    heart_time,
    lap_figures,
    power_time,
    torque_time,
)
from backend.rides.insight.power_curve import power_curve


def whole_seconds(**columns: list[float]) -> Seconds:
    values = {name: np.array(column, np.float64) for name, column in columns.items()}
    count = len(next(iter(values.values())))
    return by_seconds(values, np.arange(count, dtype=np.float64), np.ones(count))


def test_power_zones_are_those_of_allen_and_coggan() -> None:
    # At a threshold of 200 W the zones meet at 110, 150, 180, 210, 240 and 300 W.
    ride = whole_seconds(
        rider_power_w=[0, 100, 111, 149, 151, 181, 209, 211, 241, 301, 900, np.nan],
        cadence_rpm=[0, *[80] * 11],
    )
    told = power_time(ride, 200.0)

    assert told is not None
    assert [band.seconds for band in told.bands] == [1, 2, 1, 2, 1, 1, 2]
    assert [band.high for band in told.bands] == pytest.approx([110, 150, 180, 210, 240, 300, None])
    assert (told.zones, told.valid_s, told.unknown_s) == (True, 10.0, 1.0)


def test_without_a_threshold_there_are_bands_and_no_zones() -> None:
    ride = whole_seconds(rider_power_w=[120, 130, 160, 260], heart_rate_bpm=[118, 121, 122, 139])
    power, heart = power_time(ride, None), heart_time(ride, None)

    assert power is not None
    assert heart is not None
    assert (power.zones, power.reference) == (False, None)
    assert [(band.low, band.high, band.seconds) for band in power.bands] == [
        (None, 150.0, 2),
        (150.0, 200.0, 1),
        (200.0, 250.0, 0),
        (250.0, None, 1),
    ]
    assert [band.seconds for band in heart.bands] == [1, 2, 1]


def test_heart_rate_zones_meet_at_tenths_of_the_greatest() -> None:
    told = heart_time(whole_seconds(heart_rate_bpm=[110, 115, 135, 155, 175, 200]), 190.0)

    assert told is not None
    assert [band.seconds for band in told.bands] == [1, 1, 1, 1, 2]
    assert (told.mean, told.most) == (pytest.approx(890 / 6), 200.0)


def test_torque_of_a_head_unit_is_power_over_cadence() -> None:
    ride = whole_seconds(rider_power_w=[0, 157.08, 314.16], cadence_rpm=[0, 60, 60])
    told, turns = torque_time(ride), cadence_time(ride)

    assert told is not None
    assert turns is not None
    # 157.08 W at 2 pi rad/s are 25 Nm.
    assert [(band.high, band.seconds) for band in told.bands if band.seconds] == [
        (30.0, 1),
        (None, 1),
    ]
    assert turns.valid_s == 2.0
    assert power_time(whole_seconds(cadence_rpm=[60]), 200.0) is None


def test_the_swing_within_a_stroke_is_in_no_zone() -> None:
    # Legs push 0 to 400 W and back twice a turn at 60 rpm; their mean of a second is 200 W.
    start_s = np.arange(1000) / 100.0
    power = 200.0 - 200.0 * np.cos(4 * np.pi * start_s)
    ride = by_seconds({"rider_power_w": power}, start_s, np.full(1000, 0.01))
    told = power_time(ride, 200.0)

    assert told is not None
    assert [band.seconds for band in told.bands] == pytest.approx([0, 0, 0, 10, 0, 0, 0])


def searched(power: np.ndarray, start_s: np.ndarray, row_s: np.ndarray, length: int) -> float:
    """The best mean by trying every tenth of a second."""
    timeline = np.full(round((start_s[-1] + row_s[-1]) * 10), np.nan)
    for watts, begin, held in zip(power, start_s, row_s, strict=True):
        timeline[round(begin * 10) : round((begin + held) * 10)] = watts
    windows = np.lib.stride_tricks.sliding_window_view(timeline, length * 10)
    means = windows.mean(axis=1)
    return float(np.nanmax(means)) if np.isfinite(means).any() else -1.0


@pytest.mark.parametrize("seed", range(5))
def test_the_power_curve_is_what_trying_every_begin_finds(seed: int) -> None:
    random = np.random.default_rng(seed)
    row_s = random.integers(1, 40, 300) / 10.0
    pauses = np.where(random.random(300) < 0.02, 20.0, 0.0)
    start_s = np.append(0.0, np.cumsum(row_s + pauses)[:-1])
    power = random.uniform(0.0, 500.0, 300).round()
    power[random.random(300) < 0.01] = np.nan

    curve = power_curve(power, start_s, row_s)

    assert len(curve) > 6
    for best in curve[:-1]:
        assert best.power_w == pytest.approx(
            searched(power, start_s, row_s, int(best.duration_s)), abs=1e-6
        )
    assert searched(power, start_s, row_s, int(curve[-1].duration_s) + 1) == -1.0


def test_even_rows_with_a_hole_are_searched_as_exactly() -> None:
    random = np.random.default_rng(9)
    power = random.uniform(0.0, 500.0, 3000).round()
    power[[700, 701, 2000]] = np.nan
    start_s, row_s = np.arange(3000) / 10.0, np.full(3000, 0.1)

    for best in power_curve(power, start_s, row_s)[:-1]:
        assert best.power_w == pytest.approx(
            searched(power, start_s, row_s, int(best.duration_s)), abs=1e-6
        )


def test_a_ride_without_a_gap_ends_its_curve_with_its_mean() -> None:
    power = np.repeat([100.0, 300.0, 200.0], 40)
    curve = power_curve(power, np.arange(120.0), np.ones(120))

    assert (curve[-1].duration_s, curve[-1].power_w) == pytest.approx((120.0, 200.0))
    assert next(best for best in curve if best.duration_s == 30).power_w == 300.0
    assert power_curve(np.full(5, np.nan), np.arange(5.0), np.ones(5)) == []


def test_a_lap_is_the_mean_of_its_own_rows() -> None:
    power = np.repeat([100.0, 300.0, np.nan], 10)
    seconds, start_s = np.ones(30), np.arange(30.0)
    laps = [(0.0, 10.0), (10.0, 30.0), (20.0, 30.0)]
    told = lap_figures({"rider_power_w": power}, start_s, seconds, np.full(30, 5.0), laps)

    assert [lap.rider_power_w_mean for lap in told] == [100.0, 300.0, None]
    assert [lap.distance_km for lap in told] == pytest.approx([0.05, 0.1, 0.05])
    assert [lap.seconds for lap in told] == [10.0, 20.0, 10.0]
    assert told[0].heart_rate_bpm_mean is None
