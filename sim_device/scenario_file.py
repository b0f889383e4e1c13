"""Scenario files: what is ridden or measured, with the seed inside.

A *measured* scenario has `settings` that its measurement (sim_device.scenario) reads. A *live* one
has `phases` that a rider works through in real or virtual time. Everything is checked on reading;
the message names the file, the place and what is allowed.
"""

import tomllib
from dataclasses import dataclass, fields
from functools import cache
from importlib.resources import files
from typing import Any

Value = float | int | str

RIDER_KINDS = {"off": 0, "constant": 1, "legs": 2}

# What a person and a road can do; beyond it a typing error is likelier than a wish.
TORQUE_NM_MAX = 300.0
CADENCE_RPM_MAX = 250.0
GRADE_DEG_MAX = 30.0
WIND_MS_MAX = 40.0
SPEED_KMH_MAX = 100.0
PHASE_S_MAX = 36_000.0
PHASES_MAX = 1000


class ScenarioError(ValueError):
    """A scenario, a setting or a control value that does not exist or is out of its range.

    field: where in the question the fault is (`rider.torque_nm`), empty where it is in no field.
    """

    def __init__(self, message: str, field: str = "") -> None:
        super().__init__(message)
        self.field = field


@dataclass(frozen=True)
class Setting:
    """One value a measured scenario can be run with."""

    default: Value
    doc: str = ""
    min: float | None = None
    max: float | None = None
    choices: tuple[Value, ...] = ()

    def read(self, where: str, given: object) -> Value:
        """`given`, a text from the command line included, as a value of this setting.

        Raises ScenarioError, naming `where`, what was given and what is allowed.
        """
        value = self._typed(where, given)
        if self.choices and value not in self.choices:
            allowed = ", ".join(str(choice) for choice in self.choices)
            raise ScenarioError(f"{where} is {given!r}; it can be: {allowed}", where)
        if isinstance(value, str):
            return value
        below = self.min is not None and not value >= self.min
        above = self.max is not None and not value <= self.max
        if below or above:
            message = f"{where} is {given}; it lies from {self.min} to {self.max}"
            raise ScenarioError(message, where)
        return value

    def _typed(self, where: str, given: object) -> Value:
        wanted = type(self.default)
        try:
            if isinstance(given, str):
                return wanted(given)
            if wanted is float and isinstance(given, int | float) and not isinstance(given, bool):
                return float(given)
            if wanted is int and isinstance(given, int) and not isinstance(given, bool):
                return given
        except ValueError:
            pass
        kind = {int: "a whole number", float: "a number", str: "a text"}[wanted]
        raise ScenarioError(f"{where} is {given!r}, not {kind}", where)


@dataclass(frozen=True)
class Phase:
    """What rider and road do for `seconds`; the fields' names are those of the TOML file."""

    seconds: float
    rider: str = "off"
    torque_nm: float = 0.0
    cadence_rpm_max: float = 100.0
    grade_deg: float = 0.0
    wind_ms: float = 0.0
    brake: bool = False
    assist_mode: int | None = None


@dataclass(frozen=True)
class ScenarioFile:
    """A scenario as it was read; `bike` holds `part.name` values over the pinned bike W1."""

    name: str
    doc: str
    seed: int
    settings: dict[str, Setting]
    phases: tuple[Phase, ...]
    repeat: bool
    speed_kmh: float | None
    bike: dict[str, float]

    @property
    def live(self) -> bool:
        return bool(self.phases)

    @property
    def duration_s(self) -> float:
        return sum(phase.seconds for phase in self.phases)


_PHASE_RANGES = {
    "seconds": Setting(1.0, min=0.01, max=PHASE_S_MAX),
    "rider": Setting("off", choices=tuple(RIDER_KINDS)),
    "torque_nm": Setting(0.0, min=-TORQUE_NM_MAX, max=TORQUE_NM_MAX),
    "cadence_rpm_max": Setting(100.0, min=0.0, max=CADENCE_RPM_MAX),
    "grade_deg": Setting(0.0, min=-GRADE_DEG_MAX, max=GRADE_DEG_MAX),
    "wind_ms": Setting(0.0, min=-WIND_MS_MAX, max=WIND_MS_MAX),
    "assist_mode": Setting(0, min=0, max=4),
}
_SCENARIO_KEYS = {"doc", "seed", "settings", "phases", "repeat", "speed_kmh", "bike"}
_SETTING_KEYS = {field.name for field in fields(Setting)}


