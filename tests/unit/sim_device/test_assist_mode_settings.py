"""Goal: each mode slot has its own law, taper, table, ramps and torque; walk assist pushes a bike
beside its rider, and only while it may.

Method: scripted readings through the unit's own C. Expected values are worked out by hand from
thesis_checks 5 (A5), 6 and the law texts of peers 5; the walked bike is one line of Newton.
"""

from typing import Any

import numpy as np
import pytest

from firmware_protocol._generated import LimitFlags
from firmware_protocol.parameters import default_config
from sim_device.firmware.python.law import AssistLaw, assist_run, gain_points

GEAR_RATIO = 40.34
TOUR, SPORT, BOOST = 2, 3, 4
STEP_S = 0.01


def run(steps: int = 400, **given: Any) -> dict[str, Any]:
    config = {**default_config(), **given.pop("config", {})}
    readings = {
        "torque_raw_counts": np.full(steps, 2000.0),
        "speed_kmh": 10.0,
        "cadence_rpm": 60.0,
        "motor_speed_rpm": 300.0,
        "battery_voltage_v": 38.0,
        "mode": TOUR,
        "brake": 0,
    }
    return assist_run(config, {**readings, **given})


def ratio_at(taper: str, speed_kmh: float, ratio: float, market: str = "us_class_3") -> float:
    tapers = [taper] * 5
    ratios = [ratio] * 5
    free = {"mode_tapers": tapers, "mode_ratios": ratios, "market": market}
    return float(run(1, speed_kmh=speed_kmh, config=free)["assist_ratio"][0])


@pytest.mark.parametrize(
    ("speed_kmh", "ratio"), [(0, 1), (15, 1), (18, 2 / 3), (20, 4 / 9), (24, 0), (25, 0)]
)
@pytest.mark.parametrize("taper", ["taper_speeds", "japan_1_to_1"])
def test_japan_s_old_rule_is_the_fixed_law_of_the_thesis(
    taper: str, speed_kmh: float, ratio: float
) -> None:
    assert ratio_at(taper, speed_kmh, 1.0) == pytest.approx(ratio, abs=0.005)


@pytest.mark.parametrize(
    ("speed_kmh", "ratio"),
    [(0, 2.0), (10, 2.0), (15, 1.286), (20, 0.571), (22, 0.286), (24, 0.0), (30, 0.0)],
)
def test_japan_s_present_rule_falls_from_two_at_10_to_nothing_at_24(
    speed_kmh: float, ratio: float
) -> None:
    assert ratio_at("japan_2_to_1", speed_kmh, 3.0) == pytest.approx(ratio, abs=0.001)


def test_a_ceiling_leaves_a_smaller_ratio_alone() -> None:
    assert ratio_at("japan_2_to_1", 15.0, 1.25) == 1.25
    assert ratio_at("japan_2_to_1", 20.0, 1.25) == pytest.approx(4 / 7, abs=1e-6)


def test_a_free_ratio_does_not_fall() -> None:
    assert [ratio_at("none", v, 1.7) for v in (0.0, 15.0, 24.9)] == pytest.approx([1.7] * 3)


def test_each_mode_has_the_table_it_was_given() -> None:
    gentle = [0.0, 0.05, 0.1, 0.15, 0.2]
    config = {**default_config(), "mode_tables": [0, 0, 0, 0, 1], "second_gain_points": gentle}

    first_gain = run(1, torque_raw_counts=[0.0], mode=SPORT, config=config)["fuzzy_gain"]
    second_gain = run(1, torque_raw_counts=[0.0], mode=BOOST, config=config)["fuzzy_gain"]

    # At 10 km/h and no rise the rule is ZO: the middle one of each table's gains.
    assert (first_gain, second_gain) == (pytest.approx([0.3]), pytest.approx([0.1]))
    assert gain_points(config, [10.0], [0.0]) == pytest.approx([0.3])


