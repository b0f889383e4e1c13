"""What can be seen and changed of a simulated unit: the JSON of SIM_GET and SIM_SET.

Pure: a text becomes checked changes, or a ScenarioError that names what is wrong; applying them is
the unit's business (sim_device.lockstep).
"""

import contextlib
import json
import zlib
from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from typing import Any

from sim_device.scenario_file import load, names
from sim_device.scenario_phase import FAULTS, ScenarioError, Setting, read_phase_value
from sim_device.workbench import NAMES as WORKBENCH
from sim_device.workbench import read_workbench_value

SPEED_FACTOR_MIN = 0.01
SPEED_FACTOR_MAX = 1000.0
ADVANCE_S_MAX = 24 * 3600.0
CLOCKS = ("real", "virtual")
# A frame of 544 bytes holds some 530 of text.
PLAIN_BYTES_MAX = 500
TEXT_BYTES_MAX = 16_384
LOAD_SOURCES = {"road": 0, "dyno": 1}
DYNO_CONVENTIONS = {"physical": 0, "thesis": 1}
MOTOR_MODELS = {"average": 0, "foc": 1}
# What a run says that follows a printed equation which makes energy (thesis_checks I-9, I-11).
NOT_CONSISTENT = "not energy consistent"

# A host may send back what it was given: these say something, and change nothing.
_READ_ONLY = {
    "t_s",
    "advance_left_s",
    "rotor_link",
    "energy_balance_error_pct",
    "energy_consistent",
    "label",
}


@dataclass
class Changes:
    """Checked changes; None or an empty dict means as it was.

    by_hand: what is broken and around the bike. It lasts through the phases of a scenario.
    workbench: what is said of it otherwise; leave_workbench: the bike is taken off.
    own_scenarios: names that `scenario` can have besides those that come with Spindle.
    """

    own_scenarios: Collection[str] = ()

    phase: dict[str, Any] = field(default_factory=dict)
    by_hand: dict[str, Any] = field(default_factory=dict)
    bike: dict[str, float] = field(default_factory=dict)
    workbench: dict[str, Any] = field(default_factory=dict)
    leave_workbench: bool = False
    scenario: str | None = None
    stop_scenario: bool = False
    running: bool | None = None
    speed_factor: float | None = None
    clock: str | None = None
    advance_s: float | None = None
    seed: int | None = None


def parse_changes(text: str, own_scenarios: Collection[str] = ()) -> Changes:
    """Reads the JSON object of SIM_SET. Raises ScenarioError and leaves nothing half read."""
    try:
        document = json.loads(text or "{}")
    except ValueError as error:
        raise ScenarioError(f"simulation: not JSON: {error}") from error
    changes = Changes(own_scenarios)
    for name, given in _members("", document, {*_READERS, *_READ_ONLY}).items():
        if name in _READERS:
            _READERS[name](changes, name, given)
    return changes


def pack(settings: dict[str, Any]) -> bytes:
    """The answer's text: JSON, and where that would not fit a frame, deflated (zlib)."""
    text = json.dumps(settings, separators=(",", ":")).encode()
    return text if len(text) <= PLAIN_BYTES_MAX else zlib.compress(text)


def unpack(text: bytes) -> dict[str, Any]:
    """What `pack` packed."""
    found: dict[str, Any] = json.loads(plain(text))
    return found


def plain(text: bytes) -> str:
    """A host's words, deflated or not: JSON begins with a brace, zlib never does. Not more of them
    than a host can mean; what cannot be read is left for the parser to refuse."""
    if not text.startswith(b"{"):
        with contextlib.suppress(zlib.error):
            text = zlib.decompressobj().decompress(text, TEXT_BYTES_MAX)
    return text.decode("utf-8", errors="replace")


def _members(field: str, value: object, known: set[str]) -> dict[str, Any]:
    """The members of an object at `field` of the document, empty for the document itself."""
    where = field or "simulation"
    if not isinstance(value, dict):
        raise ScenarioError(f"{where} is {value!r}, not an object", field)
    unknown = sorted(set(value) - known)
    if unknown:
        allowed = ", ".join(sorted(known))
        message = f"{where} has no {', '.join(unknown)}; there are: {allowed}"
        raise ScenarioError(message, f"{field}.{unknown[0]}" if field else unknown[0])
    return value


