"""A link in memory: passes the same contract tests as the real ones (unit/link/test_link_contract).

The far end is in the test's hand: what arrived, what is sent, when the port vanishes.
"""

from __future__ import annotations

from backend.errors import LinkError

# Like a kernel's serial buffer: a writer that is never read must notice.
BUFFER_BYTES = 65536


class MemoryLink:
    """A `Link` whose other end is the attributes `arrived` and `vanish`, `say`."""

    def __init__(self, url: str = "memory", bits_per_second: float | None = None) -> None:
        self.url = url
        self.bits_per_second = bits_per_second
        self.bits_per_second_requested: int | None = None
        self.arrived = bytearray()  # what the host wrote
        self.closed = False
        self._coming = bytearray()
        self._gone = False

    def say(self, data: bytes) -> None:
        """Send bytes towards the host."""
        self._coming += data

    def heard(self) -> bytes:
        """Take what the host has written."""
        data = bytes(self.arrived)
        self.arrived.clear()
        return data

    def vanish(self) -> None:
        """Pull the cable."""
        self._gone = True

    def set_baudrate(self, bits_per_second: int) -> None:
        self.bits_per_second = float(bits_per_second)

    def read(self, bytes_max: int = 65536) -> bytes:
        self._check()
        data = bytes(self._coming[:bytes_max])
        del self._coming[:bytes_max]
        return data

    def write(self, data: bytes) -> int:
        self._check()
        taken = data[: BUFFER_BYTES - len(self.arrived)]
        self.arrived += taken
        return len(taken)

    def close(self) -> None:
        self.closed = True

    def _check(self) -> None:
        assert not self.closed, "a closed link is not used"
        if self._gone:
            raise LinkError(f"{self.url}: the port vanished.")
