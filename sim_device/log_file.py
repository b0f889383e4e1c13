"""The simulated unit's flash for ride logs on disk, written a block at a time where it changed."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sim_device.firmware.python.unit import LOG_LENGTH, Unit

BLOCK_BYTES = 4096


@dataclass
class LogFile:
    """One file. A crash while writing is to the unit what a lost supply is: it copes with that."""

    path: Path
    written: bytes = b""
    changes: int = 0

    def load(self) -> bytes | None:
        """The image, or None for a unit that has none yet. Raises ValueError on another length."""
        if not self.path.exists():
            return None
        image = self.path.read_bytes()
        if len(image) != LOG_LENGTH:
            raise ValueError(
                f"{self.path} has {len(image)} bytes, a flash for ride logs has {LOG_LENGTH}; "
                "move it away to start with an erased one"
            )
        self.written = image
        return image

    def save(self, unit: Unit) -> None:
        """Writes the blocks that changed since the last call."""
        if unit.log_changes == self.changes:
            return
        self.changes = unit.log_changes
        image = unit.log()
        if not self.written:
            self.written = b"\xff" * LOG_LENGTH
            self.path.write_bytes(self.written)
        now = np.frombuffer(image, np.uint8).reshape(-1, BLOCK_BYTES)
        before = np.frombuffer(self.written, np.uint8).reshape(-1, BLOCK_BYTES)
        with self.path.open("r+b") as file:
            for block in np.flatnonzero((now != before).any(axis=1)):
                file.seek(int(block) * BLOCK_BYTES)
                file.write(now[block].tobytes())
            file.flush()
            os.fsync(file.fileno())
        self.written = image
