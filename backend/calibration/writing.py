"""The unit's record changed: what was fitted written, the old one restored, the job closed.

A change goes through tuning: one transaction, read back, compared, a revision. It is noted as
pending before it is begun, so that after a crash or a lost answer repeating it finds out whether
the unit has it.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

from backend.calibration import job as kept
from backend.calibration.capture import Capture
from backend.calibration.coefficients import Coefficients
from backend.calibration.describe import (
    certificate_of,
    has_record,
    result_json,
    result_of,
    worked_of,
    written_part,
)
from backend.calibration.files import StoredCalibration
from backend.calibration.jobs import CalibrationJobs
from backend.calibration.plain import from_plain
from backend.calibration.records import CalibrationStore
from backend.calibration.unit_record import record_of, record_to_write
from backend.core.audit import Action, AuditEntry, differing
from backend.errors import Conflict, NoAnswer, RequestRefused
from backend.tuning.service import Tuning


class CalibrationRecord:
    """Writes, restores, closes. For any thread. software: name and version. now_s: Unix time."""

    def __init__(
        self,
        jobs: CalibrationJobs,
        store: CalibrationStore,
        tuning: Tuning,
        software: str,
        now_s: Callable[[], float] = time.time,
    ) -> None:
        self._jobs = jobs
        self._store = store
        self._tuning = tuning
        self._software = software
        self._now_s = now_s

    def planned(
        self, job: StoredCalibration, captures: Sequence[Capture]
    ) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The record that `write` would make of the captures that count, and its certificate; None
        before a fit."""
        fitted = [one for one in captures if one.state.kind != "verify"]
        made = certificate_of(job, fitted, self._software)
        if made is None or made["document"]["worked"]["fit"] is None:
            return None
        written = job.body["certificate"]
        sha256 = made["sha256"] if written is None else written["sha256"]
        stored_fit = from_plain(Coefficients, made["document"]["worked"]["fit"]["coefficients"])
        return record_to_write(job.body["found"], stored_fit, job.body["fitted_us"], sha256), made

    def write(self, job_id: int, reason: str, author: str, token: str | None = None) -> None:
        """Write what was fitted. Repeated after nobody answered, it finds out what became of it.

        Raises Conflict without a fit, TokenNeeded beyond the band, and what tuning raises.
        """
        job = self._store.get(job_id)
        planned = self.planned(job, kept.counting(self._store.captures(job_id)))
        if planned is None:
            raise kept.not_fitted()
        if kept.is_written(job.body):
            raise Conflict("The unit has what was fitted already.", "already_written")
        record, made = planned
        certificate = job.body["certificate"] or written_part(made)
        reason = reason or f"Calibration {job_id}, certificate {certificate['sha256'][:16]}"
        self._change(job, kept.WRITE, record, certificate, reason, author, token)

    def restore(self, job_id: int, reason: str, author: str, token: str | None = None) -> None:
        """Write back what the unit had before. Raises Conflict where nothing is written, and as
        `write`."""
        job = self._store.get(job_id)
        kept.require_written(job.body)
        record = job.body["changes"][-1]["before"]
        reason = reason or f"Calibration {job_id} taken back"
        self._change(job, kept.RESTORE, record, None, reason, author, token)

    def close(self, job_id: int, author: str) -> None:
        """Close a job; its file is what `spindle calibrate evaluate` reads.

        Raises Conflict while the outcome of a write is unknown.
        """
        job = self._store.get(job_id)
        if job.body["pending"] is not None:
            raise Conflict(
                "Nobody knows yet whether the unit has what was begun to be written: repeat that "
                "first.",
                "write_unsure",
            )
        captures = self._store.captures(job_id)
        made = certificate_of(job, kept.counting(captures), self._software)
        result = result_of(
            job.body, worked_of(job.body, captures), None if made is None else made["sha256"]
        )
        done = kept.changed(result=result_json(result), closed_by=author)
        self._store.close(job_id, done, made)

    # ------------------------------------------------------------------ inside

    def _change(
        self,
        job: StoredCalibration,
        kind: str,
        record: dict[str, Any],
        certificate: dict[str, Any] | None,
        reason: str,
        author: str,
        token: str | None,
    ) -> None:
        device_id = self._jobs.connected(job)
        before = self._before(job, kind, device_id, record)
        at_us = int(self._now_s() * 1e6)
        pending = {"kind": kind, "record": record, "before": before, "at_us": at_us}
        self._store.change(job.id, kept.changed(pending=pending, certificate=certificate))
        try:
            written = self._tuning.write_config(
                device_id,
                record,
                reason,
                author=author,
                token=token,
                unit_key=job.unit_key,
                read_from=job.unit_key,
            )
        except (RequestRefused, NoAnswer) as error:
            # Only what nobody answered may be in the unit.
            if not (isinstance(error, NoAnswer) and error.outcome == "unknown"):
                undone = kept.changed(pending=None, certificate=job.body["certificate"])
                self._store.change(job.id, undone)
            raise
        change = {
            **pending,
            "author": author,
            "reason": reason,
            "generation": written.generation,
            "certificate_sha256": None if certificate is None else certificate["sha256"],
        }
        self._store.change(
            job.id,
            lambda body: {**body, "pending": None, "changes": [*body["changes"], change]},
            AuditEntry(
                Action.CALIBRATION_WRITTEN if kind == kept.WRITE else Action.CALIBRATION_RESTORED,
                job.id,
                None,
                *differing(before, record),
                reason,
                job.unit_key,
            ),
        )

    def _before(
        self, job: StoredCalibration, kind: str, device_id: str, record: dict[str, Any]
    ) -> dict[str, Any]:
        """What the unit had before a change, also where an earlier try may have made it."""
        pending = job.body["pending"]
        now = self._tuning.read_config(device_id).parameters
        if pending is not None and pending["kind"] == kind and has_record(now, record):
            before: dict[str, Any] = pending["before"]
            return before
        return record_of(now)
