"""What a unit knows of its own wear: how far, how long, and how often its flash was written."""

from __future__ import annotations

from typing import Literal

from backend.core.described import described

SlotState = Literal["empty", "confirmed", "provisional", "void", "damaged", "unknown"]


@described
class ConfigSlot:
    """One of the two places in the unit's flash its configuration is kept."""

    state: SlotState
    """`unknown`: to this Spindle."""
    generation: int
    erases: int
    """In the unit's life; this wears it."""
    active: bool
    """Whether the unit runs on it."""


@described
class WearCounters:
    """What the unit knows of its own wear. What is not saved yet is lost with its supply, a minute
    at most."""

    distance_m: int
    operating_s: int
    saved_distance_m: int
    saved_operating_s: int
    config_slots: tuple[ConfigSlot, ...]
    runs_on_default: bool
    """Neither slot is good: the factory's values apply."""
