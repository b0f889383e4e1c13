"""The clients: somebody tunes, somebody rides, somebody else has a tool as well."""

from __future__ import annotations

import math
import random

from backend.device.configuration import ConfigImage
from backend.device.ebl.operations.config_outcome import outcome_of_write
from backend.device.ebl.operations.config_transaction import (
    CommitUnanswered,
    read_config,
    write_config,
)
from backend.device.ebl.operations.readings import read_values
from backend.device.readings import Snapshot
from backend.device.states import LinkState
from backend.errors import ConfigConflict, NoAnswer, PeerProtocolError
from firmware_protocol.layout import Value
from sim_device.configure import ConfigureError
from sim_device.configure import write_config as write_as_rival
from sim_device.firmware.python.unit import Unit
from tests.simulation.checker import MARKER, Intent
from tests.simulation.clients_logs import Collecting
from tests.simulation.clients_trials import Trials
from tests.simulation.clients_unlock import Unlocking
from tests.simulation.earlier_boot import CUTOFF_KMH
from tests.simulation.violation import Violation
from tests.simulation.world import Verdict, World

LABELS = ("NB", "NS", "ZO", "PS", "PB")
# Slower than this the firmware lets a configuration be written.
STANDING_KMH = 0.3
# Seconds after the calm at which everything must have ended, and a last change is made.
CALM_S = 8.0
LAST_CHANGE_S = 3.0
LEASE_S = 31.0
FLUSH_STEPS = 6
# An erased block, its first pages, and what a few seconds add.
LOG_BYTES_PER_RIDE = 7000


