"""Calibration of a torque sensor: a job from its pre-checks to its certificate."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Path, Query, Response

from backend.api.models.calibration import (
    REASON_MAX,
    CaptureRequest,
    CertificateFile,
    GravityAt,
    Job,
    JobList,
    JobRequest,
    Reading,
    SetupRequest,
    VerifyRequest,
)
from backend.api.models.config import TOKEN, TOKEN_PATTERN
from backend.api.services import Provided
from backend.domain.calibration.capture import state_of
from backend.domain.calibration.gravity import gravity_at
from backend.domain.calibration.plain import to_plain
from backend.services.calibration.paper import Language, Paper, certificate_file
from backend.web.authentication import Author
from backend.web.problem import refusals

router = APIRouter(prefix="/calibrations", tags=["calibration"], responses=refusals(404))
UNIT = refusals(403, 404, 409, 503, 504)
NUMBER_MAX = 2**31 - 1
JobId = Annotated[int, Path(ge=1, le=NUMBER_MAX)]
Reason = Annotated[str, Query(max_length=REASON_MAX, description="Why; kept.")]
Token = Annotated[str | None, Query(pattern=TOKEN_PATTERN, description=TOKEN)]


@router.post(
    "", operation_id="open_calibration", status_code=201, response_model=Job, responses=UNIT
)
def open_calibration(
    body: JobRequest, services: Provided, response: Response, author: Author
) -> Any:
    """Opens a calibration of a connected unit; 200 with the open one where there is one."""
    job_id, is_new = services.calibrations.jobs.open(body.device_id, author)
    response.status_code = 201 if is_new else 200
    response.headers["location"] = f"/api/v1/calibrations/{job_id}"
    return services.calibrations.show.get(job_id)


@router.get("", operation_id="list_calibrations", response_model=JobList)
def list_calibrations(
    services: Provided,
    unit_key: Annotated[str | None, Query(max_length=400)] = None,
    bike_id: Annotated[int | None, Query(ge=1, le=NUMBER_MAX)] = None,
) -> dict[str, Any]:
    """Calibrations, newest first, of a unit or a bike where it is named."""
    return {"items": services.calibrations.show.list(unit_key, bike_id)}


@router.get("/{calibration_id}", operation_id="get_calibration_job", response_model=Job)
def get_calibration_job(calibration_id: JobId, services: Provided) -> Any:
    """All of a calibration: plan, captures, what follows from them, what was written, and the
    earlier ones of the bike and the model."""
    return services.calibrations.show.get(calibration_id)


@router.get(
    "/{calibration_id}/reading", operation_id="get_calibration_reading", response_model=Reading
)
def get_calibration_reading(calibration_id: JobId, services: Provided) -> Any:
    """What the sensor reads now: the last 10 s, whether a capture can be taken, and why not."""
    return services.calibrations.show.reading(calibration_id)


@router.put(
    "/{calibration_id}/setup",
    operation_id="set_up_calibration",
    response_model=Job,
    responses=refusals(404, 409),
)
def set_up_calibration(calibration_id: JobId, body: SetupRequest, services: Provided) -> Any:
    """Gives it its instruments and plan. A fit of before is one no more; captures stay."""
    told = body.model_dump()
    place = body.gravity
    if isinstance(place, GravityAt):
        found = gravity_at(place.latitude_deg, place.height_m, place.height_standard_m)
        told["gravity"] = to_plain(found)
    else:
        told["gravity"]["source"] = "given"
    services.calibrations.jobs.set_up(calibration_id, told)
    return services.calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/captures",
    operation_id="capture",
    status_code=201,
    response_model=Job,
    responses=refusals(404, 409),
)
def capture(calibration_id: JobId, body: CaptureRequest, services: Provided) -> Any:
    """Takes the newest 3 s as a reading of what hangs there. Refused with every reason unless they
    are steady; a zero also while the unit tells of a foot on the pedal."""
    state = state_of(body.model_dump(exclude={"pedals_free"}))
    services.calibrations.jobs.capture(calibration_id, state, body.pedals_free)
    return services.calibrations.show.get(calibration_id)


@router.delete(
    "/{calibration_id}/captures/{number}",
    operation_id="strike_capture",
    response_model=Job,
    responses=refusals(404, 409),
)
def strike_capture(
    calibration_id: JobId,
    number: Annotated[int, Path(ge=1, le=NUMBER_MAX)],
    services: Provided,
    author: Author,
    reason: Reason = "",
) -> Any:
    """Strikes a capture out: it counts no more, and stays with the reason."""
    services.calibrations.jobs.strike(calibration_id, number, reason, author)
    return services.calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/fit",
    operation_id="fit_calibration",
    response_model=Job,
    responses=refusals(404, 409),
)
def fit_calibration(calibration_id: JobId, services: Provided) -> Any:
    """Holds what follows from the captures as the fit; refused by name where they contradict."""
    services.calibrations.jobs.fit(calibration_id)
    return services.calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/write",
    operation_id="write_calibration",
    response_model=Job,
    responses=UNIT,
)
def write_calibration(
    calibration_id: JobId,
    services: Provided,
    author: Author,
    reason: Reason = "",
    token: Token = None,
) -> Any:
    """Writes coefficients and record in one transaction, read back and compared. After an unknown
    outcome repeating it finds out."""
    services.calibrations.record.write(calibration_id, reason, author, token)
    return services.calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/verify",
    operation_id="verify_calibration",
    status_code=201,
    response_model=Job,
    responses=refusals(404, 409),
)
def verify_calibration(calibration_id: JobId, body: VerifyRequest, services: Provided) -> Any:
    """Takes a reading at a mass that the fit has not seen and compares it."""
    state = state_of({"kind": "verify", **body.model_dump()})
    services.calibrations.jobs.capture(calibration_id, state)
    return services.calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/restore",
    operation_id="restore_calibration",
    response_model=Job,
    responses=UNIT,
)
def restore_calibration(
    calibration_id: JobId,
    services: Provided,
    author: Author,
    reason: Reason = "",
    token: Token = None,
) -> Any:
    """Writes back what the unit had before."""
    services.calibrations.record.restore(calibration_id, reason, author, token)
    return services.calibrations.show.get(calibration_id)


@router.post(
    "/{calibration_id}/close",
    operation_id="close_calibration",
    response_model=Job,
    responses=refusals(404, 409),
)
def close_calibration(calibration_id: JobId, services: Provided, author: Author) -> Any:
    """Closes it: nothing of it changes any more, and it is a file."""
    services.calibrations.record.close(calibration_id, author)
    return services.calibrations.show.get(calibration_id)


@router.get(
    "/{calibration_id}/certificate",
    operation_id="get_calibration_certificate",
    response_model=CertificateFile,
    responses=refusals(404, 409),
)
def get_calibration_certificate(calibration_id: JobId, services: Provided) -> Response:
    """The certificate as the file that `spindle calibrate evaluate` reads: the closed one's as it
    is kept; of an open one with a fit, as it would be now."""
    data = services.calibrations.show.certificate(calibration_id)
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
    services: Provided,
    language: Language = "en",
    zone: Annotated[str, Query(max_length=100, description="Of all moments; IANA name.")] = "UTC",
    paper: Paper = "a4",
) -> Response:
    """The certificate to be signed, of the same file: the same bytes for the same certificate."""
    data = services.calibrations.show.certificate_pdf(calibration_id, language, zone, paper)
    headers = {"content-disposition": f'inline; filename="calibration-{calibration_id}.pdf"'}
    return Response(data, media_type="application/pdf", headers=headers)
