"""The TLS handshake of each connection, before anything else is read of it.

uvicorn would leave this to the event loop, which waits a minute and counts no such connection: as
many as a stranger likes to open would use up the process's file descriptors. Here those who are
silent are let go as anywhere else, and count among the connections that may be open. Who speaks
plain HTTP to this port is no fault of the server's, and is written nowhere.
"""

from __future__ import annotations

import asyncio
import ssl
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any

from backend.web.connections import CONNECTIONS_MAX, HEAD_S, PatientProtocol

# The other end may be gone without a word.
GOODBYE_S = 2.0


class TlsHandshake(asyncio.Protocol):
    """One connection before its handshake; after it, `behind` has the connection.

    named: what uvicorn gives to each of its connections.
    """

    handshake_s = HEAD_S
    connections_max = CONNECTIONS_MAX

    def __init__(
        self, context: ssl.SSLContext, behind: Callable[..., PatientProtocol], **named: Any
    ) -> None:
        self._context = context
        self._behind = partial(behind, **named)
        # uvicorn's own: it closes what is in there when it stops.
        self._connections: set[Any] = named["server_state"].connections
        self._loop = asyncio.get_running_loop()
        self._received = bytearray()
        self._is_lost = False
        self._shaking: asyncio.Task[None] | None = None
        self.since_s = self._loop.time()
        self.transport: asyncio.Transport | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Begin to shake hands; where there are too many, who waits longest goes."""
        assert isinstance(transport, asyncio.Transport)
        self.transport = transport
        self._connections.add(self)
        if len(self._connections) > self.connections_max:
            self._make_room()
        self._shaking = self._loop.create_task(self._shake_hands(transport))

    def data_received(self, data: bytes) -> None:
        """Keep what came right behind the handshake."""
        self._received += data

    def connection_lost(self, exc: Exception | None) -> None:
        """There is nobody any more to be handed on."""
        self._is_lost = True

    def shutdown(self) -> None:
        """End it, as uvicorn asks of each connection when it stops."""
        if self.transport is not None:
            self.transport.abort()

    @property
    def is_leaving(self) -> bool:
        """Whether it was let go already, and is here until the loop comes round."""
        return self.transport is None or self.transport.is_closing()

    def _make_room(self) -> None:
        waiting = [one for one in self._connections if isinstance(one, TlsHandshake)]
        others = [one for one in waiting if one is not self and not one.is_leaving]
        longest = min(others, key=lambda one: one.since_s, default=None)
        if longest is not None:
            longest.shutdown()

    async def _shake_hands(self, transport: asyncio.Transport) -> None:
        encrypted = None
        try:
            # Plain HTTP, a phone that trusts no such certificate, silence: none is worth a word.
            with suppress(OSError):
                encrypted = await self._loop.start_tls(
                    transport,
                    self,
                    self._context,
                    server_side=True,
                    ssl_handshake_timeout=self.handshake_s,
                    ssl_shutdown_timeout=GOODBYE_S,
                )
        finally:
            self._connections.discard(self)
        if encrypted is None or self._is_lost:
            return
        protocol = self._behind()
        encrypted.set_protocol(protocol)
        protocol.connection_made(encrypted)
        if self._received:
            protocol.data_received(bytes(self._received))
