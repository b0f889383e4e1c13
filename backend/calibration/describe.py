"""Kept jobs as the API describes them, and the certificate of a job: as it was written into the
unit, and with its verification.

What the unit keeps is the hash of the document before the verification, which needs the unit
written. So the file of a closed job has the last document with its own hash, and under `written`
what makes the one before out of it: without the verifying captures, and with what was worked out
then.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from backend.calibration.capture import Capture
from backend.calibration.certificate import About, certificate
from backend.calibration.coefficients import Coefficients
from backend.calibration.files import StoredCalibration, StoredCapture
from backend.calibration.job import Body, counting, is_written, require_setup, setup_in
from backend.calibration.judgement import Limits
from backend.calibration.plain import from_plain, to_plain
from backend.calibration.types import (
    CaptureSummary,
    ClockSet,
    JobState,
    JobSummary,
    RecordChange,
    RecordLine,
    Result,
    Struck,
)
from backend.calibration.unit_record import NUMBER, coefficients_of
from backend.calibration.verification import Past, past_of
from backend.calibration.worked import Worked, work_out
from backend.core.moments import utc, utc_or_none


def about_json(job: StoredCalibration, software: str) -> dict[str, Any]:
    """Whose certificate it is, as it is at the fit."""
    unit = job.body["unit"]
    return {
        "number": int(job.body["found"].get(NUMBER) or 0) + 1,
        "created_utc_us": job.body["fitted_us"],
        "unit_key": job.unit_key,
        "software": software,
        "serial": unit["serial_number"],
        "model": unit["model"],
        "market": unit["market"],
        "firmware_version": unit["firmware_version"],
        "bike": job.bike,
        "technician": job.author or None,
    }


def certificate_of(
    job: StoredCalibration, captures: Sequence[Capture], software: str
) -> dict[str, Any] | None:
    """What the captures that count come to, as a file; None before a fit.

    After a write, whoever and whenever it was made by is as it was then.
    """
    if job.body["fitted_us"] is None:
        return None
    written = job.body["certificate"]
    about = about_json(job, software) if written is None else written["about"]
    about = from_plain(About, {name: value for name, value in about.items() if value is not None})
    limits = limits_in(job.body)
    setup, unit_coefficients = require_setup(job.body), coefficients_of(job.body["found"])
    made = certificate(about, setup, tuple(captures), unit_coefficients, limits)
    if written is None:
        return made
    written_part = {"sha256": written["sha256"], "worked": written["worked"]}
    return {**made, "written": written_part}


def limits_in(body: Body) -> Limits:
    """What a job is judged by: as it was when it was opened."""
    return from_plain(Limits, body["limits"])


def written_part(made: Body) -> dict[str, Any]:
    """What a job keeps of the certificate that it wrote."""
    document = made["document"]
    parts = {name: document[name] for name in ("about", "worked")}
    return {**parts, "sha256": made["sha256"]}


SAME = 1e-6
"""As a share: parameters are 32 bit, and equal to a part in ten million."""


def worked_of(body: Body, captures: Sequence[StoredCapture]) -> Worked | None:
    """All that follows from a job's setup and captures; None before both are there."""
    setup, counted = setup_in(body), counting(captures)
    if setup is None or not counted:
        return None
    return work_out(setup, counted, coefficients_of(body["found"]), limits_in(body))


def state_of(job: StoredCalibration, worked: Worked | None) -> JobState:
    """Where a job stands, as of Job."""
    if job.closed_us is not None:
        return "closed"
    if is_written(job.body):
        has_unseen = worked is not None and any(entry.unseen for entry in worked.verifications)
        return "verified" if has_unseen else "written"
    if job.body["setup"] is None:
        return "setup"
    return "capturing" if job.body["fitted_us"] is None else "fitted"


def result_of(body: Body, worked: Worked | None, certificate_sha256: str | None) -> Result:
    """What a job comes to as it stands."""
    if worked is None or worked.fit is None or worked.budget is None:
        return Result(None if worked is None else worked.judgement.verdict)
    return Result(
        worked.judgement.verdict,
        past_of(worked.fit, body["fitted_us"] or 0),
        max(worked.budget.expanded_nm),
        max((side.linearity_line_pct for side in worked.figures), default=None),
        max((side.hysteresis_pct for side in worked.figures), default=None),
        is_written(body) and any(entry.unseen for entry in worked.verifications),
        certificate_sha256,
    )


