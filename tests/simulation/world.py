"""One bike, one unit, one host and the line between them, in one thread on one virtual clock.

Real: the host's session and the unit's C firmware. Made up: time, the line, the flash's supply, the
clients. Everything that happens comes from the seed, so a seed is a story that can be told again.
"""

from __future__ import annotations

import hashlib
import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from backend.device.ebl.session.operation import Operation
from backend.device.ebl.session.session import EVENTS_MAX, Session
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.states import LinkState, StateChanged, UnitEvent
from backend.device.stream import StreamBlock
from backend.errors import LinkError
from sim_device.lockstep import LockstepUnit
from tests.simulation.checker import Checker
from tests.simulation.earlier_boot import earlier_boot
from tests.simulation.link_faults import CALM, FaultyWire, LinkFaults, draw_faults
from tests.simulation.violation import Violation

STEP_S = 0.010
# Long enough for some ten changes and as many faults, short enough for 200 seeds in a minute.
SECONDS_DEFAULT = 40.0
# Then the faults stop and everything has to come to its end.
CALM_PART = 0.7
BAUD_RATES = (115_200.0, 1_000_000.0)
# As the driver does with a port that is open and silent.
HANDSHAKES_BEFORE_REOPEN = 8
OFF_S = 1.0
NEVER = 0xFFFFFFFF
JUDGED = ("t_s", "motor_demand_nm", "speed_kmh")
STEPS_PER_BOUNDS_CHECK = 5
# What a session may hold: its own bounds, and bytes of four requests and a goodbye.
WAITING_MAX = 64
RUNNING_MAX = 32
OUT_BYTES_MAX = 16384
STORY_LINES_MAX = 5000


@dataclass(frozen=True)
class Verdict:
    """How a seed ended. wrong: None, or the property that was broken. digest: of the whole trace,
    bytes included."""

    seed: int
    wrong: str | None
    story: tuple[str, ...]
    digest: str
    figures: dict[str, int]


