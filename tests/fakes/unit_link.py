"""Links whose far end is in memory: in a test's hand, or a unit that answers; what opens them, what
drives them, and a listener that can be waited for.

A unit's time passes with every read, so a driver's thread needs no second thread beside it.
"""

from __future__ import annotations

import threading
import time
from typing import Protocol

from backend.device.driver import Driver, LinkOpener, Listener
from backend.device.ebl.session.session import Session
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.errors import LinkError

READ_STEP_S = 0.010
# Like a kernel's serial buffer: a writer that is never read must notice.
BUFFER_BYTES = 65536


class Unit(Protocol):
    """What a unit under test can do: the scripted one and the simulated one alike."""

    def receive(self, data: bytes) -> object: ...

    def transmit(self) -> bytes: ...

    def advance(self, seconds: float) -> None: ...


class MemoryLink:
    """Its other end is the attributes `arrived` and `vanish`, `say`. It passes the contract tests
    of the real ones (tests/unit/device/test_link_contract.py)."""

    def __init__(self, url: str = "memory", bits_per_second: float | None = None) -> None:
        self.url = url
        self.bits_per_second = bits_per_second
        self.bits_per_second_requested: int | None = None
        self.arrived = bytearray()  # what the host wrote
        self.closed = False
        self._coming = bytearray()
        self._gone = False

    def say(self, data: bytes) -> None:
        """Send bytes towards the host."""
        self._coming += data

    def heard(self) -> bytes:
        """Take what the host has written."""
        data = bytes(self.arrived)
        self.arrived.clear()
        return data

    def vanish(self) -> None:
        """Pull the cable."""
        self._gone = True

    def set_baudrate(self, bits_per_second: int) -> None:
        self.bits_per_second = float(bits_per_second)

    def read(self, bytes_max: int = 65536) -> bytes:
        self._check()
        data = bytes(self._coming[:bytes_max])
        del self._coming[:bytes_max]
        return data

    def write(self, data: bytes) -> int:
        self._check()
        taken = data[: BUFFER_BYTES - len(self.arrived)]
        self.arrived += taken
        return len(taken)

    def close(self) -> None:
        self.closed = True

    def _check(self) -> None:
        assert not self.closed, "a closed link is not used"
        if self._gone:
            raise LinkError(f"{self.url}: the port vanished.")


class UnitLink(MemoryLink):
    """A memory link that a unit answers on."""

    def __init__(self, unit: Unit, url: str) -> None:
        super().__init__(url)
        self._unit = unit

    def read(self, bytes_max: int = 65536) -> bytes:
        self._unit.advance(READ_STEP_S)
        self._unit.receive(self.heard())
        self.say(self._unit.transmit())
        return super().read(bytes_max)


class UnitOpener:
    """Opens links to one unit, unless it is unplugged."""

    def __init__(self, unit: Unit, url: str = "memory") -> None:
        self.url = url
        self.unit = unit
        self.links: list[UnitLink] = []
        self.tried = threading.Event()
        self._refusal: LinkError | None = None

    def unplug(self) -> None:
        """Pull the cable: the open link vanishes and no new one opens."""
        self._refusal = LinkError(f"{self.url}: there is no such port. Plug the unit in.")
        self.tried.clear()
        for link in self.links:
            link.vanish()

    def plug_in(self) -> None:
        self._refusal = None

    def give_up(self) -> None:
        """Opening takes no time here."""

    def open(self) -> UnitLink:
        self.tried.set()
        if self._refusal is not None:
            raise self._refusal
        self.links.append(UnitLink(self.unit, self.url))
        return self.links[-1]


class Heard:
    """A listener that keeps what it hears and lets a test wait for it, never sleeping blindly."""

    PATIENCE_S = 20.0

    def __init__(self) -> None:
        self.events: list[object] = []
        self._news = threading.Condition()

    def __call__(self, *event: object) -> None:
        with self._news:
            self.events.append(event[0] if len(event) == 1 else event)
            self._news.notify_all()

    def wait_for(self, kind: type, count: int = 1, **fields: object) -> object:
        """The `count`-th event of this kind with these fields; fails when it does not come."""

        def found() -> list[object]:
            return [
                event
                for event in self.events
                if isinstance(event, kind)
                and all(getattr(event, name) == value for name, value in fields.items())
            ]

        with self._news:
            assert self._news.wait_for(lambda: len(found()) >= count, self.PATIENCE_S), (
                f"no {kind.__name__} {fields} among {self.events[-5:]}"
            )
            return found()[count - 1]


def ebl_driver(opener: LinkOpener, listener: Listener, plan: StreamPlan | None = None) -> Driver:
    """A port's thread, not started yet, for EBL without the unit that services see on top of it."""
    return Driver(opener, listener, Session(time.monotonic(), plan or StreamPlan()))
