"""Goal: what the two pedals read apart, and what the spindle's bending adds, is found as planted.

Method: the C sensor with a cross-talk k of a bending F b, felt most m degrees after the crank's
top (docs/simulated-bike.md). By hand, with a the angle of the pedal that is hung on, the right one
at 270 degrees when it is level: k F b cos(270 + a - m) = k F b (-sin m cos a + cos m sin a), of
the other sign on the left. As shares of F l: left/right -2 k b/l sin m, across k b/l cos m.
"""

from math import cos, radians, sin

import numpy as np
import pytest

from backend.calibration.asymmetry import Asymmetry
from backend.calibration.judgement import Limits
from backend.calibration.worked import work_out
from tests.fakes.calibration_bench import DISOBEYS, SETUP, Specimen, Workshop

SHARE, LEVER_M = 0.06, 0.1
SEEDS = range(1, 21)


def bent(mark_deg: float) -> Specimen:
    sensor = {"bending_share": SHARE, "bending_lever_m": LEVER_M, "bending_deg": mark_deg}
    return Specimen({"noise_nm": 0.06, **sensor}, angles_deg=(0.0, 40.0))


def asymmetry(specimen: Specimen, seed: int) -> Asymmetry:
    found = work_out(SETUP, Workshop(specimen, seed).captures(), None, Limits()).asymmetry
    assert found is not None
    return found


@pytest.mark.parametrize("mark_deg", [0.0, 45.0, 90.0, 200.0])
def test_a_cross_talk_is_found_within_its_uncertainty(mark_deg: float) -> None:
    """In nineteen of twenty; the dial is off by up to 2 degrees, one way on both sides."""
    share = SHARE * LEVER_M / SETUP.arm_m
    across, apart = share * cos(radians(mark_deg)), -2 * share * sin(radians(mark_deg))
    inside = []
    for seed in SEEDS:
        found = asymmetry(bent(mark_deg), seed)
        assert found.bending_across is not None
        inside.append(
            abs(found.bending_across.share - across) <= 2 * found.bending_across.standard
            and abs(found.left_right.share - apart) <= 2 * found.left_right.standard
        )
        assert found.bending_across.standard < 0.005

    assert np.mean(inside) >= 0.9


def test_a_weak_left_side_bends_nothing() -> None:
    specimen = Specimen({"noise_nm": 0.06}, left_gain=0.97, angles_deg=(0.0, 40.0))

    found = asymmetry(specimen, 2)

    assert found.bending_across is not None
    assert found.left_right.share == pytest.approx(0.03 / 0.985, abs=2 * found.left_right.standard)
    assert abs(found.bending_across.share) <= 2 * found.bending_across.standard


def test_a_bending_across_fails_by_its_own_name_where_both_sides_read_alike() -> None:
    worked = work_out(SETUP, Workshop(bent(0.0), 3).captures(), None, Limits())

    causes = {cause.code: cause.weight for cause in worked.judgement.causes}
    assert causes["bending"] == "fail"
    assert "left_right" not in causes


def test_a_level_crank_alone_tells_no_bending_across() -> None:
    level = asymmetry(DISOBEYS["asymmetric"], 2)

    assert level.left_right.share == pytest.approx(0.03 / 0.985, abs=2 * level.left_right.standard)
    assert level.bending_across is None
