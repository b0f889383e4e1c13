"""The five slots the rider's switch selects: a name, a law, a ratio and how it is applied."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from backend.errors import FieldError, InvalidRequest

LAWS = ("off", "fixed", "fuzzy")
TAPERS = ("taper_speeds", "none", "japan_1_to_1", "japan_2_to_1")
TABLES = ("first", "second")
RAMP_UP_RANGE = (5, 2000)
RAMP_DOWN_RANGE = (20, 2000)
"""Nm/s at the crank, as in the registry; the largest leaves the ramp to that of all modes."""
SLOTS = 5
NAME_BYTES_MAX = 16


@dataclass(frozen=True, slots=True)
class AssistMode:
    """One slot. ratio: motor torque at the crank per rider torque, before gain and taper.

    taper: how the fixed law's ratio falls with speed. table: which fuzzy table. The ramps: fastest
    rise and fall at the crank. torque_pct: of the unit's largest motor torque.
    """

    name: str
    law: str
    ratio: float
    taper: str = "taper_speeds"
    table: str = "first"
    ramp_up_nm_per_s: int = 2000
    ramp_down_nm_per_s: int = 2000
    torque_pct: int = 100


@dataclass(frozen=True, slots=True)
class AssistModes:
    """The five slots and the one selected when the unit is switched on.

    Raises InvalidRequest naming every field at fault.
    """

    modes: tuple[AssistMode, ...]
    mode_at_start: int

    def __post_init__(self) -> None:
        faults = list(_faults(self.modes, self.mode_at_start))
        if faults:
            listed = "; ".join(fault.message for fault in faults)
            raise InvalidRequest(f"assist modes: {listed}", "invalid_assist_modes", faults)

    @classmethod
    def from_json(cls, value: Mapping[str, Any]) -> AssistModes:
        """From `{"modes": [{"name", "law", "ratio", ...}, ...], "mode_at_start"}`.

        Fields after the ratio may be missing. Raises InvalidRequest.
        """
        try:
            modes = tuple(AssistMode(**mode) for mode in value["modes"])
            return cls(modes, value["mode_at_start"])
        except (KeyError, TypeError) as wrong:
            message = f"assist modes: modes need name, law and ratio, and mode_at_start ({wrong})"
            raise InvalidRequest(message, "invalid_assist_modes") from wrong

    def to_json(self) -> dict[str, Any]:
        """The same object again."""
        return {
            "modes": [asdict(mode) for mode in self.modes],
            "mode_at_start": self.mode_at_start,
        }

    @classmethod
    def from_parameters(cls, parameters: Mapping[str, Any]) -> AssistModes:
        """From a unit's configuration, by registry names. Raises InvalidRequest."""
        rows = zip(
            parameters["mode_names"],
            parameters["mode_laws"],
            parameters["mode_ratios"],
            parameters["mode_tapers"],
            parameters["mode_tables"],
            parameters["mode_ramp_up_nm_per_s"],
            parameters["mode_ramp_down_nm_per_s"],
            parameters["mode_torque_pct"],
            strict=True,
        )
        modes = tuple(
            AssistMode(name, law, ratio, taper, TABLES[table], *rest)
            for name, law, ratio, taper, table, *rest in rows
        )
        return cls(modes, parameters["assist_mode_at_start"])

    def to_parameters(self) -> dict[str, Any]:
        """The nine parameters the modes are in a unit's configuration."""
        return {
            "assist_mode_at_start": self.mode_at_start,
            "mode_names": [mode.name for mode in self.modes],
            "mode_laws": [mode.law for mode in self.modes],
            "mode_ratios": [mode.ratio for mode in self.modes],
            "mode_tapers": [mode.taper for mode in self.modes],
            "mode_tables": [TABLES.index(mode.table) for mode in self.modes],
            "mode_ramp_up_nm_per_s": [mode.ramp_up_nm_per_s for mode in self.modes],
            "mode_ramp_down_nm_per_s": [mode.ramp_down_nm_per_s for mode in self.modes],
            "mode_torque_pct": [mode.torque_pct for mode in self.modes],
        }


def _faults(modes: tuple[AssistMode, ...], mode_at_start: Any) -> Iterable[FieldError]:
    if len(modes) != SLOTS:
        yield FieldError("modes", "wrong_shape", f"there are {SLOTS} slots, not {len(modes)}")
    if not isinstance(mode_at_start, int) or not 0 <= mode_at_start < SLOTS:
        yield FieldError("mode_at_start", "out_of_range", f"mode_at_start must be 0 to {SLOTS - 1}")
    for slot, mode in enumerate(modes):
        yield from _mode_faults(f"modes[{slot}]", mode)


def _mode_faults(where: str, mode: AssistMode) -> Iterable[FieldError]:
    if not isinstance(mode.name, str) or len(mode.name.encode()) > NAME_BYTES_MAX:
        yield FieldError(
            f"{where}.name", "too_long", f"{where}.name must be text of {NAME_BYTES_MAX} bytes"
        )
    for field, choices in (("law", LAWS), ("taper", TAPERS), ("table", TABLES)):
        if getattr(mode, field) not in choices:
            message = f"{where}.{field} must be one of {', '.join(choices)}"
            yield FieldError(f"{where}.{field}", "not_a_choice", message)
    for field, (low, high) in (
        ("ramp_up_nm_per_s", RAMP_UP_RANGE),
        ("ramp_down_nm_per_s", RAMP_DOWN_RANGE),
        ("torque_pct", (0, 100)),
    ):
        value = getattr(mode, field)
        if type(value) is not int or not low <= value <= high:
            message = f"{where}.{field} must be a whole number from {low} to {high}"
            yield FieldError(f"{where}.{field}", "out_of_range", message)
    if isinstance(mode.ratio, bool) or not isinstance(mode.ratio, int | float):
        yield FieldError(f"{where}.ratio", "not_a_number", f"{where}.ratio is not a number")
    elif not (math.isfinite(mode.ratio) and mode.ratio >= 0.0):
        yield FieldError(
            f"{where}.ratio", "out_of_range", f"{where}.ratio must be finite and not negative"
        )
