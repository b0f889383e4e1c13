"""WebSockets: as long as who opened one may have what it shows, and never all the room there is.

A request is asked for its permission once, a socket stays. So its caller is looked at again while
it is open: whoever signed out, was disabled, has another role or key is shown nothing more.
"""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager

from fastapi import WebSocket
from starlette.concurrency import run_in_threadpool

from backend.core.person import Caller
from backend.errors import SpindleError
from backend.web.authentication import Authenticator
from backend.web.connections import CONNECTIONS_MAX
from backend.web.permissions import address_of, caller_of, operation_of

CHECK_EVERY_S = 2.0
# The rest is kept for requests: pages, signing in, health.
OPEN_MAX = CONNECTIONS_MAX * 3 // 4
# A workshop's wall of screens on one account.
OF_ONE_MAX = 128
# Application codes, beside 4404 of a unit that is not there.
CLOSE_NOT_ALLOWED, CLOSE_TOO_MANY = 4403, 4429


class OpenSockets:
    """How many sockets are open and whose they are; used on the event loop alone."""

    def __init__(self) -> None:
        self._of: Counter[str] = Counter()

    @contextmanager
    def place(self, socket: WebSocket) -> Iterator[bool]:
        """Whether there is room for one more of its caller, who has it inside."""
        whose = owner_of(socket)
        has_room = self._of.total() < OPEN_MAX and self._of[whose] < OF_ONE_MAX
        self._of[whose] += has_room
        try:
            yield has_room
        finally:
            self._of[whose] -= has_room
            self._of += Counter()


def owner_of(socket: WebSocket) -> str:
    """The account of a socket; its address on a server that asks nobody."""
    caller = caller_of(socket)
    if caller is not None:
        return f"account {caller.person.id}"
    return address_of(socket)


async def until_not_allowed(socket: WebSocket) -> None:
    """Returns when its caller may no longer have what the socket shows; else never."""
    authenticator: Authenticator | None = socket.app.state.authenticator
    caller = caller_of(socket)
    needed = socket.app.state.needed[operation_of(socket)]
    if authenticator is None or caller is None:
        # Nobody is asked to sign in.
        await asyncio.Event().wait()
        return
    while True:
        await asyncio.sleep(CHECK_EVERY_S)
        now = await run_in_threadpool(caller_now, authenticator, caller)
        if now is None or needed not in now.permissions:
            return


def caller_now(authenticator: Authenticator, caller: Caller) -> Caller | None:
    """A caller as they are now. A store that does not answer signs nobody out."""
    try:
        return authenticator.renewed(caller)
    except SpindleError:
        return caller
