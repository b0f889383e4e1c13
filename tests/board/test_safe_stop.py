"""Goal: on the microcontroller a hung program, a processor fault and missing control steps end with
the motor off by hardware and a start that BOOT tells the cause of.

Method: the unit's image in QEMU with its CMSDK watchdog, broken from the bench's registers while it
is shown a bike under way. The stage's registers and BOOT on the product's own line are what counts.
"""

from __future__ import annotations

import struct
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.device.link import Link, Opener
from firmware_protocol import codec, framing
from firmware_protocol._generated import (
    BootEvent,
    EvtFaultListRequest,
    EvtFaultListResponse,
    FaultFlags,
    ResetCause,
)
from sim_device import emulator
from sim_device.emulated import AT_STAGE, STAGE, Registers, prepare
from sim_device.firmware.python.unit import Unit

# The board's deadlines are met by the clock of the machine that emulates it.
pytestmark = pytest.mark.slow

PATIENCE_S = 60.0
LOOP, DEAF_LOOP, INSTRUCTION, STEPS = 1, 2, 3, 4
TORQUE_NM = 0.5


@pytest.fixture
def board(image: Path, tmp_path: Path) -> Iterator[emulator.Emulator]:
    memory = tmp_path / "memory"
    emulator.make_memory(memory)
    prepare(memory, b"board-stop-1", None)
    with emulator.Emulator(image, memory) as running:
        yield running


class Desk:
    """A host on the board's line and a bench at its registers."""

    def __init__(self, board: emulator.Emulator) -> None:
        self.link: Link = Opener(board.host_address).open()
        self.memory = board.memory()
        self.bench = Registers(board)
        self._decoder = framing.FrameDecoder()
        self.boots: list[BootEvent] = []
        self.faults: int | None = None

    def stage(self) -> tuple[float, int, int]:
        """Torque of the motor's stage, times it was switched off, and what is to break."""
        torque_nm, offs, breaks = STAGE.unpack_from(self.memory, AT_STAGE)
        return torque_nm, offs, breaks

    def show(self, sensors: bytes) -> None:
        self.bench.tell(sensors, False, 0)

    def break_it(self, what: int, sensors: bytes) -> None:
        struct.pack_into("<I", self.memory, AT_STAGE + 8, what)
        self.show(sensors)

    def ask_faults(self) -> None:
        request = codec.Request(1, EvtFaultListRequest())
        self.link.write(b"\0\0" + framing.encode_frame(codec.encode(request)))

    def hear(self) -> None:
        for frame in self._decoder.feed(self.link.read()):
            message = getattr(codec.decode(frame), "message", None)
            if isinstance(message, BootEvent):
                self.boots.append(message)
            if isinstance(message, EvtFaultListResponse):
                self.faults = message.fault_flags


def riding() -> bytes:
    """What the sensors of a bike see that is pedalled at a walking pace and more."""
    bike = Unit(uid=b"board-stop-1", boot_id=1, speed_kmh=12.0)
    bike.set_rider(1, 40.0, 120.0)
    bike.advance_us(1_000_000)
    return bike.sensors()


def until(desk: Desk, is_so: object, again: object = None) -> None:
    ends_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < ends_s:
        desk.hear()
        if is_so():  # type: ignore[operator]
            return
        if again is not None:
            again()  # type: ignore[operator]
        time.sleep(0.02)
    raise AssertionError(f"not within {PATIENCE_S} s: {desk.boots}, {desk.stage()}")


@pytest.mark.parametrize(
    ("what", "cause"),
    [
        (LOOP, ResetCause.WATCHDOG),
        (DEAF_LOOP, ResetCause.WATCHDOG),
        (INSTRUCTION, ResetCause.FAULT_HANDLER),
        (STEPS, ResetCause.DEADLINE),
    ],
    ids=["hung", "hung with interrupts off", "bad instruction", "no control steps"],
)
def test_a_broken_program_ends_with_the_motor_off_and_a_start_that_says_why(
    board: emulator.Emulator, what: int, cause: ResetCause
) -> None:
    desk = Desk(board)
    sensors = riding()
    until(desk, lambda: desk.stage()[0] > TORQUE_NM, lambda: desk.show(sensors))
    offs = desk.stage()[1]
    desk.boots.clear()

    desk.break_it(what, sensors)
    until(desk, lambda: desk.boots)

    torque_nm, offs_now, _ = desk.stage()
    assert offs_now > offs
    assert torque_nm == 0.0
    assert desk.boots[0].reset_cause == cause
    assert desk.boots[0].boot_id == 2
    until(desk, lambda: desk.faults is not None, desk.ask_faults)
    assert desk.faults is not None
    assert desk.faults & FaultFlags.SAFE_STOP
    for _ in range(20):  # pedalling starts nothing again
        desk.show(sensors)
        desk.hear()
        assert desk.stage()[0] == 0.0
    desk.link.close()
