"""By which settings two rides were ridden, and what differs between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from backend.control.comparison import cells_changed
from backend.domain.fuzzy_table import PARAMETERS_OF, FuzzyTable
from backend.domain.ride import Ride
from backend.services.rides.replay import ConfigOf
from backend.services.tuning.compare import Difference, differences


def settings_apart(config_of: ConfigOf, a: Ride, b: Ride) -> dict[str, Any]:
    """The configurations of two rides as the API tells them; no difference unless both are known.

    A table is among `tables` if anything of it differs and both have it whole.
    """
    sides = [config_of(ride) for ride in (a, b)]
    told = [
        side_of(ride, source == "ride") for ride, (_, source) in zip((a, b), sides, strict=True)
    ]
    answer: dict[str, Any] = {"a": told[0], "b": told[1], "differences": None, "tables": []}
    if all(side["known"] for side in told):
        old, new = (
            {name: of_today(name, value) for name, value in config.items()} for config, _ in sides
        )
        answer["differences"] = differences(old, new)
        answer["tables"] = [
            table
            for which in PARAMETERS_OF
            if (table := tables_apart(old, new, which, answer["differences"]))
        ]
    return answer


def side_of(ride: Ride, known: bool) -> dict[str, Any]:
    """Whose configuration it is, or why nobody knows it."""
    why = None
    if not known:
        why = "not_kept" if ride.context.config_crc32 is not None else "not_told"
        if why == "not_told" and ride.origin == "imported":
            why = "imported"
    return {
        "known": known,
        "why": why,
        "unit_key": ride.context.unit_key,
        "generation": ride.context.config_generation,
    }


def of_today(name: str, value: Any) -> Any:
    """A parameter with its choices as they are spelled today; versions up to 0.2 kept them in
    capital letters. Names and the labels of rules stay as they are."""
    if name.endswith(("_name", "_names", "_rules")):
        return value
    if isinstance(value, list | tuple):
        return [of_today(name, one) for one in value]
    return value.lower() if isinstance(value, str) else value


def tables_apart(
    old: Mapping[str, Any], new: Mapping[str, Any], which: str, changed: Sequence[Difference]
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
