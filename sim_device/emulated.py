"""The drive unit on an emulated microcontroller, with its bike here: what `--board mps2_an386` is.

The firmware runs in QEMU; this process is the test bench around it, at the board's registers for
sensors and motor (boards/mps2_an386/plant.h). At real speed the board's own timer runs its clock.
At another speed, or with a virtual clock, time passes in pieces of ten milliseconds that are
granted from here, and bike and board keep step exactly.
"""

import select
import struct
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from firmware_protocol._generated import Market
from sim_device.emulator import Emulator, build, free_port, make_memory
from sim_device.firmware.python.unit import ASSIST_OUTPUT_LENGTH
from sim_device.lockstep import US_PER_S, LockstepUnit
from sim_device.serial_line import linked
from sim_device.simulator import Pace

STEP_US = 10_000
HOUSEKEEPING_S = 0.25

REGISTERS_AT = 0x10000
BY_BENCH = struct.Struct("<6I")
ANSWER_BYTES = 1024
BY_BOARD = struct.Struct("<6I")
AT_BY_BOARD = REGISTERS_AT + BY_BENCH.size + ANSWER_BYTES
AT_REQUEST = AT_BY_BOARD + BY_BOARD.size
AT_INPUTS = AT_REQUEST + ANSWER_BYTES
AT_OUTPUT = AT_INPUTS + 256
AT_STAGE = AT_OUTPUT + ASSIST_OUTPUT_LENGTH
STAGE = struct.Struct("<f2I")
REGISTERS_LENGTH = AT_STAGE + STAGE.size - REGISTERS_AT

IDENTITY = struct.Struct("<II12sBBBx32sI")
MAGIC = 0x31364250
BELL = b"\x01"
BELLS_MAX = 256


def prepare(
    memory_file: Path,
    uid: bytes,
    unlock_key: bytes | None,
    has_clock: bool = False,
    serial_rate: int = 0,
    market: Market | None = Market.EU_EPAC,
) -> None:
    """What the factory writes, serial number, market and maybe the maker's key, and registers at
    rest.

    has_clock: the board's clock is in the bench's hand from power on. serial_rate: that the line
    begins with, 0 for a line where bytes take no time. market: None leaves the unit without a
    configuration, as no factory does.
    """
    with memory_file.open("r+b") as file:
        magic, boots, *_ = IDENTITY.unpack(file.read(IDENTITY.size))
        boots = boots if magic == MAGIC else 0
        file.seek(0)
        key = unlock_key or bytes(32)
        has_key = unlock_key is not None
        number, has_market = market or 0, market is not None
        file.write(IDENTITY.pack(MAGIC, boots, uid, has_key, number, has_market, key, serial_rate))
        file.seek(REGISTERS_AT)
        file.write(struct.pack("<2I", 0, has_clock) + bytes(REGISTERS_LENGTH - 8))


class Registers:
    """The bench's side of `plant_registers` (boards/mps2_an386/plant.h)."""

    def __init__(self, emulator: Emulator) -> None:
        self._memory = emulator.memory()
        self._bell = emulator.bench
        self._written = 0
        self._granted_us = 0
        self._answers = 0
        self._steps = 0

    def wait(self, wait_s: float) -> None:
        """Until the board rings. Raises EOFError when it is gone."""
        if select.select([self._bell], [], [], wait_s)[0] and not self._bell.recv(BELLS_MAX):
            raise EOFError("the emulated board is gone")

    def steps(self) -> int:
        """How many control steps the board has done since the last call."""
        steps = self._by_board()[0]
        new = (steps - self._steps) % 2**32
        self._steps = steps
        return new

    def decided(self, length: int) -> tuple[bytes, int]:
        """The latest assist_output, and the mode at start."""
        return self._memory[AT_OUTPUT : AT_OUTPUT + length], self._by_board()[2]

    def request(self) -> tuple[int, bytes] | None:
        """Message id and body of a request that has no answer yet."""
        _, _, _, requests, message_id, length = self._by_board()
        if requests == self._answers:
            return None
        return message_id, self._memory[AT_REQUEST : AT_REQUEST + length]

    def answer(self, status: int, body: bytes) -> None:
        """Answers it."""
        at = REGISTERS_AT + BY_BENCH.size
        body = body[:ANSWER_BYTES]
        self._memory[at : at + len(body)] = body
        struct.pack_into("<2I", self._memory, REGISTERS_AT + 16, status, len(body))
        self._answers = self._by_board()[3]
        struct.pack_into("<I", self._memory, REGISTERS_AT + 12, self._answers)
        self._bell.sendall(BELL)

    def tell(self, inputs: bytes, has_clock: bool, granted_us: int) -> None:
        """What the sensors see now, and so much more time."""
        self._granted_us = (self._granted_us + granted_us) % 2**32
        self._written = (self._written + 1) % 2**32 | 1
        struct.pack_into("<I", self._memory, REGISTERS_AT, self._written)
        self._memory[AT_INPUTS : AT_INPUTS + len(inputs)] = inputs
        struct.pack_into("<2I", self._memory, REGISTERS_AT + 4, has_clock, self._granted_us)
        self._written += 1
        struct.pack_into("<I", self._memory, REGISTERS_AT, self._written)
        self._bell.sendall(BELL)

    @property
    def granted_time_is_left(self) -> bool:
        """Whether time was granted that has not passed on the board."""
        return bool(self._by_board()[1] != self._granted_us)

    def _by_board(self) -> tuple[int, ...]:
        return BY_BOARD.unpack_from(self._memory, AT_BY_BOARD)


