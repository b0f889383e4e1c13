"""The use cases of calibration together: jobs as pages see them, and what the sensor reads now."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from backend.calibration import job as kept
from backend.calibration.describe import (
    capture_views,
    certificate_of,
    clock_changes,
    record_changes,
    record_lines,
    result_in,
    result_of,
    summary_of,
    worked_of,
)
from backend.calibration.files import StoredCalibration
from backend.calibration.fit import fit
from backend.calibration.job import steps
from backend.calibration.jobs import CalibrationJobs
from backend.calibration.judgement import limits_table
from backend.calibration.paper.pdf import Language, Paper, certificate_file, certificate_paper
from backend.calibration.reading import Readings
from backend.calibration.records import CalibrationStore
from backend.calibration.samples import RecentReadings
from backend.calibration.types import Action, Job, JobSummary, Reading, Step
from backend.calibration.verification import Past, among_model, change
from backend.calibration.worked import Worked
from backend.calibration.writing import CalibrationRecord
from backend.core.canonical_json import canonical_text
from backend.core.moments import utc_or_none
from backend.tuning.service import Tuning
from backend.units.service import Devices

EARLIER_MAX = 10


class CalibrationShow:
    """Reads only. For any thread. software: name and version."""

    def __init__(
        self,
        jobs: CalibrationJobs,
        record: CalibrationRecord,
        store: CalibrationStore,
        readings: Readings,
        software: str,
    ) -> None:
        self._jobs = jobs
        self._record = record
        self._store = store
        self._readings = readings
        self._software = software

    def list(self, unit_key: str | None, bike_id: int | None) -> tuple[JobSummary, ...]:
        """Jobs, newest first, of a unit and a bike where they are named."""
        return tuple(map(self._summary, self._store.list(unit_key, bike_id)))

    def get(self, job_id: int) -> Job:
        """All of a job. Raises NotFound."""
        job = self._store.get(job_id)
        body = job.body
        captures = self._store.captures(job_id)
        worked = worked_of(body, captures)
        device = self._jobs.connection(job)
        counted = kept.counting(captures)
        planned = self._record.planned(job, counted)
        setup = kept.setup_in(body)
        plan = () if setup is None else steps(setup, counted)
        others = [one for one in self._store.list() if one.id != job_id]
        summary = summary_of(job, worked)
        if job.closed_us is None:
            summary = replace(summary, result=result_of(body, worked, None))
        now = summary.result.past
        return Job(
            **{name: getattr(summary, name) for name in JobSummary.__dataclass_fields__},
            device_id=None if device is None else device.id,
            serial_number=body["unit"]["serial_number"],
            firmware_version=body["unit"]["firmware_version"],
            market=body["unit"]["market"],
            may=tuple(may(job, worked, device is not None)),
            found=body["found"],
            setup=setup,
            suggested_setup=next(
                (kept.setup_in(one.body) for one in others if one.body["setup"]), None
            ),
            steps=plan,
            next_step=next_step(plan),
            checks=() if device is None or job.closed_us else self._readings.checks(device, body),
            captures=tuple(capture_views(body, captures, worked)),
            worked=worked,
            fitted_at=utc_or_none(body["fitted_us"]),
            certificate_sha256=None if planned is None else planned[1]["sha256"],
            record=tuple(record_lines(body, None if planned is None else planned[0])),
            changes=record_changes(body),
            expanded=expanded_of(worked),
            unsure=None if body["pending"] is None else body["pending"]["kind"],
            clock_set=clock_changes(body),
            earlier_of_bike=self._earlier(job, [o for o in others if is_of_bike(o, job)]),
            earlier_of_model=self._earlier(
                job, [o for o in others if o.model == job.model and not is_of_bike(o, job)]
            ),
            change=None
            if now is None
            else change(now, pasts(o for o in others if o.unit_key == job.unit_key)),
            among_model=None if now is None else among_model(now, self._of_model(job, others)),
        )

    def reading(self, job_id: int) -> Reading:
        """What the sensor of a job's unit reads now. Raises NotFound."""
        job = self._store.get(job_id)
        device, setup = self._jobs.connection(job), kept.setup_in(job.body)
        fitted = None
        if setup is not None and job.body["fitted_us"] is not None:
            fitted = fit(setup, kept.counting(self._store.captures(job_id))).coefficients
        return self._readings.now(device, job.body, setup, fitted)

    def certificate(self, job_id: int) -> bytes:
        """A closed job's file, byte by byte; of an open one with a fit, what it would be now.

        Raises NotFound, Conflict before a fit, ObjectDamaged.
        """
        job = self._store.get(job_id)
        if job.sha256 is not None:
            return self._store.file(job)
        captures = kept.counting(self._store.captures(job_id))
        made = certificate_of(job, captures, self._software)
        if made is None:
            raise kept.not_fitted()
        return canonical_text(made).encode()

    def certificate_pdf(self, job_id: int, language: Language, zone: str, paper: Paper) -> bytes:
        """`certificate` on paper. zone: of all moments, by its IANA name.

        Raises NotFound, Conflict before a fit, ObjectDamaged, InvalidRequest for no zone.
        """
        body = json.loads(self.certificate(job_id))
        return certificate_paper(body, certificate_file(job_id), language, zone, paper)

    # ------------------------------------------------------------------ inside

    def _summary(self, job: StoredCalibration) -> JobSummary:
        if job.closed_us is not None:
            return summary_of(job)
        return summary_of(job, worked_of(job.body, self._store.captures(job.id)))

    def _earlier(
        self, job: StoredCalibration, others: Sequence[StoredCalibration]
    ) -> tuple[JobSummary, ...]:
        closed = [one for one in others if one.closed_us and one.opened_us < job.opened_us]
        return tuple(map(summary_of, closed[:EARLIER_MAX]))

    def _of_model(
        self, job: StoredCalibration, others: Sequence[StoredCalibration]
    ) -> Sequence[Past]:
        """The newest of each other unit of a job's model."""
        newest: dict[str, Past] = {}
        for one in others:
            past = result_in(one.body).past
            if past is not None and one.model == job.model and one.unit_key != job.unit_key:
                newest.setdefault(one.unit_key, past)
        return list(newest.values())


