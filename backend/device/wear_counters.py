"""What a unit knows of its own wear: how far, how long, and how often its flash was written."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ConfigSlot:
    """One of the two places in flash a configuration is kept.

    state: empty, confirmed, provisional, void, damaged, or unknown to this Spindle. erases: how
    often it was erased in the unit's life, which wears it. active: whether the unit runs on it.
    """

    state: str
    generation: int
    erases: int
    active: bool


@dataclass(frozen=True)
class WearCounters:
    """distance_m, operating_s: over the unit's life. saved_*: as its flash has them; what came
    after is lost with the supply, a minute at most. runs_on_default: neither slot was good."""

    distance_m: int
    operating_s: int
    saved_distance_m: int
    saved_operating_s: int
    config_slots: tuple[ConfigSlot, ...]
    runs_on_default: bool
