"""Which mode and which rule carried which share of a ride's motor energy.

Energy is what the motor delivered at its shaft; a ride that tells only what was asked of its motor
has none. A moment belongs to the mode that was selected and, where a table said what the motor is
asked for, to the at most four rules that fired, in the shares of the law's sets. What no table
carried (fixed modes, walk assist, a motor that runs out) is listed separately.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from backend.core.channels import Values
from backend.core.energy import MOTOR_POWER, SECONDS_PER_HOUR
from backend.core.fuzzy_table import PARAMETERS_OF, stored_json
from backend.errors import InvalidRequest
from backend.rides.insight.table_use import (
    TableUse,
    acting,
    channels_missing,
    names_for_use,
    needs_gain,
    pieces,
    slots_by,
    table_use,
)
from backend.rides.settings_in_force import ConfigOf, Stretch, source_of, stretches
from backend.store import Store

SLOTS = 5
RULE_FIELDS = ("table", "row", "column", "label", "speed_point_kmh", "torque_rate_point")


class EnergyLedger:
    """Adds up rides. Holds nothing of them; safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, ride_id: int) -> dict[str, Any]:
        """The answer as in the API. Raises NotFound; InvalidRequest without the channels."""
        reader = self._store.rides.reader(ride_id)
        missing = channels_missing(reader.ride)
        if missing:
            raise InvalidRequest(
                f"Ride {ride_id} has no {', '.join(missing)}: who carried its motor energy is not "
                "known.",
                code="missing_channel",
            )
        parts = stretches(self._config_of, reader.ride)
        is_known = source_of(parts) == "ride"
        uses = {part.from_s: {table: TableUse.none() for table in PARAMETERS_OF} for part in parts}
        seconds, motor_ws, excluded_s = np.zeros(SLOTS), np.zeros(SLOTS), 0.0
        measured = False
        row_s, names = reader.row_seconds(), names_for_use(reader.ride)
        for start, stop, part in pieces(reader, parts):
            columns, spent_s = reader.values(names, start, stop), row_s[start:stop]
            power_w = columns.get(MOTOR_POWER.name, np.full(stop - start, np.nan))
            present = np.isfinite(power_w)
            measured |= bool(present.any())
            seconds += by_slot(columns, spent_s)
            motor_ws += by_slot(columns, np.where(present, power_w, 0.0) * spent_s)
            excluded_s += float(np.sum(spent_s[~present]))
            of_part = uses[part.from_s]
            for table in of_part if is_known else ():
                of_part[table] += use_of(columns, spent_s, part.config, table)
        total_wh = float(motor_ws.sum()) / SECONDS_PER_HOUR if measured else None
        rules = rules_by_energy(parts, uses, total_wh) if is_known else None
        return {
            "ride_id": ride_id,
            "config_source": source_of(parts),
            "motor_wh": total_wh,
            "motor_excluded_s": excluded_s,
            "modes": mode_shares(seconds, motor_ws / SECONDS_PER_HOUR, parts, total_wh),
            "rules": rules,
            "without_rule_wh": None
            if rules is None or total_wh is None
            else total_wh - sum(rule["motor_wh"] for rule in rules),
        }


def by_slot(columns: Mapping[str, Values], amounts: Values) -> Values:
    """Amounts (n,) added up by the selected mode, (SLOTS,); nobody's are left out."""
    mode = columns["assist_mode"]
    valid = np.isfinite(mode) & (mode >= 0) & (mode < SLOTS)
    added = np.bincount(mode[valid].astype(np.intp), amounts[valid], minlength=SLOTS)
    return added.astype(np.float64)


def use_of(
    columns: Mapping[str, Values], spent_s: Values, config: Mapping[str, Any], table: str
) -> TableUse:
    """What these samples add to the rules of one of the ride's own tables."""
    acts = acting(columns, slots_by(config, table), needs_gain(config))
    return table_use(
        {name: values[acts] for name, values in columns.items()},
        spent_s[acts],
        config["fuzzy_speed_points_kmh"],
        config["fuzzy_torque_rate_points"],
    )


def mode_shares(
    seconds: Values,
    motor_wh: Values,
    parts: Sequence[Stretch],
    total_wh: float | None,
) -> list[dict[str, Any]]:
    """The modes that were selected, by slot; names and laws only of a known configuration, as they
    were at the end, and no law of a mode that changed its own."""
    is_known = source_of(parts) == "ride"
    names = parts[-1].config["mode_names"]
    laws = [
        {str(part.config["mode_laws"][slot]).lower() for part in parts} for slot in range(SLOTS)
    ]
    return [
        {
            "mode": slot,
            "name": names[slot] if is_known else None,
            "law": laws[slot].pop() if is_known and len(laws[slot]) == 1 else None,
            "seconds": float(seconds[slot]),
            "motor_wh": None if total_wh is None else float(motor_wh[slot]),
            "share": share(float(motor_wh[slot]), total_wh),
        }
        for slot in range(SLOTS)
        if seconds[slot] > 0.0
    ]


def rules_by_energy(
    parts: Sequence[Stretch],
    uses: Mapping[float, Mapping[str, TableUse]],
    total_wh: float | None,
) -> list[dict[str, Any]] | None:
    """The rules that carried any energy, the most first; None where no energy is known.

    uses: of each table, by the start of each part. A cell whose rule was changed on the ride is a
    rule before and another after.
    """
    if total_wh is None:
        return None
    carried: dict[tuple[Any, ...], list[float]] = {}
    for part in parts:
        for table, use in uses[part.from_s].items():
            if use.motor_wh is None:
                continue
            labels: Sequence[Sequence[str]] = stored_json(part.config, table)["rules"]
            for row, column in np.argwhere(use.motor_wh > 0.0).tolist():
                speed = part.config["fuzzy_speed_points_kmh"][row]
                rate = part.config["fuzzy_torque_rate_points"][column]
                rule = table, row, column, labels[row][column], speed, rate
                sums = carried.setdefault(rule, [0.0, 0.0])
                sums[0] += float(use.seconds[row, column])
                sums[1] += float(use.motor_wh[row, column])
    rules = [
        {
            **dict(zip(RULE_FIELDS, rule, strict=True)),
            "seconds": seconds,
            "motor_wh": motor_wh,
            "share": share(motor_wh, total_wh),
        }
        for rule, (seconds, motor_wh) in carried.items()
    ]
    return sorted(rules, key=lambda rule: -rule["motor_wh"])


def share(part_wh: float, total_wh: float | None) -> float | None:
    """Of all motor energy, 0 to 1; None where there is none."""
    return part_wh / total_wh if total_wh else None
