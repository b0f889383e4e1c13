"""Goal: a calibration over which the host's clock is set right has the right dates, in the unit,
too, and says so; where the unit has a certificate of the wrong ones already, it says that.

Method: a job at a unit behind a thread. The clock of this machine is the wrong one; set right it is
so many years further on.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.calibration.certificate import evaluate
from backend.calibration.clock import JobDates
from backend.calibration.types import Job
from backend.errors import StoreError
from tests.unit.calibration.calibration_job import Workshop

# A unit behind a thread for every test: left out of `make test-fast`.
pytestmark = pytest.mark.slow

YEARS_S = 6.9 * 365 * 86_400
SOON_S = 3_600.0


class Bench(Workshop):
    """A workshop whose server looks at its clock."""

    def start(self) -> None:
        super().start()
        self.dates = JobDates(
            self.calibrations,
            offset_us=lambda: round(self.clock_set_by_s * 1e6),
            now_us=lambda: round(self.unix_s() * 1e6),
        )

    def set_clock(self, by_s: float = YEARS_S) -> None:
        self.clock_set_by_s += by_s
        self.dates.tick()

    def is_now(self, at_s: float) -> bool:
        return abs(at_s - self.unix_s()) < SOON_S

    def dates_of(self, job: Job) -> list[float]:
        told = [job.opened_at, *(one.at for one in job.captures)]
        struck = [one.struck.at for one in job.captures if one.struck is not None]
        fitted = [job.fitted_at] if job.fitted_at else []
        return [moment.timestamp() for moment in [*told, *struck, *fitted]]


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    made = Bench(tmp_path)
    yield made
    made.stop()


def test_a_job_begun_by_a_wrong_clock_is_dated_anew_and_the_unit_gets_the_right_date(
    bench: Bench,
) -> None:
    bench.fitted()
    before = bench.dates_of(bench.view())
    bench.set_clock()

    job = bench.view()
    after = bench.dates_of(job)
    assert after == pytest.approx([at_s + YEARS_S for at_s in before], abs=1e-3)
    (told,) = job.clock_set
    assert told.by_s == pytest.approx(YEARS_S)
    assert told.dated
    assert bench.is_now(told.at.timestamp())
    bench.use.record.write(bench.job, "", "Ada")
    bench.use.record.close(bench.job, "Ada")
    assert bench.is_now(bench.held["calibrated_at_utc_s"])
    file = json.loads(bench.use.show.certificate(bench.job))
    assert bench.is_now(file["document"]["about"]["created_utc_us"] / 1e6)
    assert evaluate(file).reproduced


def test_what_the_unit_was_written_with_stays_and_is_marked(bench: Bench) -> None:
    bench.fitted()
    bench.use.record.write(bench.job, "", "Ada")
    before, held = bench.dates_of(bench.view()), bench.held
    written = bench.view().certificate_sha256
    bench.set_clock()

    job = bench.view()
    assert bench.dates_of(job) == before
    assert (bench.held, job.certificate_sha256) == (held, written)
    assert bench.use.show.certificate_pdf(bench.job, "zh", "UTC", "a4").startswith(b"%PDF")
    assert [one.dated for one in job.clock_set] == [False]
    bench.use.record.close(bench.job, "Ada")
    assert evaluate(json.loads(bench.use.show.certificate(bench.job))).reproduced


def test_a_struck_capture_is_dated_anew_too(bench: Bench) -> None:
    bench.fitted()
    bench.use.jobs.strike(bench.job, 1, "the wrong disc", "Ada")

    bench.set_clock()

    assert all(bench.is_now(at_s) for at_s in bench.dates_of(bench.view()))


def test_dates_of_an_earlier_server_stay(bench: Bench) -> None:
    bench.fitted()
    before = bench.dates_of(bench.view())
    bench.restart()
    bench.set_clock()

    job = bench.view()
    assert bench.dates_of(job) == before
    assert job.clock_set == ()


def test_a_closed_job_stays_as_it_is(bench: Bench) -> None:
    bench.fitted()
    bench.use.record.close(bench.job, "Ada")
    before = bench.use.show.certificate(bench.job)
    bench.set_clock()

    assert bench.use.show.certificate(bench.job) == before
    assert bench.view().clock_set == ()


def test_a_clock_that_is_only_adjusted_dates_nothing_anew(bench: Bench) -> None:
    bench.fitted()
    before = bench.dates_of(bench.view())
    bench.set_clock(by_s=59.0)

    assert bench.dates_of(bench.view()) == before
    assert bench.view().clock_set == ()


def test_a_store_that_refuses_is_asked_again(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    bench.fitted()

    def refuse(work: object) -> None:
        raise StoreError("The disk is full.")

    with monkeypatch.context() as full:
        full.setattr(bench.calibrations, "redate", refuse)
        with pytest.raises(StoreError):
            bench.set_clock()
    bench.dates.tick()
    bench.dates.tick()

    assert all(bench.is_now(at_s) for at_s in bench.dates_of(bench.view()))
    assert len(bench.view().clock_set) == 1
