"""The thread of a port outlives what happens to port, unit and listeners, and ends when told.

The port is a memory link or a real pseudo-terminal; the unit is the small honest one. Nothing is
timed: tests wait for events.
"""

from __future__ import annotations

import logging
import os
import select
import threading
import tty
from collections.abc import Iterator
from types import SimpleNamespace

import pytest

from backend.device.driver import Driver
from backend.device.ebl.operations.config_transaction import read_config
from backend.device.ebl.session.operation import query
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.link.opening import Opener
from backend.device.link.ports import pyserial_ports
from backend.device.states import LinkState, StateChanged
from backend.device.stream import StreamBlock, StreamStarted
from backend.errors import LinkError, NoAnswer
from firmware_protocol._generated import CfgInfoRequest, CfgInfoResponse, MessageId
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import Heard, UnitOpener, ebl_driver


@pytest.fixture
def heard() -> Heard:
    return Heard()


@pytest.fixture
def opener() -> UnitOpener:
    return UnitOpener(FakeUnit())


@pytest.fixture
def driver(opener: UnitOpener, heard: Heard) -> Iterator[Driver]:
    driver = ebl_driver(opener, heard, StreamPlan(batch=5))
    yield driver
    driver.close()


@pytest.mark.slow
def test_a_listener_hears_the_state_and_then_the_rows(driver: Driver, heard: Heard) -> None:
    driver.start()

    heard.wait_for(StateChanged, state=LinkState.READY)
    heard.wait_for(StreamStarted)
    block = heard.wait_for(StreamBlock, count=3)

    assert isinstance(block, StreamBlock)
    assert block.first_index == 10
    assert abs(block.wall_us / 1e6 - 1.7e9) < 1e9


def test_any_thread_can_ask_and_gets_the_answer(driver: Driver, heard: Heard) -> None:
    driver.start()
    heard.wait_for(StateChanged, state=LinkState.READY)

    assert driver.run(read_config(), timeout_s=10.0).generation == 7


