"""Goal: the surface of what arrives is the law's own answer for long, and what a limit takes is
what its own figure says.

Method: configurations where one limit decides and its formula is known without the law: the motor's
torque, the rating of the market, the battery's power, the cut-off; and every point held for five
minutes by the law itself, without the hurry of the surface.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.errors import InvalidRequest
from backend.law import law_defaults, torque_surface
from sim_device.firmware.python import law

SPEEDS_KMH = np.linspace(0.0, 25.0, 6)
RATES = np.linspace(0.0, 0.9, 4)
SPORT = 3
CRANK_RAD_PER_S = 2.0 * np.pi
FIVE_MINUTES = 30_000


def config(**changes: object) -> dict[str, object]:
    """Sport runs by a table whose gain is 0.5 everywhere: 1.5 times the ratio, whatever else."""
    known = law_defaults()
    known |= {"fuzzy_rules": [["PB"] * 5] * 5, "fuzzy_inference": "weighted_average"}
    known |= {"mode_laws": ["off", "fixed", "fixed", "fuzzy", "fuzzy"], "mode_tables": [0] * 5}
    known |= {"mode_ratios": [0.0, 1.0, 2.0, 1.0, 1.0], "mode_torque_pct": [100] * 5}
    return known | changes


def test_what_nothing_holds_back_arrives_as_it_is_asked_up_to_the_cut_off() -> None:
    surface = torque_surface(config(), SPORT, 10.0, SPEEDS_KMH, RATES)

    assert surface.demanded_nm == pytest.approx(15.0, rel=1e-3)
    assert surface.delivered_nm[:5] == pytest.approx(15.0, rel=1e-3)
    assert surface.limit_flags[:5].max() == 0
    # EN 15194, 4.2.12: none at 25 km/h.
    assert surface.delivered_nm[5].max() == 0.0
    assert (surface.limit_flags[5] & law.LIMITS["speed_cutoff"] > 0).all()


def test_the_motor_and_the_rating_of_the_market_take_what_their_own_figures_say() -> None:
    gear_ratio = float(law_defaults()["gear_ratio"])
    weak = torque_surface(config(motor_torque_nm_max=0.5), SPORT, 30.0, SPEEDS_KMH[:5], RATES)
    assert weak.delivered_nm == pytest.approx(0.5 * gear_ratio, rel=1e-3)
    assert (weak.limit_flags & law.LIMITS["motor_torque"] > 0).all()

    rated = torque_surface(config(), SPORT, 50.0, SPEEDS_KMH[:5], RATES)
    # 471 W are asked; 250 W are allowed for long (EN 15194, scope), at one turn a second.
    assert rated.delivered_nm * CRANK_RAD_PER_S == pytest.approx(250.0, rel=0.01)
    assert (rated.limit_flags & law.LIMITS["market"] > 0).all()


@pytest.mark.parametrize("rider_torque_nm", [20.0, 33.0])
def test_it_is_what_the_law_gives_after_five_minutes(rider_torque_nm: float) -> None:
    known = law_defaults()
    surface = torque_surface(known, SPORT, rider_torque_nm, SPEEDS_KMH, RATES)

    for row, column in [(0, 0), (1, 3), (3, 1), (4, 2), (5, 3)]:
        one = law.AssistLaw(known)
        inputs = law.pack_inputs(
            {
                "torque_raw_counts": known["sensor_offset_counts"]
                + rider_torque_nm / known["sensor_gain_nm_per_count"],
                "speed_kmh": [SPEEDS_KMH[row]],
                "cadence_rpm": 60.0,
                "motor_speed_rpm": 60.0 * known["gear_ratio"],
                "battery_voltage_v": 36.0,
                "mode": SPORT,
                "brake": 0,
            }
        )
        one.hold(inputs, float(RATES[column]), FIVE_MINUTES)
        held_nm = one.trace(inputs).output["motor_torque_nm"] * known["gear_ratio"]
        assert surface.delivered_nm[row, column] == pytest.approx(held_nm, rel=0.01, abs=0.05)


def test_a_slow_ramp_does_not_tell_because_it_ends() -> None:
    slow = config(mode_ramp_up_nm_per_s=[5] * 5)

    surface = torque_surface(slow, SPORT, 10.0, SPEEDS_KMH[:5], RATES)

    assert surface.delivered_nm == pytest.approx(15.0, rel=1e-3)


def test_what_the_unit_refuses_and_a_grid_beyond_all_need_are_refused() -> None:
    with pytest.raises(InvalidRequest):
        torque_surface(config(gear_ratio=-1.0), SPORT, 30.0, SPEEDS_KMH, RATES)
    with pytest.raises(InvalidRequest, match="coarser"):
        torque_surface(config(), SPORT, 30.0, np.zeros(100), np.zeros(100))
