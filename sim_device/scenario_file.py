"""Scenario files: what is ridden or measured, with the seed inside.

A scenario with `phases` can be ridden, in real or virtual time; one with `settings` is measured by
sim_device.scenario, which reads them. Everything is checked on reading; the message names the file,
the line, the place and what is allowed.
"""

import tomllib
from dataclasses import dataclass, fields
from functools import cache
from importlib.resources import files
from itertools import pairwise
from pathlib import Path
from typing import Any

from sim_device.bike_ranges import read_bike_value
from sim_device.firmware.python.unit import default_bike
from sim_device.scenario_lines import Source
from sim_device.scenario_phase import Phase, ScenarioError, Setting, Value, read_phase_value

SPEED_KMH_MAX = 100.0
PHASES_MAX = 1000
FILE_BYTES_MAX = 1_000_000
FILE_ENDING = ".toml"
# The unit tells it in an answer that has to fit a frame.
FILE_NAME_CHARACTERS_MAX = 80

Numbers = dict[str, float]


@dataclass(frozen=True)
class ScenarioFile:
    """A scenario as it was read.

    bike: `part.name` values over the pinned bike W1. states: named specimens of a part of it, with
    `rig.name` values for what is around them.
    """

    name: str
    doc: str
    seed: int
    settings: dict[str, Setting]
    phases: tuple[Phase, ...]
    repeat: bool
    speed_kmh: float | None
    bike: Numbers
    states: dict[str, Numbers]

    @property
    def live(self) -> bool:
        return bool(self.phases)

    @property
    def duration_s(self) -> float | None:
        """Of one round; None where a phase is given in metres: the ride will say."""
        if any(phase.metres is not None for phase in self.phases):
            return None
        return self.duration_s_max

    @property
    def duration_s_max(self) -> float:
        """After which one round has ended, even if the bike stands."""
        return sum(phase.seconds_max for phase in self.phases)


_LENGTHS = {"seconds", "metres"}
_SCENARIO_KEYS = {"doc", "seed", "settings", "phases", "repeat", "speed_kmh", "bike", "states"}
_SETTING_KEYS = {field.name for field in fields(Setting)}
_RIG = {"rig.pan_nm", "rig.scatter_nm"}
_RIG_NM = Setting(0.0, min=-100.0, max=100.0)
_SEED = Setting(0, min=0, max=2**63 - 1)


def parse(name: str, text: str) -> ScenarioFile:
    """Reads a scenario. Raises ScenarioError with the file's name, the line and the place."""
    source = Source(name, text)
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ScenarioError(f"scenario {name}: {error}") from error
    _refuse_unknown(source, "", table, _SCENARIO_KEYS)
    if not isinstance(table.get("doc"), str) or "seed" not in table:
        at = source.at("", "doc")
        raise ScenarioError(f"{at}: needs a text `doc` and a whole number `seed`")
    known = set(default_bike())
    bike = _numbers(source, "bike", _tables(source, table, "bike"), known)
    return ScenarioFile(
        name=name,
        doc=table["doc"],
        seed=int(_SEED.read(f"{source.at('', 'seed')}: seed", table["seed"])),
        settings=_settings(source, _tables(source, table, "settings")),
        phases=_phases(source, table.get("phases", []), bike),
        repeat=_flag(source, table, "repeat"),
        speed_kmh=_start_speed_kmh(source, table.get("speed_kmh")),
        bike=bike,
        states={
            state: _numbers(source, f"states.{state}", _tables(source, states, state), known | _RIG)
            for states in (_tables(source, table, "states"),)
            for state in states
        },
    )


def _tables(source: Source, table: dict[str, Any], key: str) -> dict[str, Any]:
    """The tables under `key`, none if it is not there."""
    found = table.get(key, {})
    if not isinstance(found, dict) or not all(isinstance(entry, dict) for entry in found.values()):
        where = source.at("", key)
        raise ScenarioError(f"{where}: {key} holds tables, as in [{key}.name]")
    return found


def _flag(source: Source, table: dict[str, Any], key: str) -> bool:
    given = table.get(key, False)
    if not isinstance(given, bool):
        raise ScenarioError(f"{source.at('', key)}: {key} is {given!r}, not true or false")
    return given


def _numbers(source: Source, table: str, parts: dict[str, Any], known: set[str]) -> Numbers:
    numbers: Numbers = {}
    for part, values in parts.items():
        for key, value in values.items():
            where = f"{source.at(f'{table}.{part}', key)}, {table}.{part}.{key}"
            if isinstance(value, list) and f"{part}.{key}_1" in known:
                numbers |= _list(where, f"{part}.{key}", value, known)
                continue
            if f"{part}.{key}" not in known:
                near = ", ".join(sorted(name for name in known if name.startswith(f"{part}.")))
                parts_known = ", ".join(sorted({name.split(".")[0] for name in known}))
                raise ScenarioError(f"{where} is not known; there are: {near or parts_known}")
            numbers[f"{part}.{key}"] = _number(where, f"{part}.{key}", value)
    return numbers


def _list(where: str, name: str, given: list[object], known: set[str]) -> Numbers:
    """The values of a list that rises, smallest first, filled up with zeros."""
    room = sum(path.startswith(f"{name}_") for path in known)
    if not 1 <= len(given) <= room:
        raise ScenarioError(f"{where} has {len(given)} values; it can have 1 to {room}")
    values = [_number(where, f"{name}_{n}", each) for n, each in enumerate(given, start=1)]
    if values[0] <= 0.0 or any(later <= now for now, later in pairwise(values)):
        raise ScenarioError(f"{where} is {given}; its values rise from above 0")
    values += [0.0] * (room - len(values))
    return {f"{name}_{n}": value for n, value in enumerate(values, start=1)}


