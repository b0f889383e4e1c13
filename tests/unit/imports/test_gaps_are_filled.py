"""Goal: what a recording lacked comes from the unit's log, where it was taken, and nothing else.

Method: one true ride of noise at 100 Hz; the recorder hears it without some stretches, the log has
every tenth row of it. So each row of the filled ride is either the truth or missing, and the counts
of both are known by arithmetic.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from backend.core.channels import MISSING_INT16, ChannelSpec
from backend.core.ride import Ride, RideContext, RideRows
from backend.core.ride_events import RideEvent
from backend.device.stream import StreamBlock
from backend.errors import StoreError
from backend.formats import ImportedRide, Outcome
from backend.imports.service import Uploads
from backend.rides.recording.recorder import Recorder
from backend.rides.recording.unit_recorder import RecordSettings
from backend.store import Store, open_store, rides
from backend.store.discard import named_keys
from backend.store.objects import Disk
from tests.fakes.failing_disk import FailingDisk

# A store for every test, or rides of minutes: left out of `make test-fast`.
pytestmark = pytest.mark.slow

CHANNELS = (
    ChannelSpec("speed_kmh", "km/h", 0.01),
    ChannelSpec("rider_torque_nm", "Nm", 0.01),
    ChannelSpec("fault_flags", "", 1.0),
)
PERIOD_US = 10_000
STEP = 10
SPEED = 1_800
T0_US = 5_000_000
WALL_US = 1_700_000_000_000_000
CONTEXT = RideContext("u1", "SP-1", boot_id=7, unit_key="ebl:SP-1")
Rows16 = npt.NDArray[np.int16]
Span = tuple[int, int]


def true_ride(rows: int) -> Rows16:
    truth = np.full((rows, 3), SPEED, np.int16)
    truth[:, 1] = np.random.default_rng(rows).integers(-9_000, 9_000, rows)
    truth[:, 2] = 0
    return truth


class Bench:
    """A store, and an upload whose contents the test decides."""

    def __init__(self, folder: Path, disk: Disk | None = None) -> None:
        self.folder = folder
        self.store = self.opened(disk)
        self.imported: ImportedRide | None = None
        self.uploads = self.uploads_of(self.store)
        self.files = 0

    def opened(self, disk: Disk | None = None) -> Store:
        return open_store(f"sqlite:///{self.folder}/db", f"file://{self.folder}/objects", disk=disk)

    def uploads_of(self, store: Store) -> Uploads:
        def read(path: Path, name: str) -> Outcome:
            assert self.imported is not None
            return Outcome("complete", (self.imported,), completeness=1.0)

        return Uploads(store, reader=read)

    def recorder(self) -> Recorder:
        return Recorder(self.store.rides, lambda unit: CONTEXT, RecordSettings(lost_s=60.0))

    def record(self, truth: Rows16, *lost: Span) -> list[Ride]:
        """Record the truth without these rows; the rides it became, the oldest first."""
        recorder = self.recorder()
        feed(recorder, truth, 0, *lost)
        recorder.close()
        return list(reversed(self.store.rides.list().items))

    def fetch(self, imported: ImportedRide) -> tuple[str | None, int | None]:
        """Take a log in; code of the upload and the ride it is."""
        self.imported = imported
        self.files += 1
        upload = self.uploads.receive_file(f"{self.files}.ebll", b"log %d" % self.files)
        return upload.code, upload.duplicate_of

    def rows(self, ride: Ride) -> Rows16:
        counts = self.store.rides.reader(ride.id).counts(
            [c.name for c in CHANNELS], 0, ride.row_count
        )
        return np.stack([counts[c.name] for c in CHANNELS], 1).astype(np.int16)


def feed(recorder: Recorder, truth: Rows16, first: int, *lost: Span) -> None:
    for at in range(0, len(truth), 5):
        if any(start <= at < stop for start, stop in lost):
            continue
        t0_us = T0_US + (first + at) * PERIOD_US
        recorder.watch(
            "u1",
            StreamBlock(t0_us, PERIOD_US, at, truth[at : at + 5], 0, 1, WALL_US + t0_us, CHANNELS),
        )


def log_of(truth: Rows16, first: int = 3, stop: int | None = None) -> ImportedRide:
    """The unit's log: every tenth row from `first` on."""
    rows = truth[first:stop:STEP]
    return ImportedRide(
        started_us=WALL_US,
        period_us=PERIOD_US * STEP,
        rows=RideRows(
            CHANNELS,
            np.arange(len(rows), dtype=np.int64) * PERIOD_US * STEP,
            {c.name: np.ascontiguousarray(rows[:, i]) for i, c in enumerate(CHANNELS)},
        ),
        context=replace(CONTEXT, unit_t0_us=T0_US + first * PERIOD_US),
    )


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    made = Bench(tmp_path)
    yield made
    made.store.close()