def test_the_slower_of_two_ramps_decides() -> None:
    slow = {"mode_ramp_up_nm_per_s": [2000, 2000, 20, 2000, 2000], "torque_filter_s": 0.02}

    slow_nm = run(mode=TOUR, config=slow)["motor_torque_nm"] * GEAR_RATIO
    other_nm = run(mode=SPORT, config=slow)["motor_torque_nm"] * GEAR_RATIO

    assert np.diff(slow_nm).max() == pytest.approx(0.2, rel=1e-3)  # 20 Nm/s for 10 ms
    assert np.diff(other_nm).max() == pytest.approx(2.0, rel=1e-3)


def test_a_mode_can_have_less_torque_than_the_others() -> None:
    share = {"mode_torque_pct": [100, 100, 30, 100, 100]}
    hard = np.full(400, 8000.0)

    little = run(torque_raw_counts=hard, mode=TOUR, config=share)
    all_of_it = run(torque_raw_counts=hard, mode=SPORT, config=share)

    assert little["motor_torque_nm"][-1] == pytest.approx(0.6)
    assert little["limit_flags"][-1] == LimitFlags.MOTOR_TORQUE
    assert all_of_it["motor_torque_nm"][-1] == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("name", "degc", "share"),
    [
        ("motor_temperature_degc", 110.0, 1.0),
        ("motor_temperature_degc", 120.0, 0.5),
        ("motor_temperature_degc", 130.0, 0.0),
        ("controller_temperature_degc", 85.0, 1.0),
        ("controller_temperature_degc", 92.5, 0.5),
        ("controller_temperature_degc", 100.0, 0.0),
        ("motor_temperature_degc", float("nan"), 1.0),
    ],
)
def test_heat_takes_torque_away_before_it_becomes_a_fault(
    name: str, degc: float, share: float
) -> None:
    outputs = run(torque_raw_counts=np.full(400, 9000.0), **{name: degc})

    assert outputs["motor_torque_nm"][-1] == pytest.approx(2.0 * share, abs=1e-5)
    assert bool(outputs["limit_flags"][-1] & LimitFlags.TEMPERATURE) == (share < 1.0)


def test_a_sagging_battery_is_asked_for_less_before_it_is_cut() -> None:
    pushed = {"torque_raw_counts": np.full(400, 9000.0), "motor_speed_rpm": 2000.0}
    lossless = {"motor_temperature_degc": 20.0, "battery_current_a": 0.0}

    amperes = {}
    for volts in (33.0, 31.5, 30.3):
        nm = run(battery_voltage_v=volts, **pushed, **lossless)
        current_a = nm["motor_torque_nm"][-1] / 0.112
        back_emf_v = 0.112 * 2000.0 * np.pi / 30
        amperes[volts] = current_a * (current_a * 0.25 + back_emf_v) / volts

    assert amperes == pytest.approx({33.0: 12.0, 31.5: 6.0, 30.3: 1.2}, rel=1e-3)


def lost_from(step: int, steps: int) -> Any:
    return np.maximum(np.arange(steps) - step, 0) * 10


def test_a_lost_rotor_is_believed_for_50_ms_and_then_ramped_out() -> None:
    torque_nm = run(600, torque_age_ms=lost_from(400, 600))["motor_torque_nm"] * GEAR_RATIO

    held, after = torque_nm[400:406], torque_nm[406:]
    assert held.min() > 19.9
    assert np.diff(torque_nm[405:411]).min() == pytest.approx(-4.0, rel=1e-3)  # 400 Nm/s
    assert not after[5:].any()


def test_a_gentle_mode_does_not_stretch_the_loss_of_the_rotor() -> None:
    gentle = {"assist_ramp_down_nm_per_s": 20.0}
    outputs = run(600, torque_age_ms=lost_from(400, 600), config=gentle)

    assert not outputs["motor_torque_nm"][406 + 20 :].any()  # 80 Nm at 400 Nm/s: 0.2 s
    assert outputs["limit_flags"][406] & LimitFlags.FAULT
    assert np.isnan(outputs["rider_torque_nm"][450])


def test_a_forbidden_motor_gives_nothing_in_the_same_step() -> None:
    outputs = run(inhibit=np.arange(400) >= 300)

    assert outputs["motor_torque_nm"][299] > 0.0
    assert not outputs["motor_torque_nm"][300:].any()
    assert outputs["limit_flags"][300] & LimitFlags.FAULT


