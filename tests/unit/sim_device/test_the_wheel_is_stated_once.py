"""Goal: the size of a simulated bike's wheel is stated in one place, and its unit reads true.

Method: bikes with other wheels, their units new from the factory, asked over the wire.
"""

import math

import pytest

from spindle.testing import DriveUnit


@pytest.mark.parametrize("radius_m", [0.30, 0.33, 0.36])
def test_a_unit_leaves_the_factory_for_the_wheel_of_its_bike(radius_m: float) -> None:
    unit = DriveUnit(bike={"road.wheel_radius_m": radius_m})
    configured = unit.config().parameters

    unit.unit.place(18.0)
    unit.advance(0.5)
    told_kmh = unit.channels()["speed_kmh"]

    circumference_m = 2 * math.pi * radius_m
    assert configured["wheel_circumference_m"] == pytest.approx(circumference_m, abs=1e-6)
    assert told_kmh == pytest.approx(unit.observe()["speed_kmh"], abs=0.05)
