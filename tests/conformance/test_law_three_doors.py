"""Goal: the law gives the same bits however it is reached (ADR 1).

Method: one rough ride of random readings, with every mode, brake, back-pedalling and broken
readings in it, goes through the batch, through single steps with a second instance in between, and
through a program of its own that the C compiler builds here with the extension's flags.
"""

import shlex
import subprocess
import sysconfig
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from firmware_protocol.parameters import default_config, pack_image
from sim_device.firmware.python import build
from sim_device.firmware.python.law import (
    INPUT_DTYPE,
    OUTPUT_DTYPE,
    AssistLaw,
    pack_inputs,
)

ROOT = Path(__file__).resolve().parents[2]
STEPS = 3000


def rough_ride(seed: int) -> npt.NDArray[np.void]:
    random = np.random.default_rng(seed)
    torque = np.abs(random.normal(0, 2500, STEPS)) * (random.random(STEPS) > 0.02)
    torque[random.integers(0, STEPS, 20)] = [np.nan, np.inf, -np.inf, 1e9] * 5
    return pack_inputs(
        {
            "torque_raw_counts": torque,
            "speed_kmh": np.clip(np.cumsum(random.normal(0, 0.3, STEPS)) + 15, 0, 30),
            "cadence_rpm": np.where(random.random(STEPS) < 0.02, -5, random.uniform(0, 90, STEPS)),
            "motor_speed_rpm": random.uniform(0, 3200, STEPS),
            "battery_voltage_v": random.uniform(29, 42, STEPS),
            "battery_current_a": np.where(
                random.random(STEPS) < 0.1, np.nan, random.uniform(-1, 16, STEPS)
            ),
            "motor_temperature_degc": random.uniform(90, 135, STEPS),
            "controller_temperature_degc": np.where(
                random.random(STEPS) < 0.5, np.nan, random.uniform(60, 105, STEPS)
            ),
            "sensor_temperature_degc": np.where(
                random.random(STEPS) < 0.1, np.nan, random.uniform(-300, 300, STEPS)
            ),
            "torque_age_ms": np.where(random.random(STEPS) < 0.02, 51, random.integers(0, 40)),
            "walk_button": np.repeat(random.random(STEPS // 50) < 0.3, 50),
            "inhibit": np.repeat(random.random(STEPS // 50) < 0.05, 50),
            "mode": np.repeat(random.integers(0, 6, STEPS // 100), 100),
            "brake": np.repeat(random.random(STEPS // 50) < 0.1, 50),
        }
    )


def config_of(inference: str, falling: str) -> dict[str, Any]:
    return {
        **default_config(),
        "mode_laws": ["off", "fixed", "fixed", "fuzzy", "fuzzy"],
        "fuzzy_inference": inference,
        "fuzzy_falling_torque": falling,
        "torque_filter": "half_turn" if falling == "no_gain" else "time_constant",
        "fuzzy_gain_points": [0.05, 0.11, 0.27, 0.33, 0.48],
        "assist_cutoff_band_kmh": 2.0,
        "sensor_offset_counts": 12.5,
        "sensor_offset_counts_per_k": 1.75,
        "sensor_gain_share_per_k": None if falling == "no_gain" else -3e-4,
        "sensor_reference_degc": 22.5,
        "mode_tapers": ["none", "none", "japan_1_to_1", "taper_speeds", "japan_2_to_1"],
        "mode_tables": [0, 0, 0, 0, 1],
        "mode_ramp_up_nm_per_s": [2000, 150, 90, 300, 2000],
        "mode_ramp_down_nm_per_s": [2000, 150, 700, 300, 2000],
        "mode_torque_pct": [100, 40, 70, 85, 100],
        "second_gain_points": [0.0, 0.1, 0.21, 0.33, 0.5],
        "market": "japan" if falling == "no_gain" else "eu_epac",
        "walk_speed_kmh": 4.5,
    }


def as_floats(rows: npt.NDArray[np.void]) -> npt.NDArray[np.float32]:
    names = rows.dtype.names or ()
    return np.stack([rows[name].astype(np.float32) for name in names], axis=1)


def bits(rows: npt.NDArray[np.void]) -> npt.NDArray[np.uint32]:
    return as_floats(rows).view(np.uint32)


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("law") / "law"
    compiler = shlex.split(sysconfig.get_config_var("CC") or "cc")
    control = ROOT / "sim_device/firmware/control"
    app = ROOT / "sim_device/firmware/app"
    wire = ROOT / "firmware_protocol/c"
    subprocess.run(
        [
            *compiler,
            *build.COMPILE_ARGUMENTS,
            *(f"-I{room}" for room in (control, app, wire)),
            str(ROOT / "sim_device/firmware/boards/host/main_law.c"),
            str(app / "storage/config_law.c"),
            *map(str, sorted([*control.glob("*.c"), *wire.glob("*.c")])),
            "-o",
            str(target),
        ],
        check=True,
    )
    return target


@pytest.mark.parametrize("inference", ["mamdani_centroid", "weighted_average"])
@pytest.mark.parametrize("falling", ["hold_zero_rate", "no_gain"])
@pytest.mark.slow
def test_batch_steps_and_program_agree_to_the_bit(
    program: Path, inference: str, falling: str
) -> None:
    config = config_of(inference, falling)
    ride, other_ride = rough_ride(1), rough_ride(2)

    batch = AssistLaw(config).run(ride)
    law, neighbour = AssistLaw(config), AssistLaw(config_of("weighted_average", "no_gain"))
    stepwise = np.empty(STEPS, OUTPUT_DTYPE)
    for index in range(STEPS):
        stepwise[index : index + 1] = law.run(ride[index : index + 1])
        neighbour.run(other_ride[index : index + 1])
    answer = subprocess.run(
        [program],
        input=pack_image(config) + as_floats(ride).tobytes(),
        capture_output=True,
        check=True,
    ).stdout
    program_bits = np.frombuffer(answer, np.uint32).reshape(STEPS, -1)

    np.testing.assert_array_equal(bits(stepwise), bits(batch))
    np.testing.assert_array_equal(program_bits, bits(batch))
    assert np.count_nonzero(batch["motor_torque_nm"]) > STEPS / 10


def test_the_program_refuses_a_broken_record_and_a_bad_configuration(program: Path) -> None:
    good = pack_image(config_of("mamdani_centroid", "no_gain"))
    bad = pack_image({**config_of("mamdani_centroid", "no_gain"), "gear_ratio": 0.0})

    half_a_record = good + bytes(len(INPUT_DTYPE.names or ()) * 4 - 1)

    assert subprocess.run([program], input=half_a_record, capture_output=True).returncode == 1
    assert subprocess.run([program], input=bad, capture_output=True).returncode == 2
