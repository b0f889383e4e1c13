"""Parts of the configuration in the shape people edit: table, modes, calibration, limits."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

from backend.device.parameters import Value, group
from backend.domain.assist_mode import AssistModes
from backend.domain.fuzzy_table import PARAMETER_NAMES, FuzzyTable
from backend.errors import FieldError, InvalidRequest

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
    """

    read: Callable[[Mapping[str, Value]], dict[str, Any]]
    changes: Callable[[Mapping[str, Any]], dict[str, Value]]
    fields: Mapping[str, str]

    def renamed(self, fault: FieldError) -> FieldError:
        """The fault with the name its field has in the JSON."""
        name, bracket, index = fault.field.partition("[")
        place = self.fields.get(name)
        if place is None:
            return fault
        return replace(fault, field=place.replace("{index}", bracket + index))


def _by_name(names: tuple[str, ...]) -> ConfigPart:
    """A part whose JSON is the parameters themselves."""

    def read(parameters: Mapping[str, Value]) -> dict[str, Any]:
        return {name: parameters[name] for name in names}

    def changes(value: Mapping[str, Any]) -> dict[str, Value]:
        unknown = [name for name in value if name not in names]
        if unknown:
            raise InvalidRequest(
                f"{', '.join(unknown)} does not belong here; there is {', '.join(names)}."
            )
        return dict(value)

    return ConfigPart(read, changes, {})


FUZZY_TABLE = ConfigPart(
    read=lambda parameters: FuzzyTable.from_parameters(parameters).to_json(),
    changes=lambda value: cast("dict[str, Value]", FuzzyTable.from_json(value).to_parameters()),
    fields={parameter: field + "{index}" for field, parameter in PARAMETER_NAMES.items()},
)
ASSIST_MODES = ConfigPart(
    read=lambda parameters: AssistModes.from_parameters(parameters).to_json(),
    changes=lambda value: cast("dict[str, Value]", AssistModes.from_json(value).to_parameters()),
    fields=MODE_FIELDS,
)
CALIBRATION = _by_name(group("sensor"))
LIMITS = _by_name(group("limits"))
