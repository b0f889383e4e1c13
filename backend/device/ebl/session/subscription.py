"""Keeping one stream alive: subscribe, renew the lease, hand frames to its receiver."""

from __future__ import annotations

import math

from backend.device.ebl.session.frame_counts import Balance
from backend.device.ebl.session.operation import Operation, attempt, expect, query
from backend.device.ebl.session.stream_receiver import (
    LEASE_S,
    RENEW_S,
    STREAM_ID,
    StreamPlan,
    StreamReceiver,
)
from backend.device.states import LinkStatistics
from backend.device.stream import StreamBlock, StreamStarted
from backend.errors import NoAnswer
from firmware_protocol._generated import (
    CONTROL_PERIOD_US,
    Status,
    StreamCountsEvent,
    StrRenewRequest,
    StrSnapshotRequest,
    StrSnapshotResponse,
    StrSubscribeRequest,
    StrSubscribeResponse,
)
from firmware_protocol.codec import Stream

ENCODING_PLAIN = 0
# Halving the rate five times reaches 3 Hz from 100 Hz; a line slower than that is not for us.
SLOWER_ATTEMPTS = 6
# Leases run on the unit's clock, and a simulated one may run a hundred times faster than ours.
LEASE_SIMULATED_S = 250
STEPS_PER_S = 1_000_000 // CONTROL_PERIOD_US
# A snapshot is the latest row, which is a little older than the question.
ROW_AGE_US_MAX = 100_000
# Part of a lease after which it is renewed, by whichever clock comes first.
RENEW_PART = 0.4


# A port is read every 20 ms. Its buffer and the unit's queue hold some tenths of a second.
READ_LATE_S = 0.1
# What is in these buffers comes before the first frame that shows the loss.
LATE_SHOWS_S = 1.0


class UnitRestarted(NoAnswer):
    """The unit's clock went back: it rebooted after the handshake."""

    default_code = "unit_restarted"


class Subscription:
    """The stream of one unit over all its connections; epochs count up and never repeat."""

    def __init__(self, statistics: LinkStatistics) -> None:
        self._statistics = statistics
        self._receiver: StreamReceiver | None = None
        self._epoch = 0
        self._lease_s = LEASE_S
        self._renewed_s: float | None = None
        self._renewed_unit_us = 0
        self._closed = Balance()
        self._read_s = math.inf
        self._late_until_s = -math.inf

    @property
    def started(self) -> StreamStarted | None:
        """What is being streamed, None when nothing is."""
        return self._receiver.started if self._receiver else None

    def begin(
        self, plan: StreamPlan, simulated: bool = False, hello_us: int = 0
    ) -> Operation[StreamStarted]:
        """Subscribe, more slowly where the line is too slow.

        hello_us: unit time at HELLO. Raises DeviceRefused, NoAnswer, UnitRestarted.
        """
        # The stream carries 32 bits of unit time; the snapshot gives the other 32.
        first = bytes([plan.channels[0].id])
        snapshot = yield from query(StrSnapshotRequest(first), StrSnapshotResponse)
        if snapshot.t_us + ROW_AGE_US_MAX < hello_us:
            raise UnitRestarted("The unit was restarted; asking who it is again.")
        self._lease_s = LEASE_SIMULATED_S if simulated else LEASE_S
        divider = plan.divider
        for _ in range(SLOWER_ATTEMPTS):
            request = StrSubscribeRequest(
                STREAM_ID, divider, plan.batch, ENCODING_PLAIN, self._lease_s, plan.channel_ids
            )
            response = yield from attempt(request)
            if response.status != Status.BANDWIDTH:
                break
            divider = _slower(divider, response.detail)
        reply = expect(request, response, StrSubscribeResponse)
        self._close_counts()
        self._epoch += 1
        self._receiver = StreamReceiver(plan, reply, self._epoch, snapshot.t_us, self._statistics)
        return self._receiver.started

    def renewal_due(self, now_s: float) -> bool:
        """Whether the lease should be renewed now; says so once for each renewal."""
        if self._receiver is None:
            return False
        if self._renewed_s is None:
            self._renewed_s, self._renewed_unit_us = now_s, self._receiver.time_us
        unit_s = (self._receiver.time_us - self._renewed_unit_us) / 1e6
        if now_s - self._renewed_s < RENEW_S and unit_s < RENEW_PART * self._lease_s:
            return False
        self._renewed_s, self._renewed_unit_us = now_s, self._receiver.time_us
        return True

    def renew(self) -> Operation[bool]:
        """Renew the lease; False when the unit knows no such stream (any more). Raises NoAnswer."""
        response = yield from attempt(StrRenewRequest(STREAM_ID, self._lease_s))
        return response.status == Status.OK

    def read_at(self, now_s: float) -> None:
        """The port was looked at; now_s: never goes back."""
        if now_s - self._read_s > READ_LATE_S:
            self._late_until_s = now_s + LATE_SHOWS_S
        self._read_s = now_s

    def take(self, frame: Stream, wall_us: int) -> StreamBlock | None:
        """The frame's rows; None for a frame of another subscription, which is counted."""
        if self._receiver is None:
            self._statistics.stream_frames_foreign += 1
            return None
        block = self._receiver.take(frame, wall_us, self._read_s < self._late_until_s)
        self._publish()
        return block

    def counted(self, counts: StreamCountsEvent) -> None:
        """The unit told its counts of a stream; those of another subscription are not ours."""
        if self._receiver is not None and self._receiver.counted(counts):
            self._publish()

    def end(self) -> None:
        """The unit or the port is gone; frames that still come are foreign."""
        self._close_counts()
        self._receiver = None
        self._renewed_s = None

    def _close_counts(self) -> None:
        """Add the books of the subscription that ends to those of all before."""
        if self._receiver is not None:
            self._receiver.frame_counts.ended()
            self._closed += self._receiver.frame_counts.balance
            self._receiver = None
            self._publish()

    def _publish(self) -> None:
        balance = self._closed
        if self._receiver is not None:
            balance += self._receiver.frame_counts.balance
        self._statistics.balance_built = balance.built
        self._statistics.balance_received = balance.received
        self._statistics.balance_lost = balance.lost
        self._statistics.balance_dropped = balance.dropped
        self._statistics.unit_steps_missed = balance.missed


def _slower(divider: int, rate_hz_max: int) -> int:
    """The next divider to try; rate_hz_max: what the unit says would fit, 0 when it does not."""
    if rate_hz_max == 0:
        return 2 * divider
    return max(divider + 1, -(-STEPS_PER_S // rate_hz_max))
