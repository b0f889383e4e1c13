"""Goal: the simulated unit is a process that a host opens like hardware, and that leaves politely.

Method: real child processes, a real pseudo-terminal through pyserial and a real socket; every wait
has a bound. Pacing is checked apart, with invented times.
"""

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import serial

from sim_device.flash_file import FlashFile
from sim_device.serial_line import PtyLine
from sim_device.simulator import Pace

# Processes, compilers or hundreds of files: left out of `make test-fast`.
pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[3]
WAIT_S = 20.0
POLL_S = 0.02

# The golden frame of protocol.md 4.1, and how every answer to it begins: major 1, response, tid 1.
HELLO = bytes.fromhex("0004200101030101010102020c010203040506072c8a749000")
ANSWER_START = bytes.fromhex("000428")

posix = pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals are POSIX")


def eventually(what: Callable[[], bool]) -> bool:
    end_s = time.monotonic() + WAIT_S
    while time.monotonic() < end_s:
        if what():
            return True
        time.sleep(POLL_S)
    return False


@contextmanager
def simulator(*words: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """The process and what it says it is ready on."""
    command = [sys.executable, "-m", "sim_device", "unit", *words]
    child = subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        assert child.stdout is not None
        word, _, address = child.stdout.readline().strip().partition(" ")
        assert word == "ready", child.stderr.read() if child.stderr else ""
        yield child, address
    finally:
        child.kill()
        child.communicate()


def says_hello(port: serial.Serial) -> bool:
    port.write(HELLO)
    port.timeout = WAIT_S
    answer = port.read_until(b"\x00", 1) + port.read_until(b"\x00")
    return bool(answer.startswith(ANSWER_START))


@posix
def test_a_host_opens_the_pty_like_a_port_and_may_come_back(tmp_path: Path) -> None:
    link = tmp_path / "bike"
    with simulator("--pty", str(link), "--scenario", "none") as (_, address):
        assert address == str(link)
        for _ in range(2):
            with serial.Serial(address, 115200) as port:
                port.reset_input_buffer()
                assert says_hello(port)


@posix
def test_several_units_share_a_process_and_nothing_else(tmp_path: Path) -> None:
    link, flash = tmp_path / "bike", tmp_path / "flash"
    words = ("--pty", str(link), "--flash", str(flash), "--count", "3")
    with simulator(*words, "--scenario", "none") as (child, address):
        assert child.stdout is not None
        addresses = [address, *(child.stdout.readline().split()[1] for _ in range(2))]
        assert addresses == [str(link), f"{link}-2", f"{link}-3"]
        hellos = set()
        for each in addresses:
            with serial.Serial(each, 115200, timeout=WAIT_S) as port:
                port.reset_input_buffer()
                port.write(HELLO)
                hellos.add(port.read_until(b"\x00", 1) + port.read_until(b"\x00"))
        assert len(hellos) == 3
    assert {path.name for path in tmp_path.glob("flash*")} == {"flash", "flash-2", "flash-3"}


@posix
def test_sigterm_ends_the_process_and_takes_the_link_away(tmp_path: Path) -> None:
    link = tmp_path / "bike"
    with simulator("--pty", str(link)) as (child, _):
        child.send_signal(signal.SIGTERM)

        assert child.wait(WAIT_S) == 0
        assert not link.is_symlink()


@posix
def test_the_unit_dies_with_its_parent(tmp_path: Path) -> None:
    link = tmp_path / "bike"
    parent = (
        "import subprocess, sys\n"
        f"words = [sys.executable, '-m', 'sim_device', 'unit', '--pty', {str(link)!r}]\n"
        "child = subprocess.Popen(words, stdout=subprocess.PIPE)\n"
        "child.stdout.readline()\n"
    )

    subprocess.run([sys.executable, "-c", parent], cwd=ROOT, timeout=WAIT_S, check=True)

    assert eventually(lambda: not link.is_symlink())


@posix
def test_a_file_in_the_way_is_not_replaced(tmp_path: Path) -> None:
    precious = tmp_path / "bike"
    precious.write_text("mine")

    with pytest.raises(FileExistsError, match="is not a symbolic link; choose another path"):
        PtyLine(precious)

    assert precious.read_text() == "mine"


def test_a_socket_takes_one_host_at_a_time() -> None:
    with simulator("--tcp", "0", "--scenario", "none") as (_, address):
        for _ in range(2):
            with socket.create_connection(("127.0.0.1", int(address)), WAIT_S) as host:
                host.settimeout(WAIT_S)
                host.sendall(HELLO)
                assert host.recv(3)
                with socket.create_connection(("127.0.0.1", int(address)), WAIT_S) as second:
                    second.settimeout(WAIT_S)
                    assert second.recv(1) == b""


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--tcp", "0", "--speed", "0"], "not a number from 0.01 to 1000"),
        (["--tcp", "0", "--scenario", "start"], "scenario 'start' is measured, not ridden"),
        (["--tcp", "0", "--scenario", "no.toml"], "no.toml cannot be read: No such file"),
        (["--tcp", "0", "--count", "0"], "0 is not a number from 1 to 256"),
        (["--tcp", "here"], "here is not [HOST:]PORT"),
    ],
)
def test_wrong_usage_is_said_and_ends_with_2(words: list[str], complaint: str) -> None:
    command = [sys.executable, "-m", "sim_device", "unit", *words]

    ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=WAIT_S)

    assert ended.returncode == 2
    assert complaint in ended.stderr


def test_a_flash_image_of_another_size_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "flash"
    path.write_bytes(b"short")

    with pytest.raises(ValueError, match="has 5 bytes, a flash image has 8192; move it away"):
        FlashFile(path).load()


def test_a_flash_image_survives_the_process(tmp_path: Path) -> None:
    path = tmp_path / "flash"
    with simulator("--tcp", "0", "--flash", str(path)) as (child, _):
        child.send_signal(signal.SIGTERM)
        assert child.wait(WAIT_S) == 0

    assert FlashFile(path).load() is not None


def test_time_does_not_drift_however_late_the_wake_ups_are() -> None:
    pace = Pace(100.0, 2.0)
    wake_ups_s = [100.0 + 0.0083 * n + 0.0011 * (n % 7) for n in range(1, 5001)]

    served_us = sum(pace.due_us(now_s, 2.0) for now_s in wake_ups_s)

    assert served_us == pytest.approx((wake_ups_s[-1] - 100.0) * 2e6, abs=1.0)


def test_a_machine_that_slept_is_not_caught_up_with() -> None:
    pace = Pace(0.0, 1.0)

    assert pace.due_us(0.5, 1.0) == 500_000
    assert pace.due_us(3600.0, 1.0) == 0
    assert pace.due_us(3600.1, 1.0) == pytest.approx(100_000, abs=1)


def test_a_new_speed_counts_from_now_on() -> None:
    pace = Pace(0.0, 1.0)
    pace.due_us(0.5, 1.0)

    assert pace.due_us(0.6, 10.0) == 0
    assert pace.due_us(0.7, 10.0) == pytest.approx(1_000_000, abs=1)
