"""The line's rate as the host sees it: found, raised, given back (SPEC 2.1, the line's rate).

Two ends at different rates hear noise and cannot tell each other. So a rate counts only once it was
proven, and a host that finds nobody tries the first rate and then the last one that may be right.
"""

from __future__ import annotations

from backend.device.ebl.session.operation import Operation, attempt, expect
from backend.device.ebl.session.requests import RequestTable
from backend.errors import NoAnswer, SpindleError
from firmware_protocol._generated import (
    BaudRates,
    HelloResponse,
    PingRequest,
    SetBaudRequest,
    SetBaudResponse,
    Status,
)

RATES = {int(bit.name.removeprefix("BAUD_")): bit for bit in BaudRates if bit.name}
# The unit needs one PING out of these; an adapter takes 18 ms to pass an answer on.
PINGS = 4
SWITCHES_MAX = 2
# A rate at which the link is lost so soon after it was proven is too fast for this line.
SOON_S = 10.0


class BaudRate:
    """Which rate the port has, and which others may be right.

    first: what the port opens with; None where the line has no rate. requests: told the rate, for
    how long answers may take.
    """

    def __init__(self, requests: RequestTable) -> None:
        self.first: int | None = None
        self._requests = requests
        self._current: int | None = None
        self._last_working: int | None = None
        self._requested: int | None = None
        self._tried: list[int | None] = []
        self._failures = 0
        self._proven_s: float | None = None
        self._to_set: int | None = None

    @property
    def current(self) -> int | None:
        """The port's rate, bits a second."""
        return self._current

    def opened(self, first: float | None, requested: float | None) -> None:
        """A port is open at `first`. requested: the rate to ask for, None for the fastest."""
        before = (self.first, self._requested)
        self.first = None if first is None else round(first)
        self._requested = None if requested is None else round(requested)
        if before != (self.first, self._requested):
            # A line that runs at a rate of its own is found there.
            self._last_working = self._requested
        self._current = self._requests.bits_per_second = self.first
        self._to_set = None
        self._failures = 0
        self._proven_s = None

    def take_change(self) -> int | None:
        """The rate the port must get before anything else is sent; None where it has it."""
        rate, self._to_set = self._to_set, None
        return rate

    def start_over(self, is_responding: bool) -> None:
        """A handshake begins: where the unit was heard just now, otherwise at the first rate."""
        self._tried = []
        self._try(self._current if is_responding else self.first)

    def try_another(self) -> bool:
        """Go to a rate that this handshake has not tried; False when there is none."""
        for rate in (self.first, self._last_working):
            if rate is not None and self.first is not None and rate not in self._tried:
                self._try(rate)
                return True
        return False

    def tried(self) -> str:
        """The rates of this handshake in words, empty where the line has none."""
        return " and ".join(str(rate) for rate in self._tried if rate)

    def lost(self, now_s: float) -> None:
        """Nothing is heard any more."""
        if self._proven_s is not None and now_s - self._proven_s < SOON_S:
            self._failures += 1
        self._proven_s = None

    def refused(self) -> None:
        """The port cannot run at the rate it was given."""
        self._failures = SWITCHES_MAX

    def go_faster(self, hello: HelloResponse) -> Operation[None]:
        """Ask for the rate that is wanted, prove it, or go back. Never raises but NoAnswer."""
        while (rate := self._worth_asking(hello.baud_bitmap)) is not None:
            before = self._current
            try:
                request = SetBaudRequest(rate)
                response = yield from attempt(request)
                if response.status != Status.OK:
                    self._failures = SWITCHES_MAX
                    return
                terms = expect(request, response, SetBaudResponse)
            except NoAnswer:
                self._failures += 1
                continue
            except SpindleError:
                self._failures = SWITCHES_MAX
                return
            self._go(rate)
            try:
                yield from attempt(
                    PingRequest(),
                    PINGS,
                    terms.switch_after_ms / 1000.0,
                    terms.prove_within_ms / 1000.0 / PINGS,
                )
            except NoAnswer:
                self._failures += 1
                # Our PING may have been heard and its answer lost: then the unit is there.
                self._last_working = rate
                self._go(before)
                yield from attempt(PingRequest())
            else:
                self._last_working = rate

    def proven(self, now_s: float) -> None:
        """The handshake succeeded at this rate."""
        self._proven_s = now_s if self._current != self.first else None

    def _worth_asking(self, offered: int) -> int | None:
        if self._current is None or self._failures >= SWITCHES_MAX:
            return None
        rates = [rate for rate, bit in RATES.items() if offered & bit]
        if self._requested is not None:
            rates = [rate for rate in rates if rate == self._requested]
        fastest = max(rates, default=self._current)
        worth = fastest > self._current or self._requested is not None
        return fastest if worth and fastest != self._current else None

    def _try(self, rate: int | None) -> None:
        self._tried.append(rate)
        self._go(rate)

    def _go(self, rate: int | None) -> None:
        if rate is not None and rate != self._current:
            self._current = self._to_set = rate
            self._requests.bits_per_second = rate
