"""Goal: A12 holds on rides nobody thought of: hills, ice, wind, bench, brakes, tired legs, gears,
both motors. Energy is neither made nor lost, and no bike is pulled backwards.

Method: each seed is another bike with another rider who changes his mind; the books are looked at
after every change. What is allowed comes from thesis_checks 5, the rest is mechanics.
"""

import random

import pytest

from sim_device.lockstep import LockstepUnit

CHANGES = 16


def bike_of(wishes: random.Random) -> dict[str, float]:
    return {
        "motor.model": wishes.choice([0.0, 0.0, 1.0]),
        "motor.hysteresis_nm": wishes.choice([0.0, 0.01]),
        "drivetrain.gear_drag_nm": wishes.choice([0.0, 0.015]),
        "drivetrain.chain_drag_nm": wishes.choice([0.0, 0.1]),
        "road.source": wishes.choice([0.0, 0.0, 1.0]),
        "road.grip": wishes.choice([0.0, 0.1, 0.3]),
        "rider.critical_power_w": wishes.choice([0.0, 150.0]),
        "rider.asymmetry": 0.1,
        "rider.stroke_noise": 0.05,
        "battery.capacity_ah": wishes.choice([0.3, 10.0]),
        "motor.switching_share": wishes.choice([0.0, 0.01]),
        "motor.standby_current_a": wishes.choice([0.0, 0.1]),
        "gears.cog_teeth_1": wishes.choice([0.0, 13.0]),
        "gears.cog_teeth_2": 21.0,
        "gears.cog_teeth_3": 34.0,
    }


def wish_of(wishes: random.Random) -> dict[str, object]:
    return {
        "rider": {
            "kind": wishes.choice(["off", "constant", "legs", "legs"]),
            "torque_nm": wishes.choice([-20.0, 10.0, 30.0, 60.0, 120.0]),
        },
        "road": {
            "grade_deg": wishes.uniform(-10.0, 10.0),
            "wind_ms": wishes.choice([0.0, -15.0, 10.0]),
        },
        "assist_mode": wishes.randrange(5),
        "brake": wishes.random() < 0.15,
        "walk_button": wishes.random() < 0.2,
        "dyno_nm": wishes.choice([0.0, 5.0, 40.0]),
    }


@pytest.mark.parametrize("seed", range(24))
@pytest.mark.slow
def test_a12_the_books_close_whatever_is_ridden(seed: int) -> None:
    wishes = random.Random(seed)
    unit = LockstepUnit(seed, bike=bike_of(wishes))

    for _ in range(CHANGES):
        unit.simulation_set(wish_of(wishes))
        unit.advance(wishes.uniform(0.1, 4.0))
        seen = unit.observe()
        assert seen["speed_kmh"] >= 0.0
        assert seen["wheel_speed_kmh"] >= 0.0
        # NaN says that there was no work to speak of yet.
        assert not seen["energy_balance_error_pct"] > 1.0


def test_on_ice_uphill_a_bike_that_nothing_drives_stands() -> None:
    unit = LockstepUnit(bike={"road.grip": 0.1})
    unit.road(grade_deg=9.0)
    unit.rider("off")

    unit.advance(5.0)

    seen = unit.observe()
    assert (seen["speed_kmh"], seen["wheel_speed_kmh"], seen["distance_m"]) == (0.0, 0.0, 0.0)
