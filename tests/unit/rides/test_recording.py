"""Goal: a bike that moves makes a ride with every row of it, and ends it when it stands.

Method: blocks as the device hands them over, made here; the recorded rows are compared with them.
The store is a real one in a temporary folder; unit time and wall time are numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import numpy.typing as npt
import pytest

from backend.core.channels import MISSING_INT16, ChannelSpec
from backend.core.ride import Ride, RideContext
from backend.core.ride_events import RideEvent
from backend.device.states import LinkState, StateChanged
from backend.device.stream import LostBy, StreamBlock
from backend.errors import Conflict, NotFound, StoreError
from backend.rides.recording.bounds import LOST_BY_WORDS
from backend.rides.recording.marks import MarkMoment
from backend.rides.recording.recorder import Recorder
from backend.rides.recording.running import RunningTotals
from backend.rides.recording.unit_recorder import RecordSettings
from backend.server.health import HealthCheck
from backend.store import Store
from backend.units.service import Devices

# A store for every test, or rides of minutes: left out of `make test-fast`.
pytestmark = pytest.mark.slow

CHANNELS = (
    ChannelSpec("speed_kmh", "km/h", 0.01),
    ChannelSpec("cadence_rpm", "rpm", 0.01),
    ChannelSpec("rider_torque_nm", "Nm", 0.01),
)
PERIOD_US = 10_000
BLOCK_ROWS = 5
WALL_US = 1_700_000_000_000_000
SETTINGS = RecordSettings(idle_s=5.0, lead_in_s=1.0, lost_s=10.0)
Rows16 = npt.NDArray[np.int16]


@pytest.fixture
def recorder(store: Store) -> Recorder:
    def context_of(unit: str) -> RideContext:
        return RideContext(unit, "SP-1", gear_ratio=40.34, unit_key="ebl:SP-1")

    return Recorder(store.rides, context_of, SETTINGS)


def riding(seconds: float, seed: int = 1) -> Rows16:
    """Rows of a moving bike; the torque tells every row from every other."""
    rows = np.full((round(seconds * 100), 3), 2_000, np.int16)
    rows[:, 2] = np.random.default_rng(seed).integers(-9_000, 9_000, len(rows))
    return rows


def standing(seconds: float) -> Rows16:
    rows = riding(seconds, seed=2)
    rows[:, :2] = 0
    return rows


def blocks(
    rows: Rows16, t0_us: int = 0, epoch: int = 1, block_rows: int = BLOCK_ROWS
) -> list[StreamBlock]:
    return [
        StreamBlock(
            t0_us=t0_us + start * PERIOD_US,
            period_us=PERIOD_US,
            first_index=start,
            values=rows[start : start + block_rows],
            lost_rows_before=0,
            epoch=epoch,
            wall_us=WALL_US + t0_us + start * PERIOD_US,
            channels=CHANNELS,
        )
        for start in range(0, len(rows), block_rows)
    ]


def feed(recorder: Recorder, *parts: StreamBlock) -> None:
    for block in parts:
        recorder.watch("u1", block)


def rides(store: Store, recorder: Recorder) -> list[Ride]:
    """Every ride, oldest first, once all that has ended is finished."""
    recorder.close()
    return list(reversed(store.rides.list().items))


def rows_of(store: Store, ride: Ride) -> Rows16:
    reader = store.rides.reader(ride.id)
    names = [channel.name for channel in CHANNELS]
    counts = reader.counts(names, 0, reader.row_count)
    return np.stack([counts[name] for name in names], axis=1).astype(np.int16)


def test_a_ride_is_every_row_from_just_before_it_moved_until_it_stood_long_enough(
    store: Store, recorder: Recorder
) -> None:
    rows = np.concatenate((standing(8), riding(30), standing(20)))

    feed(recorder, *blocks(rows))

    (ride,) = rides(store, recorder)
    lead, idle = 100, 500
    assert np.array_equal(rows_of(store, ride), rows[800 - lead : 3_800 + idle])
    assert ride.state == "done"
    assert ride.completeness == 1.0
    assert ride.started_us == WALL_US + (800 - lead) * PERIOD_US
    assert ride.context.device_serial == "SP-1"
    assert ride.context.unit_key == "ebl:SP-1"


@pytest.mark.parametrize(("speed_counts", "cadence_counts"), [(101, 0), (0, 501)])
def test_only_faster_than_1_kmh_or_5_rpm_a_bike_moves(
    store: Store, recorder: Recorder, speed_counts: int, cadence_counts: int
) -> None:
    """SPEC 2.5, as the unit decides for its logs: at exactly the bounds the bike stands."""
    at_bounds, above = standing(20), standing(10)
    at_bounds[:, :2] = 100, 500
    above[:, :2] = speed_counts, cadence_counts

    feed(recorder, *blocks(np.concatenate((at_bounds, above, standing(20)))))

    (ride,) = rides(store, recorder)
    assert ride.started_us == WALL_US + 19_000_000


@pytest.mark.parametrize("block_rows", [1, 7, 64, 1_000, 6_000])
def test_the_same_rows_make_the_same_rides_however_they_came_in_frames(
    store: Store, recorder: Recorder, block_rows: int
) -> None:
    rows = np.concatenate((standing(8.03), riding(30), standing(20), riding(3), standing(9)))

    feed(recorder, *blocks(rows, block_rows=block_rows))

    first, second = rides(store, recorder)
    lead, idle = 100, 500
    assert np.array_equal(rows_of(store, first), rows[803 - lead : 3_803 + idle])
    assert np.array_equal(rows_of(store, second), rows[5_803 - lead : 6_103 + idle])
    assert second.context.unit_t0_us == (5_803 - lead) * PERIOD_US


def test_a_ride_that_begins_while_the_last_one_ends_takes_no_row_twice(
    store: Store, recorder: Recorder
) -> None:
    rows = np.concatenate((riding(10), standing(5.2), riding(10)))

    feed(recorder, *blocks(rows, block_rows=2_000))

    first, second = rides(store, recorder)
    assert np.array_equal(np.concatenate((rows_of(store, first), rows_of(store, second))), rows)
    assert len(rows_of(store, first)) == 1_500


def test_a_recording_that_ends_while_the_bike_moves_says_that_it_was_cut_short(
    store: Store, recorder: Recorder
) -> None:
    stood = np.concatenate((riding(10), standing(6)))
    feed(recorder, *blocks(stood), *blocks(riding(10), t0_us=60_000_000))

    whole, cut = rides(store, recorder)

    assert (whole.cut_short, cut.cut_short) == (False, True)


def test_a_bike_that_stands_makes_no_ride(store: Store, recorder: Recorder) -> None:
    feed(recorder, *blocks(standing(60)))

    assert rides(store, recorder) == []


def test_a_red_light_does_not_cut_a_ride_in_two(store: Store, recorder: Recorder) -> None:
    rows = np.concatenate((riding(10), standing(4), riding(10)))

    feed(recorder, *blocks(rows))

    (ride,) = rides(store, recorder)
    assert np.array_equal(rows_of(store, ride), rows)


def test_lost_rows_become_missing_rows_at_their_time(store: Store, recorder: Recorder) -> None:
    rows = riding(20)
    sent = blocks(rows)

    feed(recorder, *sent[:100], *sent[140:])

    (ride,) = rides(store, recorder)
    back = rows_of(store, ride)
    assert np.array_equal(back[:500], rows[:500])
    assert (back[500:700] == MISSING_INT16).all()
    assert np.array_equal(back[700:], rows[700:])
    assert [(gap.from_s, gap.to_s, gap.rows_lost) for gap in ride.gaps] == [(5.0, 7.0, 200)]
    assert ride.completeness == pytest.approx(0.9)


def test_a_new_subscription_of_the_same_unit_goes_on_with_the_ride(
    store: Store, recorder: Recorder
) -> None:
    rows = riding(20)

    feed(recorder, *blocks(rows[:1000]), *blocks(rows[1000:], t0_us=10_000_000, epoch=2))

    (ride,) = rides(store, recorder)
    assert np.array_equal(rows_of(store, ride), rows)


def test_a_unit_that_restarted_starts_a_new_ride(store: Store, recorder: Recorder) -> None:
    first, second = riding(10, seed=3), riding(12, seed=4)

    feed(recorder, *blocks(first, t0_us=500_000_000), *blocks(second, t0_us=0, epoch=2))

    one, two = sorted(rides(store, recorder), key=lambda ride: ride.id)
    assert np.array_equal(rows_of(store, one), first)
    assert np.array_equal(rows_of(store, two), second)


def test_a_unit_that_was_away_too_long_starts_a_new_ride(store: Store, recorder: Recorder) -> None:
    feed(recorder, *blocks(riding(10)), *blocks(riding(10), t0_us=25_000_000))

    assert [ride.row_count for ride in rides(store, recorder)] == [1000, 1000]


def test_a_moment_that_was_marked_is_found_in_the_ride(store: Store, recorder: Recorder) -> None:
    mark = MarkMoment(recorder, store.marks, lambda device_id: None)
    with pytest.raises(Conflict, match="No ride is being recorded"):
        mark("u1")

    feed(recorder, *blocks(riding(4)))
    first = mark("u1")
    feed(recorder, *blocks(riding(6, seed=2), t0_us=4_000_000))
    second = mark("u1")

    # Rows come every 10 ms from 0 on: the last of 400 is that of 3.99 s.
    assert (first.t_s, first.number) == (3.99, 1)
    assert (second.t_s, second.number, second.ride_id) == (9.99, 2, first.ride_id)
    recorder.watch("u1", StateChanged(LinkState.CLOSED, "removed"))
    (ride,) = rides(store, recorder)
    assert ride.events == (RideEvent(3.99, "mark", 1), RideEvent(9.99, "mark", 2))
    with pytest.raises(Conflict, match="over"):
        store.marks.add(ride.id, 5.0)


def test_a_ride_tells_what_it_comes_to_while_it_is_recorded(
    store: Store, recorder: Recorder
) -> None:
    heard = blocks(riding(30.0))
    feed(recorder, *heard[:10], *heard[12:])
    (ride_id,) = store.rides.live_ids()

    so_far = recorder.running(ride_id)
    (ride,) = rides(store, recorder)

    assert so_far is not None
    assert ride.summary is not None
    assert so_far.duration_s == pytest.approx(ride.summary.duration_s, abs=0.1)
    for name in ("distance_km", "moving_s", "rider_wh", "speed_kmh_mean"):
        assert getattr(so_far, name) == pytest.approx(getattr(ride.summary, name), rel=1e-3), name
    assert so_far.motor_wh is ride.summary.motor_wh is None
    assert recorder.running(ride_id) is None


def test_what_was_never_measured_is_not_told_as_nothing_ridden() -> None:
    totals = RunningTotals(CHANNELS, PERIOD_US)
    rows = riding(10.0)
    silent = rows.copy()
    silent[:] = CHANNELS[0].missing

    totals.add(silent)
    before = totals.summary()
    totals.add(rows)
    totals.add(silent)
    after = totals.summary()

    assert (before.duration_s, after.duration_s) == (10.0, 30.0)
    assert before.moving_s is before.distance_km is before.rider_wh is None
    assert after.moving_s == pytest.approx(10.0)
    assert after.rider_wh is not None


def test_a_silent_unit_s_ride_ends_by_the_wall_clock(store: Store, recorder: Recorder) -> None:
    feed(recorder, *blocks(riding(10)))

    recorder.tick(WALL_US + 15_000_000)
    assert recorder.status("u1") is not None
    recorder.tick(WALL_US + 25_000_000)

    assert recorder.status("u1") is None
    assert [ride.state for ride in rides(store, recorder)] == ["done"]


def test_a_unit_that_is_let_go_ends_its_ride_at_once(store: Store, recorder: Recorder) -> None:
    feed(recorder, *blocks(riding(10)))

    recorder.watch("u1", StateChanged(LinkState.CLOSED, "removed"))

    assert recorder.status("u1") is None
    assert [ride.row_count for ride in rides(store, recorder)] == [1000]


def test_a_ride_outlives_a_unit_that_nobody_knows_any_more(store: Store) -> None:
    def gone(device_id: str) -> RideContext:
        raise NotFound(f"There is no device {device_id}.")

    recorder = Recorder(store.rides, gone, SETTINGS)
    feed(recorder, *blocks(riding(10)))

    assert [ride.row_count for ride in rides(store, recorder)] == [1000]


def test_two_units_are_recorded_side_by_side(store: Store, recorder: Recorder) -> None:
    one, two = riding(10, seed=5), riding(10, seed=6)

    for first, second in zip(blocks(one), blocks(two), strict=True):
        recorder.watch("u1", first)
        recorder.watch("u2", second)

    found = {ride.context.device_id: ride for ride in rides(store, recorder)}
    assert np.array_equal(rows_of(store, found["u1"]), one)
    assert np.array_equal(rows_of(store, found["u2"]), two)


def test_only_committed_rows_are_called_saved(store: Store, recorder: Recorder) -> None:
    feed(recorder, *blocks(riding(10.5)))
    store.database.write(lambda _: None)

    status = recorder.status("u1")

    assert status is not None
    assert status.rows == 1050
    assert 950 < status.rows_saved < 1050
    assert store.rides.get(status.ride_id).row_count == status.rows_saved


def test_a_second_the_disk_refused_is_written_again(
    store: Store, recorder: Recorder, monkeypatch: pytest.MonkeyPatch
) -> None:
    append = store.rides.append_tail
    calls = 0

    def sometimes(
        ride_id: int, row_start: int, part: Rows16, events: Sequence[RideEvent]
    ) -> Future[None]:
        nonlocal calls
        calls += 1
        if calls % 3 == 0:
            refused: Future[None] = Future()
            refused.set_exception(StoreError("no space left"))
            return refused
        return append(ride_id, row_start, part, events)

    monkeypatch.setattr(store.rides, "append_tail", sometimes)
    rows = riding(20)

    feed(recorder, *blocks(rows))

    (ride,) = rides(store, recorder)
    assert np.array_equal(rows_of(store, ride), rows)


def test_a_ride_that_the_store_refused_to_begin_has_its_first_rows_all_the_same(
    store: Store, recorder: Recorder, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object, **__: object) -> int:
        raise StoreError("no space left")

    monkeypatch.setattr(store.rides, "start_live", refuse)
    rows = riding(20)
    feed(recorder, *blocks(rows[:1000]))
    monkeypatch.undo()

    feed(recorder, *blocks(rows[1000:], t0_us=10_000_000))

    (ride,) = rides(store, recorder)
    assert np.array_equal(rows_of(store, ride), rows)


@pytest.mark.parametrize("lost_by", [LostBy.MACHINE, LostBy.LINE])
def test_rows_that_never_came_are_told_while_they_are_missing_and_by_where_they_were_lost(
    recorder: Recorder, caplog: pytest.LogCaptureFixture, lost_by: LostBy
) -> None:
    rows = blocks(riding(30))
    feed(recorder, *rows[:100])
    feed(recorder, replace(rows[110], lost_by=LostBy.UNIT))
    assert recorder.rows_missing_lately() == []

    feed(recorder, replace(rows[160], lost_by=lost_by), *rows[161:170])

    lost = 59 * BLOCK_ROWS
    assert recorder.rows_missing_lately() == [("u1", lost_by, lost)]
    assert recorder.counts("u1").rows_missing == lost
    assert recorder.counts("u1").rows_lost == 0
    (said,) = [record.getMessage() for record in caplog.records if "missing" in record.message]
    assert LOST_BY_WORDS[lost_by] in said

    feed(recorder, *blocks(standing(20), t0_us=30_000_000))
    assert recorder.rows_missing_lately() == [("u1", lost_by, lost)]
    feed(recorder, *blocks(riding(5), t0_us=50_000_000))
    assert recorder.rows_missing_lately() == []


def test_health_names_unit_and_cause_of_rows_that_never_came(
    store: Store, recorder: Recorder
) -> None:
    none = cast(Devices, SimpleNamespace(list=list))
    parts = store.watch, store.database.ping, store.soundness, store.entries
    health = HealthCheck("1.0", none, recorder, *parts)
    rows = blocks(riding(30))
    feed(recorder, *rows[:100], replace(rows[150], lost_by=LostBy.MACHINE))

    view = health.current()

    (reason,) = view.reasons
    assert (view.status, reason.code, reason.part) == ("ok", "rows_missing_machine", "u1")
    assert "250 rows of the latest ride of u1 never came" in reason.message
    assert "too busy" in reason.message


def test_a_cable_that_was_out_is_the_line_s_and_steps_left_out_are_the_unit_s(
    recorder: Recorder,
) -> None:
    rows = blocks(riding(30))
    feed(recorder, *rows[:100])
    feed(recorder, *[replace(block, epoch=2) for block in rows[200:300]])
    assert recorder.rows_missing_lately() == [("u1", LostBy.LINE, 100 * BLOCK_ROWS)]
    feed(recorder, *[replace(block, epoch=2) for block in rows[450:]])
    assert recorder.rows_missing_lately() == [("u1", LostBy.UNIT, 250 * BLOCK_ROWS)]
