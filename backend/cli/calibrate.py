"""`spindle calibrate evaluate` and `paper`: a certificate's file, worked out again or printed; no
server is needed."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import asdict
from pathlib import Path
from typing import Any

from backend.calibration.certificate import Evaluated, is_certificate, written_document
from backend.calibration.certificate import evaluate as evaluate_certificate
from backend.calibration.paper.pdf import certificate_paper
from backend.calibration.plain import to_plain
from backend.cli.client import print_json, text_of, write_out
from backend.cli.device import read_json
from backend.core.canonical_json import sha256_of
from backend.errors import InvalidRequest

SHOWN_MAX = 20
"""Differences that are listed; a wrong arm changes hundreds of numbers."""


def evaluate(options: Namespace) -> int:
    """A certificate worked out again; 1 unless all of it follows from its raw captures."""
    return _certificate(certificate_in(options.file), options.json)


def paper(options: Namespace) -> int:
    """A certificate as a PDF to be signed."""
    manner = {name: getattr(options, name) for name in ("language", "zone", "paper")}
    body = certificate_in(options.file)
    write_out(certificate_paper(body, options.file.name, **manner), options.output)
    return 0


def certificate_in(file: Path) -> dict[str, Any]:
    """What a certificate's file says. Raises InvalidRequest where it is none."""
    body: dict[str, Any] = read_json(file)
    if not is_certificate(body):
        raise InvalidRequest(f"{file} is no certificate: of `GET /calibrations/N/certificate`.")
    return body


def _certificate(body: dict[str, Any], as_json: bool) -> int:
    evaluated = evaluate_certificate(body)
    document = written_document(body)
    unit = None if document is None else sha256_of(document)
    unit_changed = unit is not None and unit != body["written"].get("sha256")
    if as_json:
        print_json({**_plain(evaluated), "unit_sha256": unit, "unit_changed": unit_changed})
    else:
        _print(evaluated)
        if unit is not None:
            changed = ": CHANGED, another was written" if unit_changed else ""
            print(f"  {'in the unit':20} {unit[:16]}{changed}")
    return 0 if evaluated.reproduced and not unit_changed else 1


def _plain(evaluated: Evaluated) -> dict[str, Any]:
    return {
        "reproduced": evaluated.reproduced,
        "sha256": evaluated.sha256,
        "stated_sha256": evaluated.stated_sha256,
        "differences": [asdict(difference) for difference in evaluated.differences],
        "worked": to_plain(evaluated.worked),
    }


def _print(evaluated: Evaluated) -> None:
    about, worked = evaluated.content.about, evaluated.worked
    changed = "" if evaluated.sha256 == evaluated.stated_sha256 else ": CHANGED, it was another"
    print(f"Certificate {about.number} of {about.unit_key}, {evaluated.sha256}{changed}")
    state = "all of it follows from the raw captures"
    if evaluated.differences:
        state = f"{len(evaluated.differences)} VALUES DO NOT FOLLOW from the raw captures"
    print(f"  {len(evaluated.content.captures)} captures; {state}")
    for difference in evaluated.differences[:SHOWN_MAX]:
        stated, computed = text_of(difference.stated), text_of(difference.computed)
        print(f"  {difference.path}: says {stated}, is {computed}")
    if worked.fit is not None:
        for name in worked.fit.names:
            value = getattr(worked.fit.coefficients, name)
            print(f"  {name:20} {value:.6g} ± {worked.fit.expanded(name):.2g}")
    if worked.budget is not None:
        torque, expanded = worked.budget.torque_nm[-1], worked.budget.expanded_nm[-1]
        print(f"  {'uncertainty':20} ± {expanded:.2f} Nm at {torque:g} Nm, k = 2")
    judgement = worked.judgement
    print(f"  {'judgement':20} {judgement.verdict} ({judgement.limits.source})")
    for cause in judgement.causes:
        print(f"    {cause.weight}: {cause.sentence}")
