"""Goal: a recorded ride through the law says what the motor would have done, and how much work.

Method: rides with constant readings, whose torque, work and limits can be worked out by hand.
"""

from typing import Any

import numpy as np
import pytest

from backend.errors import InvalidRequest
from backend.law import raw_counts_of, replay
from firmware_protocol.parameters import default_config

CONFIG = default_config()
FIXED, FUZZY = 2, 3


def steady(steps: int = 6000, **changes: Any) -> dict[str, Any]:
    ride = {
        "speed_kmh": np.full(steps, 12.0),
        "cadence_rpm": np.full(steps, 60.0),
        "torque_raw_counts": np.full(steps, 3000.0),
        "mode": FIXED,
    }
    return {**ride, **changes}


def test_a_minute_of_equal_assist_does_the_riders_own_work() -> None:
    result = replay(CONFIG, **steady())

    # 30 Nm at 60 rpm for a minute, through a gear without losses; the start costs half a second.
    rider_wh = 30.0 * 2 * np.pi * 60 / 3600
    assert result.motor_work_wh == pytest.approx(rider_wh, rel=0.02)
    assert result.motor_torque_nm_max == pytest.approx(30.0 / 40.34, rel=1e-4)
    assert not np.isnan(result.motor_torque_nm).any()


def test_newton_metres_go_back_to_the_counts_they_came_from() -> None:
    config = {**CONFIG, "sensor_offset_counts": 120.0, "sensor_gain_nm_per_count": 0.02}

    assert raw_counts_of(config, [0.0, 30.0]).tolist() == [120.0, 1620.0]


def test_another_table_changes_the_assist() -> None:
    before = replay(CONFIG, **steady(mode=FUZZY))
    after = replay({**CONFIG, "fuzzy_rules": [["NB"] * 5] * 5}, **steady(mode=FUZZY))

    assert after.assist_ratio[-1] == pytest.approx(1.1, abs=0.001)
    assert before.assist_ratio[-1] > 1.2


def test_a_configuration_kept_by_version_0_2_is_the_same_law() -> None:
    old_words = {
        "mode_laws": ["OFF", "FIXED", "FIXED", "FUZZY", "FUZZY"],
        "fuzzy_inference": "MAMDANI_CENTROID",
        "market": "EU_EPAC",
    }
    now = replay(CONFIG, **steady(mode=FUZZY))
    then = replay({**CONFIG, **old_words}, **steady(mode=FUZZY))

    assert then.motor_work_wh == now.motor_work_wh
    assert now.motor_work_wh > 0.0


def test_missing_samples_give_no_assist_and_are_counted() -> None:
    torque = np.full(1000, 3000.0)
    torque[500:600] = np.nan

    result = replay(CONFIG, **steady(1000, torque_raw_counts=torque))

    assert result.limit_shares["input_refused"] == pytest.approx(0.1)
    assert not result.motor_torque_nm[500:600].any()
    assert result.motor_torque_nm[-1] > 0.5


def test_a_mode_nobody_recorded_gives_no_assist_instead_of_a_guess() -> None:
    mode = np.where(np.arange(1000) < 600, 3.0, np.nan)

    result = replay(CONFIG, **steady(1000, mode=mode))

    assert result.limit_shares["input_refused"] == pytest.approx(0.4)
    assert result.limit_shares["mode_off"] == 0.0


def test_limits_that_held_the_motor_are_told_as_shares_of_the_ride() -> None:
    speed = np.where(np.arange(1000) < 500, 12.0, 26.0)

    shares = replay(CONFIG, **steady(1000, speed_kmh=speed, mode=FUZZY)).limit_shares

    assert shares["speed_cutoff"] == pytest.approx(0.5)
    assert shares["brake"] == 0.0


def test_an_empty_ride_is_an_empty_answer() -> None:
    result = replay(CONFIG, [], [], [], FIXED)

    assert result.motor_torque_nm.size == 0
    assert result.motor_work_wh == 0.0


@pytest.mark.parametrize(
    "changes",
    [
        {"speed_kmh": np.zeros(3)},
        {"mode": "sport"},
        {"cadence_rpm": ["fast"]},
    ],
)
def test_readings_that_do_not_fit_are_refused(changes: dict[str, Any]) -> None:
    with pytest.raises(InvalidRequest, match="replay"):
        replay(CONFIG, **steady(10, **changes))


def test_an_incomplete_configuration_is_refused() -> None:
    with pytest.raises(InvalidRequest, match="gear_ratio"):
        replay({name: v for name, v in CONFIG.items() if name != "gear_ratio"}, **steady(10))


def test_the_recorded_current_and_temperature_tell_what_the_battery_s_limit_left() -> None:
    hill = steady(400, torque_raw_counts=np.full(400, 11000.0), mode=FUZZY)
    hill |= {"motor_speed_rpm": np.full(400, 2400.0), "battery_voltage_v": 40.0}
    measured = {"battery_current_a": 0.0, "motor_temperature_degc": 20.0}

    taken_w = []
    for recorded, ohm in ((measured, 0.25), ({}, 0.25 * (1 + 0.00393 * 110))):
        torque_nm = float(replay(CONFIG, **hill, **recorded).motor_torque_nm[-1])
        taken_w.append(torque_nm * 2400 * np.pi / 30 + (torque_nm / 0.112) ** 2 * ohm)

    # A motor of copper alone; and one that nobody measured: 22 W of margin, and as hot as 130 degC.
    assert taken_w == pytest.approx([432.0, 410.0], rel=1e-3)
