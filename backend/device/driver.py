"""One thread per port: carries bytes between a link and its session, and time into it.

It reads late and in bulk: wake-ups cost, decoding does not. The thread outlives
everything but `close`: a vanished port is opened again, a listener's exception is logged.
"""

from __future__ import annotations

import logging
import os
import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeout
from typing import Protocol, TypeVar

from backend.device.conversation import Conversation, Operation
from backend.device.link import Link
from backend.device.states import CONNECTED, DeviceEvent, DeviceStatus, LinkState
from backend.errors import LinkError, NoAnswer, OtherUnit, SpindleError

LOG = logging.getLogger(__name__)

Result = TypeVar("Result")
Listener = Callable[[DeviceEvent], None]

# Between reads while only the stream flows, and while somebody waits for an answer.
READ_EVERY_S = 0.020
READ_EVERY_BUSY_S = 0.004
# A pseudo-terminal holds 4096 bytes and a unit's own queue 2240: a unit that runs many times faster
# than real time is read so often that about this much has come, which leaves room for delays.
READ_BYTES_AIM = 1024
READ_EVERY_FAST_S = 0.0002
READ_BYTES = 65536
# A port that does not open is tried again after 0.1 s, 0.2 s and so on up to this.
REOPEN_S_MIN = 0.1
REOPEN_S_MAX = 1.0
# A port that is open and silent is opened anew: some adapters do not survive a sleep otherwise, and
# a TCP connection whose other end is gone tells nobody.
HANDSHAKES_BEFORE_REOPEN = 4
# Work that waits for the thread; more means that nobody waits for the answers.
COMMANDS_MAX = 32
# What a port that takes nothing may pile up: thirty of our longest frames.
UNSENT_BYTES_MAX = 16384
CLOSE_TIMEOUT_S = 5.0
# What an operation that took too long has to end itself: a change is dropped in the unit, too.
ABANDON_S = 3.0

PROBED = (*CONNECTED, LinkState.CLOSED)

# Codes of a NoAnswer after which it is certain that the unit was not even asked.
NOT_BEGUN = "not_begun"
NEVER_SENT = frozenset({NOT_BEGUN, "not_connected"})

_Command = Callable[[], None]


class LinkOpener(Protocol):
    """Opens the same way to a unit again and again; backend.device.link.Opener is one."""

    @property
    def url(self) -> str: ...

    def open(self) -> Link: ...

    def give_up(self) -> None:
        """Let an `open` that is under way fail soon; for any thread."""
        ...