def test_a_gap_gets_the_log_s_rows_where_they_were_taken_and_no_others(bench: Bench) -> None:
    truth = true_ride(6_000)
    (before,) = bench.record(truth, (2_000, 2_600))
    assert before.completeness == pytest.approx(0.9)

    assert bench.fetch(log_of(truth)) == ("filled", before.id)

    (after,) = bench.store.rides.list().items
    found = bench.rows(after)
    there = np.ones(6_000, bool)
    there[2_000:2_600] = False
    there[2_003:2_600:10] = True
    assert (found[there] == truth[there]).all()
    assert (found[~there] == MISSING_INT16).all()
    (span,) = after.filled
    assert (span.rows_lost, span.rows_filled, span.period_us) == (597, 60, 100_000)
    assert (span.from_s, span.to_s, span.source) == (20.03, 26.0, "unit_log")
    # Three rows before the log's first in the gap: told as a gap, and with the span all there is.
    assert [(gap.from_s, gap.rows_lost) for gap in after.gaps] == [(20.0, 3)]
    assert after.completeness == pytest.approx(1 - 3 / 6_000)
    assert (after.row_count, after.period_us) == (before.row_count, before.period_us)


def test_distance_and_duration_of_a_filled_ride_are_those_of_the_whole(bench: Bench) -> None:
    truth = true_ride(6_000)
    bench.record(truth, (1_000, 4_000))

    bench.fetch(log_of(truth))

    (ride,) = bench.store.rides.list().items
    assert ride.summary is not None
    # 18 km/h for a minute is 300 m; three rows of the gap's head are missing.
    assert ride.summary.distance_km == pytest.approx(0.3 * (1 - 3 / 6_000))
    assert ride.summary.moving_s == pytest.approx(60.0 - 0.03)
    assert ride.summary.speed_kmh_mean == pytest.approx(18.0)


def test_what_people_wrote_stays_and_the_original_log_is_kept(bench: Bench) -> None:
    truth = true_ride(3_000)
    (ride,) = bench.record(truth, (500, 1_500))
    bench.store.rides.patch(ride.id, "Over the pass", "Wind from the west.")

    bench.fetch(log_of(truth))

    after = bench.store.rides.get(ride.id)
    assert (after.name, after.notes, after.origin) == (
        "Over the pass",
        "Wind from the west.",
        "recorded",
    )
    kept = [key for key in bench.store.database.read(named_keys) if key.startswith("originals/")]
    assert [bench.store.objects.local_path(key).read_bytes() for key in kept] == [b"log 1"]


def test_filling_again_changes_nothing(bench: Bench) -> None:
    truth = true_ride(3_000)
    (ride,) = bench.record(truth, (500, 1_500))
    bench.fetch(log_of(truth))
    once = bench.store.rides.get(ride.id)

    assert bench.fetch(log_of(truth)) == ("duplicate", ride.id)

    assert bench.store.rides.get(ride.id) == once


def test_two_logs_of_one_ride_fill_it_together(bench: Bench) -> None:
    truth = true_ride(6_000)
    (ride,) = bench.record(truth, (1_000, 4_000))

    bench.fetch(log_of(truth, 3, 2_500))
    bench.fetch(log_of(truth, 2_503, 6_000))

    after = bench.store.rides.get(ride.id)
    assert sum(span.rows_filled for span in after.filled) == 300
    lost = sum(gap.rows_lost or 0 for gap in after.gaps)
    assert lost + sum(span.rows_lost for span in after.filled) == 3_000
    found = bench.rows(after)
    empty = (found == MISSING_INT16).all(1)
    assert (found[~empty] == truth[~empty]).all()
    assert int(empty.sum()) == 3_000 - 300


def test_a_hole_in_the_log_stays_a_gap(bench: Bench) -> None:
    truth = true_ride(3_000)
    (ride,) = bench.record(truth, (1_000, 2_000))
    holed = log_of(truth)
    for counts in holed.rows.counts.values():
        counts[120:150] = MISSING_INT16

    bench.fetch(holed)

    after = bench.store.rides.get(ride.id)
    assert [(span.from_s, span.to_s) for span in after.filled] == [(10.03, 12.03), (15.03, 20.0)]
    assert [(gap.from_s, gap.to_s) for gap in after.gaps] == [(10.0, 10.03), (12.03, 15.03)]


def test_a_ride_that_was_joined_late_and_left_early_grows_to_what_the_unit_has(
    bench: Bench,
) -> None:
    truth = true_ride(6_000)
    (ride,) = bench.record(truth, (0, 1_500), (4_000, 6_000))
    assert ride.row_count == 2_500

    bench.fetch(log_of(truth))

    after = bench.store.rides.get(ride.id)
    assert after.context.unit_t0_us == T0_US + 3 * PERIOD_US
    assert after.started_us == ride.started_us - 1_497 * PERIOD_US
    # From the log's first row to a row of the log behind its last.
    assert after.row_count == 5_997 + 3
    found = bench.rows(after)[: 6_000 - 3]
    empty = (found == MISSING_INT16).all(1)
    assert (found[~empty] == truth[3:][~empty]).all()
    assert int((~empty).sum()) == 2_500 + 150 + 200
    assert after.completeness == pytest.approx(1 - 3 / 6_000)


