"""Goal: what was recorded is what is read, and a ride can be listed, noted and deleted.

Method: a store in a temporary folder; rows compared value by value with what went in.
"""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from backend.core.channels import MISSING_INT16
from backend.core.ride import Ride, RideContext
from backend.errors import Conflict, InvalidRequest, NotFound, StoreError
from backend.rides.traces.trace import trace
from backend.store import Sought, Store
from tests.unit.conftest import OpenStore
from tests.unit.store.ride_data import (
    CHANNELS,
    GEAR_RATIO,
    PERIOD_US,
    STARTED_US,
    Rows16,
    honest_ride,
)

# Processes, compilers or hundreds of files: left out of `make test-fast`.
pytestmark = pytest.mark.slow

CONTEXT = RideContext(device_id="u1", device_serial="SP-1", gear_ratio=GEAR_RATIO)


def recorded(store: Store, rows: Rows16, started_us: int = STARTED_US) -> int:
    ride_id = store.rides.start_live(CHANNELS, PERIOD_US, started_us, CONTEXT)
    for start in range(0, len(rows), 100):
        store.rides.append_tail(ride_id, start, rows[start : start + 100]).result()
    return ride_id


def finished(store: Store, rows: Rows16, started_us: int = STARTED_US) -> Ride:
    ride = store.rides.finish(recorded(store, rows, started_us))
    assert ride is not None
    return ride


def read_back(store: Store, ride_id: int) -> Rows16:
    reader = store.rides.reader(ride_id)
    names = [channel.name for channel in CHANNELS]
    counts = reader.counts(names, 0, reader.row_count)
    return np.stack([counts[name] for name in names], axis=1).astype(np.int16)


def test_a_finished_ride_gives_back_every_count_and_every_hole(store: Store) -> None:
    rows = honest_ride(40_000)
    rows[100:250, 2] = MISSING_INT16
    rows[20_000:20_100] = MISSING_INT16

    ride = finished(store, rows)

    assert ride.state == "done"
    assert np.array_equal(read_back(store, ride.id), rows)
    assert [(gap.from_s, gap.rows_lost) for gap in ride.gaps] == [(200.0, 100)]
    assert ride.completeness == pytest.approx(1 - 100 / 40_000)


def test_a_live_ride_can_be_read_while_it_grows(store: Store) -> None:
    rows = honest_ride(500)

    ride_id = recorded(store, rows)

    assert store.rides.get(ride_id).state == "live"
    assert np.array_equal(read_back(store, ride_id), rows)


def test_a_second_that_never_reached_the_disk_is_a_gap_and_not_a_shift(store: Store) -> None:
    rows = honest_ride(300)
    ride_id = store.rides.start_live(CHANNELS, PERIOD_US, STARTED_US, CONTEXT)
    store.rides.append_tail(ride_id, 0, rows[:100]).result()
    store.rides.append_tail(ride_id, 200, rows[200:]).result()

    store.rides.finish(ride_id)

    back = read_back(store, ride_id)
    assert np.array_equal(back[:100], rows[:100])
    assert (back[100:200] == MISSING_INT16).all()
    assert np.array_equal(back[200:], rows[200:])


def test_finishing_twice_is_finishing_once(store: Store) -> None:
    first = finished(store, honest_ride(300))

    second = store.rides.finish(first.id)

    assert second == first


def test_a_ride_without_rows_leaves_nothing(store: Store) -> None:
    ride_id = store.rides.start_live(CHANNELS, PERIOD_US, STARTED_US, CONTEXT)

    assert store.rides.finish(ride_id) is None
    with pytest.raises(NotFound):
        store.rides.get(ride_id)


