"""What a table of a ride does not say of itself, and what its owner answered.

A table without the unit of a speed, or with times of no zone, is not read until somebody says; the
answer is kept for every file with the same header.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from backend.core.zones import zone_of

ROWS_PER_SECOND_MAX = 1000.0


@dataclass(frozen=True)
class TableColumn:
    """One column of a table. channel: what it becomes, `time`, None for nothing known.

    unit: as the header says it or the format defines it, None where it must be said. units: what
    may be said then. samples: of the first rows.
    """

    name: str
    channel: str | None = None
    unit: str | None = None
    units: tuple[str, ...] = ()
    samples: tuple[str, ...] = ()


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


@dataclass(frozen=True)
class TableAnswer:
    """What was said. time_zone: an IANA name. units: by column. rows_per_second: of rows that
    tell no time."""

    time_zone: str | None = None
    units: Mapping[str, str] = field(default_factory=dict)
    rows_per_second: float | None = None


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
    found = []
    if question.time_zone and (answer.time_zone is None or zone_of(answer.time_zone) is None):
        found.append("time_zone")
    rate = answer.rows_per_second
    if question.rows_per_second and not (rate is not None and 0 < rate <= ROWS_PER_SECOND_MAX):
        found.append("rows_per_second")
    asked = [column for column in question.columns if column.units]
    found += [c.name for c in asked if answer.units.get(c.name) not in c.units]
    return found
