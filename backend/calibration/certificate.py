"""The certificate: one document with the raw captures and all that follows from them.

As a file: `{"document": ..., "sha256": ...}`. The hash is of the document's canonical JSON; its
first eight bytes are what the unit keeps. `evaluate` works everything out again from the raw counts
and names what differs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import Field

from backend.calibration.capture import Capture, capture_of, faults_of_capture
from backend.calibration.coefficients import Coefficients
from backend.calibration.judgement import Limits
from backend.calibration.plain import Plain, from_plain, to_plain
from backend.calibration.setup import Setup, faults_of
from backend.calibration.worked import Worked, work_out
from backend.core.canonical_json import sha256_of
from backend.errors import FieldError, InvalidRequest

SAME_SHARE, SAME = 1e-7, 1e-9
"""Stated and computed numbers are the same within these: another computer adds in another order."""

Text = Annotated[str, Field(max_length=200)]


@dataclass(frozen=True, slots=True)
class About(Plain):
    """Which unit, when, by whom, with what. None: unknown. number: of the unit's calibrations,
    from 1. software: name and version of what worked it out."""

    number: Annotated[int, Field(ge=1)]
    created_utc_us: Annotated[int, Field(ge=0)]
    unit_key: Text
    software: Text
    serial: Text | None = None
    model: Text | None = None
    market: Text | None = None
    firmware_version: Text | None = None
    bike: Text | None = None
    technician: Text | None = None
    temperature_degc: float | None = None


@dataclass(frozen=True, slots=True)
class CertificateContent(Plain):
    """What a certificate is worked out from. found: the coefficients the unit had."""

    kind: Literal["spindle.torque_calibration"]
    format: Literal[1]
    about: About
    setup: Setup
    captures: Annotated[tuple[Capture, ...], Field(max_length=2000)]
    found: Coefficients | None
    limits: Limits


@dataclass(frozen=True, slots=True)
class Difference:
    """A number or word of the document that does not follow from its raw captures."""

    path: str
    stated: Any
    computed: Any


@dataclass(frozen=True, slots=True)
class Evaluated:
    """sha256: of the document as it is; stated_sha256: as it says. reproduced: both are the same
    and nothing differs."""

    content: CertificateContent
    worked: Worked
    sha256: str
    stated_sha256: str
    differences: tuple[Difference, ...]

    @property
    def reproduced(self) -> bool:
        """Whether the document is unchanged, and all of it follows from its raw captures."""
        return self.sha256 == self.stated_sha256 and not self.differences


def certificate(
    about: About,
    setup: Setup,
    captures: tuple[Capture, ...],
    unit_coefficients: Coefficients | None,
    limits: Limits,
) -> dict[str, Any]:
    """The file's content, plain JSON."""
    content = CertificateContent(
        "spindle.torque_calibration", 1, about, setup, captures, unit_coefficients, limits
    )
    document = to_plain(content) | {
        "worked": to_plain(work_out(setup, captures, unit_coefficients, limits))
    }
    return {"document": document, "sha256": sha256_of(document)}


def is_certificate(body: Any) -> bool:
    """Whether a file is one, rather than the readings of an error test."""
    return isinstance(body, dict) and isinstance(body.get("document"), dict)


def unit_mark(sha256: str) -> int:
    """What the unit keeps of a certificate: the first eight bytes of its hash, high byte first."""
    return int(sha256[:16], 16)


def written_document(body: Mapping[str, Any]) -> dict[str, Any] | None:
    """The document whose hash the unit keeps: the last one without its verifying captures, with
    what was worked out before them. None where the file tells of nothing written."""
    document, written = body.get("document"), body.get("written")
    if not isinstance(document, dict) or not isinstance(written, dict):
        return None
    before = [one for one in document["captures"] if one["state"]["kind"] != "verify"]
    return {**document, "captures": before, "worked": written.get("worked")}


def evaluate(body: Mapping[str, Any]) -> Evaluated:
    """A certificate worked out again from its raw counts.

    Raises InvalidRequest naming every field at fault where it cannot be read.
    """
    document = body.get("document")
    if not isinstance(document, dict) or not isinstance(body.get("sha256"), str):
        fault = FieldError("document", "missing", "a certificate has a document and its sha256")
        raise InvalidRequest(fault.message, "invalid_certificate", [fault])
    stated = document.get("worked")
    content = from_plain(
        CertificateContent, {k: v for k, v in document.items() if k != "worked"}, _faults
    )
    fresh = tuple(_again(capture) for capture in content.captures)
    worked = work_out(content.setup, fresh, content.found, content.limits)
    differences = [
        *_differences("captures", to_plain(content)["captures"], [to_plain(one) for one in fresh]),
        *_differences("worked", stated, to_plain(worked)),
    ]
    return Evaluated(content, worked, sha256_of(document), body["sha256"], tuple(differences))


def _faults(content: CertificateContent) -> list[FieldError]:
    faults = [
        FieldError(f"setup.{fault.field}", fault.code, fault.message)
        for fault in faults_of(content.setup)
    ]
    for index, capture in enumerate(content.captures):
        faults += [
            FieldError(f"captures[{index}].{fault.field}", fault.code, fault.message)
            for fault in faults_of_capture(capture)
        ]
    return faults


def _again(capture: Capture) -> Capture:
    return capture_of(
        capture.number, capture.state, capture.raw_counts, capture.duration_s, capture.at_utc_us
    )


def _differences(path: str, stated: Any, computed: Any) -> Iterator[Difference]:
    """Of what is stated; a figure that only a later version tells is no difference."""
    if isinstance(stated, dict) and isinstance(computed, dict):
        for name, value in stated.items():
            yield from _differences(f"{path}.{name}", value, computed.get(name))
    elif isinstance(stated, list) and isinstance(computed, list) and len(stated) == len(computed):
        for index, pair in enumerate(zip(stated, computed, strict=True)):
            yield from _differences(f"{path}[{index}]", *pair)
    elif not _same(stated, computed):
        yield Difference(path, stated, computed)


def _same(stated: Any, computed: Any) -> bool:
    numbers = isinstance(stated, float | int) and isinstance(computed, float | int)
    if numbers and not isinstance(stated, bool) and not isinstance(computed, bool):
        return math.isclose(stated, computed, rel_tol=SAME_SHARE, abs_tol=SAME)
    return bool(stated == computed)
