"""Scenarios in virtual time: `run` measures or rides one and says what came out.

The whole unit takes part: the rider's torque passes the sensor, the firmware's law decides, the
motor drives the bike. Nothing is taken from the law's own opinion of the speed.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from firmware_protocol._generated import FaultFlags
from firmware_protocol.spelling import word_of
from sim_device.controls import NOT_CONSISTENT
from sim_device.firmware.python.unit import finite_or_none, kinematics
from sim_device.lockstep import LockstepUnit
from sim_device.preset_unit import FACTORY, parameters_of, preset_unit
from sim_device.scenario_calibration import calibrate
from sim_device.scenario_field_ride import field_ride
from sim_device.scenario_file import FILE_ENDING, ScenarioFile, load, load_file, names
from sim_device.scenario_phase import ScenarioError, Value

Settings = dict[str, Any]
Result = dict[str, Any]

SAMPLE_S = 0.01
FAULT_LOOK_S = 0.5
J_PER_WH = 3600.0
TAPER_OFF_KMH = (24.99, 25.0)

# First crossing of 24.95 km/h counts as 25 (thesis_checks 4.1): the fixed law only creeps there.
LIMIT_KMH = 24.95
# A hair below the cut-off, so that the motor still assists when the slope begins.
SLOPE_FROM_KMH = 24.999
UNTAPERED_FROM_KMH = TAPER_OFF_KMH[0]
SLOPE_LOST_KMH = 14.7

START_S_MAX = 120.0
CADENCE_RPM_UNLIMITED = 250.0
SETTLE_S = 3.0
FLYWHEEL_KG = 1e9

SERVO_RISE_NM_PER_S = 1.0
SERVO_NM_MAX = 400.0


def list_scenarios() -> list[Result]:
    """Name, purpose, kind and settings of every scenario."""
    return [_described(load(name)) for name in names()]


def run(name: str, settings: dict[str, object] | None = None) -> Result:
    """Runs a scenario and returns its figures (contract.md, Scenarios).

    Args:
        name: one of `list_scenarios()`, or the path of a TOML file with phases.
        settings: values over the scenario's defaults; texts are read as the default's type.

    Raises:
        ScenarioError: no such scenario or setting, or a value out of its range; named.
    """
    scenario = load_file(Path(name)) if name.endswith(FILE_ENDING) else load(name)
    values = _values(scenario, settings or {})
    measure = _MEASUREMENTS.get(name, _ride)
    seed = values.get("seed", scenario.seed)
    return {"scenario": name, "settings": values, "seed": seed} | measure(scenario, values)


def trace(name: str, settings: dict[str, object] | None = None) -> list[tuple[float, float]]:
    """Seconds and km/h of every control step of `start` or `slope`. Raises ScenarioError."""
    scenario = load(name)
    trials = {"start": _start_trial, "slope": _slope_trial}
    if name not in trials:
        raise ScenarioError(f"{name} has no trace; there are: {', '.join(trials)}")
    trial = trials[name](scenario, _values(scenario, settings or {}))
    return [(seen.t_s, seen.speed_kmh) for seen in trial.samples]


def _values(scenario: ScenarioFile, settings: dict[str, object]) -> dict[str, Value]:
    """The scenario's settings with those given read into them."""
    name = scenario.name
    unknown = sorted(set(settings) - set(scenario.settings))
    if unknown:
        known = ", ".join(scenario.settings) or "none"
        raise ScenarioError(f"{name} has no setting {', '.join(unknown)}; there are: {known}")
    values: dict[str, Value] = {key: entry.default for key, entry in scenario.settings.items()}
    for key, given in settings.items():
        values[key] = scenario.settings[key].read(f"{name}: {key}", given)
    return values


def _described(scenario: ScenarioFile) -> Result:
    return {
        "name": scenario.name,
        "doc": scenario.doc,
        "kind": "measured" if scenario.name in _MEASUREMENTS else "live",
        "settings": {
            key: {
                "default": entry.default,
                "min": entry.min,
                "max": entry.max,
                "choices": list(entry.choices),
                "doc": entry.doc,
            }
            for key, entry in scenario.settings.items()
        },
    }


@dataclass(frozen=True)
class _Sample:
    t_s: float
    speed_kmh: float


