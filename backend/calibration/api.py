"""Calibration of a torque sensor: a job from its pre-checks to its certificate."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Query, Response

from backend.calibration.capture import state_of
from backend.calibration.figures import Evaluation, evaluate
from backend.calibration.paper.pdf import Language, Paper, certificate_file
from backend.calibration.plain import to_plain
from backend.calibration.service import Calibrations
from backend.calibration.setup import gravity_at
from backend.calibration.types import (
    REASON_MAX,
    CaptureRequest,
    CertificateFile,
    EvaluationRequest,
    GravityAt,
    Job,
    JobList,
    JobRequest,
    Reading,
    SetupRequest,
    VerifyRequest,
)
from backend.core.parameter_value import TOKEN, TOKEN_PATTERN
from backend.web.authentication import Author
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(prefix="/calibrations", tags=["calibration"], responses=refusals(404))
figures = APIRouter(prefix="/calibration", tags=["calibration"], responses=refusals())
UNIT = refusals(403, 404, 409, 503, 504)
NUMBER_MAX = 2**31 - 1
Provided = Annotated[Calibrations, provided("calibrations")]
JobId = Annotated[int, Path(ge=1, le=NUMBER_MAX)]
Reason = Annotated[str, Query(max_length=REASON_MAX, description="Why; kept.")]
Token = Annotated[str | None, Query(pattern=TOKEN_PATTERN, description=TOKEN)]


@figures.post("/evaluate", operation_id="evaluate_calibration")
def evaluate_calibration(body: EvaluationRequest) -> Evaluation:
    """Linearity, hysteresis and repeatability of a sensor from its readings."""
    return evaluate(body.full_scale_nm, body.load_nm, body.forward, body.reverse)


@router.post(
    "",
    operation_id="open_calibration",
    status_code=201,
    responses={**UNIT, 200: {"model": Job, "description": "The one that is open already"}},
)
def open_calibration(
    body: JobRequest, calibrations: Provided, response: Response, author: Author
) -> Job:
    """Opens a calibration of a connected unit; 200 with the open one where there is one."""
    job_id, is_new = calibrations.jobs.open(body.device_id, author)
    response.status_code = 201 if is_new else 200
    response.headers["location"] = f"/api/v1/calibrations/{job_id}"
    return calibrations.show.get(job_id)


@router.get("", operation_id="list_calibrations")
def list_calibrations(
    calibrations: Provided,
    unit_key: Annotated[str | None, Query(max_length=400)] = None,
    bike_id: Annotated[int | None, Query(ge=1, le=NUMBER_MAX)] = None,
) -> JobList:
    """Calibrations, newest first, of a unit or a bike where it is named."""
    return JobList(calibrations.show.list(unit_key, bike_id))


@router.get(
    "/{calibration_id}",
    operation_id="get_calibration_job",
)
def get_calibration_job(calibration_id: JobId, calibrations: Provided) -> Job:
    """All of a calibration: plan, captures, what follows from them, what was written, and the
    earlier ones of the bike and the model."""
    return calibrations.show.get(calibration_id)


@router.get(
    "/{calibration_id}/reading",
    operation_id="get_calibration_reading",
)
def get_calibration_reading(calibration_id: JobId, calibrations: Provided) -> Reading:
    """What the sensor reads now: the last 10 s, whether a capture can be taken, and why not."""
    return calibrations.show.reading(calibration_id)


@router.put(
    "/{calibration_id}/setup",
    operation_id="set_up_calibration",
    responses=refusals(404, 409),
)
def set_up_calibration(calibration_id: JobId, body: SetupRequest, calibrations: Provided) -> Job:
    """Gives it its instruments and plan. A fit of before is one no more; captures stay."""
    setup = body.model_dump()
    place = body.gravity
    if isinstance(place, GravityAt):
        gravity = gravity_at(place.latitude_deg, place.height_m, place.height_standard_m)
        setup["gravity"] = to_plain(gravity)
    else:
        setup["gravity"]["source"] = "given"
    calibrations.jobs.set_up(calibration_id, setup)
    return calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/captures",
    operation_id="capture",
    status_code=201,
    responses=refusals(404, 409),
)
def capture(calibration_id: JobId, body: CaptureRequest, calibrations: Provided) -> Job:
    """Takes the newest 3 s as a reading of what hangs there. Refused with every reason unless they
    are steady; a zero also while the unit tells of a foot on the pedal."""
    state = state_of(body.model_dump(exclude={"pedals_free"}))
    calibrations.jobs.capture(calibration_id, state, body.pedals_free)
    return calibrations.show.get(calibration_id)


@router.delete(
    "/{calibration_id}/captures/{number}",
    operation_id="strike_capture",
    responses=refusals(404, 409),
)
def strike_capture(
    calibration_id: JobId,
    number: Annotated[int, Path(ge=1, le=NUMBER_MAX)],
    calibrations: Provided,
    author: Author,
    reason: Reason = "",
) -> Job:
    """Strikes a capture out: it counts no more, and stays with the reason."""
    calibrations.jobs.strike(calibration_id, number, reason, author)
    return calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/fit",
    operation_id="fit_calibration",
    responses=refusals(404, 409),
)
def fit_calibration(calibration_id: JobId, calibrations: Provided) -> Job:
    """Holds what follows from the captures as the fit; refused by name where they contradict."""
    calibrations.jobs.fit(calibration_id)
    return calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/write",
    operation_id="write_calibration",
    responses=UNIT,
)
def write_calibration(
    calibration_id: JobId,
    calibrations: Provided,
    author: Author,
    reason: Reason = "",
    token: Token = None,
) -> Job:
    """Writes coefficients and record in one transaction, read back and compared. After an unknown
    outcome repeating it finds out."""
    calibrations.record.write(calibration_id, reason, author, token)
    return calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/verify",
    operation_id="verify_calibration",
    status_code=201,
    responses=refusals(404, 409),
)
def verify_calibration(calibration_id: JobId, body: VerifyRequest, calibrations: Provided) -> Job:
    """Takes a reading at a mass that the fit has not seen and compares it."""
    state = state_of({"kind": "verify", **body.model_dump()})
    calibrations.jobs.capture(calibration_id, state)
    return calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/restore",
    operation_id="restore_calibration",
    responses=UNIT,
)
def restore_calibration(
    calibration_id: JobId,
    calibrations: Provided,
    author: Author,
    reason: Reason = "",
    token: Token = None,
) -> Job:
    """Writes back what the unit had before."""
    calibrations.record.restore(calibration_id, reason, author, token)
    return calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/close",
    operation_id="close_calibration",
    responses=refusals(404, 409),
)
def close_calibration(calibration_id: JobId, calibrations: Provided, author: Author) -> Job:
    """Closes it: nothing of it changes any more, and it is a file."""
    calibrations.record.close(calibration_id, author)
    return calibrations.show.get(calibration_id)


@router.get(
    "/{calibration_id}/certificate",
    operation_id="get_calibration_certificate",
    response_model=CertificateFile,
    responses=refusals(404, 409),
)
def get_calibration_certificate(calibration_id: JobId, calibrations: Provided) -> Response:
    """The certificate as the file that `spindle calibrate evaluate` reads: the closed one's as it
    is kept; of an open one with a fit, as it would be now."""
    data = calibrations.show.certificate(calibration_id)
    name = certificate_file(calibration_id)
    headers = {"content-disposition": f'attachment; filename="{name}"'}
    return Response(data, media_type="application/json", headers=headers)


@router.get(
    "/{calibration_id}/certificate.pdf",
    operation_id="get_calibration_certificate_pdf",
    response_class=Response,
    responses={**refusals(404, 409), 200: {"content": {"application/pdf": {}}}},
)
def get_calibration_certificate_pdf(
    calibration_id: JobId,
    calibrations: Provided,
    language: Language = "en",
    zone: Annotated[str, Query(max_length=100, description="Of all moments; IANA name.")] = "UTC",
    paper: Paper = "a4",
) -> Response:
    """The certificate to be signed, of the same file: the same bytes for the same certificate."""
    data = calibrations.show.certificate_pdf(calibration_id, language, zone, paper)
    headers = {"content-disposition": f'inline; filename="calibration-{calibration_id}.pdf"'}
    return Response(data, media_type="application/pdf", headers=headers)
