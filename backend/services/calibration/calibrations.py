"""The use cases of calibration together, as the API has them."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from backend.domain.calibration.judgement.limits import limits_table
from backend.services.calibration.jobs import CalibrationJobs
from backend.services.calibration.reading import Readings
from backend.services.calibration.readings import RecentReadings
from backend.services.calibration.show import CalibrationShow
from backend.services.calibration.writing import CalibrationRecord
from backend.services.tuning.tune import Tuning
from backend.services.units.connect import Devices
from backend.store import CalibrationStore


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
