"""The law's speed: against two Python fuzzy engines, and on a two hour ride."""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from backend.core.fuzzy_table import THESIS_TABLE
from firmware_protocol.parameters import default_config
from sim_device.firmware.python import law
from tools.bench.figures import Figure, best_of
from tools.bench.ride import SAMPLES, two_hours

ROOT = Path(__file__).resolve().parents[2]
RIVALS = ROOT / ".make" / "rivals-venv" / "bin" / "python"
POINTS = 1_000_000
RIVAL_POINTS = 600
# 101 grid points against an exact centroid: fuzzy_controller section 2 found 8e-5 and 2e-3.
AGREEMENT_MAX = 2.5e-3
FUZZY_SLOT = 3


def run() -> list[Figure]:
    random = np.random.default_rng(1)
    speeds = random.uniform(0, 25, POINTS).astype(np.float32)
    rates = random.uniform(0, 0.9, POINTS).astype(np.float32)
    table = THESIS_TABLE.to_parameters()
    batch_ns = 1e9 / POINTS * best_of(5, lambda: law.gain_points(table, speeds, rates))
    bilinear = table | {"fuzzy_inference": "weighted_average"}
    bilinear_ns = 1e9 / POINTS * best_of(5, lambda: law.gain_points(bilinear, speeds, rates))

    points = np.stack([speeds, rates], axis=1)[:RIVAL_POINTS].astype(float)
    ours = law.gain_points(table, points[:, 0], points[:, 1])
    rivals = ask_rivals(points.tolist())
    figures = [
        Figure("one fuzzy evaluation, exact centroid, batch", f"{batch_ns:.1f} ns", "<= 30 ns",
               batch_ns <= 30),
        Figure("one fuzzy evaluation, weighted average, batch", f"{bilinear_ns:.1f} ns", "", None),
    ]  # fmt: skip
    for name, target in (("pyfuzzylite", 50_000), ("scikit_fuzzy", None)):
        ratio = 1e9 * rivals[name]["seconds"] / batch_ns
        gains = np.array(rivals[name]["gains"])
        apart = float(np.abs(gains - ours[: len(gains)]).max())
        figures.append(
            Figure(
                f"times the scalar speed of {name.replace('_', '-')}",
                f"{ratio:,.0f}",
                f">= {target:,}" if target else "",
                ratio >= target if target else None,
                f"{1e6 * rivals[name]['seconds']:,.0f} us an evaluation; largest difference of "
                f"{len(gains)} gains {apart:.1e}" + ("" if apart < AGREEMENT_MAX else " (!)"),
            )
        )
    return [*figures, replay()]


def ask_rivals(points: list[list[float]]) -> dict[str, dict[str, object]]:
    with tempfile.TemporaryDirectory() as folder:
        request = Path(folder) / "points.json"
        request.write_text(json.dumps({"table": THESIS_TABLE.to_json(), "points": points}))
        done = subprocess.run(
            [RIVALS, Path(__file__).with_name("rivals.py"), request],
            check=True,
            capture_output=True,
            text=True,
        )
    return json.loads(done.stdout)


def replay() -> Figure:
    ride = two_hours()
    config = default_config()
    inputs = law.pack_inputs(
        {
            "torque_raw_counts": ride["rider_torque_nm"] / config["sensor_gain_nm_per_count"],
            "speed_kmh": ride["speed_kmh"],
            "cadence_rpm": ride["cadence_rpm"],
            "motor_speed_rpm": ride["motor_speed_rpm"],
            "battery_voltage_v": ride["battery_voltage_v"],
            "mode": np.full(SAMPLES, FUZZY_SLOT, np.uint8),
            "brake": np.zeros(SAMPLES, np.uint8),
        }
    )
    replay_ms = 1e3 * best_of(5, lambda: law.AssistLaw(config).run(inputs))
    return Figure(
        "a 2 h ride (720,000 steps) replayed through the law",
        f"{replay_ms:.0f} ms",
        "<= 100 ms",
        replay_ms <= 100,
        f"{7_200_000 / replay_ms:,.0f} times real time",
    )
