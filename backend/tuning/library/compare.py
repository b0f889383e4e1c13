"""Any two tables or configurations side by side: presets, own items, a unit's, a revision, a draft.

Reads only; a unit that is compared is asked for its configuration and not changed.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from backend.core.fuzzy_table import PARAMETERS_OF, FuzzyTable
from backend.errors import Conflict, FieldError, InvalidRequest, NotFound
from backend.law.comparison import TableComparison, compare_tables
from backend.law.feel import Feel, feel_of
from backend.tuning.library.service import Library
from backend.tuning.service import Tuning
from backend.tuning.types import ParameterChange, differences

# Figures that are kept in memory; measuring anew takes an eighth of a second.
MEASURED_MAX = 500


@dataclass(frozen=True)
class Side:
    """What is compared: exactly one of `library` (its id), `device` and `fuzzy_table`.

    version: of an own item; revision: of the device, its newest configuration if None. table:
    `first` or `second` of a configuration.
    """

    library: str | None = None
    version: int | None = None
    device: str | None = None
    revision: int | None = None
    fuzzy_table: Mapping[str, Any] | None = None
    table: str = "first"


@dataclass(frozen=True)
class TableReview:
    """A side of the comparison. values: parameters by registry name. table: None where a partial
    configuration has none. feel: None where it was not asked for or cannot be measured, with the
    reason in `no_feel_reason`."""

    name: str
    kind: str
    values: dict[str, Any]
    table: FuzzyTable | None
    feel: Feel | None
    no_feel_reason: str | None

    @property
    def fuzzy_table(self) -> dict[str, Any] | None:
        """The table as in the API."""
        return None if self.table is None else self.table.to_json()


@dataclass(frozen=True)
class Comparison:
    """parameters: what differs, right against left; of a table beside a configuration only what the
    table has. tables: None where a side has none."""

    left: TableReview
    right: TableReview
    parameters: tuple[ParameterChange, ...]
    tables: TableComparison | None


class Compare:
    """Compares; from any thread."""

    def __init__(self, library: Library, tuning: Tuning) -> None:
        self._library = library
        self._tuning = tuning
        self._measured: dict[str, Feel] = {}

    def compare(self, left: Side, right: Side, feel: bool = False) -> Comparison:
        """Two sides. feel: measure both on the simulated bike, a fraction of a second each.

        Raises NotFound, InvalidRequest, and what reading a unit raises.
        """
        one, other = self._review(left, "left", feel), self._review(right, "right", feel)
        old, new = one.values, other.values
        if "table" in (one.kind, other.kind):
            old, new = own_names(one, left), own_names(other, right)
        changed = differences(old, new)
        tables = None
        if one.table is not None and other.table is not None:
            tables = compare_tables(one.table, other.table)
        return Comparison(one, other, changed, tables)

    def feel(self, entry_id: str) -> Feel:
        """How an entry of the library feels; measured once for what it holds.

        Raises NotFound, Conflict for what no unit takes.
        """
        document = self._library.entry(entry_id).document
        return self._feel_of(
            {name: entry["value"] for name, entry in document["parameters"].items()}
        )

    def _feel_of(self, values: Mapping[str, Any]) -> Feel:
        key = json.dumps(values, sort_keys=True)
        feel = self._measured.get(key)
        if feel is None:
            feel = feel_of(values)
            if len(self._measured) >= MEASURED_MAX:
                self._measured.clear()
            self._measured[key] = feel
        return feel

    def _review(self, side: Side, where: str, feel: bool) -> TableReview:
        name, kind, values = self._values(side, where)
        which = "first" if kind == "table" else side.table
        names = PARAMETERS_OF[which].values()
        has_table = all(parameter in values for parameter in names)
        table = FuzzyTable.from_parameters(values, which) if has_table else None
        measured, no_feel_reason = None, None
        if feel:
            # A table is ridden as the first one, whichever of a configuration's it is.
            is_first = kind == "configuration" and which == "first"
            ridden = values if is_first or table is None else table.to_parameters()
            try:
                measured = self._feel_of(ridden)
            except Conflict as error:
                no_feel_reason = error.message
        return TableReview(name, kind, values, table, measured, no_feel_reason)

    def _values(self, side: Side, where: str) -> tuple[str, str, dict[str, Any]]:
        """Name, kind and values of a side. Raises InvalidRequest unless it says just one thing."""
        chosen = [
            value for value in (side.library, side.device, side.fuzzy_table) if value is not None
        ]
        if len(chosen) != 1:
            message = f"{where} must be just one of library, device and fuzzy_table."
            raise InvalidRequest(message, fields=[FieldError(where, "not_one", message)])
        if side.library is not None:
            document = self._library.entry(side.library, side.version).document
            values = {name: entry["value"] for name, entry in document["parameters"].items()}
            return document["name"], document["format"].removeprefix("spindle-"), values
        if side.fuzzy_table is not None:
            table = FuzzyTable.from_json(side.fuzzy_table)
            return table.name, "table", table.to_parameters()
        assert side.device is not None
        if side.revision is None:
            values = dict(self._tuning.read_config(side.device).parameters)
            return side.device, "configuration", values
        for revision in self._tuning.revisions(side.device):
            if revision.seq == side.revision:
                return f"{side.device} {revision.seq}", "configuration", dict(revision.parameters)
        raise NotFound(f"{side.device} has no revision {side.revision}.")


def own_names(review: TableReview, side: Side) -> dict[str, Any]:
    """The table of a side under the names of a first one, so that two can be compared."""
    if review.table is None:
        return {name: review.values.get(name) for name in PARAMETERS_OF[side.table].values()}
    return review.table.to_parameters()
