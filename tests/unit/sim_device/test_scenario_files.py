"""Goal: a scenario that is wrong says what, where and what would be right; nothing is guessed."""

import pytest

from sim_device.scenario import list_scenarios, run
from sim_device.scenario_file import ScenarioError, load, names, parse

HEAD = 'doc = "A ride."\nseed = 1\n'


def test_the_scenarios_of_the_contract_are_there() -> None:
    assert {"start", "slope", "kinematics", "resistance", "commute"} <= set(names())
    assert {row["name"] for row in list_scenarios()} == set(names())


@pytest.mark.parametrize("name", ["start", "slope", "kinematics"])
def test_an_unknown_setting_is_refused_by_name(name: str) -> None:
    with pytest.raises(ScenarioError, match=f"{name} has no setting colour; there are: "):
        run(name, {"colour": 1})


@pytest.mark.parametrize(
    ("settings", "complaint"),
    [
        ({"mass_kg": 1e9}, "mass_kg is 1000000000.0; it lies from 40.0 to 300.0"),
        ({"mass_kg": "nan"}, "mass_kg is nan"),
        ({"mass_kg": "heavy"}, "mass_kg is 'heavy', not a number"),
        ({"mass_kg": True}, "mass_kg is True, not a number"),
        ({"law": "magic"}, "law is 'magic'; it can be: fixed, fuzzy"),
    ],
)
def test_a_wrong_value_is_refused_with_what_is_allowed(
    settings: dict[str, object], complaint: str
) -> None:
    with pytest.raises(ScenarioError, match=complaint):
        run("start", settings)


def test_a_text_from_the_command_line_counts_as_the_number_it_says() -> None:
    assert run("kinematics", {"speed_kmh": "20"}) == run("kinematics", {"speed_kmh": 20.0})


def test_an_unknown_scenario_is_answered_with_those_there_are() -> None:
    with pytest.raises(ScenarioError, match=r"no scenario 'moon'; there are: .*start"):
        run("moon")


def test_a_phase_keeps_what_the_one_before_did() -> None:
    scenario = parse(
        "ride",
        HEAD
        + "[[phases]]\nseconds=2\nrider='legs'\ntorque_nm=20\nassist_mode=4\n"
        + "[[phases]]\nseconds=3\ngrade_deg=2\n",
    )

    first, second = scenario.phases
    assert (second.rider, second.torque_nm, second.grade_deg) == ("legs", 20.0, 2.0)
    assert (first.assist_mode, second.assist_mode) == (4, None)
    assert scenario.duration_s == 5.0


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("doc = ", "scenario ride: "),
        ("seed = 1", "needs a text `doc` and a whole number `seed`"),
        (HEAD + "colour = 1", "scenario ride: unknown colour; there are: "),
        (HEAD + "speed_kmh = 900", "speed_kmh is 900"),
        (HEAD + "[bike.road]\nmass_kg='much'", "bike.road.mass_kg is 'much', not a number"),
        (HEAD + "[[phases]]\nrider='legs'", "phase 1: needs `seconds`"),
        (HEAD + "[[phases]]\nseconds=0", "phase 1: seconds is 0"),
        (HEAD + "[[phases]]\nseconds=1\nrider='horse'", "phase 1: rider is 'horse'"),
        (HEAD + "[[phases]]\nseconds=1\ngrade_deg=80", "phase 1: grade_deg is 80"),
        (HEAD + "[[phases]]\nseconds=1\nbrake=1", "phase 1: brake is 1, not true or false"),
        (HEAD + "[[phases]]\nseconds=1\nhorn=1", "phase 1: horn is not known"),
        (HEAD + "[settings.mass_kg]\nmin=1", "setting mass_kg: needs a default"),
        (HEAD + "[settings.mass_kg]\ndefault=1\nmost=2", "setting mass_kg: unknown most"),
    ],
)
def test_a_wrong_file_is_refused_with_the_place(text: str, complaint: str) -> None:
    with pytest.raises(ScenarioError, match=complaint):
        parse("ride", text)


def test_the_commute_rests_long_enough_for_a_ride_to_end() -> None:
    commute = load("commute")

    assert commute.repeat
    assert commute.phases[-1].rider == "off"
    assert commute.phases[-1].seconds >= 60.0
