"""When to ask a unit for its time, and telling it ours: a burst at first, then now and then; once
more when ours was set."""

from __future__ import annotations

from collections.abc import Callable

from backend.core.moments import set_by_us
from backend.device.ebl.session.clock_sync import ClockEstimate, ClockEstimator, ClockSample
from backend.device.ebl.session.operation import Operation, attempt
from backend.device.ebl.session.runner import OperationRunner
from backend.device.states import LinkStatistics
from firmware_protocol._generated import TimSetRequest, TimSyncRequest, TimSyncResponse

# The first few tell the offset; the later ones, over minutes, the skew.
BURST = 4
BURST_EVERY_S = 0.1
EVERY_S = 10.0
UNCERTAINTY_US_MAX = 2**32 - 1
# A host whose clock stands before 2020 does not know the time and does not tell it.
PLAUSIBLE_UNIX_US = 1_577_836_800_000_000


class ClockKeeper:
    """One unit's clock from HELLO until it is gone or reboots."""

    def __init__(self, statistics: LinkStatistics) -> None:
        self._statistics = statistics
        self._estimator = ClockEstimator()
        self._due_s: float | None = None
        self._requests = 0
        # Unix time minus the host's steady time, as the unit may have been told it.
        self._offset_us: int | None = None

    @property
    def estimate(self) -> ClockEstimate | None:
        """What is known of the unit's clock, None before the first answer."""
        return self._estimator.estimate

    def begin(self, now_s: float) -> None:
        """A unit was connected: its clock is still unknown."""
        self._estimator = ClockEstimator()
        self._requests = 0
        self._offset_us = None
        self._due_s = now_s + BURST_EVERY_S
        self._statistics.clock_skew_ppm = self._statistics.clock_uncertainty_ms = None

    def end(self) -> None:
        """The unit is gone, or does not tell its time."""
        self._due_s = None

    def due(self, now_s: float) -> bool:
        """Whether it is time to ask; says so once for each time."""
        if self._due_s is None or now_s < self._due_s:
            return False
        self._requests += 1
        self._due_s = now_s + (BURST_EVERY_S if self._requests < BURST else EVERY_S)
        return True

    def synchronise(
        self, runner: OperationRunner, now: Callable[[], float], wall_us: Callable[[], int]
    ) -> None:
        """Ask for the time, and tell ours after the first burst. now: s. wall_us: Unix time."""

        def answered(answer: TimSyncResponse | None) -> None:
            offset_us = wall_us() - round(now() * 1e6)
            if self._answered(answer, now()) or self._was_set(offset_us):
                self._offset_us = offset_us
                runner.start(self._set_unit_clock(wall_us()), lambda told: None, lambda error: None)

        runner.start(self._sync(now()), answered, lambda error: None)

    def _sync(self, now_s: float) -> Operation[TimSyncResponse | None]:
        """Ask for the time, once: an answer to a repetition would tell nothing."""
        response = yield from attempt(TimSyncRequest(round(now_s * 1e6)), attempts=1)
        return response.message if isinstance(response.message, TimSyncResponse) else None

    def _answered(self, answer: TimSyncResponse | None, now_s: float) -> bool:
        """Enter an answer that came just now; True when the unit's clock should be set."""
        if answer is None:
            self.end()
            return False
        sample = ClockSample(
            answer.host_us, answer.heard_us, answer.answered_us, round(now_s * 1e6)
        )
        self._estimator.add(sample)
        estimate = self._estimator.estimate
        if estimate is not None:
            self._statistics.clock_skew_ppm = round(estimate.skew_ppm, 3)
            self._statistics.clock_uncertainty_ms = round(estimate.uncertainty_us / 1000.0, 3)
        return self._requests == BURST and answer.unix_us == 0

    def _was_set(self, offset_us: int) -> bool:
        """Whether our clock was set since the unit was met or told the time last."""
        if self._offset_us is None:
            self._offset_us = offset_us
        return self._due_s is not None and set_by_us(self._offset_us, offset_us) != 0

    def _set_unit_clock(self, unix_us: int) -> Operation[None]:
        """Tell the unit the time of the world, if we know it."""
        estimate = self._estimator.estimate
        if estimate is None or unix_us < PLAUSIBLE_UNIX_US:
            return
        uncertainty_us = min(round(estimate.uncertainty_us), UNCERTAINTY_US_MAX)
        yield from attempt(TimSetRequest(unix_us, 0, uncertainty_us))
