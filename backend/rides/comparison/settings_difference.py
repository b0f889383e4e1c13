"""By which settings two rides were ridden, and what differs between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from backend.core.fuzzy_table import PARAMETERS_OF, FuzzyTable
from backend.core.ride import Ride
from backend.law.comparison import cells_changed
from backend.rides.settings_in_force import ConfigOf
from backend.tuning.types import ParameterChange, differences

Part = tuple[Ride, float, float]
"""A ride, and a window of it from and to, s after its start."""


def settings_difference(config_of: ConfigOf, a: Part, b: Part) -> dict[str, Any]:
    """The configurations in force where two windows begin, as in the API, and when they
    changed within; no difference unless both are known.

    A table is among `tables` if anything of it differs and both have it whole.
    """
    sides = [config_of(ride, from_s) for ride, from_s, _ in (a, b)]
    are_known = [source == "ride" for _, source in sides]
    views = [side_of(a, are_known[0]), side_of(b, are_known[1])]
    answer: dict[str, Any] = {"a": views[0], "b": views[1], "differences": None, "tables": []}
    if all(are_known):
        old, new = (config for config, _ in sides)
        answer["differences"] = differences(old, new)
        answer["tables"] = [
            table
            for which in PARAMETERS_OF
            if (table := table_difference(old, new, which, answer["differences"]))
        ]
    return answer


def side_of(part: Part, is_known: bool) -> dict[str, Any]:
    """Whose configuration it is, or why it is unknown."""
    ride, from_s, to_s = part
    spans, why = ride.settings_spans(), None
    in_force = [crc32 for since_s, crc32 in spans if since_s <= from_s]
    if not is_known:
        why = "not_told" if in_force[-1] is None else "not_kept"
        if why == "not_told" and ride.origin == "imported":
            why = "imported"
    return {
        "is_known": is_known,
        "why": why,
        "unit_key": ride.context.unit_key,
        "generation": ride.context.config_generation if len(in_force) == 1 else None,
        "changed_at_s": [since_s for since_s, _ in spans if from_s < since_s <= to_s],
    }


def table_difference(
    old: Mapping[str, Any], new: Mapping[str, Any], which: str, changed: Sequence[ParameterChange]
) -> dict[str, Any] | None:
    """One of the two tables of both sides with the rules that differ; None if nothing does."""
    names = set(PARAMETERS_OF[which].values())
    if not names & {one.name for one in changed} or not names <= old.keys() & new.keys():
        return None
    left, right = (FuzzyTable.from_parameters(side, which) for side in (old, new))
    return {
        "which": which,
        "left": left.to_json(),
        "right": right.to_json(),
        "cells": cells_changed(left, right),
    }
