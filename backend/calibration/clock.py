"""Open jobs are dated anew when the host's clock is set, and say so.

Dates that this server gave before lie between its start and the moment of the change, by the clock
as it was; they move with it. Dates of an earlier server lie elsewhere and stay: a clock that starts
in the past is not told a time that it had already shown. What the unit was written with stays as it
is, and with it all that its certificate is made of: the unit keeps that certificate's hash. So does
a closed job, whose file never changes.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from backend.calibration.files import StoredCalibration, StoredCapture
from backend.calibration.job import is_written
from backend.calibration.records import CalibrationStore
from backend.core.moments import set_by_us
from backend.device.host_clock import wall_offset_us

OpenJob = tuple[StoredCalibration, Sequence[StoredCapture]]

DATES = frozenset({"at_us", "at_utc_us", "fitted_us"})


@dataclass(frozen=True)
class Jump:
    """A clock that showed from_us to to_us was set by by_us, negative for back."""

    from_us: int
    to_us: int
    by_us: int

    def moved(self, at_us: int) -> int:
        """A date, as the clock would have given it."""
        return at_us + self.by_us if self.from_us <= at_us <= self.to_us else at_us


class JobDates:
    """`tick` once a second. offset_us: Unix time minus a clock that nobody sets. now_us: Unix
    time."""

    def __init__(
        self,
        store: CalibrationStore,
        offset_us: Callable[[], int] = wall_offset_us,
        now_us: Callable[[], int] = lambda: time.time_ns() // 1000,
    ) -> None:
        self._store = store
        self._offset_us = offset_us
        self._now_us = now_us
        self._dated_by_us = offset_us()
        self._since_us = now_us()

    def tick(self) -> None:
        """Look at the clock. Raises StoreError; the next time does what was not done."""
        offset_us = self._offset_us()
        by_us = set_by_us(self._dated_by_us, offset_us)
        if by_us == 0:
            return
        jump = Jump(self._since_us, self._now_us() - by_us, by_us)
        self._store.redate(partial(redated, jump))
        self._dated_by_us = offset_us
        self._since_us += by_us


def redated(
    jump: Jump, job: StoredCalibration, captures: Sequence[StoredCapture]
) -> OpenJob | None:
    """An open job by the clock as it is now; None where none of its dates is wrong."""
    moved_job = replace(job, opened_us=jump.moved(job.opened_us), body=moved(job.body, jump))
    moved_captures = [
        replace(one, body=moved(one.body, jump), struck=moved(one.struck, jump)) for one in captures
    ]
    if moved_job == job and moved_captures == list(captures):
        return None
    dated = not (is_written(job.body) or job.body["pending"] is not None)
    entry = {"at_us": jump.to_us + jump.by_us, "by_us": jump.by_us, "dated": dated}
    dated_job, dated_captures = (moved_job, moved_captures) if dated else (job, captures)
    marked = {**dated_job.body, "clock_set": [*job.body.get("clock_set", ()), entry]}
    return replace(dated_job, body=marked), dated_captures


def moved(content: Any, jump: Jump) -> Any:
    """Plain JSON with its dates moved."""
    if isinstance(content, Mapping):
        return {
            name: jump.moved(value) if name in DATES and value is not None else moved(value, jump)
            for name, value in content.items()
        }
    return [moved(one, jump) for one in content] if isinstance(content, list) else content
