"""The unit's state, asked for again when its events did not tell it in full; once at a time."""

from __future__ import annotations

from collections.abc import Callable

from backend.device.configuration import TrialStatus
from backend.device.ebl.session.handshake import read_unit_state
from backend.device.ebl.session.runner import OperationRunner
from backend.device.ebl.session.unit_state import UnitState
from backend.errors import NoAnswer


class StateKeeper:
    """Keeps what is known of the unit fresh. now: the session's time."""

    def __init__(
        self, unit_state: UnitState, runner: OperationRunner, now: Callable[[], float]
    ) -> None:
        self._unit_state = unit_state
        self._runner = runner
        self._now = now
        self._stale = False
        self._is_querying = False

    def mark_stale(self) -> None:
        """What is known may be older than the unit."""
        self._stale = True

    def refresh(self) -> None:
        """Ask if it is stale; a question that nobody answers leaves it so."""
        if self._stale and not self._is_querying:
            self._stale, self._is_querying = False, True
            self._runner.start(read_unit_state(), self._answered, self._unanswered)

    def _answered(self, state: tuple[int, TrialStatus]) -> None:
        self._is_querying = False
        if not self._stale:
            self._unit_state.refresh(*state, self._now())

    def _unanswered(self, error: BaseException) -> None:
        self._is_querying = False
        self._stale |= isinstance(error, NoAnswer)