def test_many_threads_can_ask_at_once(driver: Driver, heard: Heard) -> None:
    driver.start()
    heard.wait_for(StateChanged, state=LinkState.READY)
    generations: list[int] = []

    def work() -> None:
        generations.append(driver.run(read_config(), timeout_s=20.0).generation)

    threads = [threading.Thread(target=work) for _ in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

    assert generations == [7] * 12


def test_a_result_that_is_late_is_not_called_undone(
    driver: Driver, opener: UnitOpener, heard: Heard
) -> None:
    driver.start()
    heard.wait_for(StateChanged, state=LinkState.READY)
    opener.unit.silent = True  # type: ignore[attr-defined]

    with pytest.raises(NoAnswer, match="no result within") as caught:
        driver.run(read_config(), 0.05)

    assert caught.value.code == "no_result"


def test_asking_a_unit_that_is_not_there_gives_the_reason(
    driver: Driver, opener: UnitOpener
) -> None:
    opener.unplug()
    driver.start()
    driver.probed.wait(10.0)

    with pytest.raises(NoAnswer, match="no such port"):
        driver.run(query(CfgInfoRequest(), CfgInfoResponse), timeout_s=10.0)


@pytest.mark.slow
def test_a_listener_that_fails_is_logged_and_the_thread_goes_on(
    opener: UnitOpener, heard: Heard, caplog: pytest.LogCaptureFixture
) -> None:
    def broken(event: object) -> None:
        heard(event)
        raise ValueError("a listener's fault")

    driver = ebl_driver(opener, broken, StreamPlan(batch=5))
    with caplog.at_level(logging.ERROR):
        driver.start()
        heard.wait_for(StreamBlock, count=5)
        driver.close()

    assert "a listener's fault" in caplog.text


def test_a_fault_of_ours_is_logged_and_the_port_is_opened_anew(
    opener: UnitOpener, driver: Driver, heard: Heard, caplog: pytest.LogCaptureFixture
) -> None:
    driver.start()
    heard.wait_for(StateChanged, state=LinkState.READY)

    with caplog.at_level(logging.ERROR):
        opener.links[0].read = lambda bytes_max=0: 1 // 0  # type: ignore[method-assign]
        heard.wait_for(StateChanged, count=2, state=LinkState.READY)

    assert "a fault in Spindle" in caplog.text
    assert opener.links[0].closed


@pytest.mark.slow
def test_a_vanished_port_is_opened_again_when_it_returns(
    opener: UnitOpener, driver: Driver, heard: Heard
) -> None:
    driver.start()
    heard.wait_for(StreamBlock, count=2)

    opener.unplug()
    heard.wait_for(StateChanged, state=LinkState.LOST)
    opener.tried.wait(10.0)
    opener.plug_in()
    heard.wait_for(StateChanged, count=2, state=LinkState.READY)
    heard.wait_for(StreamStarted, epoch=2)

    assert opener.links[0].closed
    assert driver.status().statistics.connections == 2


@pytest.mark.slow
def test_a_port_that_is_open_and_silent_is_opened_anew(
    opener: UnitOpener, driver: Driver, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("backend.device.driver.HANDSHAKES_BEFORE_REOPEN", 1)
    opener.unit.silent = True  # type: ignore[attr-defined]
    driver.start()
    driver.probed.wait(10.0)
    opener.tried.clear()

    assert opener.tried.wait(10.0)


def test_closing_says_goodbye_and_gives_the_port_back(
    opener: UnitOpener, driver: Driver, heard: Heard
) -> None:
    driver.start()
    heard.wait_for(StateChanged, state=LinkState.READY)

    driver.close()
    unit = opener.unit
    unit.receive(opener.links[0].heard())

    assert unit.executed[-1] is MessageId.BYE  # type: ignore[attr-defined]
    assert opener.links[0].closed
    heard.wait_for(StateChanged, state=LinkState.CLOSED)


def test_what_is_asked_after_the_end_is_refused(driver: Driver, heard: Heard) -> None:
    driver.start()
    heard.wait_for(StateChanged, state=LinkState.READY)
    driver.close()

    with pytest.raises((NoAnswer, LinkError)):
        driver.run(read_config(), timeout_s=0.2)


class PtyUnit:
    """A fake unit that serves a pseudo-terminal from a thread of its own."""

    def __init__(self, unit: FakeUnit) -> None:
        self.master, slave = os.openpty()
        tty.setraw(self.master)
        self.path = os.ttyname(slave)
        self._slave = slave
        self._unit = unit
        self._end, self._ask_to_end = os.pipe()
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    def stop(self) -> None:
        os.write(self._ask_to_end, b"x")
        self._thread.join()
        for descriptor in (self.master, self._slave, self._end, self._ask_to_end):
            os.close(descriptor)

    def _serve(self) -> None:
        while True:
            ready, _, _ = select.select([self.master, self._end], [], [], 0.010)
            if self._end in ready:
                return
            if self.master in ready:
                self._unit.receive(os.read(self.master, 65536))
            self._unit.advance(0.010)
            os.write(self.master, self._unit.transmit())


@pytest.mark.slow
def test_a_unit_on_a_pseudo_terminal_vanishes_with_it_and_is_ready_again_on_the_next(
    heard: Heard, tmp_path: os.PathLike[str]
) -> None:
    port = os.path.join(tmp_path, "port")  # noqa: PTH118
    unit = FakeUnit()
    served = PtyUnit(unit)
    os.symlink(served.path, port)  # noqa: PTH211
    driver = ebl_driver(Opener(port), heard, StreamPlan(batch=5))
    driver.start()
    heard.wait_for(StreamBlock, count=3)

    served.stop()
    heard.wait_for(StateChanged, state=LinkState.LOST)
    served = PtyUnit(unit)
    os.unlink(port)  # noqa: PTH108
    os.symlink(served.path, port)  # noqa: PTH211
    heard.wait_for(StateChanged, count=2, state=LinkState.READY)
    heard.wait_for(StreamBlock, epoch=2)

    driver.close()
    served.stop()


@pytest.mark.slow
def test_a_unit_whose_adapter_came_back_under_another_name_is_taken_up_again(
    heard: Heard, monkeypatch: pytest.MonkeyPatch
) -> None:
    before, after = PtyUnit(FakeUnit()), PtyUnit(FakeUnit())
    plugged = [SimpleNamespace(device=before.path, serial_number="ours")]
    monkeypatch.setattr(pyserial_ports, "comports", lambda: list(plugged))
    driver = ebl_driver(Opener(before.path), heard, StreamPlan(batch=5))
    driver.start()
    heard.wait_for(StreamBlock, count=3)

    plugged.clear()
    before.stop()
    heard.wait_for(StateChanged, state=LinkState.LOST)
    plugged.append(SimpleNamespace(device=after.path, serial_number="ours"))
    heard.wait_for(StateChanged, count=2, state=LinkState.READY)
    heard.wait_for(StreamBlock, epoch=2)

    driver.close()
    after.stop()
