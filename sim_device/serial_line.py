"""Where a host reaches the simulated unit: a pseudo-terminal or a TCP port.

Both are read and written without waiting. A host may come and go; the unit stays.
"""

import contextlib
import os
import re
import socket
import termios
import tty
from collections.abc import Iterator
from pathlib import Path
from typing import Protocol

READ_LENGTH = 4096


class SerialLine(Protocol):
    """The unit's end of the line."""

    @property
    def address(self) -> str:
        """What a host opens."""

    def read(self) -> bytes:
        """Bytes from the host; b"" when there are none."""

    def write(self, data: bytes) -> int:
        """Bytes to the host; returns how many were taken."""

    def host_baud(self) -> int | None:
        """The rate the host has set its end to, None where that cannot be seen."""

    def close(self) -> None:
        """Leaves nothing behind."""


# B115200 -> 115200, and so on for every rate this system has a name for.
_SPEEDS = {
    value: int(name[1:])
    for name, value in vars(termios).items()
    if re.fullmatch("B[1-9][0-9]*", name)
}
_OUTPUT_SPEED = 5


class PtyLine:
    """A pseudo-terminal behind a symbolic link.

    Raises FileExistsError if `link` is something other than a symbolic link.
    """

    def __init__(self, link: Path) -> None:
        _check_link(link)
        # The far end stays open here too: otherwise the line would fail while no host has it open.
        self._near, self._far = os.openpty()
        tty.setraw(self._far)
        os.set_blocking(self._near, False)
        self._device = os.ttyname(self._far)
        self._link = link
        _make_link(link, self._device)

    @property
    def address(self) -> str:
        return str(self._link)

    def read(self) -> bytes:
        try:
            return os.read(self._near, READ_LENGTH)
        except BlockingIOError:
            return b""

    def write(self, data: bytes) -> int:
        try:
            return os.write(self._near, data)
        except BlockingIOError:
            return 0

    def host_baud(self) -> int | None:
        # Both ends of a pseudo-terminal share one set of settings.
        return _SPEEDS.get(termios.tcgetattr(self._near)[_OUTPUT_SPEED])

    def close(self) -> None:
        _remove_link(self._link, self._device)
        os.close(self._near)
        os.close(self._far)


@contextlib.contextmanager
def linked(link: Path, device: str) -> Iterator[None]:
    """A symbolic link to a device that is there already, for as long as the context lasts.

    Raises FileExistsError if `link` is something other than a symbolic link.
    """
    _check_link(link)
    _make_link(link, device)
    try:
        yield
    finally:
        _remove_link(link, device)


def _check_link(link: Path) -> None:
    if link.exists() and not link.is_symlink():
        raise FileExistsError(f"{link} exists and is not a symbolic link; choose another path")


def _make_link(link: Path, device: str) -> None:
    fresh = link.with_name(f"{link.name}.{os.getpid()}")
    fresh.symlink_to(device)
    fresh.replace(link)


def _remove_link(link: Path, device: str) -> None:
    with contextlib.suppress(OSError):
        if str(link.readlink()) == device:
            link.unlink()


class TcpLine:
    """A listening socket for one host at a time; a second one is turned away at once.

    Raises OSError if the port is taken.
    """

    def __init__(self, host: str, port: int) -> None:
        self._listener = socket.create_server((host, port))
        self._listener.setblocking(False)
        self._host: socket.socket | None = None

    @property
    def address(self) -> str:
        """The port: asked for as 0, it is known only now."""
        return str(self._listener.getsockname()[1])

    def read(self) -> bytes:
        # First the host that may have left, then the one that may wait for its place.
        data = self._receive()
        self._accept()
        return data

    def _receive(self) -> bytes:
        if self._host is None:
            return b""
        try:
            data = self._host.recv(READ_LENGTH)
        except BlockingIOError:
            return b""
        except OSError:
            data = b""
        if not data:
            self._drop()
        return data

    def write(self, data: bytes) -> int:
        if self._host is None:
            return 0
        try:
            return self._host.send(data)
        except BlockingIOError:
            return 0
        except OSError:
            self._drop()
            return 0

    def host_baud(self) -> int | None:
        return None

    def close(self) -> None:
        self._drop()
        self._listener.close()

    def _accept(self) -> None:
        try:
            arrived, _ = self._listener.accept()
        except OSError:
            return
        if self._host is not None:
            arrived.close()
            return
        arrived.setblocking(False)
        arrived.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._host = arrived

    def _drop(self) -> None:
        if self._host is not None:
            self._host.close()
            self._host = None
