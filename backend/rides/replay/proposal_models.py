"""Proposals: what is asked for, how far it is, what was found."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.core.parameter_value import Parameters
from backend.rides.replay.propose import ProposalFigure
from backend.tuning.library.models import LibraryEntry
from backend.tuning.types import ParameterChange

Objective = Literal["more_range", "gentler_start", "flatter_at_the_limit"]
Knob = Literal["ratio", "band", "filter", "torque_rate", "cells"]
KNOBS: tuple[Knob, ...] = ("ratio", "band", "filter", "torque_rate", "cells")


class ProposalRequest(RequestBody):
    """A wish, the rides it is measured on, and what may be turned for it."""

    ride_ids: Annotated[list[int], Field(min_length=1, max_length=5)]
    objective: Objective
    knobs: list[Knob] = Field(
        default_factory=lambda: list(KNOBS),
        min_length=1,
        max_length=5,
        description="`ratio` of the ridden modes, `band` below the cut-off speed, `filter` of the "
        "torque, `torque_rate` points as a whole, `cells` of the table as monotone steps.",
    )
    target_pct: float | None = Field(
        default=None,
        gt=0.0,
        le=80.0,
        description="How much more range, or how much less of what is to be gentler or flatter; "
        "10 or 20 without it.",
    )
    mass_kg: float | None = Field(default=None, ge=30.0, le=400.0)
    drag_area_m2: float | None = Field(default=None, ge=0.1, le=2.0)


class ProposalCandidate(Answer):
    """Settings that were found. The linter has no doubt of them that it has not of what is set
    now, and their limit proof holds."""

    gained_pct: float = Field(description="More range, or less of what is felt, by the twin.")
    meets_target: bool
    recommended: bool
    battery_wh_per_km: ProposalFigure
    duration_s: ProposalFigure
    parameters: Parameters
    changed: list[ParameterChange]
    limit_proof_sha256: str
    document: LibraryEntry = Field(description="The same, as `POST /library` takes it.")


class Proposal(Answer):
    """A job and what it found: `done` with candidates by how much they gain, `failed` with why."""

    id: str
    state: Literal["waiting", "riding", "proving", "done", "failed", "cancelled"]
    objective: Objective
    target_pct: float
    knobs: list[Knob] = Field(description="Those that do something on these rides.")
    ride_ids: list[int]
    config_source: Literal["ride", "defaults"]
    aim_before: float = Field(
        description="What the wish is measured by, as it is now: Wh/km of the battery, or Nm/s "
        "rms at the crank."
    )
    progress: float = Field(ge=0.0, le=1.0)
    rides_ridden: int
    seconds: float
    code: str | None
    detail: str | None
    candidates: list[ProposalCandidate]
