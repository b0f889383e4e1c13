"""Simulated units as a process: for each a lockstep unit, a serial line and a clock.

The unit's time follows the clock times the speed factor, measured from an anchor, so that rounding
and late wake-ups do not add up. With a virtual clock it stands, answers what it is asked, and lets
time pass only when told to (`advance_s`): as fast as the host takes what it sends. The process ends
on SIGTERM or Ctrl-C and when its parent is gone.
"""

import os
import secrets
import signal
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from types import FrameType

from sim_device.flash_file import FlashFile, LogFile
from sim_device.lockstep import US_PER_S, LockstepUnit
from sim_device.serial_line import SerialLine

SLEEP_S = 0.008
LINE_PIECE_US = 10_000

# A machine that slept, or cannot keep up, is not caught up with: the unit skips the missed time.
BEHIND_S_MAX = 1.0

# Virtual time passes in pieces this long, so that what the unit sends meanwhile fits its queue.
PIECE_US = 100_000
# While it passes, nobody sleeps but for a line that takes no more.
LINE_FULL_S = 0.0005


class Pace:
    """How much of the unit's time is due: clock time since an anchor, times the speed factor."""

    def __init__(self, now_s: float, speed_factor: float) -> None:
        self._anchor(now_s, speed_factor)

    def due_us(self, now_s: float, speed_factor: float) -> int:
        """Whole microseconds of unit time to serve now; they count as served."""
        if speed_factor != self._speed_factor:
            self._anchor(now_s, speed_factor)
        due_us = int((now_s - self._start_s) * speed_factor * US_PER_S) - self._served_us
        if due_us > BEHIND_S_MAX * speed_factor * US_PER_S:
            self._anchor(now_s, speed_factor)
            return 0
        self._served_us += due_us
        return due_us

    def _anchor(self, now_s: float, speed_factor: float) -> None:
        self._start_s, self._speed_factor, self._served_us = now_s, speed_factor, 0


class Stop:
    """True once a signal asked for the end, or the parent process is gone."""

    def __init__(self) -> None:
        self._asked = False
        self._parent = os.getppid()
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, self._ask)

    def _ask(self, _signal: int, _frame: FrameType | None) -> None:
        self._asked = True

    def __call__(self) -> bool:
        return self._asked or os.getppid() != self._parent


@dataclass
class ServedUnit:
    """A unit on its line, and its flash memories on disk."""

    unit: LockstepUnit
    line: SerialLine
    flash: FlashFile | None = None
    log: LogFile | None = None
    pace: Pace = field(init=False)
    _waiting: bytes = b""

    def __post_init__(self) -> None:
        self.pace = Pace(time.monotonic(), self.unit.speed_factor)

    def turn(self, now_s: float) -> float:
        """Bytes in, time, bytes out; returns how many seconds the next turn may be away.

        What the unit says leaves only when its flash memories are on disk as they were when it
        spoke: an acknowledged write is there after the process was killed.
        """
        unit, line = self.unit, self.line
        unit.send(line.read())
        due_us = self.pace.due_us(now_s, unit.speed_factor)
        if unit.clock == "real":
            _advance(unit, line, due_us)
        elif not self._waiting:
            unit.poll()
            unit.pay(PIECE_US)
        # Only when the line took everything is more asked for: the unit itself notices a full line.
        self._waiting = self._waiting or unit.receive()
        save(unit, self.flash, self.log)
        if self._waiting:
            self._waiting = self._waiting[line.write(self._waiting) :]
        if unit.owed_us == 0:
            return SLEEP_S
        return LINE_FULL_S if self._waiting else 0.0


def serve(units: Sequence[ServedUnit], stop: Callable[[], bool]) -> None:
    """Runs the units against the clock until `stop()`."""
    while not stop():
        pause_s = min([served.turn(time.monotonic()) for served in units])
        if pause_s > 0.0:
            time.sleep(pause_s)


def save(unit: LockstepUnit, flash: FlashFile | None, log: LogFile | None) -> None:
    """What changed of the flash memories is on disk when this returns."""
    if flash is not None:
        flash.save(unit.unit.flash())
    if log is not None:
        log.save(unit.unit)


def _advance(unit: LockstepUnit, line: SerialLine, due_us: int) -> None:
    """Time passes for the unit; a line with a rate is looked at all along, as a UART would."""
    if unit.unit.line_baud == 0:
        unit.advance(due_us / US_PER_S)
        return
    while due_us > 0:
        piece_us = min(due_us, LINE_PIECE_US)
        unit.host_baud(line.host_baud())
        unit.send(line.read())
        unit.advance(piece_us / US_PER_S)
        due_us -= piece_us


def new_boot_id() -> int:
    """Different at every start, so that a host notices the restart."""
    return secrets.randbelow(2**32 - 1) + 1
