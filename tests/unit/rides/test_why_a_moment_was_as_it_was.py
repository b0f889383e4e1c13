"""Goal: a moment of a ride and a steady state are explained by the law's own steps, truly named.

Method: rides made row by row in a real store, with the configuration known or not. What must come
out is certain: the motor's own limit at a hard push, nothing behind a brake, delivered torque only
where it was measured, and what was recorded after a break not explained by what was before it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from backend.core.channels import Values
from backend.core.ride import Gap, Ride
from backend.errors import Conflict, InvalidRequest
from backend.law import law_defaults
from backend.rides.replay.service import WARM_UP_S, warm_up_row
from backend.rides.replay.why_ride import WhyRide, cuts_of
from backend.store import Store
from backend.tuning.why import WhySteady
from firmware_protocol._generated import InputFlags, LimitFlags
from tests.fakes.kept_rides import imported_ride

ROWS, PERIOD_US = 1000, 10_000
GEAR = 40.34
PUSHING = {
    "speed_kmh": 12.0,
    "cadence_rpm": 60.0,
    "rider_torque_raw": 3000.0,
    "motor_speed_rpm": 2420.0,
    "battery_voltage_v": 36.0,
    "battery_current_a": 2.0,
    "motor_temperature_degc": 30.0,
    "controller_temperature_degc": 30.0,
    "torque_age_ms": 2.0,
    "input_flags": 0.0,
    "assist_mode": 3.0,
    "motor_torque_nm": 0.5,
    "motor_torque_demanded_nm": 0.6,
}
STATE = {"speed_kmh": 12.0, "torque_rate": 0.0, "rider_torque_nm": 20.0, "cadence_rpm": 50.0}
STATE |= {"mode": 3, "hold_s": 5.0}


def config_of(ride: Ride, t_s: float = 0.0) -> tuple[dict[str, Any], str]:
    return law_defaults(), "ride"


def kept(store: Store, **changes: Values | None) -> int:
    """A ride of these channels, (ROWS,) each; None leaves one out."""
    columns = {name: np.full(ROWS, value) for name, value in PUSHING.items()} | changes
    columns = {name: values for name, values in columns.items() if values is not None}
    return imported_ride(store, columns, PERIOD_US)


def steps_of(answer: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {step["name"]: step for step in answer["steps"]}


def total_nm(answer: dict[str, Any]) -> float:
    return sum(step["torque_nm"] for step in answer["steps"])


def test_the_list_ends_at_what_the_motor_delivered(store: Store) -> None:
    hard = kept(store, rider_torque_raw=np.full(ROWS, 9000.0))
    answer = WhyRide(store, config_of)(hard, 8.0)

    steps = steps_of(answer)
    assert answer["delivered_nm"] == pytest.approx(0.5 * GEAR, rel=1e-3)
    assert total_nm(answer) == pytest.approx(answer["delivered_nm"], rel=1e-6)
    assert answer["steps"][-1]["name"] == "current_control"
    assert answer["commanded_nm"] == pytest.approx(
        total_nm(answer) - steps["current_control"]["torque_nm"]
    )
    assert steps["motor_torque"]["limit"] == "motor_torque"
    assert steps["motor_torque"]["power_w"] == pytest.approx(
        steps["motor_torque"]["torque_nm"] * 2.0 * np.pi, rel=1e-6
    ), "60 rpm is one turn a second"
    assert answer["recorded"]["motor_torque_demanded_nm"] == pytest.approx(0.6)
    assert (answer["moment"]["kind"], answer["warmed_up_s"]) == ("ride", 8.0)


def test_a_torque_that_was_only_asked_for_is_not_delivered(store: Store) -> None:
    answer = WhyRide(store, config_of)(kept(store, motor_torque_demanded_nm=None), 8.0)

    assert answer["delivered_nm"] is None
    assert "current_control" not in steps_of(answer)
    assert total_nm(answer) == pytest.approx(answer["commanded_nm"])


def test_a_brake_is_named_with_all_that_it_took(store: Store) -> None:
    flags = np.zeros(ROWS)
    flags[500:] = float(InputFlags.BRAKE)

    steps = steps_of(WhyRide(store, config_of)(kept(store, input_flags=flags), 5.0))

    assert steps["brake"]["limit"] == "brake"
    assert steps["brake"]["torque_nm"] < -20.0
    assert steps["motor_torque"]["torque_nm"] == 0.0


@pytest.mark.slow
def test_what_is_not_known_is_refused_with_its_reason(store: Store) -> None:
    ride_id = kept(store, speed_kmh=np.where(np.arange(ROWS) == 700, np.nan, 12.0))
    by_defaults = WhyRide(store, lambda ride, t_s=0: (law_defaults(), "defaults"))

    with pytest.raises(Conflict) as unknown:
        by_defaults(ride_id, 5.0)
    for t_s in (7.0, 10.0, 1e7):
        with pytest.raises(InvalidRequest) as nothing:
            WhyRide(store, config_of)(ride_id, t_s)
        assert nothing.value.code == "no_sample"

    assert unknown.value.code == "no_table"


def test_the_law_starts_behind_a_break_and_ten_minutes_before_at_most(store: Store) -> None:
    ride = store.rides.get(kept(store))
    broken = Ride(**{**fields(ride), "gaps": (Gap(2.0, 3.0), Gap(9.0, 9.5))})

    assert warm_up_row(ride, 500) == 0
    assert warm_up_row(broken, 500) == 300
    assert warm_up_row(ride, 100_000) == 100_000 - WARM_UP_S * 100


def test_a_ride_that_begins_on_the_way_is_explained_from_its_first_moment(store: Store) -> None:
    ride_id = kept(store)
    first, later = (WhyRide(store, config_of)(ride_id, t_s) for t_s in (0.0, 8.0))

    # Nothing changes on this ride.
    assert first["warmed_up_s"] == 0.0
    assert first["commanded_nm"] == pytest.approx(later["commanded_nm"], rel=1e-3)
    assert first["commanded_nm"] > 20.0


def fields(ride: Ride) -> dict[str, Any]:
    return {name: getattr(ride, name) for name in Ride.__dataclass_fields__}


def test_a_cut_outlives_the_holes_of_a_stroke(store: Store) -> None:
    flags = np.zeros(ROWS, np.uint16)
    flags[100:150] = LimitFlags.MOTOR_TORQUE
    flags[200:250] = LimitFlags.BATTERY_CURRENT
    flags[260:265] = LimitFlags.RAMP_UP
    flags[600:610] = LimitFlags.BRAKE
    flags[800:900] = LimitFlags.MARKET

    found = cuts_of(flags, 0.01)

    assert found == [
        {"from_s": 1.0, "to_s": 2.5, "at_s": 2.0, "limits": ["motor_torque", "battery_current"]},
        {"from_s": 8.0, "to_s": 9.0, "at_s": 8.49, "limits": ["market"]},
    ]
    assert WhyRide(store, config_of).cuts(kept(store)) == []


def nobody(device_id: str) -> Any:
    raise AssertionError(device_id)


@pytest.mark.parametrize(
    ("change", "law", "shaped"),
    [({}, "fuzzy", "gain"), ({"mode": 0}, "off", "mode_off"), ({"mode": 1}, "fixed", "taper")],
)
def test_a_steady_state_says_that_it_is_one_and_which_law_it_is(
    change: dict[str, Any], law: str, shaped: str
) -> None:
    answer = WhySteady(nobody)({**STATE, **change}, {})

    assert answer["moment"] == {"kind": "steady", "ride_id": None, "t_s": None, "hold_s": 5.0}
    assert (answer["law"], answer["config_source"], answer["delivered_nm"]) == (law, "given", None)
    assert [step["name"] for step in answer["steps"]][:3] == ["rider_torque", "mode_ratio", shaped]
    assert (answer["gain"] is None, not answer["rules"]) == (law != "fuzzy", law != "fuzzy")
    assert answer["steps"][0]["torque_nm"] == pytest.approx(20.0, rel=1e-3)
    assert total_nm(answer) == pytest.approx(answer["commanded_nm"])


def test_walk_assist_and_a_refused_input_name_their_own_step() -> None:
    walking = {**STATE, "speed_kmh": 2.0, "cadence_rpm": 0.0, "walk_button": True}
    walk = WhySteady(nobody)(walking, {"limits": {"walk_speed_kmh": 6.0}})
    refused = WhySteady(nobody)({**STATE, "speed_kmh": 1e7}, {})

    assert (walk["law"], walk["steps"][0]["name"]) == ("walk", "walk_assist")
    assert walk["commanded_nm"] > 0.0
    assert [step["name"] for step in refused["steps"]] == ["input_refused"]
    assert refused["steps"][0]["limit"] == "input_refused"
    assert (refused["commanded_nm"], refused["gain"]) == (0.0, None)
