"""A session and a unit on one bench in virtual time: bytes cross, time passes, no clock runs."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from backend.device.ebl.session.operation import Operation
from backend.device.ebl.session.schema import Schemas
from backend.device.ebl.session.session import Session
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.states import DeviceEvent, LinkState, StateChanged
from backend.device.stream import StreamBlock
from tests.fakes.unit_link import Unit

Result = TypeVar("Result")


def whole(data: bytes) -> Iterable[bytes]:
    """Everything in one piece."""
    return [data] if data else []


def bytewise(data: bytes) -> Iterable[bytes]:
    """One byte at a time."""
    return [data[at : at + 1] for at in range(len(data))]


class SessionBench(ABC):
    """A session in virtual time; what lies between it and its unit, a `step` moves."""

    STEP_S = 0.010
    PATIENCE_S = 30.0

    def __init__(self, plan: StreamPlan | None = None, schemas: Schemas | None = None) -> None:
        self.now_s = 100.0
        self.session = Session(self.now_s, plan, schemas)

    @abstractmethod
    def step(self) -> None:
        """Let STEP_S pass for the unit, the line and the session."""

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / self.STEP_S)):
            self.step()

    def run_until(self, done: Callable[[], bool], patience_s: float | None = None) -> None:
        """Step until it is so; AssertionError if that does not come in time."""
        patience_s = patience_s or self.PATIENCE_S
        for _ in range(round(patience_s / self.STEP_S)):
            if done():
                return
            self.step()
        raise AssertionError(f"not within {patience_s} s: {self.session.reason}")

    def ask(self, operation: Operation[Result]) -> Result:
        """Run an operation to its end; its error is raised here."""
        results: list[Result] = []
        errors: list[BaseException] = []
        self.session.start(operation, results.append, errors.append)
        self.run_until(lambda: bool(results or errors))
        if errors:
            raise errors[0]
        return results[0]


class Bench(SessionBench):
    """Runs a session against a unit; `to_unit` and `to_host` may harm what passes."""

    def __init__(
        self, unit: Unit, plan: StreamPlan | None = None, schemas: Schemas | None = None
    ) -> None:
        super().__init__(plan, schemas)
        self.unit = unit
        self.events: list[DeviceEvent] = []
        self.split: Callable[[bytes], Iterable[bytes]] = whole
        self.to_unit: Callable[[bytes], bytes] = lambda data: data
        self.to_host: Callable[[bytes], bytes] = lambda data: data

    def open_port(self, nonce: bytes = b"12345678") -> Bench:
        self.session.port_opened(self.now_s, "the bench", nonce)
        return self

    def connect(self) -> Bench:
        """Open the port and run until the handshake is done."""
        self.open_port()
        self.run_until(lambda: self.session.state in (LinkState.READY, LinkState.READ_ONLY))
        return self

    def blocks(self) -> list[StreamBlock]:
        return [event for event in self.events if isinstance(event, StreamBlock)]

    def states(self) -> list[LinkState]:
        return [event.state for event in self.events if isinstance(event, StateChanged)]

    def of(self, kind: type[Any]) -> list[Any]:
        return [event for event in self.events if isinstance(event, kind)]

    def step(self) -> None:
        self.now_s += self.STEP_S
        self.unit.advance(self.STEP_S)
        for piece in self.split(self.to_host(self.unit.transmit())):
            self.session.receive(piece, self.now_s)
        self.session.tick(self.now_s)
        for piece in self.split(self.to_unit(self.session.bytes_to_send())):
            self.unit.receive(piece)
        self.events += self.session.next_events()