class WalkedBike:
    """A bike of `mass_kg` on a road of `slope_n` newtons, pushed by the motor alone.

    44/14 teeth, 0.33 m, gears of 92 % and a chain of 97 % (thesis_checks 4.7).
    """

    def __init__(self, mass_kg: float, slope_n: float = 0.0, **config: Any) -> None:
        self.law = AssistLaw({**default_config(), **config})
        self.mass_kg, self.slope_n = mass_kg, slope_n
        self.speed_kmh = 0.0

    def go(self, seconds: float, **pressed: Any) -> list[float]:
        torques = []
        for _ in range(round(seconds / STEP_S)):
            torque_nm = self.law.step(
                torque_raw_counts=0.0,
                speed_kmh=self.speed_kmh,
                motor_speed_rpm=100.0 * self.speed_kmh,
                battery_voltage_v=38.0,
                **{"cadence_rpm": 0.0, "mode": TOUR, "brake": 0, "walk_button": 1, **pressed},
            )["motor_torque_nm"]
            push_n = torque_nm * GEAR_RATIO * 0.92 * 0.97 * 14 / 44 / 0.33
            acceleration = (push_n - self.slope_n) / self.mass_kg
            self.speed_kmh = max(self.speed_kmh + 3.6 * acceleration * STEP_S, 0.0)
            torques.append(torque_nm)
        return torques


@pytest.mark.parametrize(("mass_kg", "slope_n"), [(25.0, 2.0), (25.0, 20.0), (100.0, 8.0)])
@pytest.mark.slow
def test_walk_assist_holds_its_speed_and_never_passes_6_kmh(mass_kg: float, slope_n: float) -> None:
    bike = WalkedBike(mass_kg, slope_n)
    bike.go(0.1, walk_button=0)

    speeds = []
    for _ in range(300):
        bike.go(0.1)
        speeds.append(bike.speed_kmh)

    assert speeds[-1] == pytest.approx(5.0, abs=0.1)
    assert max(speeds) < 6.0


@pytest.mark.parametrize(
    "end", [{"walk_button": 0}, {"cadence_rpm": 20.0}, {"cadence_rpm": -20.0}, {"brake": 1}]
)
def test_walk_assist_ends_in_the_step_that_ends_it_and_waits_for_a_new_press(
    end: dict[str, Any],
) -> None:
    bike = WalkedBike(100.0, 8.0)
    bike.go(0.1, walk_button=0)
    assert bike.go(2.0)[-1] > 0.1

    ended = bike.go(0.1, **end)
    held_on = bike.go(1.0)
    bike.go(0.1, walk_button=0)
    again = bike.go(1.0)

    assert not any(ended)
    assert any(held_on) == ("walk_button" in end)
    assert again[-1] > 0.0


def test_a_button_held_at_switch_on_or_at_speed_does_nothing() -> None:
    at_switch_on = WalkedBike(100.0)
    rolling = WalkedBike(100.0)
    rolling.go(0.1, walk_button=0)
    rolling.speed_kmh = 12.0

    assert not any(at_switch_on.go(1.0))
    assert not any(rolling.go(0.5))
    rolling.speed_kmh = 3.0
    assert not any(rolling.go(0.5))  # it was pressed too fast; slowing down is no press


def test_a_bike_held_back_gets_half_the_motor_and_no_lunge_when_let_go() -> None:
    bike = WalkedBike(25.0, slope_n=200.0)
    bike.go(0.1, walk_button=0)

    blocked = bike.go(20.0)
    bike.slope_n = 2.0
    speeds = []
    for _ in range(60):
        bike.go(0.1)
        speeds.append(bike.speed_kmh)

    assert max(blocked) == pytest.approx(1.0)
    assert max(speeds) < 6.3


@pytest.mark.parametrize(
    "never", [{"mode": 0}, {"config": {"walk_speed_kmh": 0.0}}, {"config": {"market": "japan"}}]
)
def test_there_is_no_walk_assist_where_it_is_not_wanted(never: dict[str, Any]) -> None:
    bike = WalkedBike(25.0, **never.pop("config", {}))
    bike.go(0.1, walk_button=0, **never)

    assert not any(bike.go(2.0, **never))
