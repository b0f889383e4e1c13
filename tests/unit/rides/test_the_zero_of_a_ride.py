"""Goal: the zero of a ride is what the sensor reads while coasting, and a ride that cannot tell it
says why.

Method: rides of the simulated bike, coasting and standing by a planted zero; their columns spoiled
in a known way: a foot on the pedal, a torque that moves, channels that are missing.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from backend.core.channels import Values
from backend.rides.diagnosis.finding import Evidence, Limits
from backend.rides.diagnosis.zero import zero_of
from tests.fakes.simulated_ride import GAIN_NM_PER_COUNT, LOOK_S, Step, simulated_ride

LEGS = {"kind": "legs", "torque_nm": 30.0, "cadence_rpm_max": 90.0}
RIDING = {"rider": LEGS, "brake": False, "assist_mode": 3}
COASTING = {"rider": {"kind": "off"}}
STANDING = {"rider": {"kind": "off"}, "brake": True}
NM_PER_K, ZERO_COUNTS = 0.03, 80.0
BIKE = {
    "sensor.zero_nm_per_k": NM_PER_K,
    "sensor.zero_counts": ZERO_COUNTS,
    # Soaked through before it rides.
    "sensor.board_soak_s": 0.5,
    "sensor.gauge_soak_s": 0.5,
}


@cache
def columns(ambient_degc: float = 20.0, coasts: int = 4) -> dict[str, Values]:
    steps: list[Step] = [(10.0, {"ambient_degc": ambient_degc} | STANDING)]
    for _ in range(coasts):
        steps += [(15.0, RIDING), (14.0, COASTING)]
    ride = simulated_ride([*steps, (20.0, STANDING)], bike=BIKE)
    return ride | {"sensor_temperature_degc": np.full(len(ride["speed_kmh"]), ambient_degc)}


def evidence(changed: dict[str, Values], derived: tuple[str, ...] = ()) -> Evidence:
    count = len(changed["speed_kmh"])
    times_s = np.arange(count) * LOOK_S
    steps_s = np.full(count, LOOK_S)
    return Evidence(changed, times_s, steps_s, Limits(0), derived=frozenset(derived))


def coasting(ride: dict[str, Values]) -> Values:
    return (ride["cadence_rpm"] == 0.0) & (ride["speed_kmh"] > 3.0)


def test_a_planted_zero_is_found_in_newton_metres_and_counts() -> None:
    zero = zero_of(evidence(columns()))

    planted_nm = ZERO_COUNTS * GAIN_NM_PER_COUNT
    assert zero.reason is None
    assert zero.pieces >= 6
    assert zero.uncertainty_nm is not None
    assert 0.01 / 12**0.5 <= zero.uncertainty_nm < 0.1
    # Hysteresis and creep of the simulated sensor leave less than 0.1 Nm.
    assert zero.zero_nm == pytest.approx(planted_nm, abs=0.1)
    assert zero.zero_counts == pytest.approx(zero.zero_nm / GAIN_NM_PER_COUNT, abs=1.0)
    assert zero.temperature_degc == 20.0


def test_a_colder_ride_has_the_zero_of_its_temperature() -> None:
    warm, cold = (zero_of(evidence(columns(degc))) for degc in (20.0, -5.0))

    assert warm.zero_nm is not None
    assert cold.zero_nm is not None
    assert cold.zero_nm - warm.zero_nm == pytest.approx(-25.0 * NM_PER_K, abs=0.05)
    assert cold.temperature_degc == -5.0


def test_a_foot_that_rests_while_the_bike_stands_moves_nothing() -> None:
    ride = columns()
    foot = np.where(ride["speed_kmh"] < 0.5, 6.0, 0.0)

    pressed = ride | {"rider_torque_nm": ride["rider_torque_nm"] + foot}

    assert zero_of(evidence(pressed)) == zero_of(evidence(ride))


def test_a_foot_in_one_stretch_of_coasting_is_outvoted() -> None:
    ride = columns()
    first = np.flatnonzero(coasting(ride))[0]
    foot = np.zeros(len(ride["speed_kmh"]))
    foot[first : first + round(14.0 / LOOK_S)] = 5.0

    pressed = zero_of(evidence(ride | {"rider_torque_nm": ride["rider_torque_nm"] + foot}))

    assert pressed.zero_nm == pytest.approx(zero_of(evidence(ride)).zero_nm, abs=0.1)


@pytest.mark.parametrize(
    ("push_nm", "reason"),
    [
        (lambda at_s: np.full(len(at_s), 20.0), "foot"),
        (lambda at_s: np.sin(at_s), "not_still"),
        # Another foot on the pedal in every stretch.
        (lambda at_s: np.floor(at_s / 29.0), "disagree"),
    ],
)
def test_coasting_under_a_push_is_no_zero(push_nm: Callable[[Values], Values], reason: str) -> None:
    ride = columns()
    times_s = np.arange(len(ride["speed_kmh"])) * LOOK_S

    pushed = ride["rider_torque_nm"] + push_nm(times_s)

    zero = zero_of(evidence(ride | {"rider_torque_nm": pushed}))
    assert (zero.zero_nm, zero.uncertainty_nm, zero.reason) == (None, None, reason)


def test_what_a_ride_lacks_is_said() -> None:
    ride = columns()

    def why(*gone: str) -> str | None:
        return zero_of(evidence({k: v for k, v in ride.items() if k not in gone})).reason

    assert why("rider_torque_nm") == "no_torque"
    assert why("cadence_rpm") == "no_cadence"
    assert zero_of(evidence(ride, derived=("rider_torque_nm",))).reason == "no_torque"
    pedalled = ride | {"cadence_rpm": np.full(len(ride["speed_kmh"]), 60.0)}
    assert zero_of(evidence(pedalled)).reason == "no_coasting"
    bare = {k: v for k, v in ride.items() if k != "sensor_temperature_degc"}
    no_thermometer = zero_of(evidence(bare))
    assert no_thermometer.temperature_degc is None
    assert no_thermometer.zero_nm == zero_of(evidence(ride)).zero_nm
