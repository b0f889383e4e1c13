"""A session and the simulated unit on a serial line whose two ends each have a rate, in virtual
time: at different rates they hear noise, as from a real UART."""

from __future__ import annotations

from collections.abc import Callable

from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.states import LinkState
from backend.errors import LinkError
from firmware_protocol.framing import FrameDecoder, encode_frame
from sim_device.lockstep import LockstepUnit
from tests.fakes.bench import SessionBench

FIRST = 115200


class LineBench(SessionBench):
    """`to_unit` and `to_host` see each whole frame and say whether it arrives.

    rates: what the host's port was set to. turn_around_s: how late the host hears.
    """

    STEP_S = 0.001

    def __init__(
        self, wanted: int | None = None, plan: StreamPlan | None = None, line_baud: int = FIRST
    ) -> None:
        super().__init__(plan)
        self.unit = LockstepUnit(line_baud=line_baud)
        self.wanted = wanted
        self.rates: list[int] = []
        self.port_rates_max = 4_000_000
        self.sent: list[bytes] = []
        self.to_unit: Callable[[bytes], bool] = lambda frame: True
        self.to_host: Callable[[bytes], bool] = lambda frame: True
        self._decoder = FrameDecoder()
        self._plugged = False

    def plug_in(self) -> LineBench:
        self._plugged = True
        self.unit.host_baud(FIRST)
        self.rates.append(FIRST)
        self.session.port_opened(self.now_s, "the line", b"12345678", FIRST, self.wanted)
        return self

    def unplug(self) -> None:
        self._plugged = False
        self.session.port_failed(self.now_s, LinkError("The cable was pulled."))

    def restart_unit(self) -> None:
        """Switch the unit off and on; it begins at its first rate."""
        self.unit = LockstepUnit(line_baud=FIRST, boot_id=2)
        self.unit.host_baud(self.rates[-1])

    def connect(self) -> LineBench:
        self.plug_in()
        self.run_until(lambda: self.session.state is LinkState.READY)
        return self

    @property
    def unit_rate(self) -> int:
        return self.unit.unit.line_baud

    def step(self) -> None:
        self.now_s += self.STEP_S
        self.unit.advance(self.STEP_S)
        heard = self.unit.receive()
        if not self._plugged:
            return
        self.session.receive(self._let_through(heard), self.now_s)
        self.session.tick(self.now_s)
        rate = self.session.line.take_change()
        if rate is not None and rate > self.port_rates_max:
            self.session.line.refused()
        elif rate is not None:
            self.rates.append(rate)
            self.unit.host_baud(rate)
        data = self.session.bytes_to_send()
        for frame in FrameDecoder().feed(data):
            self.sent.append(frame)
            if self.to_unit(frame):
                self.unit.send(encode_frame(frame))

    def _let_through(self, heard: bytes) -> bytes:
        """Whole frames one by one where a test chooses among them, otherwise bytes as they come."""
        passed = b""
        bad = self._decoder.stats.crc_errors + self._decoder.stats.cobs_errors
        for frame in self._decoder.feed(heard):
            passed += encode_frame(frame) if self.to_host(frame) else b""
        noisy = self._decoder.stats.crc_errors + self._decoder.stats.cobs_errors > bad
        return passed + (b"\0" + heard if noisy else b"")
