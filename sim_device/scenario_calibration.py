"""Scenario `calibration`: the error test of thesis 3.5 on the whole unit, wheel held.

Weights hang on the arm in equal steps up and down again, three strokes each way; what is written
down is the rider torque the unit itself tells, through gauges, link and law. The rig is part of it:
what hangs swings a little, and its pan was not on the scale. The zero is set anew before a stroke.
"""

import random
from statistics import fmean
from typing import Any

from sim_device.calibration_metrics import metrics
from sim_device.lockstep import LockstepUnit
from sim_device.scenario_file import ScenarioFile
from sim_device.scenario_phase import RIDER_KINDS

FULL_SCALE_NM = 100.0
LOAD_NM = tuple(10.0 * step for step in range(11))
MODE_OFF = 0
HELD_N = 1e9
CADENCE_RPM_UNLIMITED = 250.0
SETTLE_S = 0.05
READING_S = 0.01
TARE_READINGS = 100


class _Rig:
    def __init__(self, scenario: ScenarioFile, settings: dict[str, Any]) -> None:
        state = scenario.states[settings["state"]]
        bike = {key: value for key, value in state.items() if not key.startswith("rig.")}
        self._pan_nm = state.get("rig.pan_nm", 0.0)
        self._scatter_nm = state.get("rig.scatter_nm", 0.0)
        self._readings = settings["readings"]
        self._random = random.Random(settings["seed"])
        self._unit = LockstepUnit(
            settings["seed"], name=scenario.name, bike=bike | {"road.brake_force_n": HELD_N}
        )
        self._unit.brake(True)
        self._unit.select_mode(MODE_OFF)
        self._tare_nm = 0.0

    def set_zero(self) -> None:
        self._load(0.0)
        self._tare_nm = self._mean_nm(TARE_READINGS)

    def reading_nm(self, load_nm: float) -> float:
        """What is written down at this load; the empty arm is the zero itself."""
        if load_nm == 0.0:
            self._load(0.0)
            return 0.0
        self._load(load_nm + self._pan_nm + self._random.gauss(0.0, self._scatter_nm))
        return self._mean_nm(self._readings) - self._tare_nm

    def _load(self, torque_nm: float) -> None:
        constant = RIDER_KINDS["constant"]
        self._unit.unit.set_rider(constant, torque_nm, CADENCE_RPM_UNLIMITED)
        self._unit.advance(SETTLE_S)

    def _mean_nm(self, readings: int) -> float:
        values = []
        for _ in range(readings):
            self._unit.advance(READING_S)
            values.append(self._unit.observe()["rider_torque_nm"])
        return fmean(values)


def calibrate(scenario: ScenarioFile, settings: dict[str, Any]) -> dict[str, Any]:
    """Readings of all strokes, forward and reverse (r, k) in Nm, and their figures."""
    rig = _Rig(scenario, settings)
    forward, reverse = [], []
    for _ in range(settings["strokes"]):
        rig.set_zero()
        forward.append([rig.reading_nm(load_nm) for load_nm in LOAD_NM])
        reverse.append([rig.reading_nm(load_nm) for load_nm in reversed(LOAD_NM)][::-1])
    return {
        "full_scale_nm": FULL_SCALE_NM,
        "load_nm": list(LOAD_NM),
        "forward": forward,
        "reverse": reverse,
    } | metrics(FULL_SCALE_NM, LOAD_NM, forward, reverse)