class World:
    """Everything there is. `step` lets 10 ms pass."""

    def __init__(
        self, seed: int, seconds: float = SECONDS_DEFAULT, faults: LinkFaults | None = None
    ) -> None:
        self.seed = seed
        self.now_s = 0.0
        self.end_s = seconds
        self.calm_s = seconds * CALM_PART
        chance = random.Random(f"{seed} world")
        self.faults = draw_faults(chance) if faults is None else faults
        self._chance = chance
        self._boot_id = 1
        self._steps = 0
        self._log_changes = 0
        self.past = earlier_boot(chance.random() < 0.75)
        self.unit = self._new_life(self.past.flash, self.past.log)
        self.checker = Checker(self.unit)
        self.bits_per_second = chance.choice(BAUD_RATES)
        bytes_per_s = self.bits_per_second / 10
        self._up = FaultyWire(random.Random(f"{seed} up"), self.faults, bytes_per_s)
        self._down = FaultyWire(random.Random(f"{seed} down"), self.faults, bytes_per_s)
        self._down_credit = 0.0
        self.session = Session(self.now_s, StreamPlan())
        self.plugged = False
        self._off_until_s: float | None = None
        self._replug_s: float | None = 0.0
        self.pending: dict[str, float] = {}
        self.story: list[str] = []
        self._trace = hashlib.sha256()
        self.figures = {"writes_verified": 0, "writes_refused": 0, "writes_unknown": 0}
        self.figures |= {"writes_found_done": 0, "writes_found_undone": 0}
        self.figures |= {"blocks": 0, "resets": 0, "brown_outs": 0, "unplugs": 0}
        self.figures |= {"log_brown_outs": 0, "trials_kept": 0, "trials_asked_about": 0}
        self.figures |= {"limits_raised": 0, "tokens_replayed": 0, "logs_fetched": 0}
        self.figures |= {"downloads_resumed": 0, "directories_compared": 0}
        self.last_block_s = 0.0
        self.tell("world", f"{self.bits_per_second:,.0f} baud; {self.faults.told() or 'no faults'}")

    # ------------------------------------------------------------------ what clients do

    def tell(self, who: str, what: str) -> None:
        """A line of the story."""
        line = f"{self.now_s:8.2f} s  {who:8} {what}"
        self._trace.update(line.encode())
        if len(self.story) < STORY_LINES_MAX:
            self.story.append(line)

    def ask(
        self,
        name: str,
        operation: Operation[Any],
        on_result: Callable[[Any], None],
        on_error: Callable[[BaseException], None],
    ) -> None:
        """Run an operation in the session; its one answer is awaited by the checkers."""
        self.pending[name] = self.now_s

        def ended(answer: Callable[[Any], None], value: Any) -> None:
            if name not in self.pending:
                raise Violation(f"{name} was answered twice.")
            del self.pending[name]
            answer(value)

        self.session.start(
            operation, lambda value: ended(on_result, value), lambda error: ended(on_error, error)
        )

    def unplug(self, seconds: float) -> None:
        """Pull the cable."""
        if not self.plugged:
            return
        self.tell("cable", f"pulled for {seconds:.1f} s")
        self.figures["unplugs"] += 1
        self._lose("The cable was pulled.", seconds)

    def restart(self, why: str) -> None:
        """Take the unit's power away; it is back a second later with a new RAM."""
        self.tell("unit", why)
        self.unit.unit.cut_power_after(0)
        self._off_until_s = self.now_s + OFF_S

    # ------------------------------------------------------------------ time

    def step(self) -> None:
        """Ten milliseconds for everybody."""
        self.now_s = round(self.now_s + STEP_S, 6)
        if self.now_s >= self.calm_s and self._up.faults != CALM:
            self._calm()
        self._misfortune()
        self._plug()
        self._unit_lives()
        self._session_lives()
        self._steps += 1
        if self._steps % STEPS_PER_BOUNDS_CHECK == 0:
            self._check_bounds()

    def _calm(self) -> None:
        self.tell("world", "the faults stop")
        self.faults = CALM
        self._up.calm()
        self._down.calm()
        if self.unit.unit.powered:
            self.unit.unit.cut_power_after(NEVER)
            self.unit.unit.cut_power_in_log_after(NEVER)

    def _misfortune(self) -> None:
        faults, chance = self.faults, self._chance
        if faults.unplug_per_s and chance.random() < faults.unplug_per_s * STEP_S:
            self.unplug(chance.uniform(0.1, 3.0))
        resets = faults.reset_per_s and chance.random() < faults.reset_per_s * STEP_S
        if resets and self.unit.unit.powered:
            self.figures["resets"] += 1
            self.restart("resets")

    def _plug(self) -> None:
        if self._replug_s is None or self.now_s < self._replug_s:
            return
        self._replug_s = None
        self.plugged = True
        nonce = self._chance.randbytes(8)
        self.session.port_opened(self.now_s, "the bench", nonce, self.bits_per_second)

    def _lose(self, why: str, seconds: float) -> None:
        self.plugged = False
        self._up.cut()
        self._down.cut()
        self.session.port_failed(self.now_s, LinkError(why))
        self.session.failed_handshakes = 0
        self._replug_s = self.now_s + seconds

    def _unit_lives(self) -> None:
        if self._off_until_s is not None and self.now_s >= self._off_until_s:
            self._boot()
        self._log_changes = self.unit.unit.log_changes
        self.unit.advance(STEP_S)
        if not self.unit.unit.powered and self._off_until_s is None:
            log_cut = self._log_changes != self.unit.unit.log_changes
            self.figures["log_brown_outs" if log_cut else "brown_outs"] += 1
            self.tell("unit", "its supply fails in a flash write")
            self._off_until_s = self.now_s + OFF_S
        changed = self.checker.looked(self.unit)
        if changed is not None:
            marker = changed.values["fuzzy_table_name"]
            self.tell("unit", f"generation {changed.number} is in the flash: {marker}")
        self._down_credit = min(
            self._down_credit + self._down.bytes_per_s * STEP_S, 2 * self._down.bytes_per_s * STEP_S
        )
        if not self._down.stalled(self.now_s) or not self.plugged:
            data = self.unit.receive(int(self._down_credit))
            self._down_credit -= len(data)
            self._trace.update(data)
            self.checker.said(data)
            if self.plugged:
                self._down.put(data)
        self.checker.assist_is_within_limits(self.unit.unit.observe(JUDGED))

    def _boot(self) -> None:
        self._off_until_s = None
        self._boot_id += 1
        self.unit = self._new_life(self.unit.unit.flash(), self.unit.unit.log())
        self.checker.restarted()
        self.tell("unit", f"boots with generation {self.checker.active.number}")

    def _new_life(self, flash: bytes, log: bytes) -> LockstepUnit:
        return LockstepUnit(
            seed=self.seed, name="simulated", flash=flash, log=log, boot_id=self._boot_id
        )

    def _session_lives(self) -> None:
        session = self.session
        for piece in self._down.take(self.now_s, STEP_S):
            session.receive(piece, self.now_s)
        session.tick(self.now_s)
        data = session.bytes_to_send()
        if self.plugged:
            self._up.put(data)
        for piece in self._up.take(self.now_s, STEP_S):
            self._trace.update(piece)
            if self.unit.unit.powered:
                self.unit.send(piece)
        if session.failed_handshakes >= HANDSHAKES_BEFORE_REOPEN and self.plugged:
            self.tell("host", "opens the silent port anew")
            self._lose(session.reason, 0.1)
        for event in session.next_events():
            self._heard(event)

    def _heard(self, event: object) -> None:
        if isinstance(event, StreamBlock):
            self.figures["blocks"] += 1
            self.last_block_s = self.now_s
            self.checker.shown_block(event)
        elif isinstance(event, StateChanged):
            if not event.reason:
                raise Violation(f"The state {event.state} has no reason.")
            self.tell("host", f"{event.state.value}: {event.reason}")
        elif isinstance(event, UnitEvent):
            self.tell("host", f"hears {event.name}")

    def _check_bounds(self) -> None:
        session = self.session
        table = session._requests
        held = {
            "events": (len(session._events), EVENTS_MAX),
            "waiting requests": (len(table._waiting), WAITING_MAX),
            "requests under way": (len(table._pending), max(1, table.outstanding_max)),
            "operations": (len(session._runner._running), RUNNING_MAX),
            "bytes to send": (len(session._out), OUT_BYTES_MAX),
            "bytes of half a frame": (len(session._decoder._pending), 600),
        }
        for name, (count, most) in held.items():
            if count > most:
                raise Violation(f"The host holds {count} {name}; {most} is the most.")

    # ------------------------------------------------------------------ the end

    def check_liveness(self) -> None:
        """After the calm: nothing waits, the unit is ready, its rows arrive."""
        if self.pending:
            raise Violation(f"Still waiting long after the faults stopped: {self.pending}.")
        if self.session.state is not LinkState.READY:
            raise Violation(f"Not ready long after the faults stopped: {self.session.reason}")
        if self.now_s - self.last_block_s > 1.0:
            raise Violation(
                f"Ready, and no live value since {self.now_s - self.last_block_s:.1f} s."
            )

    def verdict(self, wrong: str | None) -> Verdict:
        """The story and how it ended."""
        figures = dict(self.figures)
        figures["frames_bad"] = self.session.link_statistics().frames_bad
        figures["trials"] = len(self.checker.trials.trials)
        figures["logs_given_up"] = self.checker.logs.given_up_unconfirmed
        figures["attempts"] = self.checker.unlock.attempts
        figures["frames_seen"] = self.checker.frames_seen
        figures["conservation_checks"] = self.checker.conservation_checks
        self._trace.update(repr((wrong, figures)).encode())
        return Verdict(self.seed, wrong, tuple(self.story), self._trace.hexdigest(), figures)
