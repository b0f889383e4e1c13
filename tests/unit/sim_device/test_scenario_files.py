"""Goal: a scenario that is wrong says what, where and what would be right; nothing is guessed."""

import math
from pathlib import Path

import pytest

from sim_device.bike_ranges import BIKE_VALUES, read_bike
from sim_device.firmware.python.unit import default_bike
from sim_device.lockstep import LockstepUnit
from sim_device.scenario import list_scenarios, run
from sim_device.scenario_file import ScenarioError, load, load_live, names, parse

# A store for every test, or rides of minutes: left out of `make test-fast`.
pytestmark = pytest.mark.slow

HEAD = 'doc = "A ride."\nseed = 1\n'
BENCH = "[bike.road]\nsource = 1\n"


def test_the_scenarios_of_the_contract_are_there() -> None:
    asked = "start slope resistance kinematics calibration field_ride commute alpine_climb"
    more = "stop_and_go cold_morning worn_battery sensor_fault link_bursts slippery_start spinning"
    assert {*asked.split(), *more.split()} <= set(names())
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
        ('doc = "A ride."\nseed = true', "line 2: seed is True, not a whole number"),
        ('doc = "A ride."\nseed = -1', "line 2: seed is -1; it lies from 0"),
        (HEAD + "'speed_kmh' = 900", "line 3: speed_kmh is 900"),
        (HEAD + "phases = [{seconds = 0}]", "line 3, phase 1: seconds is 0"),
        (HEAD + "bike.road.mass_kg = 0", "line 3, bike.road.mass_kg is 0; it lies from 1.0"),
        (HEAD + "[bike.road]\nmass_kg = nan", "line 4, bike.road.mass_kg is nan"),
        (HEAD + "[bike.sensor]\nnoise_nm = inf", "line 4, bike.sensor.noise_nm is inf"),
        (HEAD + "[bike.motor]\nmodel = 5", "line 4, bike.motor.model is 5; it can be: 0.0, 1.0"),
        (HEAD + "[states.old.rig]\npan_nm = 900", "line 4, states.old.rig.pan_nm is 900"),
        (HEAD + "[settings.mass_kg]\ndefault=true", "line 3, setting mass_kg: needs a default"),
        (HEAD + "[settings.mass_kg]\ndefault=1\nchoices=3", "line 5, setting mass_kg: choices are"),
        (HEAD + "[settings.mass_kg]\ndefault=1\nmin='x'", "line 5, setting mass_kg: min is 'x'"),
        (HEAD + "colour = 1", "scenario ride, line 3: unknown colour; there are: "),
        (HEAD + "speed_kmh = 900", "speed_kmh is 900"),
        (HEAD + "[bike.road]\nmass_kg='much'", "bike.road.mass_kg is 'much', not a number"),
        (HEAD + "[[phases]]\nrider='legs'", "phase 1: needs `seconds` or `metres`"),
        (HEAD + "[[phases]]\nseconds=0", "phase 1: seconds is 0"),
        (HEAD + "[[phases]]\nseconds=1\nrider='horse'", "phase 1: rider is 'horse'"),
        (HEAD + "[[phases]]\nseconds=1\ngrade_deg=80", "phase 1: grade_deg is 80"),
        (
            HEAD + "[[phases]]\nseconds=1\ndyno_nm=5",
            "line 5, phase 1: dyno_nm loads the bench only",
        ),
        (
            HEAD + BENCH + "[[phases]]\nseconds=1\ndyno_nm=-1",
            "phase 1: dyno_nm is -1; it lies from",
        ),
        (HEAD + "[[phases]]\nseconds=1\nbrake=1", "phase 1: brake is 1, not true or false"),
        (HEAD + "[[phases]]\nseconds=1\nhorn=1", "phase 1: horn is not known"),
        (HEAD + "\n\n[[phases]]\nseconds=1\n[[phases]]\nseconds=0", "line 8, phase 2: seconds"),
        (HEAD + "[[phases]]\nseconds=1\ntorque_sensor='lame'", "line 5, phase 1: torque_sensor"),
        (
            HEAD + "[[phases]]\nseconds=1\npulses_missed=1.5",
            "line 5, phase 1: pulses_missed is 1.5; it lies from 0.0 to 1.0",
        ),
        (HEAD + "bike.wheel.jitter_share = 0.2", "line 3, bike.wheel.jitter_share is 0.2; it lies"),
        (HEAD + "bike.wheel.pulses_per_turn = 0", "line 3, bike.wheel.pulses_per_turn is 0"),
        (HEAD + "[[phases]]\nseconds=1\nbit_error_rate=2", "bit_error_rate is 2; it lies from 0.0"),
        (HEAD + "phases = 3", "line 3: phases are tables"),
        (HEAD + "settings = 3", "line 3: settings holds tables"),
        (HEAD + "repeat = 1", "line 3: repeat is 1, not true or false"),
        (
            HEAD + "[bike.link]\ncolour = 1",
            "line 4, bike.link.colour is not known; there are: link",
        ),
        (HEAD + "[settings.mass_kg]\ndefault=1\nmin=2", "setting mass_kg: default is 1; it lies"),
        (HEAD + "[settings.mass_kg]\nmin=1", "setting mass_kg: needs a default"),
        (HEAD + "[settings.mass_kg]\ndefault=1\nmost=2", "line 5, settings.mass_kg: unknown most"),
    ],
)
def test_a_wrong_file_is_refused_with_the_place(text: str, complaint: str) -> None:
    with pytest.raises(ScenarioError, match=complaint):
        parse("ride", text)


