"""What the unit's market leaves of a configuration, by the unit's own C."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from sim_device.firmware.python import market as unit

MARKETS = unit.MARKETS
MARKET_WORDS = {
    "eu_epac": "the EU (EN 15194)",
    "uk": "the United Kingdom",
    "us_class_1": "US class 1",
    "us_class_2": "US class 2",
    "us_class_3": "US class 3",
    "japan": "Japan",
    "china": "China (GB 17761)",
}
"""What a market is called in a message; a new one is called by its name."""


@dataclass(frozen=True, slots=True)
class Cutoff:
    """Where assist ends, and why.

    configured_kmh, extra_kmh: the parameters. holds_kmh: what the unit does with them. market: None
    if nobody said which; then the configured speed holds.
    """

    configured_kmh: float
    extra_kmh: float
    holds_kmh: float
    market: str | None

    @property
    def is_markets(self) -> bool:
        """Whether the market's own speed ends assist, not a lower setting."""
        return self.market is not None and self.holds_kmh >= unit.market_speed_kmh(self.market)


def market_words(market: str) -> str:
    """A market as a message calls it."""
    return MARKET_WORDS.get(market, market)


def cutoff_of(limits: Mapping[str, Any]) -> Cutoff | None:
    """The cut-off of a configuration; None if it does not tell `assist_cutoff_kmh`.

    limits: parameters by name; `market` and `assist_cutoff_extra_kmh` may be missing.
    """
    configured_kmh = limits.get("assist_cutoff_kmh")
    if configured_kmh is None:
        return None
    market = limits.get("market")
    if market is None:
        return Cutoff(configured_kmh, 0.0, configured_kmh, None)
    extra_kmh = limits.get("assist_cutoff_extra_kmh") or 0.0
    holds_kmh = unit.cutoff_that_holds_kmh(market, configured_kmh, extra_kmh)
    return Cutoff(configured_kmh, extra_kmh, holds_kmh, market)


def allowed_ratios(market: str | None, speeds_kmh: npt.ArrayLike) -> npt.NDArray[np.float64] | None:
    """Largest assist per rider torque at each speed, (n,); None where the market names none."""
    if market is None:
        return None
    ratios = unit.market_ratios(market, speeds_kmh)
    return None if ratios is None else ratios.astype(np.float64)
