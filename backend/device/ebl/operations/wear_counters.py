"""What a unit knows of its own wear, asked of it."""

from __future__ import annotations

from typing import cast

from backend.device.ebl.session.operation import Operation, query
from backend.device.wear_counters import ConfigSlot, WearCounters
from backend.device.wear_counters import SlotState as SlotWord
from firmware_protocol._generated import (
    CfgSlotsRequest,
    CfgSlotsResponse,
    CountersRequest,
    CountersResponse,
    SlotState,
)
from firmware_protocol.spelling import word_of


def read_wear_counters() -> Operation[WearCounters]:
    """Ask the unit. Raises NoAnswer, DeviceRefused."""
    counters = yield from query(CountersRequest(), CountersResponse)
    slots = yield from query(CfgSlotsRequest(), CfgSlotsResponse)
    counters_by_name = tuple(
        ConfigSlot(
            cast(SlotWord, _state_name(state)), generation, erases, slots.active_slot == index
        )
        for index, (state, generation, erases) in enumerate(
            zip(slots.states, slots.generations, slots.erases, strict=True)
        )
    )
    return WearCounters(
        counters.distance_m,
        counters.operating_s,
        counters.saved_distance_m,
        counters.saved_operating_s,
        counters_by_name,
        slots.active_slot >= len(counters_by_name),
    )


def _state_name(state: int) -> str:
    return word_of(SlotState(state).name) if state in set(SlotState) else "unknown"
