"""A calibration and its captures as they are kept, and as the file of a closed one tells them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any

Body = Mapping[str, Any]

FORMAT = "spindle-calibration"
CERTIFICATE, JOB = "certificate", "job"


@dataclass(frozen=True)
class KeptCapture:
    """One capture. number: from 1 in its calibration, never used again. body: plain JSON.

    struck: why, by whom and when it was struck out; None while it counts.
    """

    number: int
    body: Body
    struck: Body | None = None


@dataclass(frozen=True)
class KeptCalibration:
    """A job. body: all that is known of it but its captures, plain JSON. model: of the unit.

    closed_us: None while it is open. sha256: of the bytes of the closed one's file.
    """

    id: int
    unit_key: str
    bike_id: int | None
    model: str | None
    body: Body
    author: str
    author_proof: str | None
    opened_us: int
    closed_us: int | None = None
    sha256: str | None = None


def document_of(
    job: KeptCalibration, apart: tuple[KeptCapture, ...], certificate: Body | None
) -> dict[str, Any]:
    """A closed job's file, which alone brings the job back.

    certificate: as domain.calibration makes it, with the captures that count; None without a fit.
    apart: the captures that are not in it.
    """
    return {
        "format": FORMAT,
        "version": 1,
        CERTIFICATE: None if certificate is None else dict(certificate),
        JOB: {
            "unit_key": job.unit_key,
            "model": job.model,
            "body": dict(job.body),
            "author": job.author,
            "author_proof": job.author_proof,
            "opened_us": job.opened_us,
            "closed_us": job.closed_us,
            "captures": [asdict(capture) for capture in apart],
        },
    }


def numbers_of(certificate: Body | None) -> Iterator[int]:
    """The captures that a certificate holds."""
    return (int(one["number"]) for one in (certificate or {}).get("captures", ()))