def test_every_value_of_the_bike_has_its_range_and_the_pinned_bike_lies_inside() -> None:
    pinned = default_bike()

    assert set(BIKE_VALUES) == set(pinned)
    assert read_bike(pinned) == pinned


@pytest.mark.parametrize("end", ["min", "max"])
def test_a_bike_at_the_end_of_any_range_still_moves_in_numbers(end: str) -> None:
    for name, setting in BIKE_VALUES.items():
        if setting.choices:
            continue
        unit = LockstepUnit(bike={name: float(getattr(setting, end))})
        unit.select_mode(3)
        unit.rider("legs", 40.0)
        unit.advance(0.5)
        assert math.isfinite(unit.observe()["speed_kmh"]), name


EVERYTHING_LIGHT = {
    "road.source": 1.0,
    "road.dyno_mass_kg": 0.0,
    "road.wheel_inertia_kg_m2": 0.0,
    "road.flywheel_kg_m2": 0.0,
    "road.rollers_kg_m2": 0.0,
}
A_WHEEL_WITHOUT_INERTIA = {"road.wheel_inertia_kg_m2": 0.0, "road.grip": 0.02}
HEAT_THAT_FLOWS_AT_ONCE = {
    f"motor.{part}_{what}": BIKE_VALUES[f"motor.{part}_{what}"].min or 0.0
    for part in ("winding", "housing", "bridge")
    for what in ("heat_j_per_k", "k_per_w")
}
THE_COLDEST_WINDING = {
    "motor.ambient_degc": -60.0,
    "motor.winding_share": 1.0,
    "motor.resistance_share_per_k": BIKE_VALUES["motor.resistance_share_per_k"].max or 0.0,
}


@pytest.mark.parametrize(
    "bike",
    [EVERYTHING_LIGHT, A_WHEEL_WITHOUT_INERTIA, HEAT_THAT_FLOWS_AT_ONCE, THE_COLDEST_WINDING],
    ids=["no mass on the bench", "no mass to slip", "no heat to hold", "no resistance"],
)
def test_several_values_at_their_ends_together_move_in_numbers_too(bike: dict[str, float]) -> None:
    unit = LockstepUnit(bike=read_bike(bike))
    unit.select_mode(4)
    unit.rider("legs", 60.0)

    for _ in range(30):
        unit.advance(0.1)
        seen = unit.observe()
        for name in ("wheel_speed_kmh", "motor_speed_rpm", "motor_temperature_degc"):
            assert math.isfinite(seen[name]), name
        assert seen["motor_speed_rpm"] >= 0.0
        assert seen["motor_temperature_degc"] < 1000.0