class Workload:
    """Draws what is done next, and gives every answer to the checkers."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._chance = random.Random(f"{world.seed} clients")
        self._next_s = 0.3
        self._writes = 0
        self._asked = 0
        self._bases: list[ConfigImage] = []
        self._ride_until_s = 0.0
        # Limits go down freely and never up: nobody here has a token.
        self._torque_nm_max = 2.0
        self._cutoff_kmh = CUTOFF_KMH
        # Writes nobody answered, with the configuration each was made for.
        self._open: list[tuple[Intent, ConfigImage]] = []
        self._quiet = False
        self._read_again = False
        self.last_write: Intent | None = None
        self._trials = Trials(self)
        self._unlocking = Unlocking(self)
        self._collecting = Collecting(self)
        # What these clients do most of the time: seeds differ in kind.
        self._favourite = self._chance.choice(
            (self._change, self._trials.begin, self._unlocking.begin, self._collecting.begin)
        )

    def step(self) -> None:
        """Do what is due now."""
        world = self.world
        if world.now_s >= world.calm_s:
            self._bring_to_an_end()
        elif world.now_s >= self._next_s:
            self._next_s = world.now_s + self._chance.expovariate(1 / 0.7)
            self._act()
        if 0.0 < self._ride_until_s <= world.now_s:
            self._stop()
        self._find_out()
        self._trials.step()
        self._unlocking.step()
        self._collecting.step()

    def _find_out(self) -> None:
        """What became of writes nobody answered, as the service asks; the judge holds it to it."""
        if not self._open or self.world.session.state is not LinkState.READY:
            return
        intent, base = self._open.pop()
        world = self.world
        name = self.name(f"find out {intent.marker}")

        def done(config: ConfigImage) -> None:
            world.figures["writes_found_done"] += 1
            world.checker.verified(intent, config)
            world.tell("host", f"{intent.marker}: found done")

        def failed(error: BaseException) -> None:
            self.told(name, error)
            if isinstance(error, NoAnswer) and error.outcome == "unchanged":
                world.figures["writes_found_undone"] += 1
                world.checker.refused(intent, str(error))
            elif isinstance(error, NoAnswer):
                self._open.append((intent, base))

        intended = {**base.parameters, **intent.changes}
        world.ask(name, outcome_of_write(base, intended, world.session.mtu), done, failed)

    def _act(self) -> None:
        actions = (
            (self._read_all, 3),
            (self._change, 4),
            (self._change_on_an_old_base, 1),
            (self._two_changes_at_once, 1),
            (self._look, 2),
            (self._ride, 2),
            (self._stop, 1),
            (self._rival, 1),
            (self._unplug, 1),
            (self._trials.begin, 3),
            (self._unlocking.begin, 3),
            (self._collecting.begin, 3),
            (self._favourite, 9),
        )
        weights = [weight for _, weight in actions]
        self._chance.choices([action for action, _ in actions], weights)[0]()

    # ------------------------------------------------------------------ host

    def _read_all(self) -> None:
        world = self.world
        name = self.name("read")

        def done(config: ConfigImage) -> None:
            world.checker.shown_config(config)
            self.know(config)
            world.tell("host", f"{name}: generation {config.generation}")

        world.ask(name, read_config(world.session.mtu), done, lambda error: self.told(name, error))

    def _look(self) -> None:
        world = self.world
        name = self.name("look")

        def done(values: Snapshot) -> None:
            world.checker.shown_values(values)

        world.ask(name, read_values(), done, lambda error: self.told(name, error))

    def know(self, config: ConfigImage) -> None:
        """A configuration to make changes on."""
        self._bases.append(config)
        del self._bases[:-4]

    def lowered(self, cutoff_kmh: float) -> None:
        """Somebody lowers this limit; what is drawn from now on is below."""
        self._cutoff_kmh = min(self._cutoff_kmh, cutoff_kmh)

    def forget(self, base: ConfigImage) -> None:
        """It is no longer what the unit has."""
        if base in self._bases:
            self._bases.remove(base)
        if not self._bases:
            self._read_all()

    def newest_base(self) -> ConfigImage | None:
        """What was read last; None before anything was."""
        return self._bases[-1] if self._bases else None

    def told(self, name: str, error: BaseException) -> None:
        """Somebody is told why something did not come about."""
        if not isinstance(error, Exception) or not str(error):
            raise Violation(f"{name} ended with {error!r}, which tells nobody anything.")
        self.world.tell("host", f"{name}: {type(error).__name__}: {error}")

    def _change(self) -> None:
        if self._bases:
            self.write(self._bases[-1])
        else:
            self._read_all()

    def _change_on_an_old_base(self) -> None:
        if self._bases:
            self.write(self._bases[0])

    def _two_changes_at_once(self) -> None:
        self._change()
        self._change()

    def write(self, base: ConfigImage) -> Intent:
        """Start one change on `base`."""
        world = self.world
        intent = self.intend()
        self.last_write = intent
        self.perhaps_brown_out()

        def done(config: ConfigImage) -> None:
            world.figures["writes_verified"] += 1
            world.checker.verified(intent, config)
            self.know(config)
            world.tell("host", f"{intent.marker}: verified as generation {config.generation}")

        def failed(error: BaseException) -> None:
            self.told(intent.marker, error)
            if isinstance(error, CommitUnanswered | PeerProtocolError):
                intent.outcome = "unknown"
                world.figures["writes_unknown"] += 1
                if isinstance(error, CommitUnanswered):
                    self._open.append((intent, base))
            else:
                world.figures["writes_refused"] += 1
                world.checker.refused(intent, str(error))
            if isinstance(error, ConfigConflict):
                self.forget(base)

        world.tell("host", f"{intent.marker}: begins on generation {base.generation}")
        operation = write_config(base, intent.changes, world.session.mtu)
        world.ask(intent.marker, operation, done, failed)
        return intent

    def perhaps_brown_out(self) -> None:
        """The supply will not outlast the next write, if this seed's supply is bad."""
        arm, unit = self.world.faults.brown_out_per_commit, self.world.unit.unit
        if arm and unit.powered and self._chance.random() < arm:
            unit.cut_power_after(self._chance.randint(1, 1400))

    def intend(self, confirm_s: int = 0) -> Intent:
        """A new change that lowers limits and never raises them. confirm_s: only for so long."""
        chance = self._chance
        self._writes += 1
        marker = f"w{self._writes}"
        changes: dict[str, Value] = {MARKER: marker}
        if chance.random() < 0.7:
            changes["pedal_stop_ms"] = chance.randint(50, 1000)
        if chance.random() < 0.4:
            self._torque_nm_max = round(self._torque_nm_max * chance.uniform(0.6, 1.0), 3)
            changes["motor_torque_nm_max"] = self._torque_nm_max
        if chance.random() < 0.4:
            self._cutoff_kmh = round(self._cutoff_kmh * chance.uniform(0.8, 1.0), 2)
            changes["assist_cutoff_kmh"] = self._cutoff_kmh
        if chance.random() < 0.3:
            changes["fuzzy_rules"] = [[chance.choice(LABELS) for _ in range(5)] for _ in range(5)]
        if chance.random() < 0.3:
            changes["mode_names"] = [f"{marker} {slot}" for slot in range(5)]
        intent = Intent(marker, changes, confirm_s=confirm_s)
        self.world.checker.intents[marker] = intent
        return intent

    def name(self, what: str) -> str:
        """Of one question, so that its answer is awaited once."""
        self._asked += 1
        return f"{what} {self._asked}"

    # ------------------------------------------------------------------ bike and rival

    def _ride(self) -> None:
        world = self.world
        torque_nm = self._chance.uniform(10.0, 60.0)
        world.tell("rider", f"pedals with {torque_nm:.0f} Nm")
        world.unit.brake(False)
        world.unit.select_mode(self._chance.randrange(5))
        world.unit.rider("legs", torque_nm=torque_nm)
        self._ride_until_s = world.now_s + self._chance.uniform(1.0, 6.0)
        arm = world.faults.brown_out_per_ride
        if arm and world.unit.unit.powered and self._chance.random() < arm:
            world.unit.unit.cut_power_in_log_after(self._chance.randint(1, LOG_BYTES_PER_RIDE))

    def _stop(self) -> None:
        self._ride_until_s = 0.0
        self.world.unit.rider("off")
        self.world.unit.brake(True)

    def _unplug(self) -> None:
        self.world.unplug(self._chance.uniform(0.1, 3.0))

    def _rival(self) -> None:
        """Another tool takes the cable and writes, while our port is gone."""
        world = self.world
        standing = abs(world.unit.observe()["speed_kmh"]) < STANDING_KMH
        if not standing or not world.unit.unit.powered:
            return
        world.unplug(1.0)
        intent = self.intend()
        tapped = _Tapped(world)
        for _ in range(FLUSH_STEPS):
            # As every host does: what was meant for another one is dropped.
            tapped.advance_us(10_000)
            tapped.transmit()
        try:
            write_as_rival(tapped, dict(intent.changes))
            intent.outcome = "written by the rival"
        except ConfigureError as error:
            intent.outcome = "the rival failed"
            world.tell("rival", f"{intent.marker}: {error}")
        world.checker.looked(world.unit)
        world.tell("rival", f"{intent.marker}: {intent.outcome}")

    # ------------------------------------------------------------------ the end

    def _bring_to_an_end(self) -> None:
        world = self.world
        if not self._quiet:
            self._quiet = True
            self._stop()
            self._next_s = world.calm_s + CALM_S
        elif world.now_s >= self._next_s and not (self._read_again and self._bases):
            # What was read before may have been on trial, and be given up since.
            self._bases.clear()
            self._read_again = True
            self._next_s = world.now_s + 1.0
            world.check_liveness()
            self._read_all()
        elif self._bases and world.now_s >= self._next_s:
            self._next_s = math.inf
            self.write(self._bases[-1])
            self._trials.refresh()
            self._collecting.look_at_all()
        elif self._next_s == math.inf and self._is_busy():
            # A transaction whose BEGIN was never heard of again: its lease is the way out.
            self._bases.clear()
            self._next_s = world.now_s + LEASE_S
            world.end_s = self._next_s + LAST_CHANGE_S

    def _is_busy(self) -> bool:
        last = self.last_write
        return last is not None and str(last.outcome).startswith("Another change is open")


class _Tapped(Unit):
    """The unit as the rival meets it: the checker sees what is said to the rival as well."""

    def __init__(self, world: World) -> None:
        self._world = world

    def receive(self, data: bytes) -> int:
        return self._world.unit.send(data)

    def transmit(self, bytes_max: int = 8192) -> bytes:
        data = self._world.unit.receive(bytes_max)
        self._world.checker.said(data)
        return data

    def advance_us(self, duration_us: int) -> None:
        self._world.unit.unit.advance_us(duration_us)
        self._world.checker.looked(self._world.unit)


def simulate(seed: int, seconds: float | None = None) -> Verdict:
    """Live one seed to its end; a broken property ends it early."""
    world = World(seed) if seconds is None else World(seed, seconds)
    workload = Workload(world)
    wrong = None
    try:
        while world.now_s < world.end_s:
            world.step()
            workload.step()
        last = workload.last_write
        if world.session.state is not LinkState.READY or last is None:
            raise Violation("No last change was made, though nothing was in its way.")
        if last.outcome != "verified":
            raise Violation(f"The last change, on a calm line, ended as {last.outcome!r}.")
        world.check_liveness()
    except Violation as violation:
        wrong = str(violation)
        world.tell("judge", wrong)
    return world.verdict(wrong)
