"""Goal: a simulated unit is one thing in one hand: repeatable, alone, and open to a host's wishes.

Method: units in virtual time, spoken to over their own serial line.
"""

import json
from typing import Any

import pytest

from firmware_protocol import codec, framing
from firmware_protocol._generated import (
    CfgInfoRequest,
    DeviceClass,
    FaultFlags,
    HelloRequest,
    SimGetRequest,
    SimSetRequest,
    Status,
    StrSubscribeRequest,
)
from firmware_protocol.layout import Message
from sim_device.configure import ConfigureError
from sim_device.controls import pack, unpack
from sim_device.lockstep import LockstepUnit
from sim_device.scenario_file import ScenarioError

HELLO = HelloRequest(
    major_min=1, major_max=1, host_flags=0, host_mtu=544, host_nonce=bytes(range(8))
)
EVERY_CHANNEL = bytes(range(1, 21))


def ask(unit: LockstepUnit, message: Message, tid: int = 7) -> codec.Response:
    unit.send(framing.encode_frame(codec.encode(codec.Request(tid, message))))
    unit.advance(0.01)
    for frame in framing.FrameDecoder().feed(unit.receive()):
        decoded = codec.decode(frame)
        if isinstance(decoded, codec.Response) and decoded.tid == tid:
            return decoded
    raise AssertionError("no answer")


def identity(unit: LockstepUnit) -> Any:
    return ask(unit, HELLO).message


def simulation(unit: LockstepUnit, message: Message) -> Any:
    """The JSON of SIM_GET or SIM_SET, as a host that has said HELLO gets it."""
    identity(unit)
    answer: Any = ask(unit, message, tid=8).message
    return unpack(answer.text)


def standing(told: dict[str, Any]) -> dict[str, Any]:
    """What does not change by itself while a bike stands."""
    return {key: value for key, value in told.items() if key not in ("t_s", "rotor_link")}


def ridden(seed: int) -> bytes:
    """Everything a unit says to a subscribed host in twenty seconds of the commute."""
    unit = LockstepUnit(seed, scenario="commute")
    identity(unit)
    subscribe = StrSubscribeRequest(
        stream_id=1, divider=1, batch=5, encoding=0, lease_s=60, channel_ids=EVERY_CHANNEL
    )
    assert ask(unit, subscribe).status == Status.OK
    said = b""
    for _ in range(200):
        unit.advance(0.1)
        said += unit.receive()
    return said


def test_the_same_seed_gives_the_same_bytes() -> None:
    first, second = ridden(5), ridden(5)

    assert len(first) > 20 * 100 * 2 * len(EVERY_CHANNEL)
    assert first == second


def test_another_seed_gives_another_noise_and_another_serial_number() -> None:
    assert ridden(5) != ridden(6)
    assert identity(LockstepUnit(5)).uid != identity(LockstepUnit(6)).uid


def test_a_simulated_unit_says_that_it_is_one() -> None:
    assert identity(LockstepUnit()).device_class == DeviceClass.MID_DRIVE_SIMULATED


def test_time_cut_into_uneven_pieces_is_the_same_time() -> None:
    whole, pieces = LockstepUnit(scenario="commute"), LockstepUnit(scenario="commute")

    whole.advance(30.0)
    for piece in (0.0004, 0.0101, 7.3333, 10.0, 12.6562):
        pieces.advance(piece)

    assert pieces.observe() == pytest.approx(whole.observe(), nan_ok=True)


def test_two_units_do_not_know_of_each_other() -> None:
    alone = LockstepUnit(1, scenario="commute")
    beside, other = LockstepUnit(1, scenario="commute"), LockstepUnit(2)
    other.rider("legs", 60.0)

    alone.advance(20.0)
    for _ in range(200):
        beside.advance(0.1)
        other.advance(0.1)

    assert beside.observe() == pytest.approx(alone.observe(), nan_ok=True)


def test_the_brake_lever_ends_assist_within_a_twentieth_of_a_second() -> None:
    unit = LockstepUnit()
    unit.select_mode(3)
    unit.rider("constant", 30.0)
    unit.advance(5.0)
    assert unit.observe()["motor_torque_nm"] > 0.5

    unit.brake(True)
    unit.advance(0.05)

    assert unit.observe()["motor_torque_nm"] == 0.0


def test_a_rider_who_stops_lets_the_bike_roll_to_a_halt() -> None:
    unit = LockstepUnit()
    unit.rider("legs", 30.0)
    unit.advance(10.0)

    unit.rider("off")
    unit.advance(0.3)
    rolling = unit.observe()
    unit.advance(90.0)

    assert rolling["motor_torque_nm"] == 0.0
    assert rolling["cadence_rpm"] == 0.0
    assert rolling["speed_kmh"] > 10.0
    assert unit.observe()["speed_kmh"] == 0.0