def _phase_value(changes: Changes, name: str, given: object) -> None:
    changes.phase[name] = read_phase_value(name, name, given)


def _by_hand(changes: Changes, name: str, given: object) -> None:
    changes.by_hand[name] = read_phase_value(name, name, given)


def _faults(changes: Changes, name: str, given: object) -> None:
    for key, value in _members(name, given, set(FAULTS)).items():
        changes.by_hand[key] = read_phase_value(f"{name}.{key}", key, value)


def _rider(changes: Changes, name: str, given: object) -> None:
    rider = _members(name, given, {"kind", "torque_nm", "cadence_rpm_max"})
    for key, value in rider.items():
        target = "rider" if key == "kind" else key
        changes.phase[target] = read_phase_value(f"rider.{key}", target, value)


def _road(changes: Changes, name: str, given: object) -> None:
    for key, value in _members(name, given, {"grade_deg", "wind_ms"}).items():
        changes.phase[key] = read_phase_value(f"road.{key}", key, value)


_CHOICES = {
    "load_source": ("road.source", LOAD_SOURCES),
    "dyno_convention": ("road.dyno_convention", DYNO_CONVENTIONS),
    "motor_model": ("motor.model", MOTOR_MODELS),
}


def _choice(changes: Changes, name: str, given: object) -> None:
    path, choices = _CHOICES[name]
    Setting("", choices=tuple(choices)).read(name, given)
    changes.bike[path] = float(choices[str(given)])


def choices_made(bike: dict[str, float]) -> dict[str, str]:
    """What of load, dynamometer and motor this bike has, by the names of the controls."""
    return {
        name: next(word for word, number in choices.items() if number == bike.get(path, 0.0))
        for name, (path, choices) in _CHOICES.items()
    }


def _mass_kg(changes: Changes, name: str, given: object) -> None:
    changes.bike["road.mass_kg"] = float(Setting(100.0, min=20.0, max=400.0).read(name, given))


def _scenario(changes: Changes, name: str, given: object) -> None:
    if given is None:
        changes.stop_scenario = True
        return
    if isinstance(given, str) and given in changes.own_scenarios:
        changes.scenario = given
        return
    if not isinstance(given, str) or given not in names():
        message = f"there is no scenario {given!r}; there are: {', '.join(names())}"
        raise ScenarioError(message, name)
    if not load(given).live:
        raise ScenarioError(f"{name} {given!r} is measured, not ridden: use `scenario run`", name)
    changes.scenario = given


def _workbench(changes: Changes, name: str, given: object) -> None:
    changes.leave_workbench = given is None
    if given is not None:
        for key, value in _members(name, given, set(WORKBENCH)).items():
            changes.workbench[key] = read_workbench_value(f"{name}.{key}", key, value)


def _running(changes: Changes, name: str, given: object) -> None:
    if not isinstance(given, bool):
        raise ScenarioError(f"{name} is {given!r}, not true or false", name)
    changes.running = given


def _speed_factor(changes: Changes, name: str, given: object) -> None:
    setting = Setting(1.0, min=SPEED_FACTOR_MIN, max=SPEED_FACTOR_MAX)
    changes.speed_factor = float(setting.read(name, given))


def _clock(changes: Changes, name: str, given: object) -> None:
    changes.clock = str(Setting("real", choices=CLOCKS).read(name, given))


def _advance_s(changes: Changes, name: str, given: object) -> None:
    changes.advance_s = float(Setting(0.0, min=0.0, max=ADVANCE_S_MAX).read(name, given))


def _seed(changes: Changes, name: str, given: object) -> None:
    changes.seed = int(Setting(0, min=0, max=2**63 - 1).read(name, given))


_READERS: dict[str, Callable[[Changes, str, object], None]] = {
    "rider": _rider,
    "road": _road,
    "brake": _phase_value,
    "faults": _faults,
    "ambient_degc": _by_hand,
    "grip": _by_hand,
    "walk_button": _by_hand,
    "assist_mode": _phase_value,
    "load_source": _choice,
    "dyno_convention": _choice,
    "motor_model": _choice,
    "dyno_nm": _by_hand,
    "mass_kg": _mass_kg,
    "workbench": _workbench,
    "scenario": _scenario,
    "running": _running,
    "speed_factor": _speed_factor,
    "clock": _clock,
    "advance_s": _advance_s,
    "seed": _seed,
}
