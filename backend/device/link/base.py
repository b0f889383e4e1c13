"""What every transport offers: bytes that have arrived, bytes to send, an end.

Nothing here waits: one thread per port reads late and in bulk, so a link that
blocked would hold up the thread's timers.
"""

from __future__ import annotations

from typing import Protocol

# One read takes at most this much: 5 s of a full line at 115200 baud, so a thread that was held up
# catches up in a few reads while its memory stays bounded.
READ_BYTES_MAX = 65536


class Link(Protocol):
    """An open connection to one drive unit.

    url: what it was opened with. bits_per_second: the line's rate now, or None where there is no
    line (pseudo-terminal, tcp) and a frame's travel time is nothing. bits_per_second_requested: the
    rate to ask the unit for, None for the fastest it offers.
    """

    @property
    def url(self) -> str: ...

    @property
    def bits_per_second(self) -> float | None: ...

    @property
    def bits_per_second_requested(self) -> int | None: ...

    def set_baudrate(self, bits_per_second: int) -> None:
        """Run the line at this rate from now on. Raises LinkError when the port cannot."""
        ...

    def read(self, bytes_max: int = READ_BYTES_MAX) -> bytes:
        """Return what has arrived, b"" when nothing has. Raises LinkError when the way is gone."""
        ...

    def write(self, data: bytes) -> int:
        """Send what fits now and return how many bytes that was. Raises LinkError when gone."""
        ...

    def close(self) -> None:
        """Give the port back. Closing twice is allowed; reading or writing afterwards is not."""
        ...
