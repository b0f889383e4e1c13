"""Goal: a traced step is the step of the unit, and its parts add up to what the motor is told.

Method: configurations at the edges of every parameter ride through both, and output and memory are
compared to the bit. The parts are summed in double, and held against the output's own torque. The
rules' weights make the gain again by another way: the weighted mean of their peaks, and for the
centroid the area under the clipped triangles, integrated on a grid.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from sim_device.firmware.python._native import ffi, lib

from firmware_protocol.parameters import default_config
from sim_device.firmware.python.law import (
    OUTPUT_DTYPE,
    TRACE_STEPS,
    AssistLaw,
    gain_points,
    native_config,
    pack_inputs,
)
from tests import counts
from tests.fakes.accepted_laws import accepted_config, readings

CONFIGS = counts.of(2000)
STEPS = 60
RIDING: dict[str, Any] = {
    "torque_raw_counts": 3000.0,
    "speed_kmh": 12.0,
    "cadence_rpm": 60.0,
    "motor_speed_rpm": 2400.0,
    "battery_voltage_v": 36.0,
    "mode": 3,
    "brake": 0,
}


def memory_of(state: Any) -> bytes:
    return bytes(ffi.buffer(state))


def row(**changed: float) -> npt.NDArray[np.void]:
    return pack_inputs({name: [value] for name, value in {**RIDING, **changed}.items()})


@pytest.mark.large_count
@pytest.mark.slow
def test_a_traced_step_is_the_same_to_the_bit_and_its_parts_add_up() -> None:
    random = np.random.default_rng(20261123)
    took = dict.fromkeys(TRACE_STEPS, 0)

    for _ in range(CONFIGS):
        config = accepted_config(random)
        rows = readings(random, STEPS)
        native, plain = native_config(config), ffi.new("assist_state *")
        law = AssistLaw(config)
        output = np.empty(1, OUTPUT_DTYPE)
        for k in range(STEPS):
            lib.assist_step(
                native,
                plain,
                ffi.cast("assist_input *", ffi.from_buffer(rows[k : k + 1])),
                ffi.cast("assist_output *", ffi.from_buffer(output, require_writable=True)),
            )
            traced = law.trace(rows[k : k + 1])

            told = [traced.output[name] for name in OUTPUT_DTYPE.names or ()]
            np.testing.assert_array_equal(told, output[0].tolist())
            assert memory_of(plain) == memory_of(law._state)
            delivered_nm = float(output["motor_torque_nm"][0]) * float(native.gear_ratio)
            left_nm = np.array(list(traced.left_nm.values()))
            total_nm = float(np.diff(left_nm, prepend=0.0).sum())
            assert total_nm == pytest.approx(delivered_nm, rel=1e-6, abs=1e-30)
            assert np.all(np.diff(left_nm[TRACE_STEPS.index("ramps") :]) <= 0.0), traced
            for name, change in zip(TRACE_STEPS, np.diff(left_nm, prepend=0.0), strict=True):
                took[name] += change != 0.0

    assert min(took.values()) > 0, took


@pytest.mark.parametrize("inference", ["weighted_average", "mamdani_centroid"])
@pytest.mark.slow
def test_the_rules_that_fired_make_the_gain(inference: str) -> None:
    random = np.random.default_rng(3)
    grid = np.linspace(0.0, 0.5, 20_001)

    for _ in range(counts.of(1000)):
        labels = random.choice(["NB", "NS", "ZO", "PS", "PB"], (5, 5)).tolist()
        gains = np.sort(random.uniform(0.0, 0.08, 5)) + np.array([0.02, 0.12, 0.22, 0.32, 0.42])
        config = {
            **default_config(),
            "fuzzy_inference": inference,
            "fuzzy_rules": labels,
            "fuzzy_gain_points": gains.tolist(),
        }
        law = AssistLaw(config)
        speed_kmh, rate = random.uniform(0.0, 24.0), random.uniform(0.0, 1.0)
        law.hold(row(speed_kmh=speed_kmh), rate, 300)

        traced = law.trace(row(speed_kmh=speed_kmh))

        peaks = np.asarray(gains, np.float64)
        assert traced.output["torque_rate"] == pytest.approx(min(rate, 0.9), abs=1e-4)
        assert 1 <= len(traced.rules) <= 4
        for rule in traced.rules:
            assert labels[rule.row][rule.column] == ["NB", "NS", "ZO", "PS", "PB"][rule.label]
        if inference == "weighted_average":
            made = sum(rule.weight * peaks[rule.label] for rule in traced.rules)
        else:
            shape = np.zeros_like(grid)
            for rule in traced.rules:
                clipped = np.minimum(triangle(grid, peaks, rule.label), rule.weight)
                shape = np.maximum(shape, clipped)
            made = float((grid * shape).sum() / shape.sum())
        gain = traced.output["fuzzy_gain"]
        assert gain == pytest.approx(made, abs=2e-5)
        assert gain == gain_points(config, [speed_kmh], [traced.output["torque_rate"]])[0]


def triangle(grid: npt.NDArray[Any], peaks: npt.NDArray[Any], label: int) -> npt.NDArray[Any]:
    """An output set: 1 at its peak, 0 at its neighbours'; the outermost as wide outwards."""
    left = peaks[label] - peaks[label - 1] if label > 0 else peaks[1] - peaks[0]
    right = peaks[label + 1] - peaks[label] if label < 4 else peaks[4] - peaks[3]
    rising = 1.0 - (peaks[label] - grid) / left
    falling = 1.0 - (grid - peaks[label]) / right
    return np.clip(np.minimum(rising, falling), 0.0, None)


def left_by(config: dict[str, Any], **changed: float) -> tuple[dict[str, float], Any]:
    law = AssistLaw(config)
    law.run(np.repeat(row(), 400))
    traced = law.trace(row(**changed))
    return traced.left_nm, traced


def test_each_cut_takes_what_its_own_step_says() -> None:
    config = default_config()
    plain, _ = left_by(config)
    braked, _ = left_by(config, brake=1)
    fast, _ = left_by(config, speed_kmh=30.0)
    faulty, _ = left_by(config, inhibit=1, brake=1)
    stale, _ = left_by(config, torque_age_ms=200)

    assert plain["market"] > 0.0
    assert (braked["pedal_stop"] > 0.0, braked["brake"]) == (True, 0.0)
    assert fast["band"] == 0.0
    assert (fast["brake"] > 0.0, fast["speed"]) == (True, 0.0)
    assert (faulty["brake"], faulty["inhibit"]) == (0.0, 0.0)
    assert (stale["threshold"] > 0.0, stale["fresh"]) == (True, 0.0)
    assert stale["ramps"] > 0.0, "the torque that was given goes down on a ramp"


def test_a_refused_input_leaves_nothing_and_no_rules() -> None:
    left, traced = left_by(default_config(), mode=9)

    assert traced.result == "input_refused"
    assert not any(left.values())
    assert traced.rules == ()


def test_walk_assist_asks_in_the_place_of_the_law() -> None:
    law = AssistLaw({**default_config(), "walk_speed_kmh": 6.0})
    pushed = row(speed_kmh=2.0, cadence_rpm=0.0, motor_speed_rpm=0.0, walk_button=1)
    released = row(speed_kmh=2.0, cadence_rpm=0.0, motor_speed_rpm=0.0)
    law.run(np.concatenate([released, np.repeat(pushed, 50)]))

    traced = law.trace(pushed)

    assert traced.walk
    assert traced.rules == ()
    assert traced.left_nm["rider"] == traced.left_nm["fresh"] > 0.0
