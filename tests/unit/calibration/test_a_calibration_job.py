"""Goal: a calibration loses nothing that was captured, writes only what was fitted, and can be
taken back; what contradicts itself is refused by name.

Method: the use cases over a real store, with the small honest unit behind a thread; the counts are
those of a straight sensor whose truth is compared with what is found.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from backend.calibration.capture import State
from backend.calibration.certificate import evaluate, written_document
from backend.calibration.coefficients import Coefficients
from backend.calibration.unit_record import PARAMETER_OF, coefficients_of, record_to_write
from backend.cli import main
from backend.device.states import LinkState, StateChanged
from backend.errors import Conflict, InvalidRequest, NoAnswer, NotFound, NotStandingStill
from backend.tuning.records import RevisionStore
from tests.unit.calibration.calibration_job import LOADS_KG, SETUP, TRUE_GAIN, TRUE_OFFSET, Workshop

pytestmark = pytest.mark.slow

GAIN, OFFSET = "sensor_gain_nm_per_count", "sensor_offset_counts"
VERIFY = {"kind": "verify", "side": "right", "mass_kg": 30.0}


def refused(error: pytest.ExceptionInfo[Any]) -> list[str]:
    return [fault.code for fault in error.value.fields]


def test_a_job_goes_from_its_setup_to_a_file_that_is_reproduced(bench: Workshop) -> None:
    before = bench.held
    opened = bench.open()
    assert (opened.state, opened.may) == ("setup", ("setup", "close"))

    job = bench.fitted()
    # Two sides, two strokes, zero and loads up and down again.
    assert len(job.captures) == len(job.steps) == 2 * 2 * 2 * (1 + len(LOADS_KG))
    assert (job.state, job.next_step) == ("fitted", None)
    assert job.worked is not None
    assert job.worked.fit is not None
    assert bench.held == before

    bench.use.record.write(job.id, "spring service", "Ada")
    written = bench.view()
    bench.hang(30.0)
    bench.capture(VERIFY)
    verified = bench.view()
    bench.use.record.close(job.id, "Ada")
    closed = bench.view()

    assert (written.state, verified.state, closed.state) == ("written", "verified", "closed")
    found = job.worked.fit.coefficients
    for name, truth in (("gain_nm_per_count", TRUE_GAIN), ("offset_counts", TRUE_OFFSET)):
        assert getattr(found, name) == pytest.approx(
            truth, abs=3 * job.worked.fit.standard(name) + 1e-4 * truth
        )
    assert bench.held[GAIN] == pytest.approx(found.gain_nm_per_count, rel=1e-6)
    assert bench.held[OFFSET] == pytest.approx(found.offset_counts, rel=1e-6)
    assert RevisionStore(bench.store.database).list(job.unit_key, 1)[0].reason == "spring service"
    assert verified.worked is not None
    assert [entry.en < 1 and entry.unseen for entry in verified.worked.verifications] == [True]
    file = json.loads(bench.use.show.certificate(job.id))
    assert evaluate(file).reproduced
    assert file["written"]["sha256"] == job.certificate_sha256 == written.certificate_sha256
    assert closed.result.verified
    assert closed.result.past is not None
    assert closed.may == ()


def test_what_the_unit_keeps_is_the_hash_of_the_certificate_before_its_verification(
    bench: Workshop, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """From the file alone: without the verifying captures, with what was worked out then."""
    job = bench.fitted()
    unverified = json.loads(bench.use.show.certificate(job.id))
    bench.use.record.write(job.id, "", "Ada")
    bench.capture(VERIFY)
    bench.use.record.close(job.id, "Ada")
    file = json.loads(bench.use.show.certificate(job.id))

    assert written_document(file) == unverified["document"]
    assert file["written"]["sha256"] == unverified["sha256"] != file["sha256"]
    mark = bench.held["calibration_certificate"]
    assert bytes(mark).hex() == unverified["sha256"][:16]

    path = tmp_path / "file.json"
    path.write_text(json.dumps(file), encoding="utf-8")
    assert main(["calibrate", "evaluate", str(path)]) == 0
    assert unverified["sha256"][:16] in capsys.readouterr().out
    file["written"]["worked"]["fit"]["coefficients"]["offset_counts"] += 1
    path.write_text(json.dumps(file), encoding="utf-8")
    assert main(["calibrate", "evaluate", str(path)]) == 1
    assert "another was written" in capsys.readouterr().out


def test_a_job_is_judged_by_the_limits_that_held_when_it_was_opened(tmp_path: Path) -> None:
    strict = {"source": "maker, sheet 7", "linearity_pct": 1e-4}
    bench = Workshop(tmp_path, [strict])
    try:
        job = bench.fitted()
        assert job.worked is not None
        assert job.worked.judgement.limits.source == "maker, sheet 7"
        assert "linearity" in [cause.code for cause in job.worked.judgement.causes]

        bench.limits = ()
        bench.restart()
        later = bench.view().worked
        assert later is not None
        assert later.judgement.limits == job.worked.judgement.limits
    finally:
        bench.stop()


def test_another_server_finds_the_job_as_it_was(bench: Workshop) -> None:
    bench.open()
    bench.use.jobs.set_up(bench.job, SETUP)
    bench.capture({"kind": "zero", "side": "right", "direction": "loading"})
    before = bench.view()

    bench.restart()

    assert bench.use.jobs.open(bench.device, "Ben") == (bench.job, False)
    after = bench.view()
    assert (after.captures, after.setup, after.steps) == (
        before.captures,
        before.setup,
        before.steps,
    )
    bench.capture_all()
    assert bench.view().next_step is None


def test_a_load_that_swings_is_not_taken_and_the_reason_is_told(bench: Workshop) -> None:
    bench.open()
    bench.use.jobs.set_up(bench.job, SETUP)
    t_s = np.arange(400) / 100
    bench.read(2000 + 300 * np.sin(2 * np.pi * t_s) + bench.random.normal(0, 6, 400))

    reading = bench.use.show.reading(bench.job)
    with pytest.raises(Conflict) as error:
        bench.use.jobs.capture(bench.job, state(10.0))

    assert not reading.steady
    assert "swinging" in refused(error)
    assert refused(error) == [reason.code for reason in reading.reasons]
    assert bench.view().captures == ()


def test_a_bike_that_moves_is_not_taken(bench: Workshop) -> None:
    bench.open()
    bench.use.jobs.set_up(bench.job, SETUP)
    bench.read(bench.random.normal(500, 6, 400), speed_kmh=0.4)

    with pytest.raises(Conflict) as error:
        bench.use.jobs.capture(bench.job, state(10.0))

    assert refused(error) == ["turning"]


def test_the_same_seconds_are_not_taken_twice(bench: Workshop) -> None:
    bench.open()
    bench.use.jobs.set_up(bench.job, SETUP)
    bench.hang(10.0)
    bench.use.jobs.capture(bench.job, state(10.0))

    with pytest.raises(Conflict) as error:
        bench.use.jobs.capture(bench.job, state(25.0))
    bench.hang(25.0)
    bench.use.jobs.capture(bench.job, state(25.0))

    assert refused(error) == ["too_short"]
    first, second = bench.view().captures
    assert second.mean_counts - first.mean_counts == pytest.approx(
        15 * 9.81 * 0.17 / TRUE_GAIN, rel=1e-3
    )


def test_seconds_before_a_silence_are_not_now(bench: Workshop) -> None:
    bench.open()
    bench.use.jobs.set_up(bench.job, SETUP)
    bench.hang(10.0)
    bench.now_s += 60

    with pytest.raises(Conflict) as error:
        bench.use.jobs.capture(bench.job, state(10.0))

    assert refused(error) == ["no_readings"]
    assert bench.view().checks == ()


def test_what_came_before_the_link_was_lost_is_no_reading_of_who_comes_next(
    bench: Workshop,
) -> None:
    bench.open()
    bench.use.jobs.set_up(bench.job, SETUP)
    bench.hang(10.0)
    bench.use.readings.recent.follow(bench.device, StateChanged(LinkState.LOST, "unplugged"))

    with pytest.raises(Conflict) as error:
        bench.use.jobs.capture(bench.job, state(10.0))

    assert refused(error) == ["no_readings"]


def test_a_wrong_mass_is_named_and_the_step_can_be_repeated(bench: Workshop) -> None:
    bench.open()
    bench.use.jobs.set_up(bench.job, SETUP)
    bench.capture_all(wrong_at=10)

    with pytest.raises(Conflict) as error:
        bench.use.jobs.fit(bench.job)

    (fault,) = error.value.fields
    assert (fault.code, fault.field) == ("wrong_mass", "captures[11]")
    assert "20.0" in fault.message
    (wrong,) = [one for one in bench.view().captures if one.refusals]
    assert wrong.number == 11
    bench.use.jobs.strike(bench.job, 11, "the wrong disc", "Ada")
    assert bench.view().next_step == 10
    bench.capture_all()
    bench.use.jobs.fit(bench.job)
    view = bench.view()
    assert view.state == "fitted"
    assert [one.number for one in view.captures if one.struck] == [11]
    assert view.steps[10].capture == len(view.steps) + 1


def test_a_change_after_the_fit_needs_another_fit(bench: Workshop) -> None:
    bench.fitted()

    bench.use.jobs.strike(bench.job, 3, "", "Ada")

    assert bench.view().state == "capturing"
    with pytest.raises(Conflict, match="fit first"):
        bench.use.record.write(bench.job, "", "Ada")


def test_once_written_the_captures_stay_and_the_old_record_comes_back(bench: Workshop) -> None:
    before = bench.held
    job = bench.fitted()
    bench.use.record.write(job.id, "", "Ada")

    for change in (
        lambda: bench.capture({"kind": "zero"}),
        lambda: bench.use.jobs.strike(job.id, 1, "", "Ada"),
        lambda: bench.use.jobs.set_up(job.id, SETUP),
        lambda: bench.use.jobs.fit(job.id),
        lambda: bench.use.record.write(job.id, "", "Ada"),
    ):
        with pytest.raises(Conflict, match="has what was fitted"):
            change()
    bench.use.record.restore(job.id, "the customer asked", "Ben")

    assert bench.held == before
    view = bench.view()
    assert view.state == "fitted"
    assert [(one.kind, one.author) for one in view.changes] == [
        ("write", "Ada"),
        ("restore", "Ben"),
    ]
    with pytest.raises(Conflict, match="write it"):
        bench.use.record.restore(job.id, "", "Ada")


def test_a_mass_of_the_fit_verifies_nothing(bench: Workshop) -> None:
    bench.fitted()
    with pytest.raises(Conflict, match="write it"):
        bench.capture(VERIFY)
    bench.use.record.write(bench.job, "", "Ada")

    with pytest.raises(InvalidRequest, match="10 kg is a load of the fit"):
        bench.capture({**VERIFY, "mass_kg": 10.0})


def test_what_the_unit_refuses_leaves_the_job_as_it_was(bench: Workshop) -> None:
    job = bench.fitted()
    bench.unit.standing_still = False

    with pytest.raises(NotStandingStill):
        bench.use.record.write(job.id, "", "Ada")

    view = bench.view()
    assert (view.state, view.unsure, view.changes) == ("fitted", None, ())


def test_a_write_that_nobody_answered_is_found_out_by_repeating_it(bench: Workshop) -> None:
    """The server dies between the unit's commit and its own note."""
    before = bench.held
    job = bench.fitted()
    change = bench.calibrations.change
    made = 0

    def dies_after_the_first(*arguments: Any) -> Any:
        nonlocal made
        made += 1
        if made > 1:
            raise KeyboardInterrupt
        return change(*arguments)

    bench.calibrations.change = dies_after_the_first  # type: ignore[method-assign]
    with pytest.raises(KeyboardInterrupt):
        bench.use.record.write(job.id, "", "Ada")
    bench.restart()

    assert bench.held[GAIN] != before[GAIN]
    assert bench.view().unsure == "write"
    with pytest.raises(Conflict, match="repeat that first"):
        bench.use.record.close(job.id, "Ada")
    bench.use.record.write(job.id, "", "Ada")
    bench.use.record.restore(job.id, "", "Ada")

    assert bench.held == before
    assert [one.kind for one in bench.view().changes] == ["write", "restore"]


