"""What a market allows, from the tables in the unit's own code."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from firmware_protocol._generated import Market
from firmware_protocol.spelling import member_of, words_of
from sim_device.firmware.python._native import ffi, lib

MARKETS = words_of(Market)


@dataclass(frozen=True, slots=True)
class MarketProfile:
    """What a market allows, as market.h has it; None where it says nothing.

    cutoff_kmh: no assist from there on. band_kmh: assist falls over no less than this below it.
    walk_kmh: no walk assist from there on, 0 for none at all. continuous_w, peak_w: at the motor's
    shaft. pedal_stop_s: longest time assist may outlive pedalling. ratio_falls: assist per rider
    torque is under `market_ratios`.
    """

    cutoff_kmh: float
    band_kmh: float | None
    walk_kmh: float
    continuous_w: float | None
    peak_w: float | None
    pedal_stop_s: float
    ratio_falls: bool


def market_profile(market: str) -> MarketProfile:
    """A market's numbers. Raises KeyError if it is none."""
    found = lib.market_profile_of(member_of(Market, market))
    return MarketProfile(
        cutoff_kmh=_shortest(found.cutoff_kmh),
        band_kmh=_shortest(found.band_kmh) or None,
        walk_kmh=_shortest(found.walk_kmh),
        continuous_w=_shortest(found.continuous_w) or None,
        peak_w=_shortest(found.peak_w) or None,
        pedal_stop_s=_shortest(found.pedal_stop_s),
        ratio_falls=bool(found.ratio_falls),
    )


def market_speed_kmh(market: str) -> float:
    """The speed at and above which the market allows no assist. Raises KeyError if it is none."""
    return _shortest(lib.market_profile_of(member_of(Market, market)).cutoff_kmh)


def cutoff_that_holds_kmh(
    market: str, assist_cutoff_kmh: float, assist_cutoff_extra_kmh: float
) -> float:
    """Where assist ends: what is configured, or the market's own speed where that is lower.

    Raises KeyError if there is no such market.
    """
    config: Any = ffi.new("assist_config *")
    config.market = member_of(Market, market)
    config.assist_cutoff_kmh = assist_cutoff_kmh
    config.assist_cutoff_extra_kmh = assist_cutoff_extra_kmh
    return _shortest(lib.market_cutoff_kmh(config))


def market_ratios(market: str, speeds_kmh: npt.ArrayLike) -> npt.NDArray[np.float32] | None:
    """Largest assist per rider torque at each speed, (n,); None where the market names none."""
    if not lib.market_profile_of(member_of(Market, market)).ratio_falls:
        return None
    speeds = np.atleast_1d(np.asarray(speeds_kmh, np.float32))
    return np.array([lib.market_japan_ratio(float(speed)) for speed in speeds], np.float32)


def _shortest(number: float) -> float:
    """The shortest decimal that is the same float32, as parameters are told."""
    return float(str(np.float32(number)))
