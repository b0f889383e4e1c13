"""The law without a unit: surface, single points, lint."""

from __future__ import annotations

from typing import Any, cast

from fastapi import APIRouter

from backend.api.models.certificate import Certificate, CertificateRequest
from backend.api.models.curves import (
    ModeCurves,
    ModeCurvesRequest,
    TorqueSurface,
    TorqueSurfaceRequest,
)
from backend.api.models.law import (
    LintReport,
    LintRequest,
    PointGains,
    PointsRequest,
    Surface,
    SurfaceRequest,
)
from backend.api.models.why import Why, WhyRequest
from backend.api.services import Provided
from backend.services.tuning.certify import Certified
from backend.web.problem import refusals

router = APIRouter(tags=["law"], responses=refusals())


@router.post("/surface", operation_id="compute_surface", response_model=Surface)
def compute_surface(body: SurfaceRequest, services: Provided) -> Any:
    """The gain over a grid of speeds and torque rates, by the unit's own C law."""
    return services.preview.surface(
        body.fuzzy_table.model_dump(), body.speeds_kmh, body.torque_rates
    )


@router.post("/surface/points", operation_id="compute_points", response_model=PointGains)
def compute_points(body: PointsRequest, services: Provided) -> Any:
    """The gain at single points, by the unit's own C law."""
    return services.preview.points(body.fuzzy_table.model_dump(), body.points)


@router.post("/surface/torque", operation_id="compute_torque_surface", response_model=TorqueSurface)
def compute_torque_surface(body: TorqueSurfaceRequest, services: Provided) -> Any:
    """What a steady push gets of a table for long, as motor, battery and market leave it."""
    parameters = cast("dict[str, Any]", body.parameters)
    return services.preview.torque_surface(
        parameters, body.mode, body.rider_torque_nm, body.speeds_kmh, body.torque_rates
    )


@router.post("/modes/curves", operation_id="compute_mode_curves", response_model=ModeCurves)
def compute_mode_curves(body: ModeCurvesRequest, services: Provided) -> Any:
    """What each of the five modes gives for a steady push, by the unit's own C law."""
    parameters = cast("dict[str, Any]", body.parameters)
    return services.preview.mode_curves(parameters, body.rider_torque_nm, body.speeds_kmh)


@router.post("/lint", operation_id="lint_table", response_model=LintReport)
def lint_table(body: LintRequest, services: Provided) -> Any:
    """What is wrong, doubtful or notable about a table before a rider finds out."""
    question = body.model_dump()
    return services.preview.lint(
        question["fuzzy_table"],
        question["assist_modes"],
        question["limits"],
        question["table"],
        question["taper_speeds_kmh"],
        question["gear_ratio"],
    )


@router.post(
    "/certificates",
    operation_id="certify",
    response_model=Certificate,
    responses=refusals(404, 409, 503, 504),
)
def certify(body: CertificateRequest, services: Provided) -> Any:
    """What is proven of every ride with a configuration, against the law of its market."""
    parameters = cast("dict[str, Any]", body.parameters)
    asked = Certified(body.device_id, body.revision, body.library, body.changes(), parameters)
    return services.certify(asked)


@router.post("/why", operation_id="why_steady", response_model=Why)
def why_steady(body: WhyRequest, services: Provided) -> Any:
    """Why the law gives what it gives in a steady state, on the law's defaults and these."""
    return services.why_steady(*body.parts())
