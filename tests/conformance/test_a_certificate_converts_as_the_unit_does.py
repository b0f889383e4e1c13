"""Goal: a calibration's coefficients mean in Python what they mean in the unit.

The certificate's arithmetic is Python's in float64, because `evaluate` recomputes it to the last
digits; the unit's is C in float32 (docs/adr/0025). Method: random readings, temperatures and
coefficients, each also unknown, through both. What may differ is the rounding of float32: at each
of the law's seven operations half a unit in the last place of the largest term.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.calibration.coefficients import Coefficients
from backend.calibration.unit_record import PARAMETER_OF
from sim_device.firmware.python.law import rider_torque_nm

READINGS = 500
SEEDS = range(40)
OPERATIONS = 7
HALF_ULP = np.finfo(np.float32).eps / 2


def drawn(random: np.random.Generator) -> Coefficients:
    """As the unit keeps them: float32. Each that may be unknown is so in one of four."""

    def unknown_or(low: float, high: float) -> float | None:
        value = float(np.float32(random.uniform(low, high)))
        return None if random.random() < 0.25 else value

    return Coefficients(
        float(np.float32(random.uniform(-500.0, 500.0))),
        float(np.float32(random.uniform(0.0085, 0.0115))),
        unknown_or(-10.0, 10.0),
        unknown_or(-1e-3, 1e-3),
        unknown_or(-20.0, 40.0),
    )


def torques_of(
    coefficients: Coefficients, raw: np.ndarray, degc: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The unit's and the certificate's."""
    config = {parameter: getattr(coefficients, name) for name, parameter in PARAMETER_OF.items()}
    return rider_torque_nm(config, raw, degc), coefficients.torque_nm(raw, degc)


@pytest.mark.parametrize("seed", SEEDS)
def test_both_make_the_same_torque_of_a_reading(seed: int) -> None:
    random = np.random.default_rng(seed)
    coefficients = drawn(random)
    raw = random.integers(-32767, 32768, READINGS).astype(np.float64)
    degc = np.round(random.uniform(-40.0, 90.0, READINGS), 1).astype(np.float32).astype(np.float64)
    degc[random.random(READINGS) < 0.1] = np.nan

    of_unit, of_certificate = torques_of(coefficients, raw, degc)

    largest = np.abs(raw) + abs(coefficients.offset_counts) + 10.0 * 130.0
    rounding = OPERATIONS * HALF_ULP * largest * coefficients.gain_nm_per_count * 1.2
    assert (np.abs(of_unit - of_certificate) <= rounding).all()


def test_a_thermometer_that_is_broken_corrects_nothing_in_either() -> None:
    coefficients = Coefficients(10.0, 0.01, 5.0, 1e-3, 20.0)
    degc = np.array([219.0, 221.0, -179.0, -181.0, np.inf, np.nan])

    of_unit, of_certificate = torques_of(coefficients, np.full(6, 5000.0), degc)

    assert of_certificate == pytest.approx(of_unit, rel=1e-5)
    assert of_certificate[[1, 3, 4, 5]] == pytest.approx(49.9)