def read_phase_value(where: str, name: str, given: object) -> Any:
    """One value of a phase, checked; used for live controls too. Raises ScenarioError."""
    if name == "brake":
        if not isinstance(given, bool):
            raise ScenarioError(f"{where} is {given!r}, not true or false", where)
        return given
    if name not in _PHASE_RANGES:
        known = ", ".join([*_PHASE_RANGES, "brake"])
        raise ScenarioError(f"{where} is not known; there are: {known}")
    return _PHASE_RANGES[name].read(where, given)


def parse(name: str, text: str) -> ScenarioFile:
    """Reads a scenario. Raises ScenarioError with the file's name and the place."""
    where = f"scenario {name}"
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ScenarioError(f"{where}: {error}") from error
    _refuse_unknown(where, table, _SCENARIO_KEYS)
    if not isinstance(table.get("doc"), str) or not isinstance(table.get("seed"), int):
        raise ScenarioError(f"{where}: needs a text `doc` and a whole number `seed`")
    return ScenarioFile(
        name=name,
        doc=table["doc"],
        seed=table["seed"],
        settings=_settings(where, table.get("settings", {})),
        phases=_phases(where, table.get("phases", [])),
        repeat=bool(table.get("repeat", False)),
        speed_kmh=_start_speed_kmh(where, table.get("speed_kmh")),
        bike={
            f"{part}.{key}": float(Setting(0.0).read(f"{where}, bike.{part}.{key}", value))
            for part, values in table.get("bike", {}).items()
            for key, value in values.items()
        },
    )


def _start_speed_kmh(where: str, given: object) -> float | None:
    if given is None:
        return None
    setting = Setting(0.0, min=0.0, max=SPEED_KMH_MAX)
    return float(setting.read(f"{where}: speed_kmh", given))


def _refuse_unknown(where: str, table: dict[str, Any], known: set[str]) -> None:
    unknown = sorted(set(table) - known)
    if unknown:
        allowed = ", ".join(sorted(known))
        raise ScenarioError(f"{where}: unknown {', '.join(unknown)}; there are: {allowed}")


def _settings(where: str, table: dict[str, dict[str, Any]]) -> dict[str, Setting]:
    settings = {}
    for name, entry in table.items():
        _refuse_unknown(f"{where}, setting {name}", entry, _SETTING_KEYS)
        if "default" not in entry:
            raise ScenarioError(f"{where}, setting {name}: needs a default")
        settings[name] = Setting(**{**entry, "choices": tuple(entry.get("choices", ()))})
    return settings


def _phases(where: str, rows: list[dict[str, Any]]) -> tuple[Phase, ...]:
    """Each phase keeps what the one before it did, except for what it names.

    The mode button is pressed only where a phase names it: a choice made by hand stays.
    """
    if len(rows) > PHASES_MAX:
        raise ScenarioError(f"{where}: {len(rows)} phases, at most {PHASES_MAX}")
    phases: list[Phase] = []
    current: dict[str, Any] = {}
    for number, row in enumerate(rows, start=1):
        if "seconds" not in row:
            raise ScenarioError(f"{where}, phase {number}: needs `seconds`")
        for name, given in row.items():
            current[name] = read_phase_value(f"{where}, phase {number}: {name}", name, given)
        phases.append(Phase(**current))
        current.pop("assist_mode", None)
    return tuple(phases)


@cache
def load(name: str) -> ScenarioFile:
    """The scenario that comes with Spindle under this name. Raises ScenarioError."""
    if name not in names():
        raise ScenarioError(f"there is no scenario {name!r}; there are: {', '.join(names())}")
    source = files("sim_device") / "scenarios" / f"{name}.toml"
    return parse(name, source.read_text(encoding="utf-8"))


def names() -> tuple[str, ...]:
    """Every scenario that comes with Spindle."""
    folder = files("sim_device") / "scenarios"
    found = [entry.name for entry in folder.iterdir()]
    return tuple(sorted(name.removesuffix(".toml") for name in found if name.endswith(".toml")))
