"""Connections that do not talk are let go, and there are never too many.

uvicorn waits for the first request of a connection, for the rest of a body, and for the other end
to read an answer as long as that likes. A thousand sockets that say nothing would use up the
process's file descriptors, and with them the units' ports and the database.
"""

from __future__ import annotations

import asyncio
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

# A browser sends its request's head in one piece; a person typing one is not served.
HEAD_S = 15.0
# Between pieces of a body; a phone in a cellar may be slow, not silent for a minute.
BODY_S = 60.0
# An answer of which nothing more is taken; it may hold a file open.
READ_S = 60.0
CHECK_EVERY_S = 5.0
# Half of the file descriptors that a process has by default. A browser holds seven at most.
CONNECTIONS_MAX = 512


class PatientProtocol(H11Protocol):
    """uvicorn's connection with an end to its patience."""

    head_s = HEAD_S
    body_s = BODY_S
    read_s = READ_S
    check_every_s = CHECK_EVERY_S
    connections_max = CONNECTIONS_MAX

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self._next_check: asyncio.TimerHandle | None = None
        # Since when the head of the next request is awaited, which request was the last, and when
        # something came.
        self.silent_since_s = self.loop.time()
        self._last: object = None
        self.last_received_s = self.silent_since_s
        # Since when the other end takes nothing of an answer; None while it does.
        self.unread_since_s: float | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Take the connection; where there are too many, the one that waited longest goes.

        Those that send no request go first, then those in the middle of one.
        """
        super().connection_made(transport)
        self.silent_since_s = self.last_received_s = self.loop.time()
        if len(self.connections) > self.connections_max:
            self._make_room()
        self._next_check = self.loop.call_later(self.check_every_s, self._check)

    def _make_room(self) -> None:
        ours = [one for one in self.connections if isinstance(one, PatientProtocol)]
        # One that was let go is here until the loop comes round, also in a burst of new ones.
        staying = [one for one in ours if not one.transport.is_closing()]
        if len(self.connections) - len(ours) + len(staying) <= self.connections_max:
            return
        silent = [one for one in staying if one.is_silent and one is not self]
        sending = [one for one in staying if one.waits_for_body]
        longest = min(silent, key=lambda one: one.silent_since_s, default=None) or min(
            sending, key=lambda one: one.last_received_s, default=self
        )
        longest.transport.close()

    def data_received(self, data: bytes) -> None:
        """Note that the other end is alive."""
        self.last_received_s = self.loop.time()
        super().data_received(data)

    def pause_writing(self) -> None:
        """Note since when nothing more of an answer is taken."""
        self.unread_since_s = self.loop.time()
        super().pause_writing()

    def resume_writing(self) -> None:
        """Something was taken."""
        self.unread_since_s = None
        super().resume_writing()

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the timer."""
        if self._next_check is not None:
            self._next_check.cancel()
        super().connection_lost(exc)

    @property
    def is_silent(self) -> bool:
        """Whether no request is under way."""
        return self.conn.their_state is h11.IDLE

    @property
    def waits_for_body(self) -> bool:
        """Whether a request has begun and the other end is to send the rest of it."""
        return self.conn.their_state is h11.SEND_BODY

    def _check(self) -> None:
        now_s = self.loop.time()
        if self.transport.is_closing() or self.transport.get_protocol() is not self:
            # Gone, or a WebSocket by now, which has pings of its own.
            return
        if not self.is_silent or self.scope is not self._last:
            self._last = self.scope
            self.silent_since_s = now_s
        if self.flow.read_paused:
            # It is we who do not listen.
            self.last_received_s = now_s
        if self.unread_since_s is not None and now_s - self.unread_since_s >= self.read_s:
            # What is left to send would keep it open.
            self.transport.abort()
            return
        if now_s - self.silent_since_s >= self.head_s or (
            self.waits_for_body and now_s - self.last_received_s >= self.body_s
        ):
            self.transport.close()
            return
        self._next_check = self.loop.call_later(self.check_every_s, self._check)
