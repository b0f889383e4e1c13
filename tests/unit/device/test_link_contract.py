"""Every transport keeps one contract, the fake of the other tests included.

Each way is opened with its far end in the test's hand: a pseudo-terminal pair through pyserial, a
TCP pair, the link in memory. None may wait, change a byte or spin on a full buffer.
"""

from __future__ import annotations

import os
import socket
import time
import tty
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import pytest

from backend.device.link import Link
from backend.device.link.serial_port import SerialPort
from backend.device.link.socket_link import SocketLink
from backend.errors import LinkError
from tests.fakes.unit_link import MemoryLink

EVERY_BYTE = bytes(range(256))
PATIENCE_S = 5.0


@dataclass
class Wire:
    """A link and what its far end can do."""

    link: Link
    say: Callable[[bytes], object]
    hear: Callable[[], bytes]
    vanish: Callable[[], object]


def pty_wire() -> Iterator[Wire]:
    master, slave = os.openpty()
    tty.setraw(master)
    os.set_blocking(master, False)
    link = SerialPort(os.ttyname(slave), has_line=False)
    os.close(slave)
    far = os.fdopen(master, "r+b", buffering=0)
    yield Wire(link, far.write, lambda: far.read(65536) or b"", far.close)
    link.close()
    far.close()


def tcp_wire() -> Iterator[Wire]:
    with socket.create_server(("127.0.0.1", 0)) as server:
        link = SocketLink("127.0.0.1", server.getsockname()[1])
        far, _ = server.accept()
        far.setblocking(False)

        def hear() -> bytes:
            try:
                return far.recv(65536)
            except BlockingIOError:
                return b""

        yield Wire(link, far.send, hear, far.close)
        link.close()
        far.close()


def memory_wire() -> Iterator[Wire]:
    link = MemoryLink()
    yield Wire(link, link.say, link.heard, link.vanish)


@pytest.fixture(params=[pty_wire, tcp_wire, memory_wire])
def wire(request: pytest.FixtureRequest) -> Iterator[Wire]:
    yield from request.param()


def collect(take: Callable[[], bytes], count: int) -> bytes:
    """What `take` gives until `count` bytes are there or patience ends."""
    data, deadline = b"", time.monotonic() + PATIENCE_S
    while len(data) < count and time.monotonic() < deadline:
        data += take()
    return data


def test_reading_a_silent_link_gives_nothing_at_once(wire: Wire) -> None:
    assert wire.link.read() == b""


def test_every_byte_value_arrives_unchanged(wire: Wire) -> None:
    wire.say(EVERY_BYTE)

    assert collect(wire.link.read, 256) == EVERY_BYTE


def test_every_byte_value_is_sent_unchanged(wire: Wire) -> None:
    assert wire.link.write(EVERY_BYTE) == 256

    assert collect(wire.hear, 256) == EVERY_BYTE


def test_a_read_takes_no_more_than_it_was_allowed(wire: Wire) -> None:
    wire.say(EVERY_BYTE)

    first = collect(lambda: wire.link.read(10), 10)

    assert first == EVERY_BYTE[:10]
    assert collect(wire.link.read, 246) == EVERY_BYTE[10:]


def test_a_full_line_takes_nothing_more_and_does_not_wait(wire: Wire) -> None:
    block = bytes(65536)
    for _ in range(200):
        taken = wire.link.write(block)
        if taken == 0:
            break

    assert taken == 0


def test_what_a_full_line_took_is_what_arrives(wire: Wire) -> None:
    taken = []
    while not taken or taken[-1]:
        taken.append(wire.link.write(bytes(65536)))

    arrived = collect(wire.hear, sum(taken))

    assert len(arrived) == sum(taken)
    assert wire.hear() == b""


def test_a_vanished_far_end_is_an_error_in_words(wire: Wire) -> None:
    wire.vanish()

    with pytest.raises(LinkError, match="vanished"):
        collect(wire.link.read, 1)


def test_closing_twice_is_allowed(wire: Wire) -> None:
    wire.link.close()
    wire.link.close()
