"""The simulated unit, its firmware and its physics, wherever a test wants it: in virtual time under
a session, in this process behind the url of one in a process of its own, or on a TCP port.
"""

from __future__ import annotations

import os
import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import Self

from backend.device.driver import LinkOpener
from backend.device.link import Link, Opener
from backend.device.link.base import READ_BYTES_MAX
from backend.device.link.simulated import SimulatedAddress
from firmware_protocol.layout import Value
from firmware_protocol.parameters import default_config
from sim_device.__main__ import command_line, host_unit
from sim_device.emulator import BOARD_VARIABLE
from sim_device.lockstep import US_PER_S, LockstepUnit
from sim_device.serial_line import TcpLine
from sim_device.simulator import PIECE_US, Pace, ServedUnit, save, serve

# Of PIECE_US, in one read: while virtual time passes, the host hears of half a second at once.
PIECES_MAX = 5

SENSOR_AS_DRAWN: dict[str, Value] = {
    # 0.02 Nm/K and 0.02 %/K of thesis_checks 6, at 0.01 Nm a count: what a factory knows of it.
    "sensor_offset_counts_per_k": 2.0,
    "sensor_gain_share_per_k": -2e-4,
    "sensor_reference_degc": 20.0,
}


def new_unit_config() -> dict[str, Value]:
    """Every parameter of a simulated unit as it leaves the factory: never tuned."""
    return default_config() | SENSOR_AS_DRAWN


class LockstepAsUnit:
    """In virtual time, behind the names of the scripted unit (tests/fakes/unit.py)."""

    def __init__(self, unit: LockstepUnit) -> None:
        self.unit = unit

    def receive(self, data: bytes) -> object:
        return self.unit.send(data)

    def transmit(self) -> bytes:
        return self.unit.receive()

    def advance(self, seconds: float) -> None:
        self.unit.advance(seconds)


class UnitHere:
    """A link whose far end is a simulated unit in this process; arguments as of
    backend.device.link.Opener.

    The firmware, the physics and the command line are those of `python -m sim_device`; only the
    pseudo-terminal and the process are left out. A unit with a virtual clock costs nothing while
    its time stands. Time passes with every read, on the driver's thread.

    Raises SystemExit for a url whose words the simulator does not take.
    """

    def __init__(self, url: str, flash_folder: Path) -> None:
        address = SimulatedAddress.parse(url)
        if address.flash is None:
            flash_folder.mkdir(parents=True, exist_ok=True)
            address = replace(address, flash=str(flash_folder / address.memory_name))
        program_words = 3
        words = address.command(Path(os.devnull))[program_words:]
        self._unit, self._flash, self._log = host_unit(command_line().parse_args(words))
        self._pace = Pace(time.monotonic(), self._unit.speed_factor)
        self.url = url
        self.bits_per_second: float | None = None
        self.bits_per_second_requested: int | None = None

    def set_baudrate(self, bits_per_second: int) -> None:
        """Bytes take no time here."""

    def read(self, bytes_max: int = READ_BYTES_MAX) -> bytes:
        unit = self._unit
        due_us = self._pace.due_us(time.monotonic(), unit.speed_factor)
        if unit.clock == "real":
            unit.advance(due_us / US_PER_S)
        else:
            unit.poll()
        said = unit.receive(bytes_max)
        for _ in range(PIECES_MAX):
            if unit.pay(PIECE_US) == 0:
                break
            said += unit.receive(bytes_max)
        save(unit, self._flash, self._log)
        return said

    def write(self, data: bytes) -> int:
        return self._unit.send(data)

    def close(self) -> None:
        """Its memories are on disk already."""


class OpenerHere:
    """Opens a simulated unit in this process, again and again; each time it was switched on."""

    def __init__(self, url: str, flash_folder: Path) -> None:
        self.url = url
        self._flash_folder = flash_folder

    def open(self) -> Link:
        try:
            return UnitHere(self.url, self._flash_folder)
        except SystemExit:
            # In a process of its own it says what it does not take.
            return Opener(self.url, self._flash_folder).open()

    def give_up(self) -> None:
        """Opening takes no time here."""


def opener(url: str, flash_folder: Path) -> LinkOpener:
    """How a server in this process reaches `url`: a simulated unit of the host's build is here."""
    on_board = BOARD_VARIABLE in os.environ
    if url.startswith("sim") and "baud=" not in url and not on_board:
        return OpenerHere(url, flash_folder)
    return Opener(url, flash_folder)


class UnitOnPort:
    """On a thread of this process: it can be silenced, let time pass, and be unplugged.

    Plugged in from the start; words: of the command line of `sim_device unit`, whose loop is its.
    """

    def __init__(self, *words: str, port: int = 0) -> None:
        asked = ["unit", "--tcp", str(port), *words]
        self._unit, flash, log = host_unit(command_line().parse_args(asked))
        self._line = TcpLine("127.0.0.1", port)
        self._served = ServedUnit(self._unit, self._line, flash, log)
        self.port = int(self._line.address)
        self.url = f"socket://127.0.0.1:{self.port}"
        self._speaking = threading.Event()
        self._speaking.set()
        self._ending = threading.Event()
        self._pass_s = 0.0
        self._passed = threading.Event()
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    def silence(self) -> None:
        """It neither hears nor says anything, and its time stands; the port stays open."""
        self._speaking.clear()

    def speak(self) -> None:
        """It goes on."""
        self._speaking.set()

    def let_pass(self, seconds: float) -> None:
        """So much of its time passes at once; returns when it has."""
        self._passed.clear()
        self._pass_s = seconds
        assert self._passed.wait(30.0), "The unit's time does not pass."

    def unplug(self) -> None:
        """It is gone, and its port with it; twice is allowed."""
        self._ending.set()
        self._speaking.set()
        self._thread.join()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.unplug()

    def _serve(self) -> None:
        try:
            serve([self._served], self._between)
        finally:
            self._line.close()

    def _between(self) -> bool:
        """Asked by the loop before each round: whether it ends."""
        self._speaking.wait()
        if self._pass_s:
            self._unit.advance(self._pass_s)
            self._pass_s = 0.0
            self._passed.set()
        return self._ending.is_set()
