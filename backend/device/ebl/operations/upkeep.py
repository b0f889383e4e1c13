"""What a unit knows of its own wear: how far, how long, and how often its flash was written."""

from __future__ import annotations

from dataclasses import dataclass

from backend.device.ebl.session.operation import Operation, ask
from firmware_protocol._generated import (
    CfgSlotsRequest,
    CfgSlotsResponse,
    CountersRequest,
    CountersResponse,
    SlotState,
)


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
class Upkeep:
    """distance_m, operating_s: over the unit's life. saved_*: as its flash has them; what came
    after is lost with the supply, a minute at most. runs_on_default: neither slot was good."""

    distance_m: int
    operating_s: int
    saved_distance_m: int
    saved_operating_s: int
    config_slots: tuple[ConfigSlot, ...]
    runs_on_default: bool


def read_upkeep() -> Operation[Upkeep]:
    """Ask the unit. Raises NoAnswer, DeviceRefused."""
    counters = yield from ask(CountersRequest(), CountersResponse)
    slots = yield from ask(CfgSlotsRequest(), CfgSlotsResponse)
    found = tuple(
        ConfigSlot(_state_name(state), generation, erases, slots.active_slot == index)
        for index, (state, generation, erases) in enumerate(
            zip(slots.states, slots.generations, slots.erases, strict=True)
        )
    )
    return Upkeep(
        counters.distance_m,
        counters.operating_s,
        counters.saved_distance_m,
        counters.saved_operating_s,
        found,
        slots.active_slot >= len(found),
    )


def _state_name(state: int) -> str:
    return SlotState(state).name.lower() if state in set(SlotState) else "unknown"
