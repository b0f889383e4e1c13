"""Queries of what a unit reports: a row of telemetry, faults with their freeze frames, wear."""

from __future__ import annotations

from typing import cast

import numpy as np

from backend.core.channels import ChannelSpec
from backend.device.ebl.faults import FAULT_BITS, NAME_OF_BIT, described, fault_name
from backend.device.ebl.session.operation import Operation, attempt, expect, query
from backend.device.readings import ConfigSlot, Fault, Snapshot, WearCounters, named_values
from backend.device.readings import SlotState as SlotWord
from firmware_protocol._generated import (
    CHANNELS,
    CfgSlotsRequest,
    CfgSlotsResponse,
    CountersRequest,
    CountersResponse,
    EvtFaultClearRequest,
    EvtFaultClearResponse,
    EvtFaultFreezeRequest,
    EvtFaultFreezeResponse,
    EvtFaultListRequest,
    EvtFaultListResponse,
    FaultFlags,
    SlotState,
    Status,
    StrSnapshotRequest,
    StrSnapshotResponse,
)
from firmware_protocol.layout import MISSING
from firmware_protocol.spelling import word_of

CHANNEL_SPECS = tuple(ChannelSpec(row.name, row.unit, float(row.scale)) for row in CHANNELS)


def read_values() -> Operation[Snapshot]:
    """Ask the unit for one row of every channel."""
    ids = bytes(row.id for row in CHANNELS)
    answer = yield from query(StrSnapshotRequest(ids), StrSnapshotResponse)
    return values_of(answer.t_us, answer.values)


def values_of(t_us: int, row: bytes) -> Snapshot:
    """A row of every channel in the order of their ids, as the wire carries it.

    A unit of earlier firmware has fewer channels: those it does not send are missing.
    """
    channel_count = len(CHANNEL_SPECS)
    counts = np.frombuffer(row[: min(len(row) // 2, channel_count) * 2], dtype="<i2").tolist()
    return Snapshot(
        t_us, named_values(CHANNEL_SPECS, counts + [MISSING] * (channel_count - len(counts)))
    )


ALL_FAULTS = 0xFFFFFFFF
SETTINGS_LOST = FaultFlags.CONFIG_DEFAULTED | FaultFlags.NOT_PROVISIONED


def fault_frames() -> Operation[list[Fault]]:
    """The faults that are active or were, by their bit. Raises NoAnswer, DeviceRefused."""
    listed = yield from query(EvtFaultListRequest(), EvtFaultListResponse)
    frames = []
    for bit in range(FAULT_BITS):
        active = bool(listed.fault_flags >> bit & 1)
        if bit not in NAME_OF_BIT and not active:
            continue  # what a newer firmware has besides is asked for only while it is there
        request = EvtFaultFreezeRequest(bit)
        response = yield from attempt(request)
        name = fault_name(bit)
        if response.status in (Status.NOT_FOUND, Status.UNKNOWN_MSG):
            if active:
                frames.append(described(name, count=1))
            continue
        frame = expect(request, response, EvtFaultFreezeResponse)
        frames.append(described(name, active, frame.count, values_of(frame.t_us, frame.values)))
    return frames


def settings_are_lost() -> Operation[bool]:
    """Whether defaults stand where settings were: to write what the unit shows is a change then,
    and the only end of the fault. Raises NoAnswer, DeviceRefused."""
    listed = yield from query(EvtFaultListRequest(), EvtFaultListResponse)
    return bool(listed.fault_flags & SETTINGS_LOST)


def clear_faults() -> Operation[list[Fault]]:
    """Forget the faults that are over; those that are left."""
    yield from query(EvtFaultClearRequest(ALL_FAULTS), EvtFaultClearResponse)
    return (yield from fault_frames())


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
