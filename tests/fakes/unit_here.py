"""A simulated unit in this process behind the same url as one in a process of its own.

The firmware, the physics and the command line are those of `python -m sim_device`; only the
pseudo-terminal and the process are left out. A unit with a virtual clock costs nothing while its
time stands. Time passes with every read, on the driver's thread.
"""

from __future__ import annotations

import os
import time
from dataclasses import replace
from pathlib import Path

from backend.device.driver import LinkOpener
from backend.device.link import Link, Opener
from backend.device.link.base import READ_BYTES_MAX
from backend.device.link.simulated import SimulatedAddress
from sim_device.__main__ import command_line, host_unit
from sim_device.emulator import BOARD_VARIABLE
from sim_device.lockstep import US_PER_S
from sim_device.simulator import PIECE_US, Pace, save

# Of PIECE_US, in one read: while virtual time passes, the host hears of half a second at once.
PIECES_MAX = 5


class UnitHere:
    """A link whose far end is a simulated unit; arguments as of backend.device.link.Opener.

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
