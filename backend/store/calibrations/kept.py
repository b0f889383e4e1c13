"""A calibration and its captures as they are kept, and as the file of a closed one tells them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

Body = Mapping[str, Any]

DOCUMENT, JOB = "document", "job"


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

    closed_us: None while it is open. sha256: of the bytes of the closed one's file. bike: its name
    now.
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
    bike: str | None = None


def document_of(
    job: KeptCalibration, apart: tuple[KeptCapture, ...], certificate: Body | None
) -> dict[str, Any]:
    """A closed job's file: the certificate, if there is one, and what brings the job back.

    certificate: as domain.calibration makes it; its document holds the captures that count. apart:
    the captures that are not in it.
    """
    return {
        **({DOCUMENT: None} if certificate is None else certificate),
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


def told_captures(file: Body) -> Sequence[Body]:
    """The captures in the document of a file or certificate."""
    captures: Sequence[Body] = (file.get(DOCUMENT) or {"captures": ()})["captures"]
    return captures
