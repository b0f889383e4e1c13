"""Goal: what a ride took from its battery is what the charge fell by, whatever the reading did.

Method: charges made from a steady fall with what batteries' meters are known to do laid on it.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.core.channels import Values
from backend.core.charge_use import ChargeUse, charge_use

SECONDS: Values = np.arange(3600.0)


def falling(first_pct: float, last_pct: float, count: int = 3600) -> Values:
    """A steady fall, read in whole percent."""
    charge: Values = np.floor(np.linspace(first_pct, last_pct, count) + 0.5)
    return charge


def use_of(charge: Values, seconds: Values = SECONDS) -> ChargeUse:
    use = charge_use(charge, seconds)
    assert use is not None
    return use


def test_a_steady_fall_is_used_whole() -> None:
    use = use_of(falling(80.0, 50.0))

    assert (use.first_pct, use.last_pct, use.used_pct, use.jumps) == (80.0, 50.0, 30.0, ())
    assert use.used_so_far_pct[-1] == 30.0


@pytest.mark.parametrize(
    "glitch",
    [
        {0: 0.0, 1: 0.0, 2: 0.0},
        {3599: 0.0},
        {3599: 100.0},
        {1800: 0.0, 1801: 50.0},
        dict.fromkeys(range(1000, 1020), 50.0),
    ],
    ids=["0 at switch-on", "0 at the end", "100 at the end", "connects anew", "50 for 20 s"],
)
def test_a_glitch_uses_nothing(glitch: dict[int, float]) -> None:
    charge = falling(80.0, 50.0)
    for second, reading in glitch.items():
        charge[second] = reading

    use = use_of(charge)

    assert use.used_pct == pytest.approx(30.0, abs=1.0)
    assert use.jumps == ()


def test_a_minute_of_zeros_before_the_battery_answers_is_no_reading() -> None:
    charge = np.concatenate((np.zeros(60), falling(80.0, 50.0, 3540)))

    use = use_of(charge)

    assert (use.first_pct, use.used_pct, use.jumps) == (80.0, 30.0, ())


def test_an_empty_battery_is_at_zero() -> None:
    use = use_of(falling(12.0, 0.0))

    assert (use.last_pct, use.used_pct) == (0.0, 12.0)


def test_a_charge_on_the_way_and_a_battery_that_is_changed_are_told_and_counted_on() -> None:
    charge = np.concatenate((falling(85.0, 12.0, 1800), falling(100.0, 64.0, 1800)))

    use = use_of(charge)

    (jump,) = use.jumps
    assert (jump.at_s, jump.from_pct, jump.to_pct) == (1800.0, 12.0, 100.0)
    assert use.used_pct == 109.0


def test_another_battery_with_less_charge_was_not_used_empty_in_a_second() -> None:
    charge = np.concatenate((falling(90.0, 60.0, 1800), falling(30.0, 10.0, 1800)))

    use = use_of(charge)

    assert [(one.from_pct, one.to_pct) for one in use.jumps] == [(60.0, 30.0)]
    assert use.used_pct == 50.0


def test_what_was_used_in_a_gap_of_the_recording_is_used() -> None:
    seconds = np.concatenate((np.arange(600.0), 3000.0 + np.arange(600.0)))
    charge = np.concatenate((falling(90.0, 85.0, 600), falling(60.0, 55.0, 600)))

    use = use_of(charge, seconds)

    assert (use.used_pct, use.jumps) == (35.0, ())


def test_a_long_descent_gives_some_back_and_is_no_charger() -> None:
    charge = np.concatenate((falling(60.0, 40.0, 1800), falling(40.0, 43.0, 900),
                             falling(43.0, 35.0, 900)))  # fmt: skip

    use = use_of(charge)

    assert use.jumps == ()
    assert use.used_pct == 25.0


def test_readings_that_are_missing_are_no_zeros() -> None:
    charge = falling(80.0, 50.0)
    charge[::2] = np.nan

    assert use_of(charge).used_pct == 30.0
    assert charge_use(np.full(10, np.nan), np.arange(10.0)) is None


def test_a_ride_of_seconds_has_a_charge() -> None:
    assert use_of(np.array([70.0]), np.array([0.0])).used_pct == 0.0
    assert use_of(np.array([70.0, 69.0]), np.array([0.0, 1.0])).used_pct in {0.0, 1.0}
