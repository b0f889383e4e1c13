"""One telemetry stream on the host's side: frames to blocks, every lost row counted.

The unit numbers every frame it builds, so `built = received + lost` holds exactly. Frames of an
earlier subscription carry another epoch and are dropped, never misread. Unit time is 32 bit on the
wire and unwrapped to 64 here.
"""

from __future__ import annotations

from dataclasses import dataclass

from backend.core.channels import ChannelSpec
from backend.device.ebl.session.frame_counts import FrameCounts
from backend.device.states import LinkStatistics
from backend.device.stream import LostBy, StreamBlock, StreamStarted, unwrap_us
from firmware_protocol._generated import CHANNELS, StreamCountsEvent, StrSubscribeResponse
from firmware_protocol.codec import Stream
from firmware_protocol.layout import Channel

STREAM_ID = 1
# 100 Hz in frames of three rows: 33 frames a second, so that a strip drawn 30 times a second has
# something new each time, at a third of the price of frames of one row.
DIVIDER_DEFAULT = 1
BATCH_DEFAULT = 3
LEASE_S = 5
RENEW_S = 2.0

SEQUENCE_MODULUS = 1 << 16
WIRE_EPOCH_MASK = 0x07


@dataclass(frozen=True)
class StreamPlan:
    """What is subscribed: channels of the registry, rows per control step, rows per frame."""

    channels: tuple[Channel, ...] = CHANNELS
    divider: int = DIVIDER_DEFAULT
    batch: int = BATCH_DEFAULT

    @property
    def channel_ids(self) -> bytes:
        """The ids as they go over the wire."""
        return bytes(channel.id for channel in self.channels)


class StreamReceiver:
    """Follows one subscription from its first frame to its last."""

    def __init__(
        self,
        plan: StreamPlan,
        reply: StrSubscribeResponse,
        epoch: int,
        unit_time_us: int,
        statistics: LinkStatistics,
    ) -> None:
        self.channels = tuple(
            ChannelSpec(channel.name, channel.unit, float(channel.scale))
            for channel in plan.channels
        )
        self.epoch = epoch
        self.period_us = reply.period_us
        self._batch = reply.batch
        self._wire_epoch = reply.epoch & WIRE_EPOCH_MASK
        self._next_sequence = reply.start_seq
        self._next_index = 0
        self._frames = 0
        self.time_us = unit_time_us
        self.frame_counts = FrameCounts()
        self._statistics = statistics
        self._frames_bad = statistics.frames_bad

    @property
    def started(self) -> StreamStarted:
        """What the blocks of this subscription hold."""
        return StreamStarted(self.epoch, self.period_us, self.channels)

    def take(self, frame: Stream, wall_us: int, late: bool = False) -> StreamBlock | None:
        """The frame's rows, or None for a frame that is not of this subscription or not new.

        late: the port was not read for a while, just now.
        """
        ours = frame.stream_id == STREAM_ID and frame.epoch == self._wire_epoch
        if not ours or frame.values.shape[1] != len(self.channels):
            self._statistics.stream_frames_foreign += 1
            return None
        skipped = (frame.seq - self._next_sequence) % SEQUENCE_MODULUS
        if skipped >= SEQUENCE_MODULUS // 2:
            self._statistics.stream_frames_repeated += 1
            return None
        lost_rows = skipped * self._batch
        first_index = self._next_index + lost_rows
        values = frame.values
        self.frame_counts.frame(self._frames + skipped)
        self._frames += skipped + 1
        self._next_sequence = (frame.seq + 1) % SEQUENCE_MODULUS
        self._next_index = first_index + len(values)
        self.time_us = unwrap_us(frame.t0_us, self.time_us)
        self._statistics.stream_frames += 1
        self._statistics.stream_rows += len(values)
        self._statistics.stream_rows_lost += lost_rows
        return StreamBlock(
            t0_us=self.time_us,
            period_us=self.period_us,
            first_index=first_index,
            values=values,
            lost_rows_before=lost_rows,
            epoch=self.epoch,
            wall_us=wall_us,
            channels=self.channels,
            lost_by=self._lost_by(lost_rows, late),
        )

    def _lost_by(self, lost_rows: int, late: bool) -> LostBy | None:
        was_damaged = self._statistics.frames_bad != self._frames_bad
        self._frames_bad = self._statistics.frames_bad
        if lost_rows == 0:
            return None
        if late:
            return LostBy.MACHINE
        return LostBy.LINE if was_damaged else LostBy.UNIT

    def counted(self, counts: StreamCountsEvent) -> bool:
        """The unit told its counts; False when they are of another subscription."""
        if (counts.stream_id, counts.epoch) != (STREAM_ID, self._wire_epoch):
            return False
        self.frame_counts.counted(counts.built, counts.dropped_tx, counts.missed)
        return True
