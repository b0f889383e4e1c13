"""A calibration as the pages and programs see it: complete, so that nobody computes anything."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from backend.domain.calibration.capture import State
from backend.domain.calibration.judgement.history import AmongModel, Change, Past
from backend.domain.calibration.prechecks import Check
from backend.domain.calibration.refusal import Refusal
from backend.domain.calibration.setup import Setup
from backend.domain.calibration.worked import Worked
from backend.services.calibration.plan import Step

Record = Mapping[str, Any]


@dataclass(frozen=True)
class Struck:
    """Why a capture does not count any more, by whom and since when."""

    reason: str
    author: str
    at: datetime


@dataclass(frozen=True)
class CaptureView:
    """One capture. load_nm: as of the setup now. found_nm, fitted_nm: the reading by the unit's
    old coefficients and by the fit's. unit_nm: what the unit itself told then. refusals: those
    that name it."""

    number: int
    state: State
    load_nm: float
    mean_counts: float
    deviation_counts: float
    count: int
    rejected: int
    duration_s: float
    at: datetime
    found_nm: float | None
    fitted_nm: float | None
    unit_nm: float | None
    struck: Struck | None
    refusals: tuple[Refusal, ...]


@dataclass(frozen=True)
class RecordLine:
    """A parameter of the unit's record: as it was found, and as `write` makes it. free_min,
    free_max: what needs no token; beyond: whether the new value does."""

    name: str
    found: Any
    planned: Any
    free_min: float | None
    free_max: float | None
    beyond: bool


@dataclass(frozen=True)
class RecordChange:
    """A change of the unit's record that was read back. kind: `write` or `restore`. record: what
    it has since; before: what it had. generation: of the unit's configuration."""

    kind: str
    at: datetime
    author: str
    reason: str
    record: Record
    before: Record
    generation: int
    certificate_sha256: str | None


@dataclass(frozen=True)
class ClockSet:
    """The host's clock was set by by_s, negative for back, while the job was open. dated: its dates
    of before were moved; else they stand, since the unit has a certificate made with them."""

    at: datetime
    by_s: float
    dated: bool


@dataclass(frozen=True)
class Result:
    """What a job came to. past: its coefficients with their uncertainty. expanded_nm: the largest
    of the budget. linearity_pct: to the line, the worse side. All None of a job without a fit. That
    of an open job is told in JobView only."""

    verdict: str | None = None
    past: Past | None = None
    expanded_nm: float | None = None
    linearity_pct: float | None = None
    hysteresis_pct: float | None = None
    verified: bool = False
    certificate_sha256: str | None = None


@dataclass(frozen=True)
class JobSummary:
    """One line of a list. state: as in JobView. file_sha256: of a closed one's file."""

    id: int
    state: str
    unit_key: str
    bike_id: int | None
    model: str | None
    opened_at: datetime
    closed_at: datetime | None
    author: str
    author_proof: str | None
    file_sha256: str | None
    result: Result


@dataclass(frozen=True)
class JobView(JobSummary):
    """All of a job.

    state: `setup`, `capturing`, `fitted`, `written`, `verified`, `closed`. device_id: the
    connection its unit is on now, None while it is on none. may: what can be done now, of `setup`,
    `capture`, `fit`, `write`, `verify`, `restore`, `close`. suggested_setup: the newest one of
    another job here, for the same instruments. next_step: index into steps, None when all are done.
    checks: of this moment; empty without a connection. worked: all that follows from setup and
    captures. expanded: of each coefficient that is fitted. fitted_at: since when nothing of these
    changed after `fit`. unsure: a write or restore of which nobody knows whether the unit has it;
    repeating it finds out. change: since the last one of this bike. among_model: against the newest
    of each other unit of the model.
    """

    device_id: str | None
    serial_number: str | None
    firmware_version: str | None
    market: str | None
    may: tuple[str, ...]
    found: Record
    setup: Setup | None
    suggested_setup: Setup | None
    steps: tuple[Step, ...]
    next_step: int | None
    checks: tuple[Check, ...]
    captures: tuple[CaptureView, ...]
    worked: Worked | None
    fitted_at: datetime | None
    certificate_sha256: str | None
    record: tuple[RecordLine, ...]
    changes: tuple[RecordChange, ...]
    expanded: Mapping[str, float]
    unsure: str | None
    clock_set: tuple[ClockSet, ...]
    earlier_of_bike: tuple[JobSummary, ...]
    earlier_of_model: tuple[JobSummary, ...]
    change: Change | None
    among_model: AmongModel | None


@dataclass(frozen=True)
class ReadingView:
    """What the sensor reads now. t_s: unit time before the newest row, thinned with raw_counts.
    steady_s: for how long a capture could have been taken. found_nm, fitted_nm, unit_nm: of the
    steady window, as in CaptureView; all of it None where nothing comes."""

    device_id: str | None
    steady: bool
    steady_s: float
    reasons: tuple[Refusal, ...]
    t_s: tuple[float, ...]
    raw_counts: tuple[int | None, ...]
    mean_counts: float | None
    deviation_counts: float | None
    spread_counts: float | None
    spread_allowed_counts: float | None
    window_s: float
    found_nm: float | None
    fitted_nm: float | None
    unit_nm: float | None
    sensor_degc: float | None
    cadence_rpm: float | None
    speed_kmh: float | None
    checks: tuple[Check, ...]