def takes_the_clock(bike: LockstepUnit) -> bool:
    """Whether the board's own timer would run at another speed than this bike."""
    return bike.clock == "virtual" or bike.speed_factor != 1.0


class EmulatedUnit:
    """A board in QEMU and the bike around it."""

    def __init__(self, bike: LockstepUnit, board: Registers, now_s: float) -> None:
        self.bike = bike
        self._board = board
        self._pace = Pace(now_s, bike.speed_factor)
        self._due_us = 0
        self._tell(0)

    def serve(self, now_s: float, wait_s: float) -> None:
        """Hears the board once and grants it the time that is due. Raises EOFError."""
        self._board.wait(wait_s)
        # The board steps, asks, and says that its time has passed, in this order. Looked at the
        # other way round, whatever is seen has every step before it counted.
        time_is_left = self._board.granted_time_is_left
        request = self._board.request()
        for _ in range(self._board.steps()):
            self.bike.unit.drive(*self._board.decided(ASSIST_OUTPUT_LENGTH))
            self.bike.advance(STEP_US / US_PER_S)
            if not self._has_clock:
                self._tell(0)
        if request is not None:
            self._board.answer(*self.bike.answer(*request))
            self._tell(0)
        self._grant(now_s, time_is_left)

    def wait_s(self) -> float:
        """How long to wait for the board before the next grant may be due."""
        if self._board.granted_time_is_left or not self._has_clock:
            return HOUSEKEEPING_S
        if self.bike.clock == "virtual":
            return 0.0 if self.bike.owed_us else HOUSEKEEPING_S
        return STEP_US / US_PER_S / self.bike.speed_factor

    @property
    def _has_clock(self) -> bool:
        return takes_the_clock(self.bike)

    def _grant(self, now_s: float, time_is_left: bool) -> None:
        passed_us = self._pace.due_us(now_s, self.bike.speed_factor)
        if not self._has_clock:
            self._due_us = 0
            return
        whole = self.bike.clock != "virtual"
        self._due_us = self._due_us + passed_us if whole else self.bike.owed_us
        if time_is_left:
            return
        grant_us = min(self._due_us, STEP_US)
        if grant_us < STEP_US and (whole or grant_us == 0):
            return
        self._due_us -= grant_us
        self.bike.owed_us = max(0, self.bike.owed_us - grant_us)
        self._tell(grant_us)

    def _tell(self, granted_us: int) -> None:
        self._board.tell(self.bike.unit.sensors(), self._has_clock, granted_us)


def serve(bike: LockstepUnit, emulator: Emulator, stop: Callable[[], bool]) -> None:
    """Runs the bike around the board until `stop()` or the board is gone."""
    unit = EmulatedUnit(bike, Registers(emulator), time.monotonic())
    while not stop():
        try:
            unit.serve(time.monotonic(), unit.wait_s())
        except EOFError:
            return


@dataclass(frozen=True)
class EmulatedSetup:
    """What `python -m sim_device unit --board mps2_an386` was asked for.

    memory_file: keeps the board's flash memories from one run to the next, or None.
    pty: symbolic link to make to the board's first line, or None for `tcp`.
    """

    bike: LockstepUnit
    uid: bytes
    unlock_key: bytes | None
    memory_file: Path | None
    pty: Path | None
    tcp: tuple[str, int] | None
    serial_rate: int = 0
    market: Market | None = Market.EU_EPAC

    def run(self, ready: Callable[[str], None], stop: Callable[[], bool]) -> None:
        """Serves until `stop()`; `ready` is called once with the address of the first line."""
        image = build("unit")
        with tempfile.TemporaryDirectory(prefix="spindle-unit-") as folder:
            memory = self.memory_file or Path(folder) / "memory"
            make_memory(memory)
            has_clock = takes_the_clock(self.bike)
            prepare(memory, self.uid, self.unlock_key, has_clock, self.serial_rate, self.market)
            with Emulator(image, memory, self.tcp and free_port(self.tcp)) as emulator:
                if self.pty is None:
                    ready(emulator.host_address)
                    serve(self.bike, emulator, stop)
                    return
                with linked(self.pty, emulator.host_address):
                    ready(str(self.pty))
                    serve(self.bike, emulator, stop)
