"""Goal: what a mode gives for a steady push is the law's own answer, after every limit.

Method: configurations where physics or the market says the answer without the law.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.errors import InvalidRequest
from backend.law import law_defaults, mode_curves

SPEEDS_KMH = list(range(1, 29))
OFF, FIXED_1_TO_1 = 0, 1


def config(**changes: object) -> dict[str, object]:
    """A strong motor and a battery that is not felt: a mode's own ratio decides."""
    known = law_defaults()
    known |= {"mode_laws": ["off", "fixed", "fixed", "fuzzy", "fuzzy"]}
    known |= {"mode_ratios": [0.0, 1.0, 2.0, 1.0, 1.0]}
    known |= {"mode_tapers": ["none"] * 5, "assist_cutoff_band_kmh": 0.0}
    return known | changes


def test_a_fixed_ratio_gives_that_many_times_the_rider_s_torque_up_to_the_cut_off() -> None:
    curve = mode_curves(config(), 30.0, SPEEDS_KMH)[FIXED_1_TO_1]

    below = np.asarray(SPEEDS_KMH) <= 24
    assert curve.torque_nm[below] == pytest.approx(30.0, rel=0.01)
    # EN 15194, 4.2.12: no assist above 25 km/h.
    assert curve.torque_nm[np.asarray(SPEEDS_KMH) > 25].tolist() == [0.0, 0.0, 0.0]


def test_a_mode_that_is_off_gives_nothing_to_the_hardest_push() -> None:
    curve = mode_curves(config(), 30.0, SPEEDS_KMH)[OFF]

    assert (curve.torque_nm.max(), curve.torque_nm_most) == (0.0, 0.0)


def test_no_push_gets_more_than_the_motor_s_limit_allows() -> None:
    changed = config(motor_torque_nm_max=1.0)

    curves = mode_curves(changed, 30.0, SPEEDS_KMH)

    gear_ratio = float(str(changed["gear_ratio"]))
    assert max(curve.torque_nm_most for curve in curves) == pytest.approx(gear_ratio, rel=1e-3)


def test_a_slow_ramp_is_waited_for() -> None:
    slow = config(mode_ramp_up_nm_per_s=[5] * 5)

    assert mode_curves(slow, 30.0, [10])[FIXED_1_TO_1].torque_nm[0] == pytest.approx(30.0, rel=0.01)


def test_a_configuration_that_the_unit_refuses_has_no_curves() -> None:
    with pytest.raises(InvalidRequest):
        mode_curves(config(gear_ratio=-1.0), 30.0, SPEEDS_KMH)