def test_sim_get_tells_rider_road_and_clock() -> None:
    unit = LockstepUnit(4, scenario="commute", speed_factor=2.0)
    unit.advance(10.0)

    told = simulation(unit, SimGetRequest())

    assert told["scenario"] == "commute"
    assert told["running"] is True
    assert (told["seed"], told["speed_factor"]) == (4, 2.0)
    assert told["rider"] == {"kind": "legs", "torque_nm": 30.0, "cadence_rpm_max": 100.0}
    assert told["road"] == {"grade_deg": 0.0, "wind_ms": 0.0}
    assert (told["load_source"], told["mass_kg"]) == ("road", 100.0)
    assert told["assist_mode"] == 3
    assert told["energy_balance_error_pct"] <= 1.0
    assert told["energy_consistent"] is True


def test_what_sim_get_tells_can_be_sent_back_unchanged() -> None:
    unit = LockstepUnit()
    before = simulation(unit, SimGetRequest())

    after = simulation(unit, SimSetRequest(text=pack(before)))

    assert standing(after) == standing(before)


def test_a_host_that_never_said_hello_gets_no_half_object() -> None:
    assert ask(LockstepUnit(), SimGetRequest()).status == Status.NO_SPACE


def test_sim_set_puts_the_bike_on_a_hill() -> None:
    unit = LockstepUnit(scenario="commute")
    wish = {
        "rider": {"kind": "constant", "torque_nm": 50},
        "road": {"grade_deg": 2},
        "brake": False,
    }

    told = simulation(unit, SimSetRequest(text=json.dumps(wish).encode()))
    unit.advance(30.0)

    assert told["running"] is False
    assert (told["rider"]["torque_nm"], told["road"]["grade_deg"]) == (50.0, 2.0)
    assert unit.observe()["height_m"] > 3.0


@pytest.mark.parametrize(
    ("wish", "complaint"),
    [
        ('{"rider": {"kind": "horse"}}', "rider.kind is 'horse'; it can be: off, constant, legs"),
        ('{"brake": true, "road": {"grade_deg": 80}}', "road.grade_deg is 80"),
        ('{"brake": true, "colour": 1}', "simulation has no colour"),
        ('{"scenario": "start"}', "scenario 'start' is measured, not ridden"),
        ('{"speed_factor": 0}', "speed_factor is 0"),
        ('{"mass_kg": NaN}', "mass_kg is nan"),
        ("[]", "simulation is [], not an object"),
        ("{", "not JSON"),
    ],
)
def test_a_wrong_wish_is_refused_with_the_reason_and_changes_nothing(
    wish: str, complaint: str
) -> None:
    unit = LockstepUnit()
    before = unit.simulation_get()

    answer = ask(unit, SimSetRequest(text=wish.encode()))

    assert answer.status == Status.RANGE
    assert complaint in answer.payload.decode()
    assert standing(unit.simulation_get()) == standing(before)


def test_taking_the_handlebar_stops_the_scenario_but_choosing_a_mode_does_not() -> None:
    unit = LockstepUnit(scenario="commute")

    unit.select_mode(1)
    unit.advance(20.0)
    chosen = unit.simulation_get()
    unit.brake(True)

    assert (chosen["running"], chosen["assist_mode"]) == (True, 1)
    assert unit.simulation_get()["running"] is False


def test_the_commute_begins_again_after_its_rest() -> None:
    unit = LockstepUnit(scenario="commute")
    unit.advance(10.0)
    first = unit.simulation_get()["rider"]

    *_, seen = unit.ride_once(1.0)
    assert seen["t_s"] > 200.0
    unit.advance(10.0)

    assert unit.simulation_get()["rider"] == first
    assert unit.simulation_get()["running"] is True


def test_the_flash_carries_the_configuration_into_the_next_life() -> None:
    unit = LockstepUnit(config_overrides={"motor_torque_nm_max": 0.5})
    told: Any = ask(unit, CfgInfoRequest()).message

    reborn = LockstepUnit(flash=unit.unit.flash(), boot_id=2)
    still: Any = ask(reborn, CfgInfoRequest()).message
    reborn.rider("constant", 80.0)
    reborn.advance(5.0)

    assert (still.generation, still.crc32) == (told.generation, told.crc32)
    assert reborn.observe()["motor_demand_nm"] == pytest.approx(0.5)


def test_an_override_the_unit_does_not_allow_is_reported() -> None:
    with pytest.raises(ConfigureError, match="ACCESS"):
        LockstepUnit(config_overrides={"gear_ratio": 36.744})


