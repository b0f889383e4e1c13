"""A serial port through pyserial: exclusive, control lines low, read in bulk, never waiting."""

from __future__ import annotations

import os

import serial

from backend.device.link.base import READ_BYTES_MAX
from backend.device.link.port_errors import cannot_open, vanished
from backend.errors import InvalidRequest, LinkError

BAUD_DEFAULT = 115200
BAUD_MIN, BAUD_MAX = 300, 4_000_000

# Where the driver cannot write without waiting (Windows), one write waits at most this long.
WRITE_TIMEOUT_S = 0.2


def baud_of(url: str, text: str) -> int:
    """A rate as it stands in `url`; raises InvalidRequest for what is none."""
    if not text.isdigit() or not BAUD_MIN <= int(text) <= BAUD_MAX:
        raise InvalidRequest(f"`{url}`: baud is a whole number from {BAUD_MIN} to {BAUD_MAX}.")
    return int(text)


class SerialPort:
    """An open serial port or pseudo-terminal.

    name: `/dev/ttyUSB0`, `COM3`, or a pseudo-terminal's path. has_line: False where no wire limits
    the speed. requested: the rate to ask the unit for, None for its fastest; the port opens
    at 115200, where every unit starts. Raises LinkError with cause and remedy when it does not
    open.
    """

    def __init__(
        self, name: str, url: str | None = None, has_line: bool = True, requested: int | None = None
    ) -> None:
        self._name = name
        self._url = url or name
        self._bits_per_second = float(BAUD_DEFAULT) if has_line else None
        self._requested = requested
        self._port = serial.Serial()
        self._port.port = name
        self._port.baudrate = BAUD_DEFAULT
        self._port.timeout = 0
        self._port.write_timeout = WRITE_TIMEOUT_S
        self._port.exclusive = True
        # Many adapters wire DTR or RTS to the unit's reset; opening the port must not restart it.
        self._port.dtr = False
        self._port.rts = False
        try:
            self._port.open()
        except OSError as error:
            raise cannot_open(name, error) from error
        self._descriptor = self._port.fileno() if os.name == "posix" else None

    @property
    def url(self) -> str:
        """What the port was opened with."""
        return self._url

    @property
    def bits_per_second(self) -> float | None:
        """The line's rate now, None for a pseudo-terminal without one."""
        return self._bits_per_second

    @property
    def bits_per_second_requested(self) -> int | None:
        """The rate to ask the unit for, None for the fastest it offers."""
        return self._requested

    def set_baudrate(self, bits_per_second: int) -> None:
        """Run the line at this rate from now on. Raises LinkError when the port cannot."""
        try:
            self._port.baudrate = bits_per_second
        except (OSError, ValueError) as error:
            raise LinkError(
                f"{self._name} does not run at {bits_per_second} baud ({error}); it stays slower."
            ) from error
        if self._bits_per_second is not None:
            self._bits_per_second = float(bits_per_second)

    def read(self, bytes_max: int = READ_BYTES_MAX) -> bytes:
        """Return what has arrived, at most `bytes_max`; b"" when nothing has."""
        try:
            return bytes(self._port.read(bytes_max))
        except (OSError, TypeError) as error:
            # Without a number it is pyserial's guess about a port that is readable and empty.
            has_errno = getattr(error, "errno", None) is not None
            raise vanished(
                self._name, error if has_errno else "unplugged or without power"
            ) from error

    def write(self, data: bytes) -> int:
        """Send what the port takes now and return how many bytes that was."""
        try:
            if self._descriptor is not None:
                # pyserial 3.5 spins on a full buffer when told not to wait, so write ourselves.
                return os.write(self._descriptor, data)
            return int(self._port.write(data) or 0)
        except (BlockingIOError, serial.SerialTimeoutException):
            return 0
        except OSError as error:
            raise vanished(self._name, error) from error

    def close(self) -> None:
        """Give the port back; twice is allowed."""
        self._descriptor = None
        self._port.close()
