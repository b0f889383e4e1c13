"""How the unit stands, asked again when its events did not tell it in full; once at a time."""

from __future__ import annotations

from collections.abc import Callable

from backend.device.configuration import TrialStatus
from backend.device.ebl.session.handshake import unit_state
from backend.device.ebl.session.runner import OperationRunner
from backend.device.ebl.session.unit_notes import UnitNotes
from backend.errors import NoAnswer


class StateKeeper:
    """Keeps the notes true. now: the session's time."""

    def __init__(self, notes: UnitNotes, runner: OperationRunner, now: Callable[[], float]) -> None:
        self._notes = notes
        self._runner = runner
        self._now = now
        self._in_doubt = False
        self._asked = False

    def doubt(self) -> None:
        """The notes may be older than the unit."""
        self._in_doubt = True

    def settle(self) -> None:
        """Ask where there is doubt; a question that nobody answers leaves it."""
        if self._in_doubt and not self._asked:
            self._in_doubt, self._asked = False, True
            self._runner.start(unit_state(), self._told, self._not_told)

    def _told(self, state: tuple[int, TrialStatus]) -> None:
        self._asked = False
        if not self._in_doubt:
            self._notes.refresh(*state, self._now())

    def _not_told(self, error: BaseException) -> None:
        self._asked = False
        self._in_doubt |= isinstance(error, NoAnswer)
