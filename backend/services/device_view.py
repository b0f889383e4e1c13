"""A device as the rest of Spindle sees it; mirrors the device JSON of the API."""

from __future__ import annotations

from dataclasses import dataclass

from backend.device.identity import Identity


@dataclass(frozen=True)
class ConfigStamp:
    """Which configuration a unit has: its generation and the CRC-32 of its image."""

    generation: int
    crc32: int


@dataclass(frozen=True)
class FaultView:
    """An active fault and what to do about it."""

    name: str
    description: str


@dataclass(frozen=True)
class DeviceView:
    """One device at one moment.

    id: stable as long as the device is here. kind: simulated, serial or socket. state: connecting,
    ready, read_only, lost or closed. reason: a sentence for people. identity: the last one known.
    link: counters of LinkStatistics by name.
    """

    id: str
    url: str
    kind: str
    state: str
    reason: str
    identity: Identity | None
    config: ConfigStamp | None
    link: dict[str, float | None]
    faults_active: tuple[str, ...]
