"""A configuration, a change of it and its history, as the rest of Spindle sees them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from backend.core.unit_key import unit_tag
from backend.device.configuration import ConfigImage, Free, ParameterRow, Value
from backend.errors import ConfigConflict, OtherUnit


@dataclass(frozen=True)
class ConfigView:
    """A unit's whole configuration; parameters by registry name."""

    unit_key: str
    generation: int
    crc32: int
    parameters: dict[str, Value]


@dataclass(frozen=True, kw_only=True)
class ParameterView(ParameterRow):
    """A parameter, its value in the unit now, and its band; None: it has none."""

    value: Value
    free: Free | None


@dataclass(frozen=True)
class LastKnown:
    """A unit's configuration as it was last read from it, for reading only.

    seen_at: when the unit was last there; None if unknown. recorded_at: when the
    configuration was read.
    """

    unit_key: str
    seen_at: datetime | None
    recorded_at: datetime
    generation: int | None
    crc32: int | None
    parameters: tuple[ParameterView, ...]


@dataclass(frozen=True)
class Change:
    """One parameter that became another."""

    name: str
    old: Value
    new: Value


@dataclass(frozen=True)
class ConfigChange:
    """A change the unit took, and the whole configuration as it was read back.

    unit_key: of the unit that took it. state: `committed`; `provisional`: the unit returns to what
    it had at `expires_at` unless the change is confirmed; `needs_restart`: it holds from the unit's
    next start on. verified: read back whole and equal field by field, and nothing is left that only
    a restart can show.
    """

    unit_key: str
    generation: int
    crc32: int
    state: str
    verified: bool
    changed: tuple[Change, ...]
    expires_at: datetime | None
    parameters: dict[str, Value]

    @classmethod
    def of(
        cls,
        unit_key: str,
        config: ConfigImage,
        state: str = "committed",
        changed: tuple[Change, ...] = (),
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


def differences(old: Mapping[str, Value], new: Mapping[str, Value]) -> tuple[Change, ...]:
    """Parameters whose value differs, in the order of `old`."""
    return tuple(
        Change(name, value, new[name]) for name, value in old.items() if value != new[name]
    )