def test_two_rides_of_one_log_keep_their_numbers_and_share_no_row(bench: Bench) -> None:
    truth = true_ride(30_000)
    first, second = bench.record(truth, (2_000, 3_000), (10_000, 20_000))

    bench.fetch(log_of(truth))

    one, two = bench.store.rides.get(first.id), bench.store.rides.get(second.id)
    assert [ride.id for ride in reversed(bench.store.rides.list().items)] == [one.id, two.id]
    assert one.row_count == 10_000
    assert one.context.unit_t0_us is not None
    assert two.context.unit_t0_us is not None
    assert one.context.unit_t0_us + one.row_count * PERIOD_US <= two.context.unit_t0_us
    filled = sum(span.rows_filled for ride in (one, two) for span in ride.filled)
    assert filled == 100 + 1_000


def test_a_recording_without_gaps_is_left_alone(bench: Bench) -> None:
    truth = true_ride(3_000)
    (ride,) = bench.record(truth)

    assert bench.fetch(log_of(truth)) == ("duplicate", ride.id)

    assert bench.store.rides.get(ride.id) == ride


def test_a_ride_of_another_start_of_the_unit_is_another_ride(bench: Bench) -> None:
    truth = true_ride(3_000)
    (ride,) = bench.record(truth, (1_000, 2_000))
    other = log_of(truth)

    code, _ = bench.fetch(replace(other, context=replace(other.context, boot_id=8)))

    assert code is None
    assert len(bench.store.rides.list().items) == 2
    assert bench.store.rides.get(ride.id).filled == ()


def test_a_log_that_comes_before_its_ride_is_over_fills_it_afterwards(bench: Bench) -> None:
    truth = true_ride(3_000)
    recorder = bench.recorder()
    feed(recorder, truth[:2_500], 0, (1_000, 2_000))
    code, ride_id = bench.fetch(log_of(truth[:2_400]))
    assert code == "ride_is_live"
    bench.uploads.retry_waiting(WALL_US)
    assert ride_id is not None
    assert bench.store.rides.get(ride_id).state == "live"

    recorder.close()
    for looking in bench.uploads.retry_waiting(WALL_US):
        looking.result(30)

    assert sum(span.rows_filled for span in bench.store.rides.get(ride_id).filled) == 100
    (upload,) = [bench.store.uploads.get(u.id) for u in [bench.uploads.receive_file("x", b"log 1")]]
    assert upload.duplicate_of == ride_id


def test_faults_and_modes_of_the_gap_are_told_at_their_time(bench: Bench) -> None:
    truth = true_ride(3_000)
    truth[1_200:1_800, 2] = 2
    (ride,) = bench.record(truth, (1_000, 2_000))
    assert ride.events == ()
    told = (
        RideEvent(11.97, "fault_set", 2),
        RideEvent(13.0, "fault_set", 1),
        RideEvent(13.02, "fault_cleared", 1),
    )

    bench.fetch(replace(log_of(truth), events=told))

    events = bench.store.rides.get(ride.id).events
    assert [(event.kind, event.value) for event in events] == [
        ("fault_set", 2),
        ("fault_set", 1),
        ("fault_cleared", 1),
        ("fault_cleared", 2),
    ]
    assert [event.t_s for event in events] == pytest.approx([12.03, 13.03, 13.05, 18.03])


@pytest.mark.parametrize("step", [4, 5, 6, 7, 8, 9, 10, None])
def test_a_crash_anywhere_leaves_the_old_ride_or_the_new_and_the_next_start_the_new(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, step: int | None
) -> None:
    truth = true_ride(1_000)
    disk = FailingDisk()
    bench = Bench(tmp_path, disk)
    (old,) = bench.record(truth, (300, 600))
    old_rows = bench.rows(old)
    disk.left = step or 0

    def torn(*_: object) -> None:
        raise StoreError("The power is gone.")

    with monkeypatch.context() as cut:
        if step is None:
            # In the middle of the transaction, after its first statement.
            cut.setattr(rides, "finish_row", torn)
        try:
            bench.fetch(log_of(truth))
        except StoreError:
            found = bench.store.rides.get(old.id)
            assert found == old
            assert (bench.rows(found) == old_rows).all()
    bench.store.close()

    bench.store = bench.opened()
    bench.store.recover()
    uploads = bench.uploads_of(bench.store)
    uploads.recover()
    named = bench.store.database.read(named_keys)
    if not [key for key in named if key.startswith("originals/")]:
        # The log itself had not arrived.
        assert bench.store.rides.get(old.id) == old
        uploads.receive_file("again", b"log 1")
    (new,) = bench.store.rides.list().items
    assert new.id == old.id
    assert sum(span.rows_filled for span in new.filled) == 30
    assert bench.store.objects.local_path(str(new.object_key)).is_file()
    bench.store.close()


def test_a_ride_cut_short_is_not_any_more_once_the_log_told_its_end(tmp_path: Path) -> None:
    truth = true_ride(3_000)
    bench = Bench(tmp_path)
    (cut,) = bench.record(truth[:1_000])

    bench.fetch(log_of(truth))

    (ride,) = bench.store.rides.list().items
    assert (cut.cut_short, ride.cut_short) == (True, False)
    assert ride.row_count > cut.row_count
    bench.store.close()
