"""Bytes in and out: serial port, tcp, simulated unit, port list. The only door to pyserial."""

from backend.device.link.base import Link
from backend.device.link.opening import Opener, family_of, kind_of, open_link
from backend.device.link.ports import DeviceKind, Port, is_character_device, list_ports

__all__ = [
    "DeviceKind",
    "Link",
    "Opener",
    "Port",
    "family_of",
    "is_character_device",
    "kind_of",
    "list_ports",
    "open_link",
]
