"""Goal: a ride's time and motor energy are found in the cells whose rules fired, and nowhere else.

Method: a few samples whose place in the table is plain, and shares worked out by hand. The points
are not evenly spaced, so that a share by index would be another.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

from backend.core.channels import Values
from backend.core.fuzzy_table import point_faults
from backend.rides.insight.table_use import TableUse, acting, table_use

SPEEDS = (5.0, 10.0, 16.0, 20.0, 25.0)
RATES = (0.0, 0.2, 0.4, 0.8, 1.0)


def used(
    speed_kmh: list[float], torque_rate: list[float], motor_power_w: list[float] | None = None
) -> TableUse:
    """Of samples that hold for two seconds each."""
    columns: dict[str, Values] = {
        "speed_kmh": np.array(speed_kmh),
        "torque_rate": np.array(torque_rate),
    }
    if motor_power_w is not None:
        columns["motor_power_w"] = np.array(motor_power_w)
    return table_use(columns, np.full(len(speed_kmh), 2.0), SPEEDS, RATES)


def cells(**seconds: float) -> npt.NDArray[np.float64]:
    """(5, 5) of nothing but what is named: `r1c2` is the second speed, the third torque rate."""
    table = np.zeros((5, 5))
    for name, value in seconds.items():
        table[int(name[1]), int(name[3])] = value
    return table


@pytest.mark.parametrize("row", range(5))
@pytest.mark.parametrize("column", range(5))
def test_a_sample_on_a_point_is_all_of_that_cell(row: int, column: int) -> None:
    use = used([SPEEDS[row]], [RATES[column]])

    np.testing.assert_allclose(use.seconds, cells(**{f"r{row}c{column}": 2.0}), atol=1e-12)


def test_a_sample_between_points_is_shared_as_the_sets_share_it() -> None:
    # 11.5 is a quarter of the way from 10 to 16, 0.7 three quarters of the way from 0.4 to 0.8.
    use = used([11.5], [0.7])

    shares = {
        "r1c2": 0.75 * 0.25,
        "r1c3": 0.75 * 0.75,
        "r2c2": 0.25 * 0.25,
        "r2c3": 0.25 * 0.75,
    }
    expected = cells(**{name: 2.0 * share for name, share in shares.items()})
    np.testing.assert_allclose(use.seconds, expected, atol=1e-12)


def test_beyond_the_points_all_of_it_is_the_outer_set_s() -> None:
    use = used([1.0, 33.0, 33.0], [0.1, -0.5, 7.0])

    # 0.1 is half way from 0 to 0.2; the other two lie beyond both ends.
    expected = cells(r0c0=1.0, r0c1=1.0, r4c0=2.0, r4c4=2.0)
    np.testing.assert_allclose(use.seconds, expected, atol=1e-12)


def test_motor_energy_goes_where_the_time_goes() -> None:
    # 900 W and 1800 W for two seconds are 0.5 Wh and 1 Wh; the second lies half way to 10 km/h.
    use = used([5.0, 7.5], [0.0, 0.0], [900.0, 1800.0])

    np.testing.assert_allclose(use.motor_wh, cells(r0c0=1.0, r1c0=0.5), atol=1e-12)
    assert use.motor_excluded_s == 0.0


def test_a_sample_without_motor_power_is_left_out_of_the_energy_and_said_to_be() -> None:
    use = used([5.0, 5.0], [0.0, 0.0], [900.0, np.nan])

    np.testing.assert_allclose(use.seconds, cells(r0c0=4.0))
    np.testing.assert_allclose(use.motor_wh, cells(r0c0=0.5))
    assert use.motor_excluded_s == 2.0


def test_rides_without_any_motor_power_have_no_energy_and_not_none_of_it() -> None:
    use = used([5.0], [0.0]) + used([5.0], [0.0]) + TableUse.none()

    assert use.motor_wh is None
    assert use.motor_excluded_s == 4.0
    with_one = use + used([5.0], [0.0], [1800.0])
    assert with_one.motor_wh is not None
    assert with_one.motor_wh[0, 0] == pytest.approx(1.0)


def test_the_cells_of_many_samples_add_up_to_their_time() -> None:
    random = np.random.default_rng(5)
    use = used(random.uniform(0, 40, 1000).tolist(), random.uniform(-0.2, 2, 1000).tolist())

    assert use.seconds.sum() == pytest.approx(2000.0)
    assert (use.seconds >= 0.0).all()


RIDDEN = {
    "speed_kmh": 12.0,
    "torque_rate": 0.1,
    "assist_mode": 3.0,
    "cadence_rpm": 60.0,
    "motor_torque_demanded_nm": 0.5,
    "fuzzy_gain": 0.3,
}


@pytest.mark.parametrize(
    ("channel", "value"),
    [
        ("assist_mode", 2.0),  # a mode of another law or table
        ("assist_mode", np.nan),
        ("cadence_rpm", 0.0),
        ("cadence_rpm", -5.0),
        ("motor_torque_demanded_nm", 0.0),
        ("motor_torque_demanded_nm", np.nan),
        ("fuzzy_gain", np.nan),  # walk assist
        ("torque_rate", np.nan),  # a gap
        ("speed_kmh", np.nan),
    ],
)
def test_only_what_the_table_decided_counts(channel: str, value: float) -> None:
    columns = {name: np.full(3, each) for name, each in RIDDEN.items()}
    columns[channel][1] = value

    assert acting(columns, [3, 4], needs_gain=False).tolist() == [True, False, True]


def test_a_gain_of_nothing_counts_unless_the_unit_has_none_while_the_torque_falls() -> None:
    columns = {name: np.full(2, each) for name, each in RIDDEN.items()}
    columns["fuzzy_gain"][1] = 0.0

    assert acting(columns, [3], needs_gain=False).tolist() == [True, True]
    assert acting(columns, [3], needs_gain=True).tolist() == [True, False]


def test_an_older_unit_s_motor_torque_says_what_was_asked() -> None:
    asked = RIDDEN["motor_torque_demanded_nm"]
    older = {name: value for name, value in RIDDEN.items() if name != "motor_torque_demanded_nm"}
    columns = {name: np.full(2, each) for name, each in older.items()}
    columns["motor_torque_nm"] = np.array([asked, 0.0])

    assert acting(columns, [3], needs_gain=False).tolist() == [True, False]


def test_points_are_proposed_that_divide_the_time_in_which_the_torque_rises() -> None:
    # A second at each of 400 rates that are spread evenly to 0.8, and as long at none.
    rates = np.concatenate([np.linspace(0.002, 0.8, 400), np.zeros(400)])
    seconds = np.ones(800)

    use = table_use({"speed_kmh": np.full(800, 10.0), "torque_rate": rates}, seconds, SPEEDS, RATES)

    # A quarter, a half, three quarters and 98 % of 0.8.
    assert use.proposed_rates() == pytest.approx((0.0, 0.2, 0.4, 0.6, 0.785), abs=0.006)
    assert (use + use).proposed_rates() == use.proposed_rates()


def test_points_stay_apart_where_all_rates_are_alike_and_a_short_rise_proposes_none() -> None:
    columns = {"speed_kmh": np.full(100, 10.0), "torque_rate": np.full(100, 0.01)}

    alike = table_use(columns, np.ones(100), SPEEDS, RATES).proposed_rates()

    assert alike == pytest.approx((0.0, 0.01, 0.015, 0.02, 0.025), abs=0.002)
    assert not list(point_faults("torque_rate_points", alike or ()))
    assert table_use(columns, np.full(100, 0.5), SPEEDS, RATES).proposed_rates() is None
