"""Preview a law without a unit: surface, points, lint and replay, by the unit's own C."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from backend import law
from backend.core.assist_mode import AssistModes
from backend.core.energy import RADIANS_PER_S_PER_RPM
from backend.core.fuzzy_table import PARAMETER_NAMES, SHARED_FIELDS, FuzzyTable
from backend.errors import FieldError, InvalidRequest
from backend.law import Finding, LintReport, Replay


class Preview:
    """The use cases of the bench without a bike. Holds nothing; safe from any thread."""

    def surface(
        self,
        fuzzy_table: Mapping[str, Any],
        speeds_kmh: Sequence[float],
        torque_rates: Sequence[float],
    ) -> dict[str, Any]:
        """`{gain: [n][m], engine}`, rows = speeds. Raises InvalidRequest."""
        table = FuzzyTable.from_json(fuzzy_table)
        gain = law.surface(table, speeds_kmh, torque_rates)
        return {"gain": gain.tolist(), "engine": law.ENGINE}

    def points(
        self, fuzzy_table: Mapping[str, Any], points: Sequence[tuple[float, float]]
    ) -> dict[str, Any]:
        """`{gain: [k], engine}` at pairs of speed and torque rate. Raises InvalidRequest."""
        table = FuzzyTable.from_json(fuzzy_table)
        try:
            pairs = np.asarray(points, np.float64).reshape(-1, 2)
        except (TypeError, ValueError) as wrong:
            message = "points must be pairs of speed_kmh and torque_rate"
            raise InvalidRequest(message, "wrong_shape") from wrong
        places = ("points[{}][0]", "points[{}][1]")
        gain = law.points(table, pairs[:, 0], pairs[:, 1], places)
        return {"gain": gain.tolist(), "engine": law.ENGINE}

    def mode_curves(
        self, parameters: Mapping[str, Any], rider_torque_nm: float, speeds_kmh: Sequence[float]
    ) -> dict[str, Any]:
        """What each mode gives for a steady push, as in the API.

        parameters: by registry name; those that are missing have the law's defaults. Raises
        InvalidRequest.
        """
        config = {**law.law_defaults(), **parameters}
        curves = law.mode_curves(config, rider_torque_nm, speeds_kmh)
        crank_rad_per_s = law.CADENCE_RPM * RADIANS_PER_S_PER_RPM
        return {
            "cadence_rpm": law.CADENCE_RPM,
            "hard_push_nm": law.HARD_PUSH_NM,
            "modes": [
                {
                    "torque_nm": curve.torque_nm.tolist(),
                    "torque_nm_most": curve.torque_nm_most,
                    "power_w_most": curve.torque_nm_most * crank_rad_per_s,
                }
                for curve in curves
            ],
            "engine": law.ENGINE,
        }

    def torque_surface(
        self,
        parameters: Mapping[str, Any],
        mode: int,
        rider_torque_nm: float,
        speeds_kmh: Sequence[float],
        torque_rates: Sequence[float],
    ) -> dict[str, Any]:
        """What a mode gives over the grid of its table, as in the API.

        parameters: by registry name; those that are missing have the law's defaults. Raises
        InvalidRequest.
        """
        config = {**law.law_defaults(), **parameters}
        surface = law.torque_surface(config, mode, rider_torque_nm, speeds_kmh, torque_rates)
        return {
            "speeds_kmh": list(speeds_kmh),
            "torque_rates": list(torque_rates),
            "demanded_nm": surface.demanded_nm.tolist(),
            "delivered_nm": surface.delivered_nm.tolist(),
            "limit_flags": surface.limit_flags.tolist(),
            "cadence_rpm": law.CADENCE_RPM,
            "crank_rad_per_s": law.CADENCE_RPM * RADIANS_PER_S_PER_RPM,
            "engine": law.ENGINE,
        }

    def lint(
        self,
        fuzzy_table: Mapping[str, Any],
        assist_modes: Mapping[str, Any] | None = None,
        limits: Mapping[str, Any] | None = None,
        which: str = "first",
        taper_speeds_kmh: tuple[float, float] | None = None,
        gear_ratio: float | None = None,
    ) -> LintReport:
        """Findings about a table; one that cannot exist is an answer too, with its faults.

        Arguments as of backend.law.lint.
        """
        faults: list[Finding] = []
        table = modes = None
        try:
            table = FuzzyTable.from_json(fuzzy_table)
        except InvalidRequest as refused:
            faults += _findings(refused)
        try:
            modes = AssistModes.from_json(assist_modes) if assist_modes is not None else None
        except InvalidRequest as refused:
            faults += _findings(refused)
        if table is None:
            return LintReport(tuple(faults), (), ())
        report = law.lint(table, modes, limits, which, taper_speeds_kmh, gear_ratio)
        return LintReport((*faults, *report.errors), report.warnings, report.notes)

    def replay(
        self,
        config: Mapping[str, Any],
        arrays: Mapping[str, npt.ArrayLike],
        fuzzy_table: Mapping[str, Any] | None = None,
        assist_modes: Mapping[str, Any] | None = None,
        step_s: float = 0.01,
        second_table: Mapping[str, Any] | None = None,
        parameters: Mapping[str, Any] | None = None,
        first: int = 0,
    ) -> Replay:
        """What the motor would have done on a recorded ride under other settings.

        config: the unit's parameters by registry name. arrays: `speed_kmh`, `cadence_rpm`, `mode`,
        and `torque_raw_counts` or `rider_torque_nm`, (n,) each; what else is known by the names of
        law.replay, as `first` is. The rest as of `changed_config`. Raises InvalidRequest.
        """
        changed = changed_config(
            config, fuzzy_table, assist_modes, second_table, parameters=parameters
        )
        readings = dict(arrays)
        torque_nm = readings.pop("rider_torque_nm", None)
        if torque_nm is not None:
            readings.setdefault("torque_raw_counts", law.raw_counts_of(config, torque_nm))
        missing = {"speed_kmh", "cadence_rpm", "torque_raw_counts", "mode"} - set(readings)
        if missing:
            listed = ", ".join(sorted(missing))
            raise InvalidRequest(f"replay: the ride has no {listed}", "missing_channel")
        return law.replay(changed, step_s=step_s, first=first, **readings)


def changed_config(
    config: Mapping[str, Any],
    fuzzy_table: Mapping[str, Any] | None = None,
    assist_modes: Mapping[str, Any] | None = None,
    second_table: Mapping[str, Any] | None = None,
    limits: Mapping[str, Any] | None = None,
    parameters: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """A configuration with other tables, modes, limits or parameters, by registry name.

    second_table: has the points of the first. limits: parameters by name, None where one stays.
    parameters: any, before the others; sensor, wheel and drivetrain stay as they are. Raises
    InvalidRequest.
    """
    chosen = (parameters or {}).items()
    changed = {**config, **{name: one for name, one in chosen if name not in law.OF_THE_BIKE}}
    if fuzzy_table is not None:
        changed |= FuzzyTable.from_json(fuzzy_table).to_parameters()
    if second_table is not None:
        second = FuzzyTable.from_json(second_table)
        _refuse_points_of_its_own(second, changed)
        changed |= second.to_parameters("second")
    if assist_modes is not None:
        changed |= AssistModes.from_json(assist_modes).to_parameters()
    if limits is not None:
        changed |= {name: limits[name] for name in limits if limits[name] is not None}
    return changed


def _refuse_points_of_its_own(second: FuzzyTable, config: Mapping[str, Any]) -> None:
    """Raises InvalidRequest if a second table differs in what both tables share."""
    faults = [
        FieldError(f"second_table.{field}", "shared", f"{field} differ from the first table's")
        for field in SHARED_FIELDS
        if not np.array_equal(
            np.asarray(getattr(second, field), np.float32),
            np.asarray(config[PARAMETER_NAMES[field]], np.float32),
        )
    ]
    if faults:
        message = "second table: both tables share speed and torque-rate points: " + "; ".join(
            fault.message for fault in faults
        )
        raise InvalidRequest(message, "shared", faults)


def _findings(refused: InvalidRequest) -> list[Finding]:
    return [Finding(fault.code, fault.message, fault.field) for fault in refused.fields] or [
        Finding(refused.code, refused.message, None)
    ]
