"""The host's end of a ride log's window: pieces placed by offset, holes told, order restored.

Sans-I/O: the session gives frames and time and sends the acknowledgements that come back; whoever
wants the bytes takes them in order, from any thread.

    begin --frames--> pieces in order --last--> done
    no frame for 10 s, link lost --> failed, with a reason
"""

from __future__ import annotations

from collections import deque

from firmware_protocol._generated import LogAckRequest
from firmware_protocol.codec import Bulk

ACK_EVERY_CHUNKS = 8
ACK_AFTER_S = 0.020
# An acknowledgement that was lost must not leave both sides waiting.
ACK_AGAIN_S = 1.0
SILENCE_S = 10.0
BITMAP_BITS = 64


class LogReceiver:
    """Receives one log, or the rest of one.

    session: 1 to 15, the channel its frames come on; another one for every attempt, so that frames
    of an attempt before are told apart from it. now_s: when waiting begins.
    """

    def __init__(self, session: int, now_s: float) -> None:
        self.session = session
        self.failure: str | None = None
        self.frames = 0
        self.frames_repeated = 0
        self.frames_foreign = 0
        # Bytes that are here without a hole, from the log's beginning.
        self.received = 0
        self._length = 0
        self._chunk = 0
        self._window = 0
        self._ahead: dict[int, bytes] = {}
        self._segments: deque[bytes] = deque()
        self._highest = 0
        self._unacknowledged = 0
        self._ack_due_s: float | None = None
        self._acked_s = now_s
        self._received_s = now_s

    def begin(self, offset: int, length: int, chunk: int, window: int) -> None:
        """The unit has agreed: `length` bytes in pieces of `chunk`, of which `offset` are here.

        window: so many pieces from the first that is missing the unit may send, and no others are
        kept.
        """
        self._length, self._chunk, self._window = length, chunk, window
        self.received = self._highest = offset

    @property
    def done(self) -> bool:
        """Whether the whole log is here."""
        return self._chunk > 0 and self.received == self._length

    def take(self, frame: Bulk, now_s: float) -> None:
        """Place a frame's bytes. What fits neither log nor window is counted and dropped."""
        offset, size = frame.offset, len(frame.data)
        if frame.session != self.session or not self._fits(offset, size):
            self.frames_foreign += 1
            return
        self.frames += 1
        self._received_s = now_s
        self._unacknowledged += 1
        if self._ack_due_s is None:
            self._ack_due_s = now_s + ACK_AFTER_S
        if offset < self.received or offset in self._ahead:
            # The unit did not hear that this is here.
            self.frames_repeated += 1
            self._ack_due_s = now_s
            return
        if offset > self._highest:
            self._ack_due_s = now_s
        self._highest = max(self._highest, offset + size)
        self._ahead[offset] = frame.data
        while (piece := self._ahead.pop(self.received, None)) is not None:
            self._segments.append(piece)
            self.received += len(piece)
        if self.received == self._length or self._unacknowledged >= ACK_EVERY_CHUNKS:
            self._ack_due_s = now_s

    def _fits(self, offset: int, size: int) -> bool:
        """Whether a piece is one of the log, and not beyond the window."""
        if self._chunk == 0 or size != self._chunk or offset % self._chunk:
            return False
        stop = min(self._length, self.received + self._window * self._chunk)
        return offset + size <= stop

    def acknowledgement(self, now_s: float) -> LogAckRequest | None:
        """What to tell the unit now; None when there is nothing to tell."""
        if self._chunk == 0 or self.failure is not None:
            return None
        if now_s - self._received_s >= SILENCE_S and not self.done:
            self.failure = f"The unit sent nothing of its log for {SILENCE_S:g} s."
            return None
        again = not self.done and now_s - self._acked_s >= ACK_AGAIN_S
        if not again and (self._ack_due_s is None or now_s < self._ack_due_s):
            return None
        self._ack_due_s = None
        self._unacknowledged = 0
        self._acked_s = now_s
        bitmap = 0
        for offset in self._ahead:
            place = (offset - self.received) // self._chunk
            if place < BITMAP_BITS:
                bitmap |= 1 << place
        return LogAckRequest(self.session, self.received, bitmap)

    def break_off(self, reason: str) -> None:
        """The link is gone; what is here stays here."""
        if not self.done and self.failure is None:
            self.failure = reason

    def take_segments(self) -> list[bytes]:
        """Bytes in order since the last call; together with those before, `received` of them."""
        segments = []
        while self._segments:
            segments.append(self._segments.popleft())
        return segments
