"""Goal: the same seed gives the same bytes tomorrow too: in another process, under another hash
seed, clock zone and language, not only twice in one.

Method: two interpreters ride the same noisy minute, print what the unit said on its line and what
the scenario's command prints, and are compared as bytes.
"""

import os
import subprocess
import sys

import pytest

# Noise of legs, sensor and link, and every channel the unit tells.
RIDE = """
import hashlib
from sim_device.__main__ import main
from sim_device.lockstep import LockstepUnit
from spindle.testing import DriveUnit

unit = DriveUnit(seed=9, scenario="link_bursts", bike={"rider.stroke_noise": 0.1})
said = hashlib.sha256()
for _ in range(60):
    unit.advance(1.0)
    said.update(repr(sorted(unit.unit.simulation_get().items())).encode())
rows = unit.trace("rider_torque_raw", "motor_torque_nm", "battery_voltage_v")
for name in sorted(rows):
    said.update(rows[name].tobytes())
print(said.hexdigest(), len(rows["t_s"]), flush=True)
main(["scenario", "run", "link_bursts", "--json"])
"""


def ridden(**surroundings: str) -> bytes:
    environment = {**os.environ, **surroundings}
    done = subprocess.run(
        [sys.executable, "-c", RIDE], env=environment, capture_output=True, check=True
    )
    return done.stdout


@pytest.mark.slow
def test_another_process_rides_the_same_bytes() -> None:
    here = ridden(PYTHONHASHSEED="1", TZ="UTC", LC_ALL="C")
    elsewhere = ridden(PYTHONHASHSEED="2", TZ="Asia/Shanghai", LC_ALL="C.UTF-8")

    rows = int(here.split()[1])
    assert rows > 5900
    assert b'"words_bad"' in here
    assert here == elsewhere
