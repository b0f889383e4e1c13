"""Goal: no capture while it is not steady, and no fit of what is obviously wrong; each by its name.

Method: raw counts of a pendulum, a warming, a creeping, a noisy and a dead sensor; then a sound
calibration in which one thing is wrong at a time.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from backend.calibration.capture import Capture, capture_of
from backend.calibration.prechecks import Measured, prechecks
from backend.calibration.sanity import refusals
from backend.calibration.setup import Setup
from backend.calibration.steady import Steadiness, Window, steadiness
from tests.fakes.calibration_bench import OBEYS, SETUP, Workshop

RATE_HZ, NOISE_COUNTS = 100, 5.0
SOUND = Workshop(OBEYS["table5_1"], 3).captures()
NM_PER_KG = SETUP.gravity.gravity_ms2 * SETUP.arm_m


def seen(shape: Callable[[np.ndarray], np.ndarray], duration_s: float = 4.0) -> Steadiness:
    """A load of 60 Nm, with what `shape` adds over time in counts, and white noise."""
    time_s = np.arange(int(duration_s * RATE_HZ)) / RATE_HZ
    noise = np.random.default_rng(1).normal(0, NOISE_COUNTS, time_s.size)
    raw = np.rint(6000 + shape(time_s) + noise).astype(int)
    found = steadiness(Window(raw.tolist(), duration_s), SETUP)
    assert found is not None
    return found


def codes(found: Steadiness) -> list[str]:
    return [reason.code for reason in found.reasons]


def test_noise_alone_is_steady() -> None:
    found = seen(np.zeros_like)

    assert found.steady
    assert found.deviation_counts == pytest.approx(NOISE_COUNTS, rel=0.1)
    # A block of a quarter second averages 25 readings.
    assert found.spread_counts < 2 * NOISE_COUNTS / 5


def test_a_mass_that_swings_is_told_from_a_sensor_that_is_noisy() -> None:
    # 0.25 m below the pedal: a pendulum of 1 Hz; 3 degrees either way pull 1 % more and less.
    assert codes(seen(lambda t: 60 * np.sin(2 * np.pi * 0.9 * t))) == ["swinging"]

    loud = np.random.default_rng(2).normal(0, 120, 400)
    assert codes(seen(lambda t: loud[: t.size])) == ["noisy"]


def test_a_creep_drifts_and_a_slow_one_of_noise_does_not() -> None:
    # 0.02 % of the scale a second.
    assert codes(seen(lambda t: 2.0 * t)) == ["drifting"]
    assert seen(lambda t: 2.0 * t).drift_counts == pytest.approx(8.0, abs=1.5)

    assert seen(lambda t: 0.5 * t).steady


def test_too_short_dead_or_at_its_end_is_said() -> None:
    assert codes(seen(np.zeros_like, 2.0)) == ["too_short"]
    for counts, code in ((5832, "stuck"), (32767, "end_of_range"), (-32767, "end_of_range")):
        found = steadiness(Window([counts] * 400, 4.0), SETUP)
        assert found is not None
        assert codes(found) == [code]


def test_a_damaged_word_is_rejected_and_many_are_refused() -> None:
    few = seen(lambda t: np.where(np.arange(t.size) == 40, 20000.0, 0.0))
    many = seen(lambda t: np.where(np.arange(t.size) % 10 == 0, 20000.0, 0.0))

    assert few.steady
    assert few.rejected == (40,)
    assert "outliers" in codes(many)


def test_a_sensor_that_warms_is_waited_for() -> None:
    raw = np.random.default_rng(1).normal(6000, 5, 400).astype(int).tolist()

    found = steadiness(Window(raw, 4.0, [20.0, 21.0, 22.0]), SETUP)

    assert found is not None
    assert codes(found) == ["temperature_moving"]


def with_counts(captures: list[Capture], change: Callable[[Capture], float]) -> list[Capture]:
    """The same captures, with other counts: each about its new mean."""
    return [
        capture_of(
            one.number,
            one.state,
            [round(value + change(one) - one.mean_counts) for value in one.raw_counts],
            one.duration_s,
            one.at_utc_us,
        )
        for one in captures
    ]


def named(setup: Setup, captures: list[Capture]) -> set[str]:
    return {refusal.code for refusal in refusals(setup, captures)}


def test_a_sound_calibration_is_not_refused() -> None:
    assert named(SETUP, SOUND) == set()


def test_newton_metres_named_as_kilograms_are_called_that() -> None:
    """10 Nm hung on, 10 named as kg: 10 kg would make 16.7 Nm."""
    told = [
        replace(one, state=replace(one.state, mass_kg=one.state.load_nm(SETUP))) for one in SOUND
    ]

    (refusal,) = refusals(SETUP, told)

    assert refusal.code == "looks_like_nm"
    assert refusal.figure == pytest.approx(1 / NM_PER_KG, rel=0.01)


def test_kilograms_named_as_newton_metres_are_called_that() -> None:
    told = [
        replace(one, state=replace(one.state, mass_kg=one.state.mass_kg / NM_PER_KG))
        for one in SOUND
    ]

    (refusal,) = refusals(SETUP, told)

    assert refusal.code == "looks_like_kg"
    assert "looks like kg: 10 read as Nm" in refusal.sentence


@pytest.mark.parametrize(("factor", "code"), [(0.7, "slope"), (1.4, "slope"), (-1.0, "against")])
def test_a_slope_beyond_the_bounds_is_refused(factor: float, code: str) -> None:
    assert named(SETUP, with_counts(SOUND, lambda one: factor * one.mean_counts)) == {code}


@pytest.mark.parametrize("factor", [0.82, 1.23])
def test_a_slope_within_them_is_not(factor: float) -> None:
    assert named(SETUP, with_counts(SOUND, lambda one: factor * one.mean_counts)) == set()


def test_a_mass_left_out_is_named_with_what_it_reads_like() -> None:
    wrong = next(one for one in SOUND if one.state.mass_kg == 36.0)

    (refusal,) = refusals(
        SETUP,
        with_counts(SOUND, lambda one: one.mean_counts * (34.8 / 36.0 if one is wrong else 1.0)),
    )

    assert (refusal.code, refusal.captures) == ("wrong_mass", (wrong.number,))
    assert refusal.figure == pytest.approx(34.8, abs=0.1)


def test_a_mass_on_the_other_pedal_is_named() -> None:
    wrong = next(one for one in SOUND if one.state.mass_kg == 24.0)

    (refusal,) = refusals(
        SETUP,
        with_counts(SOUND, lambda one: one.mean_counts * (-1.0 if one is wrong else 1.0)),
    )

    assert (refusal.code, refusal.captures) == ("swapped_pedal", (wrong.number,))
    assert refusal.values["side"] == wrong.state.side


def test_loads_out_of_order_are_named() -> None:
    first, second = [one for one in SOUND if one.state.kind == "load"][:2]
    swapped = [
        replace(one, state=second.state)
        if one is first
        else replace(one, state=first.state)
        if one is second
        else one
        for one in SOUND
    ]

    assert "order" in named(SETUP, swapped)


def test_a_step_is_repeated_from_the_side_it_is_come_to() -> None:
    """Up to 24 kg again from the zero that ends the stroke; not down to it from there."""
    ends = next(n for n, one in enumerate(SOUND) if n and one.state.mass_kg == 0.0)
    up, down = (
        next(one for one in SOUND[:ends] if (one.state.mass_kg, one.state.direction) == way)
        for way in ((24.0, "loading"), (24.0, "unloading"))
    )

    def repeated(one: Capture) -> set[str]:
        rest = [other for other in SOUND[: ends + 1] if other is not one]
        return named(SETUP, [*rest, replace(one, number=rest[-1].number + 1)])

    assert "order" not in repeated(up)
    assert "order" in repeated(down)


def test_the_way_down_may_begin_above_what_was_captured_on_the_way_up() -> None:
    top = max(one.state.mass_kg for one in SOUND)
    left_out = [
        one
        for one in SOUND
        if (one.state.mass_kg, one.state.direction, one.state.stroke) != (top, "loading", 1)
    ]

    assert "order" not in named(SETUP, left_out)


def test_prechecks_pass_fail_or_say_that_the_unit_does_not_tell() -> None:
    good = Measured(0.0, 0.0, 0.0, 0.4, 36.9, 31.0, 0.0)
    foot = replace(good, idle_nm=-6.2, cadence_rpm=12.0, warming_k=2.0, battery_v=30.0)

    assert [check.passed for check in prechecks(good)] == [True] * 4
    assert [check.passed for check in prechecks(foot)] == [False] * 4
    assert [check.passed for check in prechecks(Measured())] == [None] * 4
    # The figure that turns, and its unit.
    assert prechecks(foot)[0].values == {"wheel_kmh": 0.0, "cadence_rpm": 12.0, "motor_rpm": 0.0}
    assert "12 rpm" in prechecks(foot)[0].sentence
