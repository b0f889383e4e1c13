"""A configuration, a change of it and its history, as the rest of Spindle sees them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any, Literal, TypeAlias

from backend.core.described import described
from backend.core.unit_key import unit_tag
from backend.device.configuration import ConfigImage, Free, ParameterRow, Value
from backend.errors import ConfigConflict, OtherUnit

ChangeState: TypeAlias = Literal["committed", "provisional", "needs_restart"]


@described
class Config:
    """A unit's whole configuration; parameters by registry name."""

    unit_key: str
    """Of the unit that has it."""
    generation: int
    crc32: int
    parameters: Mapping[str, Value]


@described
class Parameter(ParameterRow):
    """What a parameter is, and its value in the unit now.

    `min`, `max` and `choices` are the unit's own bounds. Choices are in lower case, but for the
    labels of rules, NB NS ZO PS PB; they are taken in any case. `may_be_none`: `null` is a value, a
    correction that is not known. `of_the_unit`: measured or set for this one unit and its bike, as
    the sensor's calibration and the wheel, so no part of a set-up for another one.
    """

    value: Value = field(kw_only=True)
    free: Free | None = field(kw_only=True)
    """Only of parameters that are held near the factory's value."""


@described
class LastKnown:
    """What a unit was last known to be set to. Nothing can be written on it: it has no ETag."""

    unit_key: str
    seen_at: datetime | None
    """When the unit was last there."""
    recorded_at: datetime
    """When this configuration was read from it."""
    generation: int | None
    crc32: int | None
    parameters: tuple[Parameter, ...]


@described
class ParameterChange:
    """One parameter that became another."""

    name: str
    old: Value
    new: Value


@described
class TrialValues:
    """What is on trial over the configuration, in the unit's memory alone; null where nothing is.

    parameters: those that differ from the configuration, with the value in force.
    """

    parameters: Mapping[str, Value]
    remaining_s: float | None
    expires_at: datetime | None


@described
class ConfigChange:
    """A change that the unit took, read back and compared field by field."""

    unit_key: str
    """Of the unit that took it."""
    generation: int
    crc32: int
    state: ChangeState
    """`provisional`: given up at `expires_at` unless it is confirmed. `needs_restart`: holds from
    the unit's next start on."""
    verified: bool
    """Whether the last comparison that this make of unit allows was made."""
    changed: tuple[ParameterChange, ...]
    expires_at: datetime | None
    parameters: Mapping[str, Value]
    """The whole configuration as it was read back."""

    @classmethod
    def of(
        cls,
        unit_key: str,
        config: ConfigImage,
        state: ChangeState = "committed",
        changed: tuple[ParameterChange, ...] = (),
        expires_at: datetime | None = None,
    ) -> ConfigChange:
        """A change after which the unit has `config`."""
        verified = state != "needs_restart"
        return cls(
            unit_key,
            config.generation,
            config.crc32,
            state,
            verified,
            changed,
            expires_at,
            config.parameters,
        )


@dataclass(frozen=True)
class TypedView:
    """A part of the configuration in the shape people edit, and which configuration it is of."""

    unit_key: str
    generation: int
    crc32: int
    value: dict[str, Any]


# Entity tags of a list, a weak one with its mark. A comma may stand inside the quotes.
ENTITY_TAGS = re.compile(r'[^\s,"]*"[^"]*"')
TAGS_OF_UNITS = re.compile(r"\d+-[0-9a-f]{8}-[0-9a-f]{8}")


def etag(unit_key: str, generation: int, crc32: int) -> str:
    """Names one configuration of one unit: another one at every commit, content and unit."""
    return f'"{generation}-{crc32:08x}-{unit_tag(unit_key)}"'


def check_base(unit_key: str, config: ConfigImage, if_match: str | None) -> None:
    """Raise OtherUnit when the change was made for another unit, ConfigConflict when for another
    configuration of this one.

    if_match: an ETag or several as HTTP writes them, `*` or None for any. One that is marked weak
    never matches, as for every method that changes something (RFC 9110, 13.1.1).
    """
    current = etag(unit_key, config.generation, config.crc32)
    if is_match(current, if_match):
        return
    units = {tag.strip('"').split("-")[2] for tag in TAGS_OF_UNITS.findall(if_match or "")}
    if units and unit_tag(unit_key) not in units:
        raise OtherUnit(
            f"The change was made for another unit than {unit_key}, which is on this connection "
            "now: nothing was changed. Connect the unit it was made for, or look at this one first."
        )
    raise ConfigConflict(
        f"The change was made for configuration {if_match}, but the unit has {current} now: "
        "somebody else changed it. Read it again, look at the difference, and write once more."
    )


def is_match(current: str, if_match: str | None) -> bool:
    """Whether a request that is meant for `if_match` is meant for what is there.

    current: its ETag. if_match: as of `check_base`.
    """
    if if_match is None or if_match.strip() == "*":
        return True
    return current in ENTITY_TAGS.findall(if_match) or if_match.strip() == current.strip('"')


def differences(old: Mapping[str, Value], new: Mapping[str, Value]) -> tuple[ParameterChange, ...]:
    """What differs between two sets of parameters by name, in the order of the first.

    None stands for a value where a set has no such parameter.
    """
    names = [*old, *(name for name in new if name not in old)]
    return tuple(
        ParameterChange(name, old.get(name), new.get(name))
        for name in names
        if old.get(name) != new.get(name)
    )
