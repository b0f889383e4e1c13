"""A unit behind a TCP port, `socket://host:port`: a serial server, a bridge, a simulated unit."""

from __future__ import annotations

import socket

from backend.device.link.base import READ_BYTES_MAX
from backend.device.link.port_errors import cannot_open, vanished

# A host that does not answer must not hold up the unit's thread for longer.
CONNECT_TIMEOUT_S = 2.0


class SocketLink:
    """An open TCP connection to a unit. Raises LinkError with cause and remedy when it fails."""

    def __init__(self, host: str, port: int, url: str | None = None) -> None:
        self._url = url or f"socket://{host}:{port}"
        try:
            self._socket = socket.create_connection((host, port), timeout=CONNECT_TIMEOUT_S)
        except OSError as error:
            raise cannot_open(self._url, error) from error
        self._socket.setblocking(False)
        # A request is one small packet; collecting it with the next would cost 40 ms each.
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    @property
    def url(self) -> str:
        """What the connection was opened with."""
        return self._url

    @property
    def bits_per_second(self) -> float | None:
        """None: no serial line limits the speed here."""
        return None

    @property
    def bits_per_second_requested(self) -> int | None:
        """None: there is nothing to ask for."""
        return None

    def set_baudrate(self, bits_per_second: int) -> None:
        """Nothing: the rate belongs to whoever holds the serial line behind the socket."""

    def read(self, bytes_max: int = READ_BYTES_MAX) -> bytes:
        """Return what has arrived, at most `bytes_max`; b"" when nothing has."""
        try:
            data = self._socket.recv(bytes_max)
        except BlockingIOError:
            return b""
        except OSError as error:
            raise vanished(self._url, error) from error
        if not data:
            raise vanished(self._url, "the other side closed the connection")
        return data

    def write(self, data: bytes) -> int:
        """Send what the socket takes now and return how many bytes that was."""
        try:
            return self._socket.send(data)
        except BlockingIOError:
            return 0
        except OSError as error:
            raise vanished(self._url, error) from error

    def close(self) -> None:
        """End the connection; twice is allowed."""
        self._socket.close()
