"""A calibration as it is requested and described: complete, so that nobody computes anything."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import BaseModel, Field

from backend.calibration.capture import State
from backend.calibration.prechecks import Check, Refusal
from backend.calibration.setup import MassClass, Setup, Side
from backend.calibration.verification import AmongModel, Change, Past
from backend.calibration.worked import Worked
from backend.core.api_models import RequestBody
from backend.core.author import AuthorProof
from backend.core.described import described
from backend.core.parameter_value import ParameterValue

Record = Mapping[str, ParameterValue | None]
JobState = Literal["setup", "capturing", "fitted", "written", "verified", "closed"]
Action = Literal["setup", "capture", "fit", "write", "verify", "restore", "close"]
Verdict = Literal["pass", "conditional", "fail"]
Angle = Annotated[
    float,
    Field(gt=-85, lt=85, description="0: the crank level and forward; positive: pedal going down."),
]
REASON_MAX = 400
Readings = Annotated[
    list[Annotated[list[float], Field(min_length=2, max_length=200)]],
    Field(min_length=1, max_length=100),
]


class EvaluationRequest(RequestBody):
    """Readings in Nm of `r` strokes over the `k` loads, rising and falling."""

    full_scale_nm: float = Field(gt=0.0)
    load_nm: list[float] = Field(min_length=2, max_length=200)
    forward: Readings
    reverse: Readings


class JobRequest(RequestBody):
    device_id: str = Field(max_length=400)


class GravityAt(RequestBody):
    """Of a place, by the normal gravity of WGS 84 with its free-air correction."""

    latitude_deg: float = Field(ge=-90, le=90)
    height_m: float = Field(ge=-500, le=9000)
    height_standard_m: float = Field(default=50.0, ge=0, le=1000)


class GravityInput(RequestBody):
    gravity_ms2: float = Field(ge=9.76, le=9.84)
    standard_ms2: float = Field(ge=0, le=0.05, description="Its standard uncertainty.")


class MassRequest(RequestBody):
    """One weight: of a class of OIML R 111, or weighed to within `limit_kg`."""

    name: str = Field(min_length=1, max_length=60)
    mass_kg: float = Field(ge=0.1, le=200)
    mass_class: MassClass | None = None
    limit_kg: float | None = Field(default=None, ge=0, le=10)


class SetupRequest(RequestBody):
    """Instruments and plan. The gain that the unit was made with is the unit's to tell."""

    arm_m: float = Field(ge=0.05, le=1.0, description="From the spindle's axis to the pedal's.")
    arm_limit_m: float = Field(ge=0, le=0.05, description="Half width of what it may be.")
    gravity: GravityAt | GravityInput
    masses: list[MassRequest] = Field(min_length=1, max_length=50)
    loads_kg: list[Annotated[float, Field(gt=0, le=200)]] = Field(
        min_length=1, max_length=50, description="What is hung on in turn, without the zero."
    )
    full_scale_nm: float = Field(ge=5, le=1000)
    strokes: int = Field(default=2, ge=1, le=10)
    sides: list[Side] = Field(default=["right", "left"], min_length=1, max_length=2)
    angles_deg: list[Angle] = Field(default=[0.0], min_length=1, max_length=12)
    level_limit_deg: float = Field(default=2.0, ge=0, le=10)
    resolution_counts: float = Field(default=1.0, ge=0, le=1000)
    thermometer_limit_k: float = Field(default=0.5, ge=0, le=10)
    zero_limit_nm_per_k: float = Field(default=0.02, ge=0)
    span_limit_share_per_k: float = Field(default=2e-4, ge=0)
    arm_again_m: float | None = Field(
        default=None, ge=0.05, le=1.0, description="The same length, read once more before the fit."
    )


class CaptureRequest(RequestBody):
    """What hangs there now. The sensor's temperature is the unit's to tell."""

    kind: Literal["zero", "load"]
    side: Side | None = None
    mass_kg: float = Field(default=0.0, ge=0, le=200)
    arm_m: float | None = Field(default=None, ge=0.05, le=1.0, description="The setup's if null.")
    crank_angle_deg: Angle = 0.0
    stroke: int = Field(default=1, ge=1, le=100)
    direction: Literal["loading", "unloading"] | None = None
    pedals_free: bool = Field(
        default=False,
        description="Somebody looked: nothing is on the pedals, although the unit tells of a foot.",
    )


class VerifyRequest(RequestBody):
    """A mass that the fit has not seen."""

    side: Side
    mass_kg: float = Field(gt=0, le=200)
    arm_m: float | None = Field(default=None, ge=0.05, le=1.0, description="The setup's if null.")
    crank_angle_deg: Angle = 0.0


@described
class Step:
    """One state to be captured."""

    state: State
    load_nm: float
    """What its mass makes."""
    capture: int | None
    """The newest that counts; null: to be done."""


@described
class Struck:
    """Why a capture does not count any more, by whom and since when."""

    reason: str
    author: str
    at: datetime


