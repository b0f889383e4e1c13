"""What the driver's thread needs of a family's conversation with a unit: bytes and time, no I/O."""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import Any, Protocol, TypeAlias, TypeVar

from backend.device.states import DeviceEvent, DeviceStatus, LinkState
from backend.errors import LinkError, SpindleError

Result = TypeVar("Result")
# What is asked of a unit: yields requests of its family and gets their answers.
Operation: TypeAlias = Generator[Any, Any, Result]
OnResult: TypeAlias = Callable[[Result], object]
OnError: TypeAlias = Callable[[BaseException], object]


class Line(Protocol):
    """The rate of the line below a conversation."""

    def take_change(self) -> int | None:
        """The rate the line is to have from now on, in bit/s; None for no change."""
        ...

    def refused(self) -> None:
        """The port does not take that rate."""
        ...


class Conversation(Protocol):
    """The conversation with one unit over all its connections. Never raises on what a unit sends.

    failed_handshakes: in a row; a port that stays silent is opened anew. wall_offset_us: Unix time
    minus the driver's clock. is_busy: whether answers are awaited, so that reading soon pays.
    """

    wall_offset_us: int
    failed_handshakes: int

    @property
    def state(self) -> LinkState: ...
    @property
    def reason(self) -> str: ...
    @property
    def is_busy(self) -> bool: ...
    @property
    def line(self) -> Line: ...

    def port_opened(
        self,
        now_s: float,
        name: str,
        nonce: bytes,
        bits_per_second: float | None = None,
        requested: float | None = None,
    ) -> None:
        """A port is open. nonce: 8 random bytes. Rates as in backend.device.link.Link."""
        ...

    def port_failed(self, now_s: float, error: LinkError) -> None:
        """The port does not open or is gone; the message of `error` becomes the reason."""
        ...

    def receive(self, data: bytes, now_s: float) -> None:
        """Take what arrived, in any split."""
        ...

    def tick(self, now_s: float) -> None:
        """Let time pass."""
        ...

    def bytes_to_send(self) -> bytes:
        """Take what is to be sent now."""
        ...

    def next_events(self) -> list[DeviceEvent]:
        """Take what happened since the last call, oldest first."""
        ...

    def start(
        self, operation: Operation[Result], on_result: OnResult[Result], on_error: OnError
    ) -> None:
        """Run an operation; exactly one callback is called, with LinkError when not connected."""
        ...

    def abandon(self, operation: Operation[Result], error: SpindleError) -> None:
        """Wait no longer for an operation's answers: it goes on with this error."""
        ...

    def status(self) -> DeviceStatus:
        """A copy of what other threads may want to know."""
        ...

    def close(self, now_s: float) -> None:
        """Say goodbye; the bytes are still to be sent."""
        ...