def expanded_of(worked: Worked | None) -> dict[str, float]:
    """The expanded uncertainty of each coefficient that was fitted."""
    fit = None if worked is None else worked.fit
    return {} if fit is None else {name: fit.expanded(name) for name in fit.names}


def is_of_bike(one: StoredCalibration, job: StoredCalibration) -> bool:
    """Whether a job was of another's bike, be it with another unit."""
    return one.unit_key == job.unit_key or (one.bike_id is not None and one.bike_id == job.bike_id)


def pasts(jobs: Iterator[StoredCalibration]) -> Sequence[Past]:
    """What closed jobs came to."""
    past_results = (result_in(job.body).past for job in jobs)
    return [past for past in past_results if past is not None]


def next_step(plan: Sequence[Step]) -> int | None:
    """Index of the first step that is to be done."""
    return next((place for place, step in enumerate(plan) if step.capture is None), None)


def may(job: StoredCalibration, worked: Worked | None, connected: bool) -> Iterator[Action]:
    """What can be done with a job now, as of Job."""
    if job.closed_us is not None:
        return
    body = job.body
    written, unsure = kept.is_written(body), body["pending"] is not None
    if not written and not unsure:
        yield "setup"
        if body["setup"] is not None and connected:
            yield "capture"
        if worked is not None and worked.fit is not None:
            yield "fit"
    if body["fitted_us"] is not None and not written and connected:
        yield "write"
    if written and connected:
        yield from ("verify", "restore")
    if not unsure:
        yield "close"


@dataclass(frozen=True)
class Calibrations:
    """readings: of the sensors now. jobs: opened, set up, captured, fitted. record: the unit's,
    written and restored; a job closed. show: all of it told."""

    readings: Readings
    jobs: CalibrationJobs
    record: CalibrationRecord
    show: CalibrationShow


def open_calibrations(
    devices: Devices,
    store: CalibrationStore,
    tuning: Tuning,
    version: str,
    limits: Sequence[Any] = (),
    now_s: Callable[[], float] = time.monotonic,
    unix_s: Callable[[], float] = time.time,
) -> Calibrations:
    """Over units whose streams are followed from now on. version: of this Spindle, for
    certificates. limits: plain tables of the house's own. now_s: any steady clock.
    unix_s: Unix time.

    Raises InvalidRequest for limits that are none.
    """
    software = f"spindle {version}"
    recent = RecentReadings(now_s)
    devices.watch(recent.follow)
    readings = Readings(recent)
    jobs = CalibrationJobs(devices, store, readings, limits_table(limits), unix_s)
    record = CalibrationRecord(jobs, store, tuning, software, unix_s)
    show = CalibrationShow(jobs, record, store, readings, software)
    return Calibrations(readings, jobs, record, show)
