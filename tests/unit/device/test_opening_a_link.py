"""A url leads to the right transport, and a port that does not open says why and what to do."""

from __future__ import annotations

import os
import socket
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from backend.device.link import kind_of, list_ports, open_link, ports
from backend.device.link.opening import Opener
from backend.device.link.port_errors import cannot_open
from backend.device.link.ports import pyserial_ports
from backend.device.link.serial_port import SerialPort
from backend.device.link.simulated import SimulatedAddress, SimulatedLink
from backend.errors import InvalidRequest, LinkError


@pytest.mark.parametrize(
    ("url", "kind"),
    [
        ("sim", "simulated"),
        ("sim:workshop?seed=3&clock=virtual&scenario=commute", "simulated"),
        ("socket://127.0.0.1:9000", "socket"),
        ("/dev/ttyUSB0", "serial"),
        ("/dev/ttyUSB0?baud=921600", "serial"),
        ("COM3", "serial"),
    ],
)
def test_the_url_tells_the_transport(url: str, kind: str) -> None:
    assert kind_of(url) == kind


@pytest.mark.parametrize(
    "url",
    [
        "",
        "http://bike",
        "socket://bike",
        "socket://:80",
        "sim:a?sped=2",
        "sim:a?seed=x",
        "sim:a?seed=-1",
        "sim:a?seed=18446744073709551616",
        "socket://.bike:80",
        f"socket://{'b' * 64}:80",
        "COM3?baud=9",
    ],
)
def test_a_url_that_leads_nowhere_is_refused(url: str) -> None:
    with pytest.raises(InvalidRequest):
        kind_of(url)


@given(st.text(max_size=400) | st.text(max_size=390).map("socket://{}:80".format))
@example("x" * 400)
@example("/dev/" + "x" * 300)
@example("socket://a..b:80")
@example("/dev/\0")
def test_any_text_is_a_way_or_is_refused_and_nothing_else_happens(url: str) -> None:
    try:
        assert kind_of(url) in ("simulated", "socket", "serial")
    except InvalidRequest:
        return


def test_what_may_not_be_looked_at_is_tried_as_a_port(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def forbidden(name: object, **_: object) -> None:
        raise PermissionError(13, "Permission denied", name)

    monkeypatch.setattr("os.stat", forbidden)

    assert kind_of("/root/bike") == "serial"


def test_two_names_are_two_simulated_units_and_one_name_is_always_the_same() -> None:
    left, right = SimulatedAddress.parse("sim:left"), SimulatedAddress.parse("sim:right")

    assert left.seed != right.seed
    assert left == SimulatedAddress.parse("sim:left")


@pytest.mark.parametrize("market", ["JAPAN", "japan"])
def test_a_market_is_another_memory_in_whatever_case_it_is_asked_for(market: str) -> None:
    made_for_one = SimulatedAddress.parse(f"sim:tokyo?seed=1&market={market}")

    assert made_for_one.memory_name == "unit-1-JAPAN.flash"
    assert SimulatedAddress.parse("sim:tokyo?seed=1").memory_name == "unit-1.flash"
    nobody = SimulatedAddress.parse("sim:tokyo?seed=1&market=none")
    assert nobody.memory_name == "unit-1-none.flash"


def test_an_absent_port_says_so_and_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(LinkError, match=r"no such port.*Plug the unit in") as caught:
        open_link(str(tmp_path / "ttyUSB7"))

    assert caught.value.code == "port_absent"


def test_a_port_that_is_already_open_says_another_program_has_it() -> None:
    master, slave = os.openpty()
    first = SerialPort(os.ttyname(slave))

    with pytest.raises(LinkError, match="another program has it open") as caught:
        open_link(os.ttyname(slave))

    assert caught.value.code == "port_busy"
    first.close()
    os.close(master)
    os.close(slave)


def test_a_forbidden_port_names_the_group() -> None:
    error = cannot_open("/dev/ttyUSB0", PermissionError(13, "Permission denied"))

    assert "dialout" in error.message
    assert error.code == "port_permission"


def test_a_host_where_nothing_listens_says_so() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]

    with pytest.raises(LinkError, match="nothing listens there"):
        open_link(f"socket://127.0.0.1:{port}")