def test_a_scenario_that_does_not_exist_is_refused() -> None:
    with pytest.raises(ScenarioError, match="there is no scenario 'moon'"):
        LockstepUnit(scenario="moon")


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"rider": {"torque_nm": 1e6}}, "rider.torque_nm"),
        ({"rider": {"weight_kg": 80}}, "rider.weight_kg"),
        ({"road": 3}, "road"),
        ({"mass_kg": "heavy"}, "mass_kg"),
        ({"brake": 1}, "brake"),
        ({"scenario": "moon"}, "scenario"),
        ({"scenario": "kinematics"}, "scenario"),
        ({"colour": "red"}, "colour"),
        ({"dyno_convention": "printed"}, "dyno_convention"),
        ({"motor_model": 1}, "motor_model"),
    ],
)
def test_a_refused_control_is_named_by_its_place(changes: dict[str, object], field: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        LockstepUnit(scenario=None).simulation_set(changes)

    assert caught.value.field == field


def test_faults_and_weather_are_set_seen_and_taken_back() -> None:
    unit = LockstepUnit(scenario="commute")
    wish = {"faults": {"torque_sensor": "open_high", "bit_error_rate": 1e-3}, "ambient_degc": -5}

    told = simulation(unit, SimSetRequest(text=json.dumps(wish).encode()))
    unit.advance(30.0)
    broken = unit.observe()
    unit.simulation_set({"faults": {"torque_sensor": "sound", "bit_error_rate": 0.0}})
    unit.advance(1.0)

    assert told["faults"] == {"torque_sensor": "open_high", "bit_error_rate": 1e-3}
    assert told["ambient_degc"] == -5.0
    assert told["running"] is True
    assert broken["torque_raw_counts"] == 32767
    assert broken["words_bad"] > 100
    assert broken["sensor_temperature_degc"] < 5.0
    assert abs(unit.observe()["torque_raw_counts"]) < 20_000


def test_a_fault_made_by_hand_lasts_through_the_scenarios_phases() -> None:
    unit = LockstepUnit(scenario="commute")

    unit.simulation_set({"faults": {"speed_sensor": "lost"}})
    unit.advance(60.0)

    assert unit.simulation_get()["faults"] == {"speed_sensor": "lost"}
    unit.simulation_set({"scenario": "commute"})
    assert unit.simulation_get()["faults"] == {}


@pytest.mark.slow
def test_every_answer_of_a_busy_simulation_fits_a_frame() -> None:
    unit = LockstepUnit(2**62, scenario="slippery_start")
    unit.advance(3600.0)
    wish = {"faults": {"torque_sensor": "open_high", "speed_sensor": "stuck"}}

    told = simulation(unit, SimSetRequest(text=json.dumps(wish).encode()))

    assert told["rotor_link"]["words_good"] > 1_000_000


def test_the_bench_s_convention_and_the_motor_s_model_are_chosen_by_name() -> None:
    unit = LockstepUnit()
    bench = {"load_source": "dyno", "dyno_nm": 20.0, "motor_model": "foc"}

    sound = simulation(unit, SimSetRequest(text=json.dumps(bench).encode()))
    printed = simulation(unit, SimSetRequest(text=b'{"dyno_convention": "thesis"}'))

    assert (sound["dyno_convention"], sound["motor_model"]) == ("physical", "foc")
    assert (sound["energy_consistent"], sound["label"]) == (True, None)
    assert (printed["dyno_convention"], printed["load_source"]) == ("thesis", "dyno")
    assert (printed["energy_consistent"], printed["label"]) == (False, "not energy consistent")


@pytest.mark.parametrize(("convention", "breakaway_nm"), [("physical", 64.8), ("thesis", 6.36)])
def test_the_convention_decides_what_moves_a_bench_of_20_nm(
    convention: str, breakaway_nm: float
) -> None:
    """thesis_checks I-9: 20 Nm times 44/14 over 97 %, or divided by 44/14 as printed."""
    moved = []
    for torque_nm in (breakaway_nm - 0.2, breakaway_nm + 0.2):
        unit = LockstepUnit()
        unit.select_mode(0)
        unit.simulation_set({"load_source": "dyno", "dyno_nm": 20.0, "dyno_convention": convention})
        unit.rider("constant", torque_nm)
        unit.advance(1.0)
        moved.append(unit.observe()["speed_kmh"] > 0.0)

    assert moved == [False, True]


def test_a_scenario_leaves_the_bike_as_it_found_it() -> None:
    unit = LockstepUnit(scenario="worn_battery")
    unit.advance(10.0)

    unit.simulation_set({"scenario": "slippery_start"})
    unit.advance(3.0)

    seen = unit.observe()
    assert seen["battery_soc_pct"] > 80.0
    assert unit.simulation_get()["grip"] == 0.16
    unit.simulation_set({"scenario": "commute"})
    assert unit.simulation_get()["grip"] == 0.0


def test_the_battery_s_management_can_be_made_to_cut() -> None:
    unit = LockstepUnit()
    unit.rider("constant", 30.0)
    unit.advance(5.0)

    unit.simulation_set({"faults": {"battery_cut": True}})
    unit.advance(0.05)

    seen = unit.observe()
    assert seen["battery_cut"] == 1
    assert seen["motor_torque_nm"] == 0.0


def test_a_unit_that_no_factory_has_seen_gives_no_assist() -> None:
    unit = LockstepUnit(1, market="none")
    unit.select_mode(2)
    unit.rider("constant", torque_nm=30.0, cadence_rpm_max=70.0)

    unit.advance(10.0)

    assert unit.observe()["fault_flags"] == FaultFlags.NOT_PROVISIONED
    assert unit.observe()["motor_demand_nm"] == 0.0
