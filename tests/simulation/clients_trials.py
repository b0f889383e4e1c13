"""Somebody tries a configuration: keeps it, gives it up, or lets its time run out."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING

from backend.device.configuration import ConfigImage, TrialStatus
from backend.device.ebl.operations.config_transaction import CommitUnanswered, write_config
from backend.device.ebl.operations.config_trial import confirm_config, rollback_config
from backend.device.ebl.session.trial_status import trial_status
from backend.errors import ConfigConflict, PeerProtocolError
from tests.simulation.checker import Intent

if TYPE_CHECKING:
    from tests.simulation.workload import Workload

# Shorter than the calm at the end lasts.
CONFIRM_S_MAX = 6
# A word of four bytes ends a trial.
WORD_BYTES = 4


class Trials:
    """Trials of one seed."""

    def __init__(self, clients: Workload) -> None:
        self._clients = clients
        self._world = clients.world
        self._chance = random.Random(f"{clients.world.seed} trials")
        self._open: tuple[float, Intent, ConfigImage] | None = None

    def step(self) -> None:
        """Decide what has been tried for long enough."""
        if self._open is None or self._world.now_s < self._open[0]:
            return
        _, intent, config = self._open
        self._open = None
        if self._chance.random() < 0.7:
            self._keep(intent, config)
        else:
            self._give_up(intent)

    def begin(self) -> None:
        """Try a change on what is known."""
        clients, world = self._clients, self._world
        base = clients.newest_base()
        if base is None:
            return
        intent = clients.intend(confirm_s=self._chance.randint(1, CONFIRM_S_MAX))
        clients.perhaps_brown_out()

        def done(config: ConfigImage) -> None:
            world.checker.tried(intent, config)
            world.tell("host", f"{intent.marker}: on trial as generation {config.generation}")
            self._tried(intent, config)

        def failed(error: BaseException) -> None:
            clients.told(intent.marker, error)
            if isinstance(error, CommitUnanswered | PeerProtocolError):
                intent.outcome = "unknown"
            else:
                world.checker.refused(intent, str(error))
            if isinstance(error, ConfigConflict):
                clients.forget(base)

        world.tell("host", f"{intent.marker}: tried for {intent.confirm_s} s")
        operation = write_config(base, intent.changes, world.session.mtu, intent.confirm_s)
        world.ask(intent.marker, operation, done, failed)

    def _tried(self, intent: Intent, config: ConfigImage) -> None:
        what = self._chance.random()
        if what < 0.7:
            due_s = self._world.now_s + self._chance.uniform(0.0, 1.1) * intent.confirm_s
            self._open = (due_s, intent, config)
        elif what < 0.8 and self._world.faults.reset_per_s:
            self._world.restart("is restarted with a trial running")

    def _keep(self, intent: Intent, config: ConfigImage) -> None:
        clients, world = self._clients, self._world
        intent.keep_asked = True
        self._perhaps_brown_out_in_the_word()

        def done(found: ConfigImage) -> None:
            world.figures["trials_kept"] += 1
            world.checker.verified(intent, found)
            clients.know(found)
            world.tell("host", f"{intent.marker}: kept")

        operation = confirm_config(config.parameters, world.session.mtu)
        name = clients.name(f"keep {intent.marker}")
        world.ask(name, operation, done, lambda error: clients.told(name, error))

    def _give_up(self, intent: Intent) -> None:
        clients, world = self._clients, self._world
        intent.return_asked = True
        # The request names no trial: whatever is on trial now is given up, somebody else's too.
        current = world.checker.trials.current
        if current is not None:
            world.checker.intents[current.marker].return_asked = True
        self._perhaps_brown_out_in_the_word()

        def done(found: ConfigImage) -> None:
            world.checker.shown_config(found)
            world.checker.refused(intent, "given up")
            clients.know(found)
            world.tell("host", f"{intent.marker}: given up")

        name = clients.name(f"give up {intent.marker}")
        operation = rollback_config(world.session.mtu)
        world.ask(name, operation, done, lambda error: clients.told(name, error))

    def _perhaps_brown_out_in_the_word(self) -> None:
        world = self._world
        arm = self._chance.random() < world.faults.brown_out_per_commit
        if arm and world.unit.unit.powered:
            world.unit.unit.cut_power_after(self._chance.randint(1, WORD_BYTES))

    def refresh(self) -> None:
        """On a calm line: the unit says how its last trial ended, and that none is running."""
        world, clients = self._world, self._clients
        boot = world.checker.boot
        name = clients.name("status")

        def done(status: TrialStatus) -> None:
            world.figures["trials_asked_about"] += 1
            world.checker.status_told(status, boot)

        world.ask(name, trial_status(), done, lambda error: clients.told(name, error))
