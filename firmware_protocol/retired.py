"""Configurations of older units, backups and servers, as what their parameters are called now."""

from collections.abc import Mapping

from firmware_protocol._generated import PARAMETER_BY_NAME, RETIRED
from firmware_protocol.layout import Value
from firmware_protocol.parameter_values import respelled

DIGITS = 7
"""Of a converted number: what a float32 holds, so that it reads like a typed one."""


def with_words_of_today(config: Mapping[str, Value]) -> dict[str, Value]:
    """A configuration with every choice in its one spelling; nothing else is looked at."""
    return {
        name: respelled(PARAMETER_BY_NAME[name], value) if name in PARAMETER_BY_NAME else value
        for name, value in config.items()
    }


def brought_forward(config: Mapping[str, Value]) -> tuple[dict[str, Value], list[str]]:
    """A configuration without retired names, and in words what was made of each of them.

    Choices are spelled as today, which is no change and not told. A name of today that stands
    beside its retired one wins. What is no number is left out and said.
    """
    found = with_words_of_today(config)
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
