"""The simulator's speed: physics at 1 kHz and firmware at 100 Hz, one unit, and fifty on one core.

In processor time, because what else runs on the machine is not the simulator's.
"""

import json
import subprocess
import time
from pathlib import Path

from sim_device.lockstep import LockstepUnit
from tools.bench.figures import Figure

HERE = Path(__file__).resolve().parent
RIVALS = HERE.parents[1] / ".make" / "rivals-venv" / "bin" / "python"
SECONDS = 1000.0
UNITS = 50
FLEET_SECONDS = 20.0
FLEET_PIECE_S = 0.1
FIXED_MODE = 2
AGREEMENT_KMH = 0.3


def run() -> list[Figure]:
    factor = one_unit()
    rivals = json.loads(
        subprocess.run(
            [RIVALS, HERE / "rivals_plant.py"], check=True, capture_output=True, text=True
        ).stdout
    )
    ours_kmh = start_kmh()
    fleet = fifty_units()
    figures = [
        Figure("one simulated unit on the commute, physics at 1 kHz, firmware at 100 Hz",
               f"{factor:,.0f} times real time", ">= 2,000", factor >= 2000),
    ]  # fmt: skip
    for name, title in (("solve_ivp", "scipy's solve_ivp"), ("numpy_steps", "a step in numpy")):
        theirs = rivals[name]
        apart = abs(theirs["speed_kmh"] - ours_kmh)
        figures.append(
            Figure(
                f"times the speed of {title} on the bike's equation alone",
                f"{factor / theirs['times_real_time']:,.0f}",
                "",
                None,
                f"{theirs['times_real_time']:,.1f} times real time; after 20 s "
                f"{theirs['speed_kmh']:.2f} and {ours_kmh:.2f} km/h"
                + ("" if apart < AGREEMENT_KMH else " (!)"),
            )
        )
    figures.append(
        Figure(f"{UNITS} simulated units on one core, in turns of a tenth of a second",
               f"{fleet:,.1f} times real time", ">= 1", fleet >= 1.0)
    )  # fmt: skip
    return figures


def one_unit() -> float:
    """The commute with noise, legs, link and battery; best of three."""
    best = 0.0
    for seed in range(3):
        unit = LockstepUnit(seed, scenario="commute")
        start = time.process_time()
        unit.advance(SECONDS)
        best = max(best, SECONDS / (time.process_time() - start))
    return best


def start_kmh() -> float:
    """The fixed law after 20 s from rest, as the rivals compute it."""
    unit = LockstepUnit()
    unit.select_mode(FIXED_MODE)
    unit.rider("constant", 24.48, cadence_rpm_max=250.0)
    unit.advance(20.0)
    return float(unit.observe()["speed_kmh"])


def fifty_units() -> float:
    units = [LockstepUnit(seed, scenario="commute") for seed in range(UNITS)]
    start = time.process_time()
    for _ in range(round(FLEET_SECONDS / FLEET_PIECE_S)):
        for unit in units:
            unit.advance(FLEET_PIECE_S)
    return FLEET_SECONDS / (time.process_time() - start)