class _Trial:
    """A unit under test, sampled every control step from the moment `begin` is called."""

    def __init__(
        self,
        scenario: ScenarioFile,
        law: str,
        bike: dict[str, float],
        preset: str = FACTORY,
        config: dict[str, Any] | None = None,
    ) -> None:
        """preset: that the unit is configured with. config: parameters over it."""
        self.unit = preset_unit(
            preset, scenario.seed, config or {}, name=scenario.name, bike=scenario.bike | bike
        )
        self.unit.select_mode(_mode_of(law, parameters_of(preset)))
        self.samples: list[_Sample] = []
        self._t0_s = 0.0

    def begin(self) -> None:
        self.unit.unit.change_bike({})
        self._t0_s = self.unit.observe()["t_s"]
        self._look()

    def advance_until(self, done: Callable[[_Sample], bool], seconds_max: float) -> bool:
        """True if `done` came true; False when the time is up."""
        while self.samples[-1].t_s < seconds_max - SAMPLE_S / 2:
            self.unit.advance(SAMPLE_S)
            self._look()
            if done(self.samples[-1]):
                return True
        return False

    def _look(self) -> None:
        seen = self.unit.observe()
        self.samples.append(_Sample(seen["t_s"] - self._t0_s, seen["speed_kmh"]))

    def first(self, holds: Callable[[_Sample], bool]) -> float | None:
        """Time of the first sample for which `holds`, to a control step; None if there is none."""
        return next((round(seen.t_s, 3) for seen in self.samples if holds(seen)), None)

    def speeds_kmh(self, *seconds: int) -> dict[str, float]:
        """Speed at whole seconds after `begin`, as far as the run went."""
        steps = {second: round(second / SAMPLE_S) for second in seconds}
        return {
            str(second): self.samples[step].speed_kmh
            for second, step in steps.items()
            if step < len(self.samples)
        }

    def energy(self) -> Result:
        return _energy(self.unit.observe())


def _energy(seen: Result) -> Result:
    """How well the books close, and a label where they cannot: a printed equation makes energy."""
    told: Result = {
        "energy_balance_error_pct": finite_or_none(seen["energy_balance_error_pct"]),
        "energy_consistent": bool(seen["energy_consistent"]),
    }
    if not seen["energy_consistent"]:
        told["label"] = NOT_CONSISTENT
    return told


def _config_of(settings: Settings) -> dict[str, Any]:
    """The fixed law as configured, or without its taper: full assist up to the cut-off."""
    if settings["taper"] == "on":
        return {}
    start_kmh, end_kmh = TAPER_OFF_KMH
    return {"fixed_taper_start_kmh": start_kmh, "fixed_taper_end_kmh": end_kmh}


def _mode_of(law: str, config: dict[str, Any]) -> int:
    """The mode slot that runs this law at the thesis's ratio 1."""
    slots = zip(config["mode_laws"], config["mode_ratios"], strict=True)
    for slot, (slot_law, ratio) in enumerate(slots):
        if slot_law == law and ratio in (0.0, 1.0):
            return slot
    raise ScenarioError(f"no assist mode runs the {law} law at ratio 1")


def _start_trial(scenario: ScenarioFile, settings: Settings) -> _Trial:
    bike = {"road.mass_kg": settings["mass_kg"]}
    trial = _Trial(scenario, settings["law"], bike, settings["preset"], _config_of(settings))
    trial.begin()
    trial.unit.rider(settings["rider"], settings["rider_torque_nm"], CADENCE_RPM_UNLIMITED)
    trial.advance_until(lambda seen: seen.speed_kmh >= LIMIT_KMH, START_S_MAX)
    return trial


def _start(scenario: ScenarioFile, settings: Settings) -> Result:
    trial = _start_trial(scenario, settings)
    return {
        "time_to_limit_s": trial.first(lambda seen: seen.speed_kmh >= LIMIT_KMH),
        "speed_kmh": trial.speeds_kmh(*range(5, int(START_S_MAX) + 1, 5)),
    } | trial.energy()


