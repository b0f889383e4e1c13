"""Disks that fail at a chosen step, as a full or a dying one does."""

from __future__ import annotations

import errno
from pathlib import Path

from backend.store.objects import Disk

EVERY_STEP = ("flush_file", "rename", "flush_folder")


class FailingDisk(Disk):
    """Fails at the `left`-th of its `steps` from when that is set, counted from 1; never if 0."""

    def __init__(self, left: int = 0, steps: tuple[str, ...] = EVERY_STEP) -> None:
        self.left = left
        self._steps = steps

    def flush_file(self, path: Path) -> None:
        self._step("flush_file")
        super().flush_file(path)

    def rename(self, source: Path, target: Path) -> None:
        self._step("rename")
        super().rename(source, target)

    def flush_folder(self, path: Path) -> None:
        self._step("flush_folder")
        super().flush_folder(path)

    def _step(self, step: str) -> None:
        if step not in self._steps:
            return
        self.left -= 1
        if self.left == 0:
            raise OSError(errno.ENOSPC, "No space left on device")
