"""The unit's clock as the host sees it: offset from the quickest round trips, skew from a line.

A request that carries the host's time comes back with the unit's. Whatever delays it, on either
way, makes the round trip longer, so the shortest ones know the offset best: it is wrong by no more
than half of what the trip took. A line through the best of each stretch of time gives the skew.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Final

import numpy as np

# Ten minutes at one sample every ten seconds.
SAMPLES_MAX: Final = 64
STRETCHES: Final = 8
# Below this a clock's skew is smaller than what a round trip leaves open.
SPAN_US_MIN: Final = 20_000_000
# A trip cannot be known better than the clock that timed it.
UNCERTAINTY_US_MIN: Final = 1.0


@dataclass(frozen=True)
class ClockSample:
    """One exchange: host time sent, unit time heard and answered, host time received; all us."""

    sent_us: int
    heard_us: int
    answered_us: int
    received_us: int

    @property
    def round_trip_us(self) -> float:
        """Time on the way there and back, without the unit's own."""
        return float((self.received_us - self.sent_us) - (self.answered_us - self.heard_us))

    @property
    def host_us(self) -> float:
        """The middle of the exchange on the host's clock."""
        return (self.sent_us + self.received_us) / 2.0

    @property
    def unit_us(self) -> float:
        """The middle of the exchange on the unit's clock."""
        return (self.heard_us + self.answered_us) / 2.0


@dataclass(frozen=True)
class ClockEstimate:
    """unit time = unit_us + rate x (host time - host_us). uncertainty_us: of that at `host_us`."""

    host_us: float
    unit_us: float
    rate: float
    round_trip_us: float
    uncertainty_us: float

    @property
    def skew_ppm(self) -> float:
        """How much faster than the host's the unit's clock runs, in millionths."""
        return (self.rate - 1.0) * 1e6

    def unit_at(self, host_us: float) -> float:
        """The unit's time at a time of the host."""
        return self.unit_us + self.rate * (host_us - self.host_us)

    def host_at(self, unit_us: float) -> float:
        """The host's time at a time of the unit."""
        return self.host_us + (unit_us - self.unit_us) / self.rate


class ClockEstimator:
    """Gathers samples of one unit since its start and tells its clock."""

    def __init__(self) -> None:
        self._samples: deque[ClockSample] = deque(maxlen=SAMPLES_MAX)

    def add(self, sample: ClockSample) -> bool:
        """Take a sample; False for one that cannot be: answered before it was sent."""
        if sample.round_trip_us < 0.0 or sample.answered_us < sample.heard_us:
            return False
        self._samples.append(sample)
        return True

    @property
    def estimate(self) -> ClockEstimate | None:
        """What the samples say together, None before the first."""
        if not self._samples:
            return None
        best = min(self._samples, key=lambda sample: sample.round_trip_us)
        uncertainty_us = max(best.round_trip_us / 2.0, UNCERTAINTY_US_MIN)
        rate = self._rate()
        return ClockEstimate(best.host_us, best.unit_us, rate, best.round_trip_us, uncertainty_us)

    def _rate(self) -> float:
        """Slope through the quickest sample of each stretch; the quicker count more."""
        chosen = self._quickest()
        host_us = np.array([sample.host_us for sample in chosen])
        unit_us = np.array([sample.unit_us for sample in chosen])
        if len(chosen) < 2 or np.ptp(host_us) < SPAN_US_MIN:
            return 1.0
        half_us = np.array([max(s.round_trip_us / 2.0, UNCERTAINTY_US_MIN) for s in chosen])
        weights = 1.0 / half_us**2
        host_us -= np.average(host_us, weights=weights)
        unit_us -= np.average(unit_us, weights=weights)
        return float(np.sum(weights * host_us * unit_us) / np.sum(weights * host_us**2))

    def _quickest(self) -> list[ClockSample]:
        first_us = self._samples[0].host_us
        span_us = max(self._samples[-1].host_us - first_us, 1.0)
        best: dict[int, ClockSample] = {}
        for sample in self._samples:
            stretch = min(int((sample.host_us - first_us) / span_us * STRETCHES), STRETCHES - 1)
            if stretch not in best or sample.round_trip_us < best[stretch].round_trip_us:
                best[stretch] = sample
        return list(best.values())
