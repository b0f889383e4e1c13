"""Goal: one account's sockets leave room for everybody's, and all sockets leave room for requests.

Method: places as the application gives them, for sockets that are only who opened them.
"""

from __future__ import annotations

from contextlib import ExitStack
from datetime import UTC, datetime
from typing import cast

from fastapi import WebSocket
from starlette.types import Receive, Send

from backend.core.person import Caller, Person
from backend.web.connections import CONNECTIONS_MAX
from backend.web.sockets import OF_ONE_MAX, OPEN_MAX, OpenSockets


def socket_of(number: int | None, address: str = "10.0.0.1") -> WebSocket:
    """A socket of an account, or of an address where nobody signs in."""
    state = {}
    if number is not None:
        person = Person(number, f"person {number}", "dealer", True, datetime.now(UTC))
        state["caller"] = Caller(person, person.permissions)
    scope = {"type": "websocket", "state": state, "client": (address, 1), "headers": []}
    return WebSocket(scope, receive=cast(Receive, None), send=cast(Send, None))


def test_an_account_has_its_share_and_no_more() -> None:
    sockets = OpenSockets()
    with ExitStack() as held:
        mine = [held.enter_context(sockets.place(socket_of(1))) for _ in range(OF_ONE_MAX + 5)]
        other = held.enter_context(sockets.place(socket_of(2)))

        assert mine == [True] * OF_ONE_MAX + [False] * 5
        assert other
    with sockets.place(socket_of(1)) as again:
        assert again


def test_where_nobody_signs_in_an_address_has_its_share() -> None:
    sockets = OpenSockets()
    with ExitStack() as held:
        for _ in range(OF_ONE_MAX):
            held.enter_context(sockets.place(socket_of(None)))

        assert not held.enter_context(sockets.place(socket_of(None)))
        assert held.enter_context(sockets.place(socket_of(None, "10.0.0.2")))


def test_sockets_never_take_the_room_of_requests() -> None:
    sockets = OpenSockets()
    with ExitStack() as held:
        places = [
            held.enter_context(sockets.place(socket_of(number))) for number in range(OPEN_MAX + 1)
        ]

        assert places == [True] * OPEN_MAX + [False]
    assert OPEN_MAX < CONNECTIONS_MAX
