"""What the linter says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Finding:
    """code: for programs. message: for people. where: the cell, point or field; None for all.

    values: what the message tells, by name, for whoever says it in another language.
    """

    code: str
    message: str
    where: str | None
    values: Mapping[str, float | str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class LintReport:
    """errors: cannot be written. warnings: need a reason. notes: good to know."""

    errors: tuple[Finding, ...]
    warnings: tuple[Finding, ...]
    notes: tuple[Finding, ...]