def test_pages_of_rides_neither_skip_nor_repeat(store: Store) -> None:
    rows = honest_ride(100)
    ids = [finished(store, rows, STARTED_US + (n // 2) * 1_000_000).id for n in range(7)]

    seen: list[int] = []
    cursor: str | None = None
    while True:
        page = store.rides.list(limit=2, cursor=cursor)
        seen += [ride.id for ride in page.items]
        cursor = page.next
        if cursor is None:
            break

    assert seen == sorted(ids, reverse=True)


def test_rides_are_found_by_time_and_by_unit(store: Store) -> None:
    old = finished(store, honest_ride(100), STARTED_US)
    new = finished(store, honest_ride(100), STARTED_US + 10)

    assert [ride.id for ride in store.rides.list(Sought(from_us=STARTED_US + 1)).items] == [new.id]
    assert [ride.id for ride in store.rides.list(Sought(to_us=STARTED_US + 10)).items] == [old.id]
    assert store.rides.list(Sought(device="SP-2")).items == ()
    with pytest.raises(InvalidRequest):
        store.rides.list(cursor="nonsense")


def test_words_are_kept_without_what_no_text_of_sql_can_hold(store: Store) -> None:
    ride = finished(store, honest_ride(100))

    assert store.rides.patch(ride.id, name="A\0lps").name == "Alps"


def test_notes_change_and_measurements_do_not(store: Store) -> None:
    ride = finished(store, honest_ride(100))

    changed = store.rides.patch(ride.id, name="To work", notes="headwind")

    assert (changed.name, changed.notes) == ("To work", "headwind")
    assert changed.summary == ride.summary
    with pytest.raises(InvalidRequest):
        store.rides.patch(ride.id, name="x" * 201)


def test_a_deleted_ride_leaves_no_object_behind(store: Store) -> None:
    ride = finished(store, honest_ride(100))

    store.rides.delete(ride.id)

    assert list(store.objects.keys()) == []
    with pytest.raises(NotFound):
        store.rides.reader(ride.id)


def test_the_kept_overview_has_the_exact_extremes_of_recorded_and_derived_channels(
    store: Store,
) -> None:
    rows = honest_ride(100_000)
    rows[77_777, 2] = 9_500
    ride = finished(store, rows)
    reader = store.rides.reader(ride.id)
    names = ["rider_torque_nm", "rider_power_w", "battery_power_w", "motor_torque_crank_nm"]
    raw = reader.counts(names, 0, len(rows))

    for pixels in (3, 40, 500):
        shown = trace(reader, names, pixels=pixels)

        assert shown.kind == "minmax"
        starts = np.rint(shown.t_first_s * 1e6 / PERIOD_US).astype(int)
        for name in names:
            assert np.array_equal(np.minimum.reduceat(raw[name], starts), shown.minimum[name])
            assert np.array_equal(np.maximum.reduceat(raw[name], starts), shown.maximum[name])
        assert shown.maximum["rider_torque_nm"].max() == 9_500


def test_the_number_of_a_deleted_ride_never_comes_back(reopen: OpenStore) -> None:
    store = reopen()
    first, last = finished(store, honest_ride(100)), finished(store, honest_ride(200))
    store.rides.delete(last.id)
    store.close()

    again = reopen()

    assert finished(again, honest_ride(300)).id not in (first.id, last.id)


def test_two_rides_of_equal_rows_share_an_object_until_both_are_gone(store: Store) -> None:
    rows = honest_ride(100)
    one, two = finished(store, rows), finished(store, rows)
    assert one.object_key == two.object_key

    store.rides.delete(one.id)

    assert np.array_equal(read_back(store, two.id), rows)


def test_a_ride_that_is_being_recorded_cannot_be_deleted(store: Store) -> None:
    ride_id = recorded(store, honest_ride(100))

    with pytest.raises(Conflict, match="being recorded"):
        store.rides.delete(ride_id)


def test_a_flipped_bit_in_the_object_is_told_and_never_shown(store: Store) -> None:
    ride = finished(store, honest_ride(5_000))
    assert ride.object_key is not None
    path = store.objects.local_path(ride.object_key)
    damaged = bytearray(path.read_bytes())
    damaged[2_000] ^= 0x10
    path.write_bytes(damaged)

    with pytest.raises(StoreError, match="damaged"):
        read_back(store, ride.id)


def test_a_12_channel_ride_takes_at_most_6_5_bytes_a_row_with_its_overview(store: Store) -> None:
    rows = honest_ride(120_000)

    ride = finished(store, rows)

    overview = sum(
        len(level.minimum[name]) * level.minimum[name].itemsize * 2
        for rows_per_bin in (128, 1024, 8192)
        if (level := store.rides.reader(ride.id).level(rows_per_bin)) is not None
        for name in level.minimum
    )
    assert ride.object_bytes is not None
    assert ride.object_bytes / len(rows) <= 6.5
    # Uncompressed; in the database it is about half of that.
    assert overview / len(rows) <= 0.7


def test_only_one_spindle_may_use_a_folder(store: Store) -> None:
    folder = store.objects.root
    script = (
        "from backend.store import open_store\n"
        f"open_store('sqlite:///{folder.parent}/spindle.db', 'file://{folder}')\n"
    )

    second = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )

    assert second.returncode != 0
    assert "Another Spindle is using" in second.stderr
