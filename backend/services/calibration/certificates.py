"""The certificate of a job: as it was written into the unit, and with its verification.

What the unit keeps is the hash of the document before the verification, which needs the unit
written. So the file of a closed job has the last document with its own hash, and under `written`
what makes the one before out of it: without the verifying captures, and with what was worked out
then.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from backend.domain.calibration.capture import Capture
from backend.domain.calibration.certificate import About, certificate
from backend.domain.calibration.judgement.limits import Limits
from backend.domain.calibration.plain import from_plain
from backend.services.calibration.body import Body, require_setup
from backend.services.calibration.record import NUMBER, coefficients_of
from backend.store import KeptCalibration


def about_json(job: KeptCalibration, software: str) -> dict[str, Any]:
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
    job: KeptCalibration, captures: Sequence[Capture], software: str
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
    setup, found = require_setup(job.body), coefficients_of(job.body["found"])
    made = certificate(about, setup, tuple(captures), found, limits)
    if written is None:
        return made
    told = {"sha256": written["sha256"], "worked": written["worked"]}
    return {**made, "written": told}


def limits_in(body: Body) -> Limits:
    """What a job is judged by: as it was when it was opened."""
    return from_plain(Limits, body["limits"])


def written_part(made: Body) -> dict[str, Any]:
    """What a job keeps of the certificate that it wrote."""
    document = made["document"]
    kept = {name: document[name] for name in ("about", "worked")}
    return {**kept, "sha256": made["sha256"]}