def test_the_commute_rests_long_enough_for_a_ride_to_end() -> None:
    commute = load("commute")

    assert commute.repeat
    assert commute.phases[-1].rider == "off"
    assert (commute.phases[-1].seconds or 0.0) >= 60.0


def test_a_scenario_of_one_s_own_is_ridden_by_its_path(tmp_path: Path) -> None:
    path = tmp_path / "hill.toml"
    phase = "[[phases]]\nseconds=20\nrider='legs'\ntorque_nm=40\ngrade_deg=1\n"
    path.write_text(HEAD + phase)

    ridden = run(str(path))

    assert ridden["duration_s"] == 20.0
    assert ridden["climb_m"] > 1.0


def test_a_file_without_phases_cannot_be_ridden(tmp_path: Path) -> None:
    path = tmp_path / "nothing.toml"
    path.write_text(HEAD)

    with pytest.raises(ScenarioError, match=r"scenario nothing.toml: needs \[\[phases\]\]"):
        run(str(path))


def test_a_file_in_place_of_a_name_is_read_or_refused_with_the_reason(tmp_path: Path) -> None:
    path = tmp_path / "hill.toml"
    path.write_text(HEAD + "[[phases]]\nseconds=20\ngrade_deg=80\n")

    with pytest.raises(ScenarioError, match=r"hill.toml, line 5, phase 1: grade_deg is 80"):
        load_live(str(path))
    with pytest.raises(ScenarioError, match=r"flat.toml cannot be read: No such file"):
        load_live(str(tmp_path / "flat.toml"))
    with pytest.raises(ScenarioError, match=r"no scenario 'hill'; there are: .* path of a file"):
        load_live("hill")
    with pytest.raises(ScenarioError, match="'start' is measured, not ridden"):
        load_live("start")
    with pytest.raises(ScenarioError, match="more than 80 characters"):
        load_live("h" * 100 + ".toml")


@pytest.mark.parametrize("name", [name for name in names() if load(name).live])
def test_the_same_seed_rides_the_same_ride(name: str) -> None:
    settings = {"hours": 0.02} if name == "field_ride" else {}

    assert run(name, settings) == run(name, settings)


def test_the_page_s_example_is_a_scenario_and_its_complaint_is_true() -> None:
    page = (Path(__file__).resolve().parents[3] / "docs" / "scenarios.md").read_text()
    example = page.split("```toml\n")[1].split("```")[0]

    ride = parse("my.toml", example)
    with pytest.raises(ScenarioError) as refused:
        parse("my.toml", example.replace("burst_share = 1.0", "burst_share = 3"))

    assert len(ride.phases) == 2
    assert f"`{refused.value}`" in page


def test_a_ride_says_which_faults_the_unit_told_on_the_way() -> None:
    told = {"torque_sensor", "speed_sensor", "torque_stuck", "torque_drift"}
    assert set(run("sensor_fault")["faults_seen"]) == told
    assert run("link_bursts")["faults_seen"] == ["torque_link"]
    assert "battery_cut" in run("worn_battery")["faults_seen"]
    for sound in ("alpine_climb", "cold_morning", "commute", "slippery_start", "stop_and_go"):
        assert run(sound)["faults_seen"] == []


@pytest.mark.parametrize("name", ["sensor_fault", "link_bursts"])
def test_what_breaks_breaks_while_the_motor_helps(name: str) -> None:
    """Above 25 km/h there is no assist to take away, and such a ride shows nothing."""
    phases = load(name).phases
    sound = next(k for k, phase in enumerate(phases) if phase.faults)
    unit = LockstepUnit(scenario=name)

    unit.advance(sum(phase.seconds_max for phase in phases[:sound]) - 1.0)
    before_j = unit.observe()["motor_electric_j"]
    unit.advance(1.0)

    assert unit.observe()["motor_electric_j"] > before_j + 50.0
