"""What a table of a ride does not say of itself, and what its owner answered.

A table without the unit of a speed, or with times of no zone, is not read until somebody says; the
answer is kept for every file with the same header.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from backend.core.calendar import zone_of
from backend.core.described import described

ROWS_PER_SECOND_MAX = 1000.0


@described
class TableColumn:
    """One column of a table."""

    name: str
    channel: str | None = None
    """What it becomes, or `time`; null for nothing known."""
    unit: str | None = None
    """As the table says it; null where it must be said."""
    units: tuple[str, ...] = ()
    """What may be said; empty where nothing is asked."""
    samples: tuple[str, ...] = ()
    """Of the first rows."""


@dataclass(frozen=True)
class TableQuestion:
    """What must be said before a table is read.

    header_sha256: of the names of its columns; tables that share it share the answer. kind: of
    table, as people call it. time_zone, rows_per_second: whether it lacks these.
    """

    header_sha256: str
    kind: str
    time_zone: bool = False
    rows_per_second: bool = False
    columns: tuple[TableColumn, ...] = ()


@described
class TableAnswer:
    """What was said before."""

    time_zone: str | None = None
    """A name of the IANA database."""
    units: Mapping[str, str] = field(default_factory=dict)
    """By column."""
    rows_per_second: float | None = None
    """Of rows without a time."""


def question_from_json(body: Mapping[str, Any]) -> TableQuestion:
    """The inverse of `asdict`. Raises KeyError, TypeError, ValueError."""
    columns = tuple(
        TableColumn(**{**c, "units": tuple(c["units"]), "samples": tuple(c["samples"])})
        for c in body["columns"]
    )
    return TableQuestion(**{**body, "columns": columns})


def answer_from_json(body: Mapping[str, Any] | None) -> TableAnswer | None:
    """The inverse of `asdict`, from the members it has; None for none."""
    if body is None:
        return None
    rate = body.get("rows_per_second")
    zone = body.get("time_zone")
    return TableAnswer(
        None if zone is None else str(zone),
        {str(name): str(unit) for name, unit in dict(body.get("units", {})).items()},
        None if rate is None else float(rate),
    )


def answer_to_json(answer: TableAnswer) -> dict[str, object]:
    """Plain JSON."""
    return asdict(answer)


def lacking(question: TableQuestion, answer: TableAnswer | None) -> list[str]:
    """What the answer does not say, or says wrongly: `time_zone`, `rows_per_second`, columns."""
    answer = answer or TableAnswer()
    missing = []
    if question.time_zone and (answer.time_zone is None or zone_of(answer.time_zone) is None):
        missing.append("time_zone")
    rate = answer.rows_per_second
    if question.rows_per_second and not (rate is not None and 0 < rate <= ROWS_PER_SECOND_MAX):
        missing.append("rows_per_second")
    with_units = [column for column in question.columns if column.units]
    missing += [c.name for c in with_units if answer.units.get(c.name) not in c.units]
    return missing
