"""The books of one stream: every frame built was received, lost on the line or dropped by the unit.

The unit tells now and then how many frames it had built and dropped by then. The count is true of
the stream up to that frame, and is entered when the host has passed it. Then
built = received + lost + dropped holds exactly, because lost is what is left and nothing else.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

# Counts whose frames have not come yet; one a second comes, so more means that none do.
COUNTS_MAX = 16


@dataclass(frozen=True)
class Balance:
    """Frames up to one count of the unit. missed: control steps of the unit without a row."""

    built: int = 0
    received: int = 0
    lost: int = 0
    dropped: int = 0
    missed: int = 0

    def __add__(self, other: Balance) -> Balance:
        return Balance(
            self.built + other.built,
            self.received + other.received,
            self.lost + other.lost,
            self.dropped + other.dropped,
            self.missed + other.missed,
        )


class FrameCounts:
    """Follows one subscription; `balance` is of the latest count that could be entered."""

    def __init__(self) -> None:
        self.balance = Balance()
        self._received = 0
        self._passed = 0
        self._counts: deque[tuple[int, int, int]] = deque(maxlen=COUNTS_MAX)

    def frame(self, index: int) -> None:
        """A frame came: the `index`-th the unit built, from 0, each greater than the one before."""
        self._enter(index)
        self._received += 1
        self._passed = index + 1
        self._enter(self._passed)

    def counted(self, built: int, dropped: int, missed: int) -> None:
        """The unit told its counts since the subscription."""
        if built < self._passed:
            # Frames overtook their count; how many of the first `built` came is not known any more.
            return
        self._counts.append((built, dropped, missed))
        self._enter(self._passed)

    def ended(self) -> None:
        """No frame comes any more: what was built after the latest one that came did not."""
        if self._counts:
            self._enter(self._counts[-1][0])

    def _enter(self, passed: int) -> None:
        """Enter the counts up to the `passed`-th frame."""
        while self._counts and self._counts[0][0] <= passed:
            built, dropped, missed = self._counts.popleft()
            lost = built - self._received - dropped
            self.balance = Balance(built, self._received, lost, dropped, missed)