@described
class CaptureSummary:
    """One capture, without its raw counts, which the certificate has."""

    number: int
    state: State
    load_nm: float
    """As of the setup now."""
    mean_counts: float
    deviation_counts: float
    count: int
    rejected: int
    """Samples left out as outliers."""
    duration_s: float
    at: datetime
    found_nm: float | None
    """By the coefficients that the unit had."""
    fitted_nm: float | None
    """By those of the fit."""
    unit_nm: float | None
    """What the unit itself told then."""
    struck: Struck | None
    refusals: tuple[Refusal, ...]
    """Those that name this capture."""


@described
class RecordLine:
    """A parameter of the unit's record: as it was found, and as `write` makes it."""

    name: str
    found: ParameterValue | None
    planned: ParameterValue | None
    free_min: float | None
    """From here to `free_max` it needs no token."""
    free_max: float | None
    beyond: bool
    """Whether the new value needs the maker's token."""


@described
class RecordChange:
    """A change of the unit's record that was read back."""

    kind: Literal["write", "restore"]
    at: datetime
    author: str
    reason: str
    record: Record
    """What it has since."""
    before: Record
    generation: int
    """Of the unit's configuration."""
    certificate_sha256: str | None


@described
class ClockSet:
    """The host's clock was set while the calibration was open."""

    at: datetime
    by_s: float
    """Negative for back."""
    dated: bool
    """Dates of before were moved; else they stand: the unit has a certificate of them."""


@described
class Result:
    """What a job came to; null without a fit."""

    verdict: Verdict | None = None
    past: Past | None = None
    """Its coefficients with their uncertainty."""
    expanded_nm: float | None = None
    """The largest of the budget, k = 2."""
    linearity_pct: float | None = None
    """To the line, the worse side."""
    hysteresis_pct: float | None = None
    verified: bool = False
    certificate_sha256: str | None = None


@described
class JobSummary:
    """One line of a list."""

    id: int
    state: JobState
    unit_key: str
    bike_id: int | None
    model: str | None
    opened_at: datetime
    closed_at: datetime | None
    author: str
    author_proof: AuthorProof | None
    file_sha256: str | None
    """Of the file of a closed one."""
    result: Result


@described
class JobList:
    items: tuple[JobSummary, ...]


@described
class Job(JobSummary):
    """All of a calibration, so that a page has nothing to work out."""

    file_sha256: str | None
    """Of the file of a closed one."""
    device_id: str | None
    """The connection its unit is on now."""
    serial_number: str | None
    firmware_version: str | None
    market: str | None
    may: tuple[Action, ...]
    """What can be done now."""
    found: Record
    """The unit's record when the job was opened."""
    setup: Setup | None
    suggested_setup: Setup | None
    """The newest of another job here."""
    steps: tuple[Step, ...]
    next_step: int | None
    """Index into `steps`; null: all are done."""
    checks: tuple[Check, ...]
    """Of this moment; empty without a connection."""
    captures: tuple[CaptureSummary, ...]
    worked: Worked | None
    """All that follows from setup and captures."""
    fitted_at: datetime | None
    """Since when nothing of these changed after the fit."""
    certificate_sha256: str | None
    """What the unit's record is written with."""
    record: tuple[RecordLine, ...]
    changes: tuple[RecordChange, ...]
    expanded: Mapping[str, float]
    """Uncertainty (k = 2) of each coefficient that was fitted, by its name."""
    unsure: Literal["write", "restore"] | None
    """Begun, with unknown outcome in the unit; repeating it finds out."""
    clock_set: tuple[ClockSet, ...]
    earlier_of_bike: tuple[JobSummary, ...]
    earlier_of_model: tuple[JobSummary, ...]
    change: Change | None
    """Since the last one of this unit."""
    among_model: AmongModel | None
    """Against the newest of each other unit of the model."""


@described
class Reading:
    """The sensor now; null where nothing comes."""

    device_id: str | None
    steady: bool
    steady_s: float
    """For how long a capture could have been taken."""
    reasons: tuple[Refusal, ...]
    """Why it may not be captured."""
    t_s: tuple[float, ...]
    """Unit time before the newest row, thinned with `raw_counts`."""
    raw_counts: tuple[int | None, ...]
    mean_counts: float | None
    deviation_counts: float | None
    spread_counts: float | None
    """Of the means of its quarter seconds."""
    spread_allowed_counts: float | None
    window_s: float
    found_nm: float | None
    """Of the steady window by the coefficients that the unit had."""
    fitted_nm: float | None
    unit_nm: float | None
    sensor_degc: float | None
    cadence_rpm: float | None
    speed_kmh: float | None
    checks: tuple[Check, ...]


class CertificateFile(BaseModel):
    """What `spindle calibrate evaluate` reads; docs/calibration.md says what is in it."""

    document: dict[str, Any] | None
    sha256: str | None = None
    written: dict[str, Any] | None = None
    job: dict[str, Any] | None = None
