"""A certificate's file as a PDF: of a closed calibration, and of one with a fit as it is now."""

from __future__ import annotations

from typing import Any, Literal

from backend.calibration.capture import Capture
from backend.calibration.certificate import evaluate, written_document
from backend.calibration.plain import from_plain
from backend.core.calendar import zone_of
from backend.core.canonical_json import sha256_of
from backend.errors import FieldError, InvalidRequest

Language = Literal["en", "zh"]
Paper = Literal["a4", "letter"]


def certificate_file(job_id: int) -> str:
    """What the file of a certificate is called where it is given out."""
    return f"calibration-{job_id}.json"


def certificate_paper(
    body: dict[str, Any], file: str, language: Language, zone: str, paper: Paper
) -> bytes:
    """The PDF, the same bytes for the same file. file: its name, for whoever checks it. zone: of
    all moments, by its IANA name.

    Raises InvalidRequest for a file that is no certificate, a zone that is none.
    """
    from backend.calibration.paper.certificate import certificate_pdf
    from backend.calibration.paper.content import Certified, Change, ClockSet, Manner, Struck

    at = zone_of(zone)
    if at is None:
        fault = FieldError("zone", "unknown", f"zone: no time zone has the name {zone}")
        raise InvalidRequest(fault.message, "invalid_zone", [fault])
    written = written_document(body)
    job = body.get("job") or {"captures": [], "body": {"changes": []}, "closed_us": None}
    changes = job["body"]["changes"]
    certified = Certified(
        evaluated=evaluate(body),
        file=file,
        unit_sha256=None if written is None else sha256_of(written),
        closed_us=job["closed_us"],
        change=None
        if not changes
        else Change(changes[-1]["kind"], changes[-1]["at_us"], changes[-1]["generation"]),
        struck=[
            Struck(from_plain(Capture, one["body"]), struck["author"], struck["reason"])
            for one in job["captures"]
            if (struck := one["struck"]) is not None
        ],
        clock_set=[
            ClockSet(one["at_us"], one["dated"]) for one in job["body"].get("clock_set", ())
        ],
    )
    return certificate_pdf(certified, Manner(language, at, paper))