def test_a_unit_that_is_away_loses_nothing(bench: Workshop) -> None:
    bench.open()
    bench.use.jobs.set_up(bench.job, SETUP)
    bench.capture({"kind": "zero"})
    bench.opener.unplug()
    assert bench.opener.tried.wait(20)

    with pytest.raises(Conflict, match="is not connected"):
        bench.use.jobs.capture(bench.job, state(10.0))
    with pytest.raises((Conflict, NoAnswer)):
        bench.use.jobs.open(bench.device, "Ada")

    view = bench.view()
    assert (view.device_id, len(view.captures), view.may) == (None, 1, ("setup", "close"))


def test_a_job_without_a_fit_is_closed_and_kept(bench: Workshop) -> None:
    bench.open()
    bench.use.jobs.set_up(bench.job, SETUP)
    bench.capture({"kind": "zero"})

    bench.use.record.close(bench.job, "Ada")

    file = json.loads(bench.use.show.certificate(bench.job))
    assert file["document"] is None
    assert [one["number"] for one in file["job"]["captures"]] == [1]
    other = bench.open()
    assert other.id != file["job"]
    assert [one.id for one in other.earlier_of_bike] == [other.id - 1]
    assert other.suggested_setup is not None


def test_every_field_at_fault_is_named(bench: Workshop) -> None:
    bench.open()

    with pytest.raises(InvalidRequest) as error:
        bench.use.jobs.set_up(bench.job, {**SETUP, "arm_m": 17.0, "strokes": 0})
    with pytest.raises(Conflict, match="no setup yet"):
        bench.capture({"kind": "zero"})
    with pytest.raises(NotFound):
        bench.use.show.get(99)

    assert [fault.field for fault in error.value.fields] == ["arm_m", "strokes"]