def _number(where: str, name: str, given: object) -> float:
    if name in _RIG:
        return float(_RIG_NM.read(where, given))
    return read_bike_value(where, name, given)


def _start_speed_kmh(source: Source, given: object) -> float | None:
    if given is None:
        return None
    setting = Setting(0.0, min=0.0, max=SPEED_KMH_MAX)
    return float(setting.read(f"{source.at('', 'speed_kmh')}: speed_kmh", given))


def _refuse_unknown(source: Source, at: str, table: dict[str, Any], known: set[str]) -> None:
    unknown = sorted(set(table) - known)
    if unknown:
        allowed = ", ".join(sorted(known))
        where = source.at(at, unknown[0]) + (f", {at}" if at else "")
        raise ScenarioError(f"{where}: unknown {', '.join(unknown)}; there are: {allowed}")


def _settings(source: Source, table: dict[str, dict[str, Any]]) -> dict[str, Setting]:
    settings = {}
    for name, entry in table.items():
        at = f"settings.{name}"
        where = f"{source.at(at)}, setting {name}"
        _refuse_unknown(source, at, entry, _SETTING_KEYS)
        default = entry.get("default")
        if not isinstance(default, float | int | str) or isinstance(default, bool):
            raise ScenarioError(f"{where}: needs a default, a number or a text")
        choices = entry.get("choices", [])
        if not isinstance(choices, list):
            raise ScenarioError(f"{source.at(at, 'choices')}, setting {name}: choices are a list")
        bounds: dict[str, Value] = {
            key: Setting(0.0).read(f"{source.at(at, key)}, setting {name}: {key}", entry[key])
            for key in ("min", "max")
            if key in entry
        }
        setting = Setting(**{**entry, **bounds, "choices": tuple(choices)})
        setting.read(f"{where}: default", setting.default)
        settings[name] = setting
    return settings


def _phases(source: Source, rows: object, bike: Numbers) -> tuple[Phase, ...]:
    """Each phase keeps what the one before it did, except for what it names.

    The mode button is pressed only where a phase names it: a choice made by hand stays.
    """
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise ScenarioError(f"{source.at('', 'phases')}: phases are tables, as in [[phases]]")
    if len(rows) > PHASES_MAX:
        raise ScenarioError(f"{source.at()}: {len(rows)} phases, at most {PHASES_MAX}")
    phases: list[Phase] = []
    current: dict[str, Any] = {}
    for number, row in enumerate(rows, start=1):
        at = f"phases {number}"
        lengths = row.keys() & _LENGTHS
        if len(lengths) != 1:
            raise ScenarioError(
                f"{source.at(at)}, phase {number}: needs `seconds` or `metres`, and not both"
            )
        current = {name: value for name, value in current.items() if name not in _LENGTHS}
        for name, given in row.items():
            where = f"{source.at(at, name)}, phase {number}: {name}"
            current[name] = read_phase_value(where, name, given)
            if name == "dyno_nm" and not bike.get("road.source"):
                raise ScenarioError(f"{where} loads the bench only: [bike.road] needs source = 1")
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


def load_file(path: Path) -> ScenarioFile:
    """A scenario of one's own, to be ridden. Raises ScenarioError, OSError if it cannot be read."""
    if path.stat().st_size > FILE_BYTES_MAX:
        raise ScenarioError(f"{path} has more than {FILE_BYTES_MAX} bytes: no scenario is so long")
    try:
        scenario = parse(path.name, path.read_text(encoding="utf-8"))
    except UnicodeDecodeError as error:
        raise ScenarioError(f"{path} is not UTF-8 text: {error}") from error
    if not scenario.live:
        raise ScenarioError(f"scenario {path.name}: needs [[phases]] to be ridden")
    return scenario


def load_live(name: str) -> ScenarioFile:
    """A scenario to be ridden: one that comes with Spindle, or a TOML file by its path.

    Raises ScenarioError, also for a file that cannot be read.
    """
    if name.endswith(FILE_ENDING):
        if len(Path(name).name) > FILE_NAME_CHARACTERS_MAX:
            raise ScenarioError(
                f"scenario {name}: its name has more than {FILE_NAME_CHARACTERS_MAX} characters"
            )
        try:
            return load_file(Path(name))
        except OSError as error:
            raise ScenarioError(f"scenario {name} cannot be read: {error.strerror}") from error
    if name not in names():
        known = ", ".join(name for name in names() if load(name).live)
        raise ScenarioError(
            f"there is no scenario {name!r}; there are: {known}; or give the path of a file "
            f"of your own, *{FILE_ENDING}"
        )
    scenario = load(name)
    if not scenario.live:
        raise ScenarioError(f"scenario {name!r} is measured, not ridden: use `scenario run`")
    return scenario


def names() -> tuple[str, ...]:
    """Every scenario that comes with Spindle."""
    folder = files("sim_device") / "scenarios"
    found = [entry.name for entry in folder.iterdir()]
    return tuple(sorted(name.removesuffix(".toml") for name in found if name.endswith(".toml")))


__all__ = [
    "Phase",
    "ScenarioError",
    "ScenarioFile",
    "Setting",
    "Value",
    "load",
    "load_file",
    "load_live",
    "names",
    "parse",
    "read_phase_value",
]
