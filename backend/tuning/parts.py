"""Parts of the configuration in the shape people edit: table, modes, calibration, limits."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from operator import itemgetter
from typing import Any, cast

from backend.core.assist_mode import AssistModes
from backend.core.fuzzy_table import PARAMETERS_OF, SHARED_FIELDS, FuzzyTable, stored_json
from backend.device.capability import Capability
from backend.device.configuration import ParameterTable, Value
from backend.errors import FieldError, InvalidRequest
from backend.law import cutoff_of

EFFECTIVE_CUTOFF = "effective_assist_cutoff_kmh"
# Parameter of the slots -> where its element `{index}` is in the modes' JSON.
MODE_FIELDS = {
    "mode_names": "modes{index}.name",
    "mode_laws": "modes{index}.law",
    "mode_ratios": "modes{index}.ratio",
    "mode_tapers": "modes{index}.taper",
    "mode_tables": "modes{index}.table",
    "mode_ramp_up_nm_per_s": "modes{index}.ramp_up_nm_per_s",
    "mode_ramp_down_nm_per_s": "modes{index}.ramp_down_nm_per_s",
    "mode_torque_pct": "modes{index}.torque_pct",
    "assist_mode_at_start": "mode_at_start",
}


@dataclass(frozen=True)
class ConfigPart:
    """One part: parameters -> JSON, JSON -> changes (raises InvalidRequest), and the names.

    fields: parameter -> its place in the JSON, so that a fault marks the right field of a form.
    compared: parameters the part shows and may not change, because another part owns them.
    unknown_while_lost: what is unknown while defaults stand in place of what was lost.
    """

    read: Callable[[Mapping[str, Value]], dict[str, Any]]
    changes: Callable[[Mapping[str, Any]], dict[str, Value]]
    fields: Mapping[str, str]
    compared: tuple[str, ...] = ()
    unknown_while_lost: tuple[str, ...] = ()

    def renamed(self, fault: FieldError) -> FieldError:
        """The fault with the name its field has in the JSON."""
        name, bracket, index = fault.field.partition("[")
        place = self.fields.get(name)
        if place is None:
            return fault
        return replace(fault, field=place.replace("{index}", bracket + index))


def _by_name(
    names: tuple[str, ...],
    readers: Mapping[str, Callable[[Mapping[str, Value]], Any]] | None = None,
) -> ConfigPart:
    """A part whose JSON is the parameters themselves.

    readers: what follows from them, by name; it is shown with them and not written.
    """
    readers = readers or {}

    def read(parameters: Mapping[str, Value]) -> dict[str, Any]:
        shown = {name: parameters[name] for name in names}
        return shown | {name: derive(parameters) for name, derive in readers.items()}

    def changes(value: Mapping[str, Any]) -> dict[str, Value]:
        unknown = [name for name in value if name not in names and name not in readers]
        if unknown:
            raise InvalidRequest(
                f"{', '.join(unknown)} does not belong here; there is {', '.join(names)}."
            )
        return {name: value[name] for name in value if name in names}

    return ConfigPart(read, changes, {})


def _fuzzy_table(which: str) -> ConfigPart:
    """One of the two rule tables. The points both share are the first one's to change."""
    names = PARAMETERS_OF[which]

    def read(parameters: Mapping[str, Value]) -> dict[str, Any]:
        return stored_json(parameters, which)

    def changes(value: Mapping[str, Any]) -> dict[str, Value]:
        return FuzzyTable.from_json(value).to_parameters(which)

    fields = {parameter: field + "{index}" for field, parameter in names.items()}
    compared = () if which == "first" else tuple(names[field] for field in SHARED_FIELDS)
    return ConfigPart(read, changes, fields, compared)


def _effective_cutoff_kmh(parameters: Mapping[str, Value]) -> float | None:
    """Where assist ends, by the unit's own C: what is configured, or less if the market says so."""
    cutoff = cutoff_of(parameters)
    return None if cutoff is None else cutoff.holds_kmh


def _assist_modes() -> ConfigPart:
    return ConfigPart(
        read=lambda parameters: AssistModes.from_parameters(parameters).to_json(),
        changes=lambda value: cast(
            "dict[str, Value]", AssistModes.from_json(value).to_parameters()
        ),
        fields=MODE_FIELDS,
    )


def _calibration(table: ParameterTable) -> ConfigPart:
    """Sensor and record of its calibration; what the maker gave it is shown and not written."""
    names = table.group("sensor") + table.group("calibration")
    readers = {name: itemgetter(name) for name in names if name in table.factory}
    return _by_name(tuple(name for name in names if name not in readers), readers)


def _limits(table: ParameterTable) -> ConfigPart:
    """Limits and market, and where assist ends because of them: at walking pace, or there is none,
    while defaults stand in place of what was lost."""
    names = table.group("limits") + table.group("market")
    part = _by_name(names, {EFFECTIVE_CUTOFF: _effective_cutoff_kmh})
    return replace(part, unknown_while_lost=(EFFECTIVE_CUTOFF,))


@dataclass(frozen=True)
class PartKind:
    """A part as units have it: what a unit needs for it, and the part for its parameters."""

    capability: Capability
    of: Callable[[ParameterTable], ConfigPart]


PARTS = {
    "fuzzy_table": PartKind(Capability.FUZZY_TABLE, lambda _: _fuzzy_table("first")),
    "second_fuzzy_table": PartKind(Capability.FUZZY_TABLE, lambda _: _fuzzy_table("second")),
    "assist_modes": PartKind(Capability.ASSIST_MODES, lambda _: _assist_modes()),
    "calibration": PartKind(Capability.CALIBRATE, _calibration),
    "limits": PartKind(Capability.LIMITS, _limits),
}
