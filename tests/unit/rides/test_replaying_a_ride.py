"""Goal: a ride is replayed with everything the law was given on it, and the answer says what of
that the ride lacks.

Method: rides made row by row, kept in a real store and replayed. What the motor gives is certain:
nothing while a brake is on, a fault forbids torque or the torque reading is too old.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from backend.core.assist_mode import AssistModes
from backend.core.channels import Values
from backend.core.fuzzy_table import THESIS_TABLE
from backend.errors import InvalidRequest
from backend.law import law_defaults
from backend.rides.replay.service import RideReplay
from backend.store import Store
from backend.tuning.preview import Preview
from firmware_protocol._generated import InputFlags, LimitFlags
from tests.fakes.kept_rides import config_of, imported_ride

ROWS, PERIOD_US = 1000, 10_000
PUSHING = {
    "speed_kmh": 12.0,
    "cadence_rpm": 60.0,
    "rider_torque_raw": 3000.0,
    "motor_speed_rpm": 2400.0,
    "battery_voltage_v": 36.0,
    "battery_current_a": 2.0,
    "motor_temperature_degc": 30.0,
    "controller_temperature_degc": 30.0,
    "torque_age_ms": 2.0,
    "input_flags": 0.0,
    "assist_mode": 2.0,
}
SPORT = {"assist_modes": None, "fuzzy_table": None}
HELD = slice(500, 700)
DELIVERED_BY = ("motor_torque_nm", "motor_torque_demanded_nm")
"""Channels of a ride whose motor torque is what the motor gave."""


def replayed(store: Store, columns: dict[str, Values], **changes: Any) -> dict[str, Any]:
    """The answer for a ride of these channels, (ROWS,) each."""
    ride_id = imported_ride(store, columns, PERIOD_US)
    return RideReplay(Preview(), config_of)(store.rides.reader(ride_id), **{**SPORT, **changes})


def pushing(**changes: Values) -> dict[str, Values]:
    return {name: np.full(ROWS, value) for name, value in PUSHING.items()} | changes


def while_held(value: float, otherwise: float) -> Values:
    values = np.full(ROWS, otherwise)
    values[HELD] = value
    return values


def motor_nm(answer: dict[str, Any]) -> Values:
    series = answer["series"]
    assert series["kind"] == "rows"
    (motor,) = [c for c in series["channels"] if c["name"] == "replayed_motor_torque_nm"]
    return np.asarray(motor["max"], np.float64)


def test_a_ride_that_begins_on_the_way_is_assisted_from_its_first_row(store: Store) -> None:
    columns = pushing()
    columns["speed_kmh"][:600] = columns["cadence_rpm"][:600] = 0.0
    columns["motor_speed_rpm"][:600] = columns["rider_torque_raw"][:600] = 0.0

    on_the_way, from_a_stand = (
        motor_nm(replayed(store, pushing())),
        motor_nm(replayed(store, columns)),
    )

    # As much as the rider's 30 Nm, through a gear of 40.34 to 1.
    assert on_the_way[:50] == pytest.approx(30.0 / 40.34, rel=1e-3)
    assert not from_a_stand[:600].any()
    assert from_a_stand[610] < 0.5 * on_the_way[0]
    assert from_a_stand[-1] == pytest.approx(on_the_way[0], rel=1e-3)


@pytest.mark.parametrize(
    ("channel", "value"),
    [
        ("input_flags", float(InputFlags.BRAKE)),
        ("input_flags", float(InputFlags.INHIBIT)),
        ("input_flags", float(InputFlags.BRAKE | InputFlags.WALK_BUTTON)),
        ("controller_temperature_degc", 100.0),
    ],
)
def test_what_took_the_torque_away_on_the_ride_takes_it_away_in_its_replay(
    store: Store, channel: str, value: float
) -> None:
    held = while_held(value, PUSHING[channel])

    delivered_nm = motor_nm(replayed(store, pushing(**{channel: held})))

    assert delivered_nm[HELD.start - 1] > 0.5
    assert not delivered_nm[HELD].any()
    assert delivered_nm[-1] > 0.5


def test_a_torque_that_was_too_old_is_let_go_in_the_replay_too(store: Store) -> None:
    aged = while_held(1000.0, 2.0)

    delivered_nm = motor_nm(replayed(store, pushing(torque_age_ms=aged)))

    # 30 Nm at the crank fall by at least 400 Nm a second.
    assert delivered_nm[HELD.start - 1] > 0.5
    assert not delivered_nm[HELD.start + 8 : HELD.stop].any()


def test_a_ride_of_before_is_replayed_with_the_brake_off_and_the_answer_says_so(
    store: Store,
) -> None:
    columns = pushing()
    for later in ("input_flags", "torque_age_ms", "controller_temperature_degc"):
        del columns[later]

    answer = replayed(store, columns)

    assert answer["inputs_missing"] == [
        "controller_temperature_degc",
        "torque_age_ms",
        "input_flags",
    ]
    assert motor_nm(answer)[HELD].min() > 0.5


def test_a_channel_without_a_single_sample_is_missing(store: Store) -> None:
    never = np.full(ROWS, np.nan)

    answer = replayed(store, pushing(controller_temperature_degc=never))

    assert answer["inputs_missing"] == ["controller_temperature_degc"]


def test_a_ride_with_every_input_lacks_none(store: Store) -> None:
    assert replayed(store, pushing())["inputs_missing"] == []


def test_the_answer_tells_every_limit_of_the_registry(store: Store) -> None:
    faulty = while_held(float(InputFlags.INHIBIT), 0.0)

    shares = replayed(store, pushing(input_flags=faulty))["limit_shares"]

    assert shares.keys() == {str(flag.name).lower() for flag in LimitFlags}
    assert shares["fault"] == pytest.approx(0.2)  # 200 of 1000 rows


def test_the_limits_the_unit_told_on_the_ride_stand_beside_those_of_the_replay(
    store: Store,
) -> None:
    told = while_held(float(LimitFlags.BRAKE | LimitFlags.TEMPERATURE), 0.0)
    told[:200] = np.nan

    answer = replayed(store, pushing(limit_flags=told))

    shares = answer["limit_shares_recorded"]
    assert shares.keys() == answer["limit_shares"].keys()
    # 200 of the 800 rows that tell it.
    assert {name: share for name, share in shares.items() if share} == {
        "brake": 0.25,
        "temperature": 0.25,
    }
    assert answer["limit_shares"]["brake"] == 0.0


def test_limits_that_the_ride_does_not_tell_are_missing(store: Store) -> None:
    assert replayed(store, pushing())["limit_shares_recorded"] is None


def test_what_was_only_asked_of_the_motor_is_not_compared_with_what_it_gives(store: Store) -> None:
    asked = replayed(store, pushing(motor_torque_nm=np.full(ROWS, 0.5)))

    assert asked["motor_torque_meaning"] == "demanded"
    assert asked["motor_torque_nm_max"]["recorded"] is None
    assert asked["motor_torque_nm_max"]["difference"] is None
    assert asked["motor_torque_nm_difference_max"] is None
    assert asked["motor_work_wh"]["recorded"] is None


def test_heat_is_told_as_what_held_the_motor_back(store: Store) -> None:
    hot = replayed(store, pushing(controller_temperature_degc=np.full(ROWS, 100.0)))

    assert hot["limit_shares"]["temperature"] > 0.9


def test_a_market_is_told_as_what_held_the_motor_back(store: Store) -> None:
    modes = AssistModes.from_parameters(law_defaults()).to_json()
    modes["modes"][2] |= {"law": "fixed", "ratio": 3.0, "taper": "none"}
    japan = RideReplay(
        Preview(), lambda ride, t_s=0: ({**law_defaults(), "market": "japan"}, "ride")
    )
    cool = replayed(store, pushing())["ride_id"]
    held = japan(store.rides.reader(cool), None, modes)

    assert held["limit_shares"]["market"] > 0.5


def test_the_loop_is_open_and_what_is_compared_is_work_for_a_kilometre(store: Store) -> None:
    modes = AssistModes.from_parameters(law_defaults()).to_json()
    modes["modes"][2]["ratio"] *= 2
    delivered = {name: np.full(ROWS, 0.5) for name in DELIVERED_BY}
    columns = pushing(**delivered)

    answer = replayed(store, columns, assist_modes=modes)

    assert answer["mode"] == "open_loop"
    assert "speed and legs as recorded" in answer["meaning"]
    assert answer["duration_s"] == pytest.approx(10.0)
    assert answer["distance_km"] == pytest.approx(12.0 / 360)
    # 0.5 Nm at 2400 r/min are 125.66 W; at 12 km/h that is 10.47 Wh for every kilometre.
    assert answer["wh_per_km"]["recorded"] == pytest.approx(0.5 * 2400 * np.pi / 30 / 12, rel=1e-3)
    assert answer["wh_per_km"]["replayed"] == pytest.approx(
        answer["motor_work_wh"]["replayed"] * 360 / 12
    )
    assert answer["range_km"] is None


def test_a_ride_that_went_nowhere_has_no_work_for_a_kilometre_and_no_mean(store: Store) -> None:
    stood = replayed(store, pushing(speed_kmh=np.zeros(ROWS)))

    for name in ("wh_per_km", "motor_power_w_mean", "ripple_nm_per_s"):
        assert stood[name] is None


def test_mean_power_and_ripple_are_of_the_time_on_the_way(store: Store) -> None:
    # 2 s at a stand with the motor at a steady pull, then torque as a sine of 1 Hz.
    time_s = np.arange(ROWS) * PERIOD_US / 1e6
    stroke = np.where(time_s < 2.0, 0.0, np.sin(2.0 * np.pi * time_s))
    recorded_nm = 0.6 + 0.3 * stroke
    speed_kmh = np.where(time_s < 2.0, 0.0, 12.0)
    given = {name: recorded_nm.copy() for name in DELIVERED_BY}

    answer = replayed(
        store, pushing(speed_kmh=speed_kmh, rider_torque_raw=3000.0 + 2000.0 * stroke, **given)
    )

    # The rise of a sine has an rms of amplitude times 2 pi over the root of 2.
    assert answer["ripple_nm_per_s"]["recorded"] == pytest.approx(
        0.3 * 2.0 * np.pi / np.sqrt(2.0), rel=0.01
    )
    # What was done at the stand counts as work, as in the closed loop.
    watts = recorded_nm * 2400.0 * np.pi / 30.0
    assert answer["motor_power_w_mean"]["recorded"] == pytest.approx(
        watts.sum() / np.count_nonzero(speed_kmh), rel=1e-3
    )
    delivered_nm = motor_nm(answer)
    rises = np.diff(delivered_nm)[speed_kmh[1:] > 0.0] * 100.0
    assert answer["ripple_nm_per_s"]["replayed"] == pytest.approx(
        np.sqrt(np.mean(rises**2)), rel=0.01
    )
    assert answer["motor_power_w_mean"]["replayed"] == pytest.approx(
        delivered_nm.sum() * 2400.0 * np.pi / 30.0 / np.count_nonzero(speed_kmh), rel=1e-3
    )


def test_a_torque_that_is_missing_has_no_rise(store: Store) -> None:
    recorded_nm = np.full(ROWS, 0.5)
    recorded_nm[HELD] = np.nan

    answer = replayed(store, pushing(**{name: recorded_nm.copy() for name in DELIVERED_BY}))

    assert answer["ripple_nm_per_s"]["recorded"] == 0.0


def test_the_second_table_is_replaced_for_the_modes_that_use_it(store: Store) -> None:
    modes = AssistModes.from_parameters(law_defaults()).to_json()
    modes["modes"][2] |= {"law": "fuzzy", "ratio": 1.0, "table": "second"}
    most = THESIS_TABLE.to_json() | {"rules": [["PB"] * 5] * 5, "inference": "weighted_average"}
    least = most | {"rules": [["NB"] * 5] * 5}

    strong, weak, first_only = (
        replayed(store, pushing(), assist_modes=modes, **tables)
        for tables in (
            {"second_table": most},
            {"second_table": least},
            {"second_table": least, "fuzzy_table": most},
        )
    )

    # Gains of 0.5 and 0.1 on a ratio of 1: 1.5 to 1.1.
    works = [answer["motor_work_wh"]["replayed"] for answer in (strong, weak, first_only)]
    assert works[0] / works[1] == pytest.approx(1.5 / 1.1, rel=0.01)
    assert works[2] == works[1]


def test_settings_beside_tables_and_modes_are_replayed_and_the_bike_stays(store: Store) -> None:
    modes = AssistModes.from_parameters(law_defaults()).to_json()
    modes["modes"][2] |= {"law": "fixed", "ratio": 1.0, "taper": "none"}
    columns = pushing(speed_kmh=np.full(ROWS, 23.0))
    of_another_bike = {"sensor_gain_nm_per_count": 0.02, "gear_ratio": 20.0}

    narrow, wide, moved = (
        replayed(store, columns, assist_modes=modes, parameters=parameters)["motor_work_wh"]
        for parameters in (
            {"assist_cutoff_band_kmh": 1.0},
            {"assist_cutoff_band_kmh": 4.0},
            {"assist_cutoff_band_kmh": 1.0, **of_another_bike},
        )
    )

    # 2 km/h below the cut-off a band of 4 leaves half.
    assert wide["replayed"] == pytest.approx(0.5 * narrow["replayed"], rel=0.02)
    assert moved == narrow


def test_a_second_table_with_points_of_its_own_is_refused(store: Store) -> None:
    other = THESIS_TABLE.to_json() | {"speed_points_kmh": [4.0, 10.0, 15.0, 20.0, 25.0]}

    with pytest.raises(InvalidRequest) as refused:
        replayed(store, pushing(), second_table=other)

    assert [fault.field for fault in refused.value.fields] == ["second_table.speed_points_kmh"]
