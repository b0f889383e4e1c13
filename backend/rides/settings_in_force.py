"""Which configuration a unit had at each moment of a ride: one after the other, never two."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from backend.core.ride import Ride
from backend.core.ride_events import SETTINGS, RideEvent
from backend.errors import InvalidRequest
from backend.store import RideReader

Config = Mapping[str, Any]


class ConfigOf(Protocol):
    """The configuration of a ride at a moment, s after its start, and where it is from: `ride`, or
    `defaults` where nobody kept it."""

    def __call__(self, ride: Ride, t_s: float = 0.0) -> tuple[Config, str]:
        """See the class."""


@dataclass(frozen=True)
class Stretch:
    """From from_s to before to_s, None for the ride's end. source: as of `ConfigOf`."""

    from_s: float
    to_s: float | None
    config: Config
    source: str

    def rows(self, reader: RideReader) -> tuple[int, int]:
        """Its rows [start, stop)."""
        start = first_row(reader, self.from_s) if self.from_s else 0
        return start, reader.row_count if self.to_s is None else first_row(reader, self.to_s)


def first_row(reader: RideReader, t_s: float) -> int:
    """The first row that is not before a moment."""
    return int(np.searchsorted(reader.times_us(0, reader.row_count), round(t_s * 1e6)))


def stretches(config_of: ConfigOf, ride: Ride) -> list[Stretch]:
    """The ride by its configurations; at least one."""
    starts = [from_s for from_s, _ in ride.settings_spans()]
    ends = [*starts[1:], None]
    return [
        Stretch(from_s, to_s, *config_of(ride, from_s))
        for from_s, to_s in zip(starts, ends, strict=True)
        if from_s != to_s
    ]


def source_of(parts: Sequence[Stretch]) -> str:
    """Where all of it is from: `defaults` where any part of it is."""
    return "ride" if all(part.source == "ride" for part in parts) else "defaults"


def shared(parts: Sequence[Stretch]) -> Config:
    """What a ride's configurations agree on; nothing where one of them is not known."""
    if source_of(parts) != "ride":
        return {}
    first, *others = (part.config for part in parts)
    return {
        name: value
        for name, value in first.items()
        if all(name in other and other[name] == value for other in others)
    }


def all_through(config_of: ConfigOf, ride: Ride) -> tuple[Config, str]:
    """What was so on the whole ride, and where it is from."""
    parts = stretches(config_of, ride)
    return shared(parts), source_of(parts)


def unchanged(config_of: ConfigOf, ride: Ride) -> tuple[Config, str]:
    """The one configuration of a ride, and where it is from; what things are called may change.

    Raises InvalidRequest `settings_changed` where there were several.
    """
    first, *later = stretches(config_of, ride)
    for part in later:
        if any(
            part.config.get(name) != value
            for name, value in first.config.items()
            if not name.endswith(("_name", "_names"))
        ):
            raise InvalidRequest(
                f"Ride {ride.id} cannot be ridden again: its settings were changed at"
                f" {part.from_s:.0f} s, and a twin has one set of them. Choose a ride without a"
                " change, or replay this one.",
                code="settings_changed",
            )
    return first.config, first.source


@dataclass
class SettingsInForce:
    """The newest of a ride that is recorded. crc32: of its image, None while it is unknown."""

    crc32: int | None = None
    since_s: float = 0.0

    def change(self, t_s: float, crc32: int) -> RideEvent | None:
        """The event of a configuration that is in force from t_s on; None where nothing changed.

        What comes late has its own time; what is first known was so from the start.
        """
        if self.crc32 is None:
            t_s = 0.0
        elif t_s < 0.0 or (t_s >= self.since_s and crc32 == self.crc32):
            return None
        if t_s >= self.since_s:
            self.crc32, self.since_s = crc32, t_s
        return RideEvent(t_s, SETTINGS, crc32)
