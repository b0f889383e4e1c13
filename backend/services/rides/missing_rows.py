"""Rows of a unit's rides that never came, by where they were lost."""

from __future__ import annotations

import logging
from collections import Counter

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
    """Of the latest ride of one unit. Read by those that must not wait for its recorder.

    rows: how many there are. most: where most of them were lost and how many there are, once they
    are worth telling, else None.
    """

    def __init__(self, device_id: str) -> None:
        self._device_id = device_id
        self._by_place: Counter[LostBy] = Counter()
        self.rows = 0
        self.most: tuple[LostBy, int] | None = None

    def begin(self) -> None:
        """Another ride begins."""
        self._by_place.clear()
        self.rows, self.most = 0, None

    def add(self, lost_by: LostBy, rows: int, period_us: int) -> None:
        """Count rows; in the log once a ride."""
        self._by_place[lost_by] += rows
        self.rows += rows
        if self.rows * period_us < TOLD_S * 1e6:
            return
        place = self._by_place.most_common(1)[0][0]
        if self.most is None:
            words = LOST_BY_WORDS[place]
            LOG.warning("Unit %s: rows of its ride are missing: %s.", self._device_id, words)
        self.most = (place, self.rows)