def _slope_trial(scenario: ScenarioFile, settings: Settings) -> _Trial:
    # On a flywheel too heavy to change its speed until filter and ramp have settled.
    bench = {
        "road.source": 1.0,
        "road.dyno_mass_kg": FLYWHEEL_KG,
        "road.drag_area_m2": settings["drag_area_m2"],
        "road.rolling_coefficient": settings["rolling_coefficient"],
        "drivetrain.literal_4_14": float(settings["model"] == "literal_4_14"),
        "motor.model": float(settings["motor"] == "foc"),
    }
    trial = _Trial(scenario, settings["law"], bench, settings["preset"], _config_of(settings))
    trial.unit.place(SLOPE_FROM_KMH if settings["taper"] == "on" else UNTAPERED_FROM_KMH)
    trial.unit.rider(settings["rider"], settings["rider_torque_nm"], CADENCE_RPM_UNLIMITED)
    trial.unit.advance(SETTLE_S)
    trial.unit.simulation_set(
        {
            "load_source": "road",
            "mass_kg": settings["mass_kg"],
            "road": {"grade_deg": settings["grade_deg"]},
        }
    )
    trial.begin()
    trial.advance_until(lambda _: False, settings["seconds"])
    return trial


def _slope(scenario: ScenarioFile, settings: Settings) -> Result:
    trial = _slope_trial(scenario, settings)
    return {
        "final_speed_kmh": trial.samples[-1].speed_kmh,
        "speed_kmh": trial.speeds_kmh(1, 2, 5, 10, 15, 20),
        "below_14_7_kmh_at_s": trial.first(lambda seen: seen.speed_kmh < SLOPE_LOST_KMH),
        "stopped_at_s": trial.first(lambda seen: seen.speed_kmh <= 0.0),
    } | trial.energy()


def _kinematics(scenario: ScenarioFile, settings: Settings) -> Result:
    return kinematics(scenario.bike, settings["speed_kmh"])


def _resistance(scenario: ScenarioFile, settings: Settings) -> Result:
    bench = {
        "road.source": 1.0,
        "road.dyno_convention": float(settings["convention"] == "thesis"),
    }
    trial = _Trial(scenario, "off", bench)
    trial.unit.simulation_set({"dyno_nm": settings["dyno_nm"]})
    trial.begin()
    servo_nm = 0.0
    while servo_nm < SERVO_NM_MAX:
        servo_nm += SERVO_RISE_NM_PER_S * SAMPLE_S
        trial.unit.rider("constant", servo_nm, CADENCE_RPM_UNLIMITED)
        trial.unit.advance(SAMPLE_S)
        if trial.unit.observe()["speed_kmh"] > 0.0:
            break
    moved = trial.unit.observe()["speed_kmh"] > 0.0
    return {"breakaway_torque_nm": round(servo_nm, 3) if moved else None} | trial.energy()


def _ride(scenario: ScenarioFile, _settings: Settings) -> Result:
    unit = LockstepUnit(scenario.seed, name=scenario.name, scenario=scenario)
    faults_seen = 0
    seen = unit.observe()
    begun_s = seen["t_s"]
    for seen in unit.ride_once(FAULT_LOOK_S):
        faults_seen |= seen["fault_flags"]
    return {
        "duration_s": round(seen["t_s"] - begun_s, 3),
        "stalled_phases": unit.stalled_phases,
        "distance_m": seen["distance_m"],
        "climb_m": seen["height_m"],
        "rider_wh": seen["rider_work_j"] / J_PER_WH,
        "motor_wh": seen["motor_electric_j"] / J_PER_WH,
        "battery_soc_pct": seen["battery_soc_pct"],
        "motor_temperature_degc": seen["motor_temperature_degc"],
        "sensor_temperature_degc": seen["sensor_temperature_degc"],
        "faults_seen": [
            word_of(name) for name, flag in FaultFlags.__members__.items() if faults_seen & flag
        ],
        "words_good": seen["words_good"],
        "words_bad": seen["words_bad"],
        "words_lost": seen["words_lost"],
    } | _energy(seen)


_MEASUREMENTS: dict[str, Callable[[ScenarioFile, Settings], Result]] = {
    "start": _start,
    "slope": _slope,
    "kinematics": _kinematics,
    "resistance": _resistance,
    "calibration": calibrate,
    "field_ride": field_ride,
}
