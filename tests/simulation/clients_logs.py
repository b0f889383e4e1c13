"""Somebody collects rides from the unit's flash, and goes on where the line broke."""

from __future__ import annotations

import random
import zlib
from typing import TYPE_CHECKING

from backend.device.ebl.operations.ride_logs import (
    close_log,
    confirm_log,
    list_logs,
    log_crc,
    receive_log,
)
from backend.device.ebl.session.log_receiver import LogReceiver
from backend.device.readings import RideLog, RideLogs
from tests.simulation.violation import Violation

if TYPE_CHECKING:
    from tests.simulation.workload import Workload

SESSIONS = 15


class Collecting:
    """Downloads of one seed, one at a time."""

    def __init__(self, clients: Workload) -> None:
        self._clients = clients
        self._world = clients.world
        self._chance = random.Random(f"{clients.world.seed} logs")
        self._parts: dict[tuple[int, int], bytes] = {}
        self._pending: tuple[RideLog, LogReceiver, bytes] | None = None
        self._session = 0
        self._asking = False

    @property
    def idle(self) -> bool:
        """Whether nothing is being fetched."""
        return self._pending is None and not self._asking

    def step(self) -> None:
        """Take what has come."""
        if self._pending is None:
            return
        log, receiver, truth = self._pending
        key = (log.log_id, log.generation)
        self._parts[key] = self._parts.get(key, b"") + b"".join(receiver.take_segments())
        if receiver.failure is not None:
            self._world.tell("host", f"log {log.log_id}: broken off: {receiver.failure}")
            self._end()
        elif receiver.done:
            self._end()
            self._has(log, truth, self._parts.pop(key))

    def begin(self) -> None:
        """Look what there is and fetch one."""
        clients, world = self._clients, self._world
        if not self.idle:
            return
        name = clients.name("logs")

        def done(found: RideLogs) -> None:
            self._asking = False
            world.checker.logs.shown_logs(found.logs)
            closed = [log for log in found.logs if not log.recording]
            if closed:
                self._resume(self._chance.choice(closed))

        self._ask(name, list_logs(), done)

    def look_at_all(self) -> None:
        """On a calm line: the directory is the flash's, to the last log."""
        name = self._clients.name("logs")

        def done(found: RideLogs) -> None:
            self._asking = False
            self._world.checker.logs.all_shown(found.logs)
            self._world.figures["directories_compared"] += 1

        self._ask(name, list_logs(), done)

    def _ask(self, name: str, operation: object, done: object) -> None:
        def failed(error: BaseException) -> None:
            self._asking = False
            self._clients.told(name, error)

        self._asking = True
        self._world.ask(name, operation, done, failed)  # type: ignore[arg-type]

    def _resume(self, log: RideLog) -> None:
        """Go on behind what is here, if the unit's check value says that it is a beginning."""
        part = self._parts.get((log.log_id, log.generation), b"")
        if not part:
            self._fetch(log, part)
            return

        def done(crc32: int) -> None:
            self._asking = False
            if crc32 != zlib.crc32(part):
                raise Violation(f"The first {len(part)} bytes of log {log.log_id} are others now.")
            self._world.figures["downloads_resumed"] += 1
            self._fetch(log, part)

        self._ask(self._clients.name(f"crc {log.log_id}"), log_crc(log, len(part)), done)

    def _fetch(self, log: RideLog, part: bytes) -> None:
        world = self._world
        stored = world.checker.logs.logs.get((log.log_id, log.generation))
        if stored is None:
            return
        self._session = self._session % SESSIONS + 1
        receiver = LogReceiver(self._session, world.now_s)
        self._pending = (log, receiver, stored.data)
        world.session.receive_log(receiver)
        name = self._clients.name(f"log {log.log_id}")
        world.tell("host", f"{name}: fetched from byte {len(part)} of {log.length}")

        def failed(error: BaseException) -> None:
            self._clients.told(name, error)
            if self._pending is not None and self._pending[1] is receiver:
                self._end()

        world.ask(name, receive_log(log, receiver, len(part)), lambda _: None, failed)

    def _end(self) -> None:
        self._pending = None
        self._world.session.receive_log(None)

    def _has(self, log: RideLog, truth: bytes, data: bytes) -> None:
        world, clients = self._world, self._clients
        world.checker.logs.fetched(log, truth, data)
        world.figures["logs_fetched"] += 1
        world.tell("host", f"log {log.log_id}: here")
        name = clients.name("close")
        world.ask(name, close_log(self._session), lambda _: None, lambda e: clients.told(name, e))
        if self._chance.random() < 0.3:
            # As if its bytes had spoiled on the disk: the unit must not believe in it.
            self._confirm(log, zlib.crc32(data) ^ 1, False)
        elif self._chance.random() < 0.8:
            world.checker.logs.safe.add((log.log_id, log.generation))
            self._confirm(log, zlib.crc32(data), True)

    def _confirm(self, log: RideLog, crc32: int, is_right: bool) -> None:
        world, clients = self._world, self._clients
        name = clients.name(f"confirm {log.log_id}")

        def done(_: None) -> None:
            key = (log.log_id, log.generation)
            stored = world.checker.logs.logs.get(key)
            if not is_right and key not in world.checker.logs.safe:
                raise Violation(f"The unit took a wrong hash for log {log.log_id}.")
            if stored is not None and not stored.confirmed:
                raise Violation(f"Log {log.log_id} is confirmed and not marked in the flash.")

        world.ask(name, confirm_log(log, crc32), done, lambda error: clients.told(name, error))
