"""Bytes in and out: serial port, tcp, simulated unit, port list. The only door to pyserial."""

from backend.link.base import Link
from backend.link.opening import Opener, kind_of, open_link
from backend.link.ports import PortInfo, list_ports

__all__ = ["Link", "Opener", "PortInfo", "kind_of", "list_ports", "open_link"]