def test_the_list_of_ports_always_offers_a_simulated_unit() -> None:
    assert list_ports()[-1].url == "sim"


@pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals are POSIX")
def test_the_list_of_ports_says_with_a_word_what_stands_in_the_way(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    gone = str(tmp_path / "ttyUSB0")  # what is not there may not be opened either
    pair = os.openpty()
    adapter = {"description": None, "manufacturer": None, "vid": None, "pid": None}
    plugged = [
        SimpleNamespace(device=at, serial_number=None, **adapter)
        for at in (os.ttyname(pair[1]), gone)
    ]
    monkeypatch.setattr(pyserial_ports, "comports", lambda: plugged)
    try:
        found = {port.url: port.hint_code for port in list_ports()}
        assert found == {gone: "port_permission", plugged[0].device: None, "sim": None}

        monkeypatch.setattr(ports, "_open_devices", lambda: {os.path.realpath(os.ttyname(pair[1]))})
        found = {port.url: port.hint_code for port in list_ports()}
        assert found[plugged[0].device] == "port_busy"
    finally:
        for end in pair:
            os.close(end)


def child(program: str) -> list[str]:
    return [sys.executable, "-c", program]


def test_a_simulator_that_dies_at_start_is_quoted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        SimulatedAddress,
        "command",
        lambda self, path: child("raise SystemExit('no such scenario')"),
    )

    with pytest.raises(LinkError, match="no such scenario") as caught:
        SimulatedLink("sim")

    assert caught.value.code == "simulator_failed"


def test_the_simulator_ends_with_its_link(monkeypatch: pytest.MonkeyPatch) -> None:
    program = (
        "import os, sys, tty, signal\n"
        "master, slave = os.openpty(); tty.setraw(master)\n"
        "print('ready', os.ttyname(slave), flush=True)\n"
        "while True: os.write(master, os.read(master, 100))\n"
    )
    monkeypatch.setattr(SimulatedAddress, "command", lambda self, path: child(program))
    link = SimulatedLink("sim")
    process_id = link.process_id

    link.close()

    with pytest.raises(ProcessLookupError):
        os.kill(process_id, 0)


def test_a_plain_file_is_no_serial_port(tmp_path: Path) -> None:
    notes = tmp_path / "notes"
    notes.write_text("precious")

    with pytest.raises(InvalidRequest, match="no serial port"):
        kind_of(str(notes))


@pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals are POSIX")
def test_an_adapter_is_known_by_its_serial_number_and_not_by_its_name(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pairs = [os.openpty(), os.openpty()]
    first, second = (os.ttyname(slave) for _, slave in pairs)
    plugged: dict[str, str] = {}
    monkeypatch.setattr(
        pyserial_ports,
        "comports",
        lambda: [SimpleNamespace(device=at, serial_number=who) for at, who in plugged.items()],
    )
    opener = Opener(first)
    try:
        plugged[first] = "ours"
        opener.open().close()

        plugged = {second: "ours", first: "another"}
        renamed = opener.open()
        os.write(pairs[1][0], b"hello")
        assert renamed.read() == b"hello"
        renamed.close()

        plugged = {first: "another"}
        with pytest.raises(LinkError, match="another adapter has this name now") as caught:
            opener.open()
        assert caught.value.code == "port_absent"
    finally:
        for descriptor in (end for pair in pairs for end in pair):
            os.close(descriptor)


def test_a_simulator_that_ends_later_is_quoted_too(monkeypatch: pytest.MonkeyPatch) -> None:
    program = (
        "import os, sys, tty\n"
        "master, slave = os.openpty(); tty.setraw(master)\n"
        "print('ready', os.ttyname(slave), flush=True)\n"
        "os.read(master, 1)\n"
        "raise SystemExit('the flash cannot be written')\n"
    )
    monkeypatch.setattr(SimulatedAddress, "command", lambda self, path: child(program))
    link = SimulatedLink("sim")

    def read_on() -> None:
        while True:
            link.read()

    try:
        link.write(b"x")
        with pytest.raises(
            LinkError, match="ended with code 1: the flash cannot be written"
        ) as caught:
            read_on()
    finally:
        link.close()

    assert caught.value.code == "simulator_failed"
