"""How long an answer takes beside a stream as full as the unit admits it, in virtual time."""

from backend.device.ebl.operations.readings import read_values
from backend.device.ebl.session.operation import Operation, query
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.errors import DeviceRefused
from firmware_protocol._generated import (
    CHANNELS,
    Bank,
    CfgReadRequest,
    CfgReadResponse,
    Status,
    StrSubscribeRequest,
    StrSubscribeResponse,
)
from tests.fakes.bench_unit import BenchUnit
from tests.fakes.serial_wire import SerialWire
from tools.bench.figures import Figure

TURN_AROUND_S = 0.002
# Rate -> 99 of 100 answers within so long, the turn-around not counted (protocol page, 5.6).
WITHIN_S = {115200: 0.080, 1_000_000: 0.025}
BATCH = 5
# The second to fourth stream of the unit; a tool beside ours has them.
OTHER_STREAMS = (2, 3, 4)
LEASE_S = 255
PAUSE_S = 0.003
COUNT = 200


def run() -> list[Figure]:
    """One figure for every rate."""
    return [answers(rate) for rate in WITHIN_S]


def answers(rate: int) -> Figure:
    """The 99th percentile over two kinds of request, one after the other."""
    unit = BenchUnit()
    unit.line_baud(rate)
    wire = SerialWire(unit, rate, TURN_AROUND_S, plan=StreamPlan(batch=BATCH)).connect()
    wire.run(1.0)
    for stream_id in OTHER_STREAMS:
        fill(wire, stream_id)
    carried, began_s = wire.up.carried, wire.now_s
    took_s = sorted(answered(wire, index) - TURN_AROUND_S for index in range(COUNT))
    share = (wire.up.carried - carried) / (wire.now_s - began_s) / wire.bytes_per_s
    p99_s = took_s[COUNT * 99 // 100 - 1]
    return Figure(
        f"answer beside a full stream at {rate} bit/s, 99th percentile",
        f"{p99_s * 1000:.0f} ms",
        f"<= {WITHIN_S[rate] * 1000:.0f} ms",
        p99_s <= WITHIN_S[rate],
        f"{share:.0%} of the line is taken; median {took_s[COUNT // 2] * 1000:.0f} ms, "
        f"longest {took_s[-1] * 1000:.0f} ms, {TURN_AROUND_S * 1000:.0f} ms turn-around on top",
    )


def fill(wire: SerialWire, stream_id: int) -> None:
    """One more stream, of as many channels as the unit admits beside the others."""
    for count in range(len(CHANNELS), 0, -1):
        ids = bytes(channel.id for channel in CHANNELS[:count])
        request = StrSubscribeRequest(stream_id, 1, BATCH, 0, LEASE_S, ids)
        try:
            wire.ask(query(request, StrSubscribeResponse))
            return
        except DeviceRefused as error:
            if error.status != Status.BANDWIDTH.name:
                raise


def answered(wire: SerialWire, index: int) -> float:
    """Seconds from asking to the answer; a short one and a long one in turn."""
    # Not in step with the stream's frames.
    wire.run(PAUSE_S * (1 + index % 7))
    began_s = wire.now_s
    question: Operation[object] = (
        read_values() if index % 2 else query(CfgReadRequest(Bank.ACTIVE, 0, 100), CfgReadResponse)
    )
    wire.ask(question)
    return wire.now_s - began_s
