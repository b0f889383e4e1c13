"""A file that is taken away piece by piece while it is written: what a download is made into."""

from __future__ import annotations

from io import RawIOBase
from typing import Any


class Pipe(RawIOBase):
    """Bytes that wait to be taken; it cannot go back."""

    def __init__(self) -> None:
        self._waiting = bytearray()
        self._at = 0

    def writable(self) -> bool:
        return True

    def write(self, data: Any) -> int:
        self._waiting += data
        self._at += len(data)
        return len(data)

    def tell(self) -> int:
        """How much was written in all."""
        return self._at

    def taken(self) -> bytes:
        """All that was written since the last call."""
        piece, self._waiting = bytes(self._waiting), bytearray()
        return piece