def result_json(result: Result) -> dict[str, Any]:
    """A result as it is kept with a closed job."""
    past = None if result.past is None else to_plain(result.past)
    return {**{name: getattr(result, name) for name in Result.__dataclass_fields__}, "past": past}


def result_in(body: Body) -> Result:
    """The result of a closed job; nothing of an open one."""
    result = body["result"]
    if result is None:
        return Result()
    past = None if result["past"] is None else from_plain(Past, result["past"])
    return Result(**{**result, "past": past})


def summary_of(job: StoredCalibration, worked: Worked | None = None) -> JobSummary:
    """One line of a list. worked: of an open job whose state is told to the end."""
    return JobSummary(
        id=job.id,
        state=state_of(job, worked),
        unit_key=job.unit_key,
        bike_id=job.bike_id,
        model=job.model,
        opened_at=utc(job.opened_us),
        closed_at=utc_or_none(job.closed_us),
        author=job.author,
        author_proof=job.author_proof,
        file_sha256=job.sha256,
        result=result_in(job.body),
    )


def capture_views(
    body: Body, captures: Sequence[StoredCapture], worked: Worked | None
) -> Iterator[CaptureSummary]:
    """All of them, struck ones too; a job has no capture before its setup."""
    setup = setup_in(body)
    if setup is None:
        return
    unit_coefficients = coefficients_of(body["found"])
    fitted = worked.fit.coefficients if worked is not None and worked.fit is not None else None
    refusals = () if worked is None else worked.refusals
    for one in captures:
        capture = from_plain(Capture, one.body)
        yield CaptureSummary(
            number=capture.number,
            state=capture.state,
            load_nm=capture.state.load_nm(setup),
            mean_counts=capture.mean_counts,
            deviation_counts=capture.deviation_counts,
            count=capture.count,
            rejected=len(capture.rejected),
            duration_s=capture.duration_s,
            at=utc(capture.at_utc_us),
            found_nm=reading_nm(unit_coefficients, capture.mean_counts, capture.state.sensor_degc),
            fitted_nm=reading_nm(fitted, capture.mean_counts, capture.state.sensor_degc),
            unit_nm=body["unit_nm"].get(str(capture.number)),
            struck=None
            if one.struck is None
            else Struck(one.struck["reason"], one.struck["author"], utc(one.struck["at_us"])),
            refusals=tuple(
                refusal
                for refusal in refusals
                if one.struck is None and capture.number in refusal.captures
            ),
        )


def reading_nm(
    coefficients: Coefficients | None, counts: float | None, degc: float | None
) -> float | None:
    """One reading by coefficients; None where either is not there."""
    if coefficients is None or counts is None:
        return None
    temperatures = None if degc is None else [degc]
    return float(coefficients.torque_nm([counts], temperatures)[0])


def record_lines(body: Body, planned: Body | None) -> Iterator[RecordLine]:
    """The unit's record as it was found, beside what is to be written."""
    for name, stored in body["found"].items():
        value = None if planned is None else planned.get(name)
        low, high = body["free"].get(name, (None, None))
        beyond = value is not None and low is not None and not low <= value <= high
        yield RecordLine(name, stored, value, low, high, beyond)


def record_changes(body: Body) -> tuple[RecordChange, ...]:
    """What was done to the unit's record, oldest first."""
    return tuple(
        RecordChange(
            kind=one["kind"],
            at=utc(one["at_us"]),
            author=one["author"],
            reason=one["reason"],
            record=one["record"],
            before=one["before"],
            generation=one["generation"],
            certificate_sha256=one["certificate_sha256"],
        )
        for one in body["changes"]
    )


def clock_changes(body: Body) -> tuple[ClockSet, ...]:
    """When the host's clock was set while the job was open, oldest first."""
    return tuple(
        ClockSet(at=utc(one["at_us"]), by_s=one["by_us"] / 1e6, dated=one["dated"])
        for one in body.get("clock_set", ())
    )


def has_record(parameters: Body, record: Body) -> bool:
    """Whether a unit's parameters are a record, as 32 bit numbers are."""
    return all(same(parameters.get(name), value) for name, value in record.items())


def same(one: Any, other: Any) -> bool:
    """Whether two values of a parameter are one."""
    if isinstance(one, float) and isinstance(other, int | float):
        return abs(one - other) <= SAME * max(abs(one), abs(other))
    return bool(one == other)
