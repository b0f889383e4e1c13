"""Goal: a fault this Spindle has no name for is listed like any other, as long as it is active.

The operation is driven by hand; the unit's answers are written as its firmware would give them.
"""

from __future__ import annotations

from backend.device.ebl.faults import NAME_OF_BIT, fault_names
from backend.device.ebl.operations.fault_frames import fault_frames
from backend.device.ebl.session.operation import Question
from backend.device.faults import Fault
from firmware_protocol._generated import (
    EvtFaultFreezeRequest,
    EvtFaultListRequest,
    EvtFaultListResponse,
    FaultFlags,
    Status,
)
from firmware_protocol.codec import Response

NEWER_BIT = 30  # the last one that is ever given


def answer(asked: Question, active: int) -> Response:
    """What a unit says that keeps no freeze frame."""
    if isinstance(asked.message, EvtFaultListRequest):
        return Response(1, asked.message.MESSAGE_ID, Status.OK, 0, EvtFaultListResponse(active))
    assert isinstance(asked.message, EvtFaultFreezeRequest)
    return Response(1, asked.message.MESSAGE_ID, Status.NOT_FOUND)


def listed(active: int) -> list[Fault]:
    operation = fault_frames()
    try:
        questions = next(operation)
        while True:
            questions = operation.send([answer(question, active) for question in questions])
    except StopIteration as done:
        return list(done.value)


def test_an_unknown_fault_is_named_by_its_bit() -> None:
    assert NEWER_BIT not in NAME_OF_BIT

    assert fault_names(FaultFlags.TORQUE_SENSOR | 1 << NEWER_BIT) == ("torque_sensor", "fault_30")


def test_an_active_fault_of_a_newer_firmware_is_listed() -> None:
    found = listed(FaultFlags.TORQUE_SENSOR | 1 << NEWER_BIT)

    assert [(one.name, one.active) for one in found] == [
        ("torque_sensor", True),
        ("fault_30", True),
    ]
