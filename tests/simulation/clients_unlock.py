"""Somebody raises a limit: with the maker's word, with another's, with one that was used before."""

from __future__ import annotations

import random
from dataclasses import replace
from typing import TYPE_CHECKING

from backend.device.configuration import ConfigImage
from backend.device.ebl.operations.config_transaction import CommitUnanswered, write_config
from backend.errors import ConfigConflict, PeerProtocolError, TokenNeeded
from firmware_protocol.layout import Value
from firmware_protocol.unlock_token import Token
from tests.fakes.maker import Maker, challenge_of
from tests.simulation.checker import MARKER, Intent
from tests.simulation.earlier_boot import MAKER

if TYPE_CHECKING:
    from tests.simulation.workload import Workload

CUTOFF_KMH_MAX = 25.0
STRANGER = Maker(2)


class Unlocking:
    """Raised limits of one seed."""

    def __init__(self, clients: Workload) -> None:
        self._clients = clients
        self._world = clients.world
        self._chance = random.Random(f"{clients.world.seed} unlock")
        self._due: tuple[float, Intent, ConfigImage, Token] | None = None
        # A raise that was made: what it changed, and with which token.
        self._used: tuple[Intent, Token] | None = None

    def step(self) -> None:
        """Show the token that has come from the maker meanwhile."""
        if self._due is None or self._world.now_s < self._due[0]:
            return
        _, intent, base, token = self._due
        self._due = None
        self._world.checker.again(intent)
        self._clients.perhaps_brown_out()
        self._write(intent, base, token)

    def begin(self) -> None:
        """Ask for more, or show an old token again."""
        base = self._clients.newest_base()
        if base is None or self._due is not None:
            return
        if self._used is not None and self._chance.random() < 0.6:
            self._replay(base)
            return
        now_kmh = float(str(base.parameters["assist_cutoff_kmh"]))
        intent = self._clients.intend()
        intent.changes = {
            MARKER: intent.marker,
            "assist_cutoff_kmh": min(CUTOFF_KMH_MAX, now_kmh + self._chance.uniform(0.1, 5.0)),
        }
        self._write(intent, base, None)

    def _write(self, intent: Intent, base: ConfigImage, token: Token | None) -> None:
        clients, world = self._clients, self._world

        def done(config: ConfigImage) -> None:
            world.figures["limits_raised"] += token is not None
            world.checker.verified(intent, config)
            clients.know(config)
            world.tell("host", f"{intent.marker}: raised as generation {config.generation}")
            if token is not None:
                self._used = (intent, token)

        def failed(error: BaseException) -> None:
            clients.told(intent.marker, error)
            if isinstance(error, CommitUnanswered | PeerProtocolError):
                intent.outcome = "unknown"
                return
            world.checker.refused(intent, str(error))
            if isinstance(error, ConfigConflict):
                clients.forget(base)
            elif isinstance(error, TokenNeeded) and token is None:
                self._fetch_token(intent, base, error)

        world.tell("host", f"{intent.marker}: should go up" + (", with a token" if token else ""))
        operation = write_config(base, intent.changes, world.session.mtu, token=token)
        world.ask(clients.name(intent.marker), operation, done, failed)

    def _fetch_token(self, intent: Intent, base: ConfigImage, error: TokenNeeded) -> None:
        challenge = challenge_of(error)
        what = self._chance.choice(
            ("good", "good", "good", "stranger", "other image", "other unit")
        )
        if what == "good":
            intent.authorised = True
            self._world.checker.unlock.good_tokens_shown += 1
            token = MAKER.sign(challenge)
        elif what == "stranger":
            token = STRANGER.sign(challenge)
        elif what == "other image":
            token = MAKER.sign(replace(challenge, image=challenge.image[::-1]))
        else:
            token = MAKER.sign(replace(challenge, uid=bytes(12)))
        self._world.tell("maker", f"{intent.marker}: a token, {what}")
        due_s = self._world.now_s + self._chance.uniform(0.0, 1.5)
        self._due = (due_s, intent, base, token)

    # ------------------------------------------------------------------ a token shown twice

    def _replay(self, base: ConfigImage) -> None:
        """Lower the limit, then show the same token for the same content again."""
        clients, world = self._clients, self._world
        assert self._used is not None
        raised, token = self._used
        lower = clients.intend()
        limit_kmh = float(str(raised.changes["assist_cutoff_kmh"])) / 2
        clients.lowered(limit_kmh)
        lower.changes = {MARKER: lower.marker, "assist_cutoff_kmh": limit_kmh}

        def lowered(config: ConfigImage) -> None:
            world.checker.verified(lower, config)
            clients.know(config)
            self._show_again(config, raised.changes, None, token)

        def failed(error: BaseException) -> None:
            clients.told(lower.marker, error)
            if isinstance(error, CommitUnanswered | PeerProtocolError):
                lower.outcome = "unknown"
            else:
                world.checker.refused(lower, str(error))

        operation = write_config(base, lower.changes, world.session.mtu)
        world.ask(lower.marker, operation, lowered, failed)

    def _show_again(
        self, base: ConfigImage, changes: dict[str, Value], token: Token | None, old: Token
    ) -> None:
        """First without a token, so that a challenge is open; then with the old one.

        If it is taken, the flash has the same change twice, which the judge sees.
        """
        clients, world = self._clients, self._world
        name = clients.name("replay")

        def failed(error: BaseException) -> None:
            clients.told(name, error)
            if isinstance(error, TokenNeeded) and token is None:
                world.figures["tokens_replayed"] += 1
                self._show_again(base, changes, old, old)

        operation = write_config(base, changes, world.session.mtu, token=token)
        world.ask(name, operation, clients.know, failed)
