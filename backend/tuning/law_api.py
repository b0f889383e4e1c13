"""The law without a unit: surface, single points, lint."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter

from backend.law.finding import LintReport
from backend.tuning.limit_proof import ProofSubject, ProveLimits
from backend.tuning.models.curves import (
    ModeCurves,
    ModeCurvesRequest,
    TorqueSurface,
    TorqueSurfaceRequest,
)
from backend.tuning.models.law import (
    LintRequest,
    PointGains,
    PointsRequest,
    Surface,
    SurfaceRequest,
)
from backend.tuning.models.limit_proof import LimitProof, LimitProofRequest
from backend.tuning.models.why import Why, WhyRequest
from backend.tuning.preview import Preview
from backend.tuning.why import WhySteady
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(tags=["law"], responses=refusals())
TheProveLimits = Annotated[ProveLimits, provided("prove_limits")]
ThePreview = Annotated[Preview, provided("preview")]
TheWhySteady = Annotated[WhySteady, provided("why_steady")]


@router.post("/surface", operation_id="compute_surface", response_model=Surface)
def compute_surface(body: SurfaceRequest, preview: ThePreview) -> Any:
    """The gain over a grid of speeds and torque rates, by the unit's own C law."""
    return preview.surface(body.fuzzy_table.model_dump(), body.speeds_kmh, body.torque_rates)


@router.post("/surface/points", operation_id="compute_points", response_model=PointGains)
def compute_points(body: PointsRequest, preview: ThePreview) -> Any:
    """The gain at single points, by the unit's own C law."""
    return preview.points(body.fuzzy_table.model_dump(), body.points)


@router.post("/surface/torque", operation_id="compute_torque_surface", response_model=TorqueSurface)
def compute_torque_surface(body: TorqueSurfaceRequest, preview: ThePreview) -> Any:
    """What a steady push gets of a table for long, as motor, battery and market leave it."""
    return preview.torque_surface(
        body.parameters, body.mode, body.rider_torque_nm, body.speeds_kmh, body.torque_rates
    )


@router.post("/modes/curves", operation_id="compute_mode_curves", response_model=ModeCurves)
def compute_mode_curves(body: ModeCurvesRequest, preview: ThePreview) -> Any:
    """What each of the five modes gives for a steady push, by the unit's own C law."""
    return preview.mode_curves(body.parameters, body.rider_torque_nm, body.speeds_kmh)


@router.post("/lint", operation_id="lint_table", response_model=LintReport)
def lint_table(body: LintRequest, preview: ThePreview) -> Any:
    """What is wrong, doubtful or notable about a table before a rider finds out."""
    question = body.model_dump()
    return preview.lint(
        question["fuzzy_table"],
        question["assist_modes"],
        question["limits"],
        question["table"],
        question["taper_speeds_kmh"],
        question["gear_ratio"],
    )


@router.post(
    "/certificates",
    operation_id="prove_limits",
    response_model=LimitProof,
    responses=refusals(404, 409, 503, 504),
)
def prove_limits(body: LimitProofRequest, prove: TheProveLimits) -> Any:
    """What is proven of every ride with a configuration, against the law of its market."""
    return prove(
        ProofSubject(body.device_id, body.revision, body.library, body.changes(), body.parameters)
    )


@router.post("/why", operation_id="why_steady", response_model=Why)
def why_steady(body: WhyRequest, why: TheWhySteady) -> Any:
    """Why the law gives what it gives in a steady state, on the law's defaults and these."""
    return why(*body.parts())
