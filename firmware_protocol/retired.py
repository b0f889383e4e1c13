"""Configurations of older units, backups and servers, as what their parameters are called now."""

from collections.abc import Mapping

from firmware_protocol._generated import RETIRED
from firmware_protocol.layout import Value

DIGITS = 7
"""Of a converted number: what a float32 holds, so that it reads like a typed one."""


def brought_forward(config: Mapping[str, Value]) -> tuple[dict[str, Value], list[str]]:
    """A configuration without retired names, and in words what was made of each of them.

    A name of today that stands beside its retired one wins. What is no number is left out and said.
    """
    found = {**config}
    notes = []
    for row in RETIRED:
        if row.name not in found:
            continue
        value = found.pop(row.name)
        if row.becomes in found:
            continue
        if isinstance(value, bool) or not isinstance(value, int | float):
            notes.append(f"{row.name} {value!r} is no number; {row.becomes} is left out.")
            continue
        found[row.becomes] = float(f"{value * row.factor:.{DIGITS}g}")
        notes.append(
            f"{row.name} {value:g} is {row.becomes} {found[row.becomes]:g} now"
            f" (times {row.factor:.6g})."
        )
    return found, notes
