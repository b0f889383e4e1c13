"""Goal: a climb is compared with the certificate of the calibration that its unit had then, and
with no other.

Method: a calibration of the workshop, written, and restored; rides before and after it, under its
gain and under another one.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import pytest

from backend.calibration.certified_torque import CertifiedTorque
from backend.calibration.types import Job
from backend.core.ride import Ride, RideContext
from tests.unit.calibration.calibration_job import Workshop

pytestmark = pytest.mark.slow

GAIN = "sensor_gain_nm_per_count"
LATER_US = 60_000_000


def ride_at(view: Job, later_us: int) -> Ride:
    """Of the calibrated unit, so long after the write."""
    written_us = round(view.changes[0].at.timestamp() * 1e6)
    context = RideContext(unit_key=view.unit_key)
    begins_us = written_us + later_us
    return Ride(1, "done", "recorded", "", "", begins_us, 0, 10_000, (), (), context=context)


def test_the_certificate_that_the_unit_had_on_the_ride_tells(bench: Workshop) -> None:
    job = bench.fitted()
    bench.use.record.write(job.id, "", "Ada")
    view = bench.view()
    has: dict[str, Any] = {GAIN: bench.held[GAIN]}
    known = CertifiedTorque(bench.calibrations, lambda ride: (has, "ride"))
    budget = view.worked.budget if view.worked else None
    assert budget is not None

    told = known(ride_at(view, LATER_US), 30.0)

    assert told is not None
    assert (told.calibration_id, told.sha256) == (job.id, view.changes[0].certificate_sha256)
    assert told.expanded_share == pytest.approx(budget.expanded_at(30.0) / 30.0)
    assert known(ride_at(view, -LATER_US), 30.0) is None
    stranger = dataclasses.replace(ride_at(view, LATER_US), context=RideContext(unit_key="other"))
    assert known(stranger, 30.0) is None
    has[GAIN] *= 1.01
    assert known(ride_at(view, LATER_US), 30.0) is None


def test_a_calibration_that_was_taken_back_tells_nothing(bench: Workshop) -> None:
    job = bench.fitted()
    bench.use.record.write(job.id, "", "Ada")
    bench.use.record.restore(job.id, "", "Ada")

    known = CertifiedTorque(bench.calibrations, lambda ride: ({}, "defaults"))

    assert known(ride_at(bench.view(), LATER_US), 30.0) is None
