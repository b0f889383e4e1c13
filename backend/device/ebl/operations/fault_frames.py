"""The faults a unit has had, each with what the bike did when it came."""

from __future__ import annotations

from backend.device.ebl.faults import FAULT_BITS, NAME_OF_BIT, described, fault_name
from backend.device.ebl.operations.live_values import values_of
from backend.device.ebl.session.operation import Operation, attempt, expect, query
from backend.device.faults import Fault
from firmware_protocol._generated import (
    EvtFaultClearRequest,
    EvtFaultClearResponse,
    EvtFaultFreezeRequest,
    EvtFaultFreezeResponse,
    EvtFaultListRequest,
    EvtFaultListResponse,
    FaultFlags,
    Status,
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
