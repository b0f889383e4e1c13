"""What the linter says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from backend.core.described import described


@described
class Finding:
    """code: for programs. message: for people. where: the cell, point or field; None for all.

    values: the figures of the message, by name, for translations.
    """

    code: str
    """For programs."""
    message: str
    """For people."""
    where: str | None
    """The cell, point or field; null for all."""
    values: Mapping[str, float | str] = field(default_factory=dict)
    """What the message tells, by name, for a text in another language."""


@described
class LintReport:
    """errors: cannot be written. warnings: need a reason. notes: good to know."""

    errors: tuple[Finding, ...]
    """Cannot be written."""
    warnings: tuple[Finding, ...]
    """Need a reason."""
    notes: tuple[Finding, ...]
    """Good to know."""