class Driver:
    """A device's thread.

    opener: how to get to the unit. listener: called on this thread with every event; it must not
    wait. conversation: from here on this thread's. reopen_when_silent: False where a silent unit is
    better left alone.
    """

    def __init__(
        self,
        opener: LinkOpener,
        listener: Listener,
        conversation: Conversation,
        reopen_when_silent: bool = True,
    ) -> None:
        self._opener = opener
        self._listener = listener
        self._reopen_when_silent = reopen_when_silent
        self._session = conversation
        self._link: Link | None = None
        self._unsent = b""
        self._open_at_s = 0.0
        self._reopen_s = REOPEN_S_MIN
        self._read_every_s = READ_EVERY_S
        self._read_at_s = time.monotonic()
        self._commands: queue.Queue[_Command] = queue.Queue(COMMANDS_MAX)
        # Set once it is known what hangs on the port, or that nothing does.
        self.probed = threading.Event()
        # Set while the unit can be asked.
        self.connected = threading.Event()
        self._wake = threading.Event()
        self._stop = threading.Event()
        # From here on nobody takes commands but who gives them.
        self._ended = threading.Event()
        self._lock = threading.Lock()
        self._thread = threading.Thread(target=self._run, name=f"unit {opener.url}", daemon=True)

    def start(self) -> None:
        """Begin to open the port."""
        self._thread.start()

    def stop(self) -> None:
        """Begin to close, without waiting: so several close side by side."""
        self._stop.set()
        self._wake.set()
        self._opener.give_up()

    def close(self) -> None:
        """Say goodbye to the unit, give the port back and end the thread."""
        self.stop()
        self._thread.join(CLOSE_TIMEOUT_S)
        if self._thread.is_alive():
            LOG.error("The thread of %s does not end; its port stays open.", self._opener.url)

    def status(self) -> DeviceStatus:
        """Where the device stands now; callable from any thread."""
        with self._lock:
            return self._session.status()

    def between_turns(self, work: Callable[[], Result]) -> Result:
        """Do something with the conversation while its thread does not; it must not wait."""
        with self._lock:
            return work()

    def run(
        self, operation: Operation[Result], timeout_s: float, meant: str | None = None
    ) -> Result:
        """Run an operation and wait for its result; for any thread but the driver's own.

        meant: the serial number of the unit it is for, None for whichever is there. Raises
        OtherUnit when another one has come onto the line, and what the operation raises. After
        `timeout_s` the operation gets NoAnswer in place of the answer it waits for, and what it
        makes of that is raised: a change knows how far it was.
        """
        future: Future[Result] = Future()

        def begin() -> None:
            if not future.set_running_or_notify_cancel():
                return
            identity = self._session.status().identity
            if meant is not None and identity is not None and identity.serial_number != meant:
                operation.close()
                future.set_exception(other_unit(self._opener.url, meant, identity.serial_number))
                return
            self._session.start(operation, future.set_result, future.set_exception)

        self._command(begin)
        try:
            return future.result(timeout_s)
        except FutureTimeout:
            pass
        late = NoAnswer(f"{self._opener.url}: no result within {timeout_s:g} s.", "no_result")
        if future.cancel():
            raise NoAnswer(f"{late.message} Nothing was asked of the unit yet.", NOT_BEGUN)
        self._command(lambda: self._session.abandon(operation, late))
        try:
            return future.result(ABANDON_S)
        except FutureTimeout:
            raise NoAnswer(
                f"{late.message} What was asked may still be done; look again before you repeat "
                "it.",
                late.code,
            ) from None

    def _command(self, work: _Command) -> None:
        try:
            self._commands.put_nowait(work)
        except queue.Full:
            raise LinkError(
                f"{self._opener.url}: too much is asked at once; try again in a moment."
            ) from None
        self._wake.set()
        if self._ended.is_set():
            with self._lock:
                self._begin_commands()

    # ------------------------------------------------------------------ the thread

    def _run(self) -> None:
        while not self._stop.is_set():
            try:
                self._turn(time.monotonic())
            except Exception:
                # Ours to mend; the device must not die of it silently.
                LOG.exception("%s: a fault in Spindle; the port is opened anew.", self._opener.url)
                self._drop(LinkError("A fault in Spindle; the port is opened anew."))
            self._wake.wait(self._read_every_s)
            self._wake.clear()
        self._finish()

    def _turn(self, now_s: float) -> None:
        """One round: port, commands, bytes in, time, bytes out, events."""
        if self._link is None and now_s >= self._open_at_s:
            self._open()
        with self._lock:
            self._session.wall_offset_us = (time.time_ns() - time.monotonic_ns()) // 1000
            received = self._exchange(self._link) if self._link is not None else 0
            if self._link is None:
                self._session.tick(time.monotonic())
            self._begin_commands()
            busy = self._session.is_busy
            events = self._session.next_events()
            silent = self._session.failed_handshakes >= HANDSHAKES_BEFORE_REOPEN
            probed = self._session.failed_handshakes > 0 or self._session.state in PROBED
            if self._session.state in CONNECTED:
                self.connected.set()
            else:
                self.connected.clear()
        for event in events:
            self._emit(event)
        if probed:
            self.probed.set()
        if silent and self._reopen_when_silent and self._link is not None:
            self._drop(LinkError(self._session.reason))
        self._read_every_s = _read_every_s(busy, received, now_s - self._read_at_s)
        self._read_at_s = now_s

    def _begin_commands(self) -> None:
        while True:
            try:
                self._commands.get_nowait()()
            except queue.Empty:
                break
        if self._link is not None:
            self._send(self._link)

    def _exchange(self, link: Link) -> int:
        """Bytes in, time, bytes out; returns how many came."""
        try:
            data = link.read(READ_BYTES)
        except LinkError as error:
            self._port_lost(error)
            return 0
        now_s = time.monotonic()
        if data:
            self._session.receive(data, now_s)
        self._session.tick(now_s)
        self._send(link)
        return len(data)

    def _send(self, link: Link) -> None:
        rate = self._session.line.take_change()
        if rate is not None:
            self._set_rate(link, rate)
        self._unsent += self._session.bytes_to_send()
        if not self._unsent:
            return
        try:
            self._unsent = self._unsent[link.write(self._unsent) :]
            if len(self._unsent) > UNSENT_BYTES_MAX:
                raise LinkError(f"{link.url}: the port takes no bytes; it is opened anew.")
        except LinkError as error:
            self._port_lost(error)

    def _set_rate(self, link: Link, rate: int) -> None:
        """What still waits was for the rate before; nobody would understand it now."""
        self._unsent = b""
        try:
            link.set_baudrate(rate)
        except LinkError as error:
            LOG.warning("%s", error)
            self._session.line.refused()

    def _open(self) -> None:
        """Open the port; outside the lock, because a simulated unit takes a second to start."""
        try:
            link = self._opener.open()
        except SpindleError as error:
            failure = error if isinstance(error, LinkError) else LinkError(error.message)
            with self._lock:
                self._port_lost(failure)
            return
        with self._lock:
            self._link = link
            self._reopen_s = REOPEN_S_MIN
            self._session.port_opened(
                time.monotonic(),
                link.url,
                os.urandom(8),
                link.bits_per_second,
                link.bits_per_second_requested,
            )

    def _drop(self, error: LinkError) -> None:
        with self._lock:
            self._port_lost(error)

    def _port_lost(self, error: LinkError) -> None:
        """The port is gone or was never there; the caller holds the lock."""
        now_s = time.monotonic()
        self._close_link()
        self._session.port_failed(now_s, error)
        self._session.failed_handshakes = 0
        self.probed.set()
        self._open_at_s = now_s + self._reopen_s
        self._reopen_s = min(2.0 * self._reopen_s, REOPEN_S_MAX)

    def _emit(self, event: DeviceEvent) -> None:
        try:
            self._listener(event)
        except Exception:
            LOG.exception("%s: a listener failed on %s.", self._opener.url, type(event).__name__)

    def _finish(self) -> None:
        with self._lock:
            self._session.close(time.monotonic())
            if self._link is not None:
                self._send(self._link)
            self._close_link()
            self._ended.set()
            self._begin_commands()
            events = self._session.next_events()
        for event in events:
            self._emit(event)

    def _close_link(self) -> None:
        self._unsent = b""
        if self._link is None:
            return
        try:
            self._link.close()
        except (OSError, SpindleError) as error:
            LOG.warning("%s: closing the port failed: %s", self._opener.url, error)
        self._link = None


def other_unit(url: str, meant: str, present: str | None) -> OtherUnit:
    """The refusal of what was meant for a unit that is not on the line any more."""
    return OtherUnit(
        f"This was meant for the unit {meant}, but {url} leads to {present or 'another one'} now: "
        "nothing was changed. Connect the unit it was meant for, or look at this one first."
    )


def _read_every_s(busy: bool, received: int, within_s: float) -> float:
    """How long to wait until the next read, from what came within the last wait."""
    calm_s = READ_EVERY_BUSY_S if busy else READ_EVERY_S
    if received == 0:
        return calm_s
    return max(READ_EVERY_FAST_S, min(calm_s, within_s * READ_BYTES_AIM / received))
