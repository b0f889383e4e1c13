"""Goal: a phase in metres is a piece of road: every bike meets the next one at the same place,
and a bike that stands waits for no end of the road.

Method: roads of two phases, ridden in virtual time by strong and weak riders.
"""

from typing import Any

import pytest

from sim_device.lockstep import LockstepUnit
from sim_device.scenario import run
from sim_device.scenario_file import ScenarioError, ScenarioFile, parse

HEAD = 'doc = "A road."\nseed = 1\n'
HILL_AT_M = 60.0


def road(torque_nm: float, ending: str = "metres = 40", more: str = "") -> ScenarioFile:
    """Level road, then a hill."""
    return parse(
        "road",
        f"{HEAD}{more}\n"
        f"[[phases]]\nmetres = {HILL_AT_M}\nrider = 'legs'\ntorque_nm = {torque_nm}\n"
        f"[[phases]]\n{ending}\ngrade_deg = 3.0\n",
    )


def grade_deg(unit: LockstepUnit) -> float:
    grade: Any = unit.simulation_get()["road"]["grade_deg"]
    return float(grade)


def where_the_hill_begins(unit: LockstepUnit) -> tuple[float, float]:
    """Seconds and metres, to the millisecond."""
    while grade_deg(unit) == 0.0:
        unit.advance(0.001)
    seen = unit.observe()
    return seen["t_s"], seen["distance_m"]


@pytest.mark.slow
def test_a_faster_bike_meets_the_hill_sooner_and_at_the_same_place() -> None:
    begun = [where_the_hill_begins(LockstepUnit(scenario=road(push))) for push in (20.0, 45.0)]
    (slow_s, slow_m), (fast_s, fast_m) = begun

    assert fast_s < slow_s - 2.0
    # At 30 km/h a millisecond takes it 8 mm further.
    for met_m in (slow_m, fast_m):
        assert HILL_AT_M <= met_m < HILL_AT_M + 0.01


def test_the_hill_begins_in_the_middle_of_whatever_is_asked_for_at_once() -> None:
    whole, pieces = LockstepUnit(scenario=road(30.0)), LockstepUnit(scenario=road(30.0))

    whole.advance(60.0)
    for _ in range(600):
        pieces.advance(0.1)

    assert whole.observe() == pytest.approx(pieces.observe(), rel=1e-12, nan_ok=True)


def test_what_a_step_goes_too_far_is_not_added_up_over_the_phases() -> None:
    pieces = "".join("[[phases]]\nmetres = 1.7\n" for _ in range(40))
    scenario = parse(
        "road", f"{HEAD}{pieces}".replace("1.7\n", "1.7\nrider='legs'\ntorque_nm=30\n")
    )
    unit = LockstepUnit(scenario=scenario)

    *_, seen = unit.ride_once(0.5)

    assert 68.0 <= seen["distance_m"] < 68.01


@pytest.mark.slow
def test_a_bike_that_stands_is_let_go_after_the_time_of_a_pushed_one() -> None:
    scenario = road(0.0)
    unit = LockstepUnit(scenario=scenario)
    # 2 km/h, and half a minute to begin with.
    expected_s = 30.0 + HILL_AT_M / (2.0 / 3.6)

    stood_s, _ = where_the_hill_begins(unit)

    assert stood_s == pytest.approx(expected_s, abs=0.002)
    assert scenario.duration_s is None
    assert scenario.duration_s_max == pytest.approx(expected_s + 30.0 + 40.0 * 1.8)


def test_the_ride_says_which_phases_stalled_and_how_long_it_took(tmp_path: Any) -> None:
    path = tmp_path / "wall.toml"
    path.write_text(
        f"{HEAD}[[phases]]\nmetres = 30\nrider = 'legs'\ntorque_nm = 30\n"
        "[[phases]]\nmetres = 20\ngrade_deg = 25.0\n[[phases]]\nseconds = 2\nbrake = true\n"
    )

    ridden = run(str(path))

    assert ridden["stalled_phases"] == [2]
    assert ridden["distance_m"] < 50.0
    assert 68.0 < ridden["duration_s"] < 90.0


@pytest.mark.slow
def test_a_road_that_begins_again_begins_again_at_its_end() -> None:
    unit = LockstepUnit(scenario=road(30.0, more="repeat = true"))
    seen_m = []

    for _ in range(3):
        _, met_m = where_the_hill_begins(unit)
        seen_m.append(met_m)
        while grade_deg(unit) != 0.0:
            unit.advance(0.01)

    assert [round(met, 1) for met in seen_m] == [60.0, 160.0, 260.0]


@pytest.mark.slow
def test_seconds_after_metres_count_from_where_the_metres_ended() -> None:
    unit = LockstepUnit(scenario=road(30.0, ending="seconds = 5"))
    begun_s, _ = where_the_hill_begins(unit)

    *_, seen = unit.ride_once(60.0)

    assert seen["t_s"] == pytest.approx(begun_s + 5.0, abs=0.0011)
    assert unit.simulation_get()["running"] is False


def test_a_bike_put_on_the_road_again_keeps_its_way_into_the_phase() -> None:
    unit = LockstepUnit(scenario=road(30.0))
    while unit.observe()["distance_m"] < 50.0:
        unit.advance(0.01)
    left_m = HILL_AT_M - unit.observe()["distance_m"]

    unit.place(10.0)
    _, met_m = where_the_hill_begins(unit)

    assert met_m == pytest.approx(left_m, abs=0.01)


def test_what_is_ridden_while_the_scenario_pauses_is_no_part_of_the_road() -> None:
    unit = LockstepUnit(scenario=road(30.0))
    while unit.observe()["distance_m"] < 50.0:
        unit.advance(0.01)
    left_m = HILL_AT_M - unit.observe()["distance_m"]

    unit.simulation_set({"running": False})
    unit.advance(5.0)
    resumed_m = unit.observe()["distance_m"]
    unit.simulation_set({"running": True})
    _, met_m = where_the_hill_begins(unit)

    assert resumed_m > HILL_AT_M + 10.0
    assert met_m - resumed_m == pytest.approx(left_m, abs=0.01)


@pytest.mark.parametrize(
    ("phase", "complaint"),
    [
        ("rider = 'legs'", "needs `seconds` or `metres`, and not both"),
        ("seconds = 1\nmetres = 5", "needs `seconds` or `metres`, and not both"),
        ("metres = 0", "metres is 0; it lies from 0.1"),
        ("metres = 1e6", "metres is 1000000.0; it lies from 0.1"),
    ],
)
def test_exactly_one_length_is_asked_for(phase: str, complaint: str) -> None:
    with pytest.raises(ScenarioError, match=complaint):
        parse("road", f"{HEAD}[[phases]]\n{phase}\n")


def test_a_phase_may_name_the_other_length_than_the_one_before() -> None:
    scenario = parse("road", f"{HEAD}[[phases]]\nmetres = 5\n[[phases]]\nseconds = 3\n")

    assert [(each.metres, each.seconds) for each in scenario.phases] == [(5.0, None), (None, 3.0)]
