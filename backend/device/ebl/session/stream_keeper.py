"""The live stream of a session: begun when the unit is known, renewed as long as it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from backend.device.conversation import OnError
from backend.device.ebl.session.handshake import Handshake
from backend.device.ebl.session.reasons import forgotten_reason, restarted_reason
from backend.device.ebl.session.runner import OperationRunner
from backend.device.ebl.session.stream_receiver import RENEW_S, StreamPlan
from backend.device.ebl.session.subscription import Subscription, UnitRestarted
from backend.device.stream import StreamStarted
from backend.errors import LinkError, NoAnswer

# Rows that come prove only one direction: after two renewals without an answer (5 s) we are not
# heard.
RENEWALS_UNANSWERED_MAX = 2


class StreamKeeper:
    """Keeps one subscription alive.

    plan: what to stream, None for nothing. now: the session's time. on_started: with what is
    streamed. on_reboot: with a sentence, when the unit must be asked again who it is.
    on_refused: with why there is no stream.
    """

    def __init__(
        self,
        plan: StreamPlan | None,
        subscription: Subscription,
        runner: OperationRunner,
        now: Callable[[], float],
        on_started: Callable[[StreamStarted], None],
        on_reboot: Callable[[str], None],
        on_refused: OnError,
    ) -> None:
        self._plan = plan
        self._subscription = subscription
        self._runner = runner
        self._now = now
        self._on_started = on_started
        self._on_reboot = on_reboot
        self._on_refused = on_refused
        self._handshake: Handshake | None = None
        self._due_s: float | None = None
        self._renewals_unanswered = 0

    @property
    def tx_timed_out(self) -> bool:
        """Whether the unit leaves renewals unanswered while its rows may still come."""
        return self._renewals_unanswered >= RENEWALS_UNANSWERED_MAX

    def begin(self, handshake: Handshake) -> None:
        """The unit is known: subscribe to what the plan wants and the unit has."""
        self._handshake, self._due_s = handshake, None
        if self._plan is None or not handshake.channels:
            return
        plan = replace(self._plan, channels=handshake.channels)
        begin = self._subscription.begin(
            plan, handshake.identity.simulated, handshake.hello.uptime_us
        )
        self._runner.start(begin, self._on_started, self._not_begun)

    def do_due_work(self) -> bool:
        """Ask the unit for what is due now; whether anything was."""
        now_s = self._now()
        if self._due_s is not None and now_s >= self._due_s and self._handshake is not None:
            self.begin(self._handshake)
        elif self._subscription.renewal_due(now_s):
            self._runner.start(self._subscription.renew(), self._renewed, self._not_renewed)
        else:
            return False
        return True

    def end(self) -> None:
        """The unit or the port is gone."""
        self._subscription.end()
        self._handshake, self._due_s = None, None
        self._renewals_unanswered = 0

    def _not_begun(self, error: BaseException) -> None:
        if isinstance(error, UnitRestarted):
            self._on_reboot(restarted_reason())
        elif isinstance(error, LinkError):
            # The line was bad just now, or too much was asked at once: neither lasts.
            self._due_s = self._now() + RENEW_S
        else:
            self._on_refused(error)

    def _renewed(self, is_known: bool) -> None:
        self._renewals_unanswered = 0
        if not is_known:
            self._on_reboot(forgotten_reason())

    def _not_renewed(self, error: BaseException) -> None:
        self._renewals_unanswered += isinstance(error, NoAnswer)
