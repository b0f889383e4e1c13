"""The ways to a unit, for services: what a url means, which ports there are."""

from __future__ import annotations

from backend.device.link import (
    DeviceKind,
    Opener,
    Port,
    family_of,
    is_character_device,
    kind_of,
    list_ports,
)

__all__ = [
    "DeviceKind",
    "Opener",
    "Port",
    "family_of",
    "is_character_device",
    "kind_of",
    "list_ports",
]
