"""Goal: who rides at the speed limit feels no motor switch on and off; EN 15194 asks for a
progressive reduction.

Method: legs that hold 25 km/h with the motor and less without, on the level in virtual
time, a factory unit beside the thesis's, which cuts hard. Half a minute of steady riding is looked
at in every control step.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sim_device.lockstep import LockstepUnit
from sim_device.preset import load
from sim_device.preset_unit import preset_unit
from tests.fakes.thesis import THESIS

SPORT = 3
SEED = 5
SETTLED_S, LOOKED_S, STEP_S = 40.0, 30.0, 0.01


def at_the_limit(unit: LockstepUnit) -> tuple[float, float, float]:
    """Times a second the motor is switched, the scatter of its torque at the crank in Nm, km/h."""
    unit.select_mode(SPORT)
    unit.place(24.0)
    unit.rider("legs", 16.0, 140.0)
    unit.advance(SETTLED_S)
    torque_nm, speed_kmh = [], []
    for _ in range(round(LOOKED_S / STEP_S)):
        unit.advance(STEP_S)
        seen = unit.observe()
        torque_nm.append(seen["motor_demand_nm"] * THESIS["gear_ratio"])
        speed_kmh.append(seen["speed_kmh"])
    switched = np.count_nonzero(np.diff(np.array(torque_nm) > 0.0))
    return switched / LOOKED_S, float(np.std(torque_nm)), float(np.mean(speed_kmh))


def test_the_thesis_s_hard_cut_is_felt() -> None:
    switched_hz, scatter_nm, _ = at_the_limit(preset_unit("thesis", SEED, {}))

    assert switched_hz > 2.0
    assert scatter_nm > 5.0


@pytest.mark.parametrize(
    ("market", "parameters"),
    [("eu_epac", {}), ("uk", {}), ("china", {}), ("eu_epac", load("thesis").values)],
    ids=["eu", "uk", "china", "the thesis set on a unit for the eu"],
)
def test_a_unit_for_the_road_is_never_switched(market: str, parameters: dict[str, Any]) -> None:
    switched_hz, scatter_nm, speed_kmh = at_the_limit(LockstepUnit(SEED, parameters, market=market))

    assert switched_hz == 0.0
    assert scatter_nm < 1.0
    _, _, hard_kmh = at_the_limit(preset_unit("thesis", SEED, {}))
    # What the band costs a rider who could go on at the limit.
    assert hard_kmh - speed_kmh < 0.6
