"""What a table of a ride does not say of itself, and what its owner answered.

A table without the unit of a speed, with times of no zone, dates that may be read two ways or a
power that may be the rider's or the battery's is not read until somebody answers; the answer is
kept for every file with the same header. An owner can also state what any other column is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

from backend.core.calendar import zone_of
from backend.core.described import described

ROWS_PER_SECOND_MAX = 1000.0
DATE_ORDERS = ("day_first", "month_first")
TIME = "time"
LEFT_OUT = ""
"""The answer for a column that is to be no channel of ours; its numbers stay under its own name."""


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
    """Of the first rows; of a column that cannot be read, of what stands there."""
    channels: tuple[str, ...] = ()
    """What it may be where that must be stated, `""` to leave it out; empty: nothing is asked."""
    unread: int = 0
    """Cells that hold something that is no number."""


@described
class OfferedChannel:
    """What an owner can say that a column is."""

    name: str
    unit: str
    units: tuple[str, ...] = ()
    """In which its numbers may be, where that is never taken for granted."""


@dataclass(frozen=True)
class TableQuestion:
    """What can be said of a table, and what must be before it is read.

    header_sha256: of the names of its columns; tables that share it share the answer. kind: of
    table, as people call it. time_zone, rows_per_second, date_order: whether it lacks these.
    """

    header_sha256: str
    kind: str
    time_zone: bool = False
    rows_per_second: bool = False
    date_order: bool = False
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
    date_order: Literal["day_first", "month_first"] | None = None
    """How 03/04 is read: 3 April or 4 March."""
    channels: Mapping[str, str] = field(default_factory=dict)
    """By column, what it is; `""` for none of ours."""


LISTS = ("units", "samples", "channels")


def question_from_json(body: Mapping[str, Any]) -> TableQuestion:
    """The inverse of `asdict`. Raises KeyError, TypeError, ValueError."""
    columns = tuple(
        TableColumn(**{**c, **{name: tuple(c.get(name, ())) for name in LISTS}})
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
        body.get("date_order"),
        {str(name): str(channel) for name, channel in dict(body.get("channels", {})).items()},
    )


def answer_to_json(answer: TableAnswer) -> dict[str, object]:
    """Plain JSON."""
    return asdict(answer)


def lacking(question: TableQuestion, answer: TableAnswer | None) -> list[str]:
    """What the answer does not state, or states wrongly: `time_zone`, `rows_per_second`,
    `date_order`, columns."""
    answer = answer or TableAnswer()
    missing = []
    if question.time_zone and (answer.time_zone is None or zone_of(answer.time_zone) is None):
        missing.append("time_zone")
    rate = answer.rows_per_second
    if question.rows_per_second and not (rate is not None and 0 < rate <= ROWS_PER_SECOND_MAX):
        missing.append("rows_per_second")
    if question.date_order and answer.date_order not in DATE_ORDERS:
        missing.append("date_order")
    missing += [c.name for c in question.columns if c.channels and c.name not in answer.channels]
    # What is something else by its owner's word has other units.
    as_asked = [c for c in question.columns if answer.channels.get(c.name, c.channel) == c.channel]
    missing += [c.name for c in as_asked if c.units and answer.units.get(c.name) not in c.units]
    return list(dict.fromkeys(missing))
