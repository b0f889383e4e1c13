"""Rows of a unit's rides that never came, by where they were lost."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Mapping

from backend.device.stream import LostBy

LOG = logging.getLogger(__name__)

# So much of a ride is missing before somebody is told: a single damaged frame is no news.
TOLD_S = 1.0
LOST_BY_WORDS = {
    LostBy.MACHINE: "this computer is too busy to read the unit's port in time. End what else runs "
    "on it, or connect fewer units",
    LostBy.LINE: "the line damages or interrupts them. Look at cable, adapter and connectors",
    LostBy.UNIT: "the unit does not send them: the line is slower than the stream, or the unit is "
    "too busy to measure. Raise the line's rate",
}


class MissingRows:
    """Of the latest ride of one unit. told: the rows once they are worth telling, else empty."""

    def __init__(self, device_id: str) -> None:
        self._device_id = device_id
        self._rows: Counter[LostBy] = Counter()
        self.told: Mapping[LostBy, int] = {}

    def begin(self) -> None:
        """Another ride begins."""
        self._rows.clear()
        self.told = {}

    def add(self, lost_by: LostBy, rows: int, period_us: int) -> None:
        """Count rows; in the log once a ride."""
        self._rows[lost_by] += rows
        if self._rows.total() * period_us < TOLD_S * 1e6:
            return
        if not self.told:
            words = LOST_BY_WORDS[self._rows.most_common(1)[0][0]]
            LOG.warning("Unit %s: rows of its ride are missing: %s.", self._device_id, words)
        self.told = dict(self._rows)

    @property
    def most(self) -> tuple[LostBy, int] | None:
        """Where most of them were lost, and how many there are in all; None while none is told."""
        told = self.told
        return (max(told, key=told.__getitem__), sum(told.values())) if told else None
