"""Goal: built = received + lost on the line + dropped by the unit, to the frame, whatever happens.

Method: the real firmware in virtual time, and a wire between that destroys stream frames by a list
it keeps, or is not read for a while so that the unit itself must drop. What the host enters in its
books is compared with what the wire destroyed.
"""

from __future__ import annotations

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from backend.device.ebl.session.frame_counts import Balance, FrameCounts
from backend.device.ebl.session.stream_receiver import StreamPlan
from firmware_protocol.codec import Stream, decode
from firmware_protocol.framing import FrameDecoder, encode_frame
from sim_device.lockstep import LockstepUnit
from tests.fakes.bench import Bench
from tests.fakes.simulated_unit import LockstepAsUnit

STEP_S = 0.010


class Wire(LockstepAsUnit):
    """The unit behind a wire that loses stream frames and stalls."""

    def __init__(self, losses: list[int]) -> None:
        super().__init__(LockstepUnit(seed=1))
        self.stalled = False
        self.destroyed: list[tuple[int, int]] = []  # epoch and sequence number
        self._losses = losses
        self._seen = 0
        self._decoder = FrameDecoder()

    def transmit(self) -> bytes:
        if self.stalled:
            return b""
        out = b""
        for frame in self._decoder.feed(super().transmit()):
            message = decode(frame)
            if isinstance(message, Stream):
                self._seen += 1
                if self._losses and self._seen % 97 in self._losses:
                    self.destroyed.append((message.epoch, message.seq))
                    continue
            out += encode_frame(frame)
        return out


@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    losses=st.lists(st.integers(0, 96), max_size=30),
    stall_steps=st.integers(0, 700),
    run_steps=st.integers(150, 500),
)
def test_the_books_balance_and_name_exactly_what_the_wire_destroyed(
    losses: list[int], stall_steps: int, run_steps: int
) -> None:
    wire = Wire(losses)
    bench = Bench(wire, StreamPlan(batch=1)).connect()
    bench.run(run_steps * STEP_S)
    wire.stalled = True
    bench.session.tick(bench.now_s)
    wire.unit.advance(stall_steps * STEP_S)
    wire.stalled = False
    bench.run(run_steps * STEP_S)
    balance, lost_before = balance_at_a_count(bench, wire)

    assert balance.built == balance.received + balance.lost + balance.dropped
    assert balance.lost == lost_before
    assert balance.built > 100
    assert balance.missed == 0
    if stall_steps > 600:
        assert balance.dropped > 0


def balance_at_a_count(bench: Bench, wire: Wire) -> tuple[Balance, int]:
    """The counts at the moment a count is entered, and what was destroyed of its frames."""
    wire._losses = []
    before = bench.session.link_statistics().balance_built
    bench.run_until(lambda: bench.session.link_statistics().balance_built > before)
    counted = bench.session.link_statistics()
    balance = Balance(
        counted.balance_built,
        counted.balance_received,
        counted.balance_lost,
        counted.balance_dropped,
        counted.unit_steps_missed,
    )
    return balance, len(wire.destroyed)


@given(
    fates=st.lists(st.sampled_from(["comes", "lost", "dropped"]), min_size=1, max_size=200),
    count_every=st.integers(1, 40),
    ahead=st.integers(0, 5),
)
def test_any_order_of_frames_and_counts_balances(
    fates: list[str], count_every: int, ahead: int
) -> None:
    frame_counts = FrameCounts()
    for index, fate in enumerate(fates):
        if fate == "comes":
            frame_counts.frame(index)
        if index % count_every == 0:
            upto = min(len(fates), index + 1 + ahead)
            frame_counts.counted(upto, fates[:upto].count("dropped"), 0)
        balance = frame_counts.balance
        truth = fates[: balance.built]
        assert balance.received == truth.count("comes")
        assert balance.lost == truth.count("lost")
        assert balance.dropped == truth.count("dropped")

    frame_counts.counted(len(fates), fates.count("dropped"), 0)
    frame_counts.ended()

    assert frame_counts.balance.built == len(fates)
    assert frame_counts.balance.lost == fates.count("lost")


def test_a_count_that_frames_have_overtaken_is_not_entered() -> None:
    frame_counts = FrameCounts()
    for index in range(10):
        frame_counts.frame(index)

    frame_counts.counted(5, 0, 0)

    assert frame_counts.balance == Balance()
