"""Links whose far end is a unit in memory, and an opener a test can refuse with.

The unit's time passes with every read, so a driver's thread needs no second thread beside it.
"""

from __future__ import annotations

import threading
from typing import Protocol

from backend.errors import LinkError
from tests.fakes.memory_link import MemoryLink

READ_STEP_S = 0.010


class Unit(Protocol):
    def receive(self, data: bytes) -> object: ...

    def transmit(self) -> bytes: ...

    def advance(self, seconds: float) -> None: ...


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


class LockstepAsUnit:
    """The real firmware in virtual time behind the names of the fake unit."""

    def __init__(self, lockstep: object) -> None:
        self.lockstep = lockstep

    def receive(self, data: bytes) -> object:
        return self.lockstep.send(data)  # type: ignore[attr-defined]

    def transmit(self) -> bytes:
        data: bytes = self.lockstep.receive()  # type: ignore[attr-defined]
        return data

    def advance(self, seconds: float) -> None:
        self.lockstep.advance(seconds)  # type: ignore[attr-defined]


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