def test_temperature_coefficients_that_nobody_measured_stay_as_they_were() -> None:
    """At 24 degC the old and the new record differ by what was found there; 10 K above by the
    same, since both walk by 2 counts/K, but for the gain, which is 1 % another."""
    old = Coefficients(10.0, 0.01, 2.0, -2e-4, 20.0)
    found = {name: getattr(old, short) for short, name in PARAMETER_OF.items()}
    fitted = Coefficients(30.0, 0.0101, None, None, 24.0)

    record = record_to_write(found, fitted, 1_700_000_000_000_000, "ab" * 32)

    now = coefficients_of(record)
    assert now == Coefficients(30.0, 0.0101, 2.0, -2e-4, 24.0)
    assert now.torque_nm([4000.0], [24.0]) == fitted.torque_nm([4000.0], [24.0])
    apart = [float((now.torque_nm([10.0], [t]) - old.torque_nm([10.0], [t]))[0]) for t in (24, 34)]
    assert apart[0] == pytest.approx(apart[1], rel=0.02)
    # What the unit has no place for is not written.
    assert set(record) == set(found)


def test_the_last_calibrations_of_the_bike_tell_what_moved(bench: Workshop) -> None:
    first = bench.fitted()
    bench.use.record.write(first.id, "", "Ada")
    bench.use.record.close(first.id, "Ada")

    second = bench.fitted()

    assert [one.id for one in second.earlier_of_bike] == [first.id]
    assert second.change is not None
    assert second.change.gain_en < 1
    # Found at what the first one wrote.
    assert second.found[GAIN] == pytest.approx(TRUE_GAIN, rel=2e-3)


def state(mass_kg: float) -> State:
    return State("load", "right", mass_kg, direction="loading")
