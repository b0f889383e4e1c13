"""A sighting: when and over which connection a unit was last there, and who it said it was."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from backend.core.moments import utc


@dataclass(frozen=True)
class Sighting:
    """url: of the connection. unit_key: as of domain.unit_key. seen_us: Unix time."""

    url: str
    unit_key: str
    seen_us: int
    serial_number: str | None = None
    name: str | None = None
    model: str | None = None
    firmware_version: str | None = None

    @property
    def seen_at(self) -> datetime:
        """`seen_us` as a moment in UTC."""
        return utc(self.seen_us)
