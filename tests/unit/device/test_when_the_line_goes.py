"""Goal: whatever happens to the line, the device's state says so in time and it ends by itself.

Method: a session and a small honest unit in virtual time; the times are those that
docs/life-of-a-packet.md promises, read from its table. Only the half-open TCP connection is a real
one: the far end keeps it and never reads again, as a router that was switched off does.
"""

from __future__ import annotations

import contextlib
import re
import select
import socket
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.device.driver import REOPEN_S_MAX
from backend.device.ebl.session.session import Session
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.link.opening import Opener
from backend.device.states import LinkState, StateChanged
from backend.device.stream import StreamBlock
from backend.errors import LinkError
from tests.fakes.bench import Bench
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import Heard, ebl_driver

PAGE = Path(__file__).resolve().parents[3] / "docs" / "life-of-a-packet.md"


def promised_s(what: str) -> tuple[float, float]:
    """After how many seconds the page says it is known, and ready again after its end."""
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if cells[1:2] == [what]:
            known, back = (re.match(r"[0-9.]+", cell) for cell in cells[3:5])
            return float(known.group()) if known else 0.1, float(back.group()) if back else 0.1
    raise AssertionError(f"{PAGE.name} says nothing of: {what}")


@pytest.fixture
def unit() -> FakeUnit:
    return FakeUnit()


@pytest.fixture
def bench(unit: FakeUnit) -> Bench:
    """Connected and streaming."""
    bench = Bench(unit, StreamPlan()).connect()
    bench.run(5.0)
    return bench


def is_in(session: Session, state: LinkState) -> bool:
    return session.state is state


def test_a_vanished_port(bench: Bench) -> None:
    detected_s, back_s = promised_s("the port vanishes")

    bench.session.port_failed(bench.now_s, LinkError("ttyUSB0: the port vanished."))
    bench.run_until(lambda: is_in(bench.session, LinkState.LOST), detected_s)
    bench.run(20.0)
    bench.open_port(b"87654321")

    bench.run_until(lambda: is_in(bench.session, LinkState.READY), back_s - REOPEN_S_MAX)


def test_a_unit_that_stops_answering(bench: Bench, unit: FakeUnit) -> None:
    detected_s, back_s = promised_s("the unit stops answering")

    unit.silent = True
    bench.run_until(lambda: is_in(bench.session, LinkState.LOST), detected_s + 0.02)
    assert "stopped answering" in bench.session.reason
    bench.run(20.0)
    unit.silent = False

    bench.run_until(lambda: is_in(bench.session, LinkState.READY), back_s)


def test_a_unit_that_is_heard_and_does_not_hear(bench: Bench) -> None:
    detected_s, back_s = promised_s("only what the unit says still comes through")

    bench.to_unit = lambda data: b""
    bench.run_until(lambda: is_in(bench.session, LinkState.LOST), detected_s)
    assert bench.session.reason
    bench.run(20.0)
    bench.to_unit = lambda data: data

    bench.run_until(lambda: is_in(bench.session, LinkState.READY), back_s)


@pytest.mark.parametrize("tell", [True, False])
def test_a_unit_that_starts_again(bench: Bench, unit: FakeUnit, tell: bool) -> None:
    lost_boot = "" if tell else " and its BOOT is lost"
    detected_s, back_s = promised_s(f"the unit starts again{lost_boot}")
    before = len(bench.states())

    unit.restart(tell=tell)
    bench.run_until(lambda: LinkState.CONNECTING in bench.states()[before:], detected_s)

    bench.run_until(lambda: is_in(bench.session, LinkState.READY), back_s)
    assert bench.session.handshake is not None
    assert bench.session.handshake.identity.boot_id == 2


class TcpUnit:
    """A unit behind a TCP port that forgets the connections it has when told to."""

    def __init__(self) -> None:
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        self._kept: list[socket.socket] = []
        self._host: socket.socket | None = None
        self._forget = threading.Event()
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    def half_open(self) -> None:
        """From now on nobody reads or writes what is connected; it stays connected."""
        self._forget.set()

    def close(self) -> None:
        self._end.set()
        self._thread.join()
        for connection in (self._listener, *self._kept):
            connection.close()

    def _serve(self) -> None:
        unit = FakeUnit()
        while not self._end.is_set():
            if self._forget.is_set():
                self._forget.clear()
                self._host = None
            watched = [self._listener] if self._host is None else [self._host]
            ready, _, _ = select.select(watched, [], [], 0.010)
            unit.advance(0.010)
            if self._listener in ready:
                self._host = self._listener.accept()[0]
                self._kept.append(self._host)
            elif ready and self._host is not None:
                with contextlib.suppress(ConnectionError):
                    unit.receive(self._host.recv(65536))
            said = unit.transmit()
            if said and self._host is not None:
                with contextlib.suppress(ConnectionError):
                    self._host.sendall(said)


@pytest.fixture
def far_unit() -> Iterator[TcpUnit]:
    unit = TcpUnit()
    yield unit
    unit.close()


@pytest.mark.slow
def test_a_half_open_connection_is_noticed_and_made_anew(far_unit: TcpUnit) -> None:
    heard = Heard()
    driver = ebl_driver(Opener(f"socket://127.0.0.1:{far_unit.port}"), heard, StreamPlan(batch=5))
    driver.start()
    heard.wait_for(StreamBlock, count=3)

    far_unit.half_open()

    lost = heard.wait_for(StateChanged, state=LinkState.LOST)
    assert isinstance(lost, StateChanged)
    assert "stopped answering" in lost.reason
    heard.wait_for(StateChanged, count=2, state=LinkState.READY)
    heard.wait_for(StreamBlock, epoch=2)
    driver.close()
