"""Goal: no configuration that the unit takes is a throttle. The motor follows legs that push, never
more than the mode says, and is without torque soon after they do not.

Method: configurations drawn at the edges of every parameter (filters, ramps, thresholds, tables,
ratios, gear) ride with one steady rider. How long assist may outlive the push is what
docs/safety.md promises, written down here again.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from sim_device.firmware.python._native import ffi, lib

from firmware_protocol._generated import Status
from firmware_protocol.layout import Value
from firmware_protocol.parameters import default_config
from sim_device.firmware.python.law import OUTPUT_DTYPE, STEP_S, native_config, pack_inputs
from tests import counts
from tests.fakes.accepted_laws import RIDING, accepted_config
from tests.fakes.bench_unit import BenchUnit

CONFIGS = counts.of(3000)
FUZZY_GAIN_MAX = 0.5
ROUNDING = 0.01
"""Room for a reading in float32 beside an offset of 30,000 counts."""
NOTHING_NM = 1e-30
"""Far above float32's denormals, where a ratio of 1e-45 rounds by more than a hundredth."""
LEGS_STOP_STEPS = 100
"""A second at most (`pedal_stop_ms`); EU, UK and China stop after 2 m at 25 km/h."""
PUSH_STOP_STEPS = 150
EU_STOP_STEPS = 29
PEDAL_STOP = 0x0004

THROTTLE: dict[str, Value] = {
    "torque_filter_s": 2.0,
    "pedal_torque_nm_min": 0.0,
    "assist_ramp_down_nm_per_s": 20.0,
    "mode_ratios": [0.0, 3.0, 3.0, 3.0, 3.0],
}
"""What kept the motor on for a minute on turning cranks that nobody pushed."""


def drawn(random: np.random.Generator) -> dict[str, Any]:
    return dict(accepted_config(random))


def ride(config: dict[str, Any], state: Any, steps: int, **readings: float) -> npt.NDArray[np.void]:
    """Outputs of so many steps with one and the same reading, where the state left off."""
    rows = pack_inputs({name: [value] * steps for name, value in (RIDING | readings).items()})
    outputs = np.empty(steps, OUTPUT_DTYPE)
    inputs = ffi.cast("assist_input *", ffi.from_buffer(rows))
    given = ffi.cast("assist_output *", ffi.from_buffer(outputs, require_writable=True))
    lib.assist_run(native_config(config), state, inputs, given, steps)
    return outputs


def raw_counts(config: dict[str, Any], torque_nm: float) -> float:
    """What the sensor reads at this torque, calibrated as configured."""
    offset, gain = config["sensor_offset_counts"], config["sensor_gain_nm_per_count"]
    return float(offset + torque_nm / gain)


def pushed(
    config: dict[str, Any], state: Any, random: np.random.Generator
) -> tuple[float, int, npt.NDArray[np.void]]:
    """A rider who pushed steadily for 3 s: his torque and mode, and the outputs."""
    torque_nm = float(random.uniform(5.0, 80.0))
    speed_kmh, mode = float(random.uniform(0.0, 20.0)), int(random.integers(1, 5))
    rider = {
        "torque_raw_counts": raw_counts(config, torque_nm),
        "speed_kmh": speed_kmh,
        "mode": mode,
    }
    return torque_nm, mode, ride(config, state, 300, **rider)


@pytest.mark.large_count
@pytest.mark.slow
def test_whatever_is_configured_the_motor_gives_no_more_than_the_mode_says() -> None:
    random = np.random.default_rng(7)
    driven = 0

    for _ in range(CONFIGS):
        config, state = drawn(random), ffi.new("assist_state *")
        torque_nm, mode, outputs = pushed(config, state, random)

        gain = FUZZY_GAIN_MAX if config["mode_laws"][mode] == "fuzzy" else 0.0
        most_nm = config["mode_ratios"][mode] * (1 + gain) * torque_nm
        crank_nm = outputs["motor_torque_nm"] * config["gear_ratio"]
        assert (crank_nm <= most_nm * (1 + ROUNDING) + NOTHING_NM).all(), config
        driven += bool(crank_nm[-1] > 0)

    assert driven > CONFIGS // 8


@pytest.mark.large_count
@pytest.mark.parametrize("turning_rpm", [1e-3, 60.0, 150.0])
@pytest.mark.slow
def test_whatever_is_configured_legs_that_turn_and_do_not_push_soon_get_nothing(
    turning_rpm: float,
) -> None:
    random = np.random.default_rng(23)
    driven = 0

    for _ in range(CONFIGS // 3):
        config, state = drawn(random), ffi.new("assist_state *")
        _, _, before = pushed(config, state, random)
        driven += bool(before["motor_torque_nm"][-1] > 0)
        resting = {"torque_raw_counts": raw_counts(config, 0.0), "cadence_rpm": turning_rpm}

        after = ride(config, state, 1000, **resting, mode=int(random.integers(1, 5)))

        assert not after["motor_torque_nm"][PUSH_STOP_STEPS:].any(), config

    assert driven > CONFIGS // 15


@pytest.mark.large_count
@pytest.mark.slow
def test_whatever_is_configured_legs_that_push_and_do_not_turn_soon_get_nothing() -> None:
    random = np.random.default_rng(13)
    driven = 0

    for _ in range(CONFIGS):
        config, state = drawn(random), ffi.new("assist_state *")
        torque_nm, _, before = pushed(config, state, random)
        driven += bool(before["motor_torque_nm"][-1] > 0)
        standing = {"torque_raw_counts": raw_counts(config, torque_nm), "cadence_rpm": 0.0}

        after = ride(config, state, 300, **standing, mode=int(random.integers(1, 5)))

        two_metres = config["market"] in ("eu_epac", "uk", "china")
        stop = EU_STOP_STEPS if two_metres else LEGS_STOP_STEPS
        stop = min(stop, round(float(config["pedal_stop_ms"]) * 1e-3 / STEP_S) + 1)
        assert not after["motor_torque_nm"][stop:].any(), config

    assert driven > CONFIGS // 8


def test_a_rider_with_one_leg_is_helped_through_the_half_turn_without_a_push() -> None:
    """A sine for half a turn, then nothing for a second: 30 turns a minute."""
    config, state = dict[str, Any](default_config()), ffi.new("assist_state *")
    half_turn_s = 1.0
    push_nm = 60.0 * np.sin(np.pi * np.arange(0.0, half_turn_s, STEP_S) / half_turn_s)
    for torque_nm in push_nm:
        ride(config, state, 1, torque_raw_counts=raw_counts(config, float(torque_nm)))

    after = ride(config, state, len(push_nm), torque_raw_counts=raw_counts(config, 0.0))

    assert not (after["limit_flags"] & PEDAL_STOP).any()


def test_the_unit_itself_lets_go_of_cranks_that_nobody_pushes_any_more() -> None:
    unit = BenchUnit()
    unit.hello()
    assert unit.write(THROTTLE).status == Status.OK
    unit.inputs(cadence_rpm=60.0, speed_kmh=10.0, motor_speed_rpm=2000.0, mode_selected=2)
    unit.inputs(torque_raw_counts=6000.0)
    unit.advance(5.0)
    assert unit.motor_nm() > 1.0

    unit.inputs(torque_raw_counts=0.0)
    unit.advance(PUSH_STOP_STEPS * STEP_S)

    assert unit.motor_nm() == 0.0
    unit.inputs(torque_raw_counts=6000.0)
    unit.advance(0.1)
    assert unit.motor_nm() > 0.0
