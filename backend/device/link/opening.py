"""From a url to an open link: which transport, and how to find the same adapter again.

- `sim`, `sim:NAME?seed=&speed=&scenario=&flash=`: a simulated unit as a child process.
- `socket://host:port`: a unit behind TCP.
- `/dev/ttyUSB0`, `COM3`, any other path: a serial port. It opens at 115200 bit/s and then asks the
  unit for the fastest rate both have; `?baud=115200` stays, `?baud=921600` asks for that one.

`?family=` of any of these names the make of the unit, where it is not our own.

A pseudo-terminal and TCP have no rate, unless `?baud=` says that what is behind them has one.
"""

from __future__ import annotations

import threading
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

from backend.device.link.base import Link
from backend.device.link.port_errors import another_adapter
from backend.device.link.ports import (
    DeviceKind,
    device_with_usb_serial,
    is_character_device,
    usb_serial_of,
)
from backend.device.link.serial_port import SerialPort, baud_of
from backend.device.link.simulated import SimulatedAddress, SimulatedLink
from backend.device.link.socket_link import SocketLink
from backend.errors import InvalidRequest


def open_link(url: str) -> Link:
    """Open the way to a unit. Raises InvalidRequest for a bad url, LinkError when it fails."""
    return Opener(url).open()


def kind_of(url: str) -> DeviceKind:
    """`simulated`, `socket` or `serial`. Raises InvalidRequest when the url is none of them."""
    if url == "sim" or url.startswith(("sim:", "sim?")):
        SimulatedAddress.parse(url)
        return "simulated"
    if url.startswith("socket://"):
        _host_and_port(url)
        return "socket"
    if "://" in url or not url.strip():
        raise InvalidRequest(
            f"`{url}` is no way to a unit; write `sim`, a serial port such as /dev/ttyUSB0 or "
            "COM3, or socket://host:port."
        )
    name, _ = _name_and_baud(url)
    if is_character_device(name) is False:
        raise InvalidRequest(f"{name} is no serial port: a port is a device such as /dev/ttyUSB0.")
    return "serial"


def family_of(url: str, default: str) -> str:
    """The make of the unit behind a url: `?family=`, or `default`."""
    return parse_qs(url.partition("?")[2]).get("family", [default])[-1]


class Opener:
    """Opens one url again and again, and finds a USB adapter that came back under another name.

    flash_folder: where simulated units keep their configuration, None for nowhere.
    """

    def __init__(self, url: str, flash_folder: Path | None = None) -> None:
        self.url = url
        self._flash_folder = flash_folder
        self._kind = kind_of(url)
        self._usb_serial_number: str | None = None
        self._cancelled = threading.Event()

    def give_up(self) -> None:
        """Let an `open` that waits for a simulated unit's start fail soon; for any thread."""
        self._cancelled.set()

    def open(self) -> Link:
        """Open the link; raises LinkError with cause and remedy."""
        if self._kind == "simulated":
            return SimulatedLink(self.url, self._flash_folder, cancelled=self._cancelled)
        if self._kind == "socket":
            host, port = _host_and_port(self.url)
            return SocketLink(host, port, url=self.url)
        name, baud = _name_and_baud(self.url)
        link = SerialPort(
            self._present_name(name),
            self.url,
            has_line=baud is not None or not _is_pseudo_terminal(name),
            requested=baud,
        )
        if self._usb_serial_number is None:
            self._usb_serial_number = usb_serial_of(name)
        return link

    def _present_name(self, name: str) -> str:
        """Where the adapter is now. Raises LinkError when its name belongs to another adapter."""
        if self._usb_serial_number is None:
            return name
        present = device_with_usb_serial(self._usb_serial_number)
        if present is None and usb_serial_of(name) not in (None, self._usb_serial_number):
            raise another_adapter(name, self._usb_serial_number)
        return present or name


def _host_and_port(url: str) -> tuple[str, int]:
    try:
        parts = urlsplit(url)
        host, port = parts.hostname or "", parts.port
        # Names that no name server can be asked for: too long, or with an empty part.
        host.encode("idna")
    except ValueError:
        host, port = "", None
    if not host or not port:
        raise InvalidRequest(f"`{url}`: write socket://host:port with a port from 1 to 65535.")
    return host, port


def _name_and_baud(url: str) -> tuple[str, int | None]:
    name, _, query = url.partition("?")
    baud = parse_qs(query).get("baud", [None])[-1]
    return name, None if baud is None else baud_of(url, baud)


def _is_pseudo_terminal(name: str) -> bool:
    return str(Path(name).resolve()).startswith("/dev/pts/")
