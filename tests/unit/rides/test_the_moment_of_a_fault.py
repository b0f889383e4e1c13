"""Goal: what the bike did around a fault is told sample by sample, from the ride it came on or the
last minutes of the stream, and nothing is made up where neither has it.

Method: blocks as the device hands them over, made here; the torque of each row is its number, so
that every sample shows which row it is. The fault takes the reading away: from there on it is
missing, and the motor gives nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from backend.core.channels import MISSING_INT16, ChannelSpec
from backend.core.ride import RideContext
from backend.device.readings import Fault, Snapshot
from backend.device.stream import StreamBlock
from backend.errors import NotFound
from backend.rides.recording.fault_moment import FaultMoments, RecentRows
from backend.store import Store, open_store

# A store for every test: left out of `make test-fast`.
pytestmark = pytest.mark.slow

CHANNELS = (
    ChannelSpec("rider_torque_nm", "Nm", 0.01),
    ChannelSpec("motor_torque_nm", "Nm", 0.001),
    ChannelSpec("motor_torque_demanded_nm", "Nm", 0.001),
)
PERIOD_US = 10_000
BOOT, GEAR_RATIO = 77, 40.0
T0_US = 5_000_000
ROWS = 1000
FAULT_ROW = 600
FAULT_US = T0_US + FAULT_ROW * PERIOD_US


def rows_with_fault() -> np.ndarray[tuple[int, int], np.dtype[np.int16]]:
    """Ten seconds: row r has r / 100 Nm of the rider and 1 Nm of the motor until the fault."""
    rows = np.zeros((ROWS, 3), np.int16)
    rows[:, 0] = np.arange(ROWS)
    rows[:, 1:] = 1000
    rows[FAULT_ROW:, 0] = MISSING_INT16
    rows[FAULT_ROW:, 1:] = 0
    return rows


class Bench:
    """A unit with a fault, a store for its rides, and what its stream brought lately."""

    def __init__(self, folder: Path) -> None:
        self.store: Store = open_store(f"sqlite:///{folder}/db", f"file://{folder}/objects")
        self.recent = RecentRows()
        self.boot_id = BOOT
        self.frame: Snapshot | None = Snapshot(FAULT_US, {})
        self.moment = FaultMoments(
            self.store.rides,
            self.recent,
            lambda device: [Fault("torque_sensor", "", frozen=self.frame)],
            lambda device: self.context(None),
        )

    def context(self, unit_t0_us: int | None) -> RideContext:
        return RideContext(
            unit_key="ebl:SP-1", boot_id=self.boot_id, gear_ratio=GEAR_RATIO, unit_t0_us=unit_t0_us
        )

    def ride(self, row_count: int = ROWS, t0_us: int = T0_US, done: bool = True) -> int:
        """The first rows of the ten seconds as a ride whose first row is at t0_us."""
        rides = self.store.rides
        ride_id = rides.start_live(CHANNELS, PERIOD_US, 1_700_000_000_000_000, self.context(t0_us))
        rides.append_tail(ride_id, 0, rows_with_fault()[:row_count]).result()
        if done:
            rides.finish(ride_id)
        return ride_id

    def stream(self, first: int, last: int) -> None:
        """Rows [first, last) come over the line, five in a frame."""
        for start in range(first, last, 5):
            rows = rows_with_fault()[start : min(start + 5, last)]
            t_us = T0_US + start * PERIOD_US
            block = StreamBlock(t_us, PERIOD_US, start, rows, 0, 1, t_us, CHANNELS)
            self.recent.follow("dev", block)


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    made = Bench(tmp_path)
    yield made
    made.store.close()


def test_the_ride_tells_every_sample_two_seconds_before_to_one_after(bench: Bench) -> None:
    ride_id = bench.ride()

    told = bench.moment("dev", "torque_sensor")

    assert (told.source, told.ride_id, told.ride_t_s) == ("ride", ride_id, 6.0)
    assert told.complete
    assert told.occurred_at == datetime.fromtimestamp(1_700_000_006, UTC)
    assert list(told.at_s) == [round(row / 100, 2) for row in range(-200, 101)]
    assert told.rider_torque_nm[:200] == [row / 100 for row in range(400, 600)]
    assert told.rider_torque_nm[200:] == [None] * 101
    # 1 Nm at the motor's shaft is 40 Nm at the crank; what stopped is a measured 0.
    assert told.motor_torque_nm == [40.0] * 200 + [0.0] * 101
    assert told.motor_torque_meaning == "delivered"


def test_a_ride_that_is_recorded_tells_what_it_has_and_that_more_is_to_come(bench: Bench) -> None:
    bench.ride(row_count=FAULT_ROW + 50, done=False)

    told = bench.moment("dev", "torque_sensor")

    assert told.source == "ride"
    assert told.at_s[-1] == 0.49
    assert not told.complete


def test_a_ride_that_began_or_ended_near_the_fault_tells_no_more_than_its_rows(
    bench: Bench,
) -> None:
    bench.ride(row_count=100, t0_us=FAULT_US - 300_000)

    told = bench.moment("dev", "torque_sensor")

    assert (told.at_s[0], told.at_s[-1]) == (-0.3, 0.69)
    assert told.complete


def test_without_a_ride_the_stream_tells_it_with_lost_rows_as_missing(bench: Bench) -> None:
    bench.stream(303, 500)
    bench.stream(510, 800)

    told = bench.moment("dev", "torque_sensor")

    assert (told.source, told.ride_id, told.complete) == ("stream", None, True)
    assert (told.at_s[0], told.at_s[-1]) == (-2.0, 1.0)
    at = dict(zip(told.at_s, told.rider_torque_nm, strict=True))
    assert at[-1.01] == 4.99
    assert [at[-1.0], at[-0.91], at[0.0]] == [None, None, None]
    assert at[-0.9] == 5.1


@pytest.mark.parametrize("boot_id", [BOOT + 1, None])
def test_a_ride_of_another_start_of_the_unit_is_not_taken_for_it(
    bench: Bench, boot_id: int | None
) -> None:
    bench.ride()
    bench.boot_id = boot_id  # type: ignore[assignment]

    told = bench.moment("dev", "torque_sensor")

    assert (told.missing, told.source, told.at_s) == ("not_recorded", None, ())
    assert told.unit_t_us == FAULT_US


def test_a_unit_that_started_anew_has_no_rows_of_before(bench: Bench) -> None:
    bench.stream(300, 800)
    bench.stream(0, 100)

    assert bench.moment("dev", "torque_sensor").missing == "not_recorded"


def test_where_nobody_knows_when_it_came_that_is_said(bench: Bench) -> None:
    bench.ride()
    bench.frame = None

    assert bench.moment("dev", "torque_sensor").missing == "no_frame"


def test_a_fault_that_is_not_remembered_is_not_found(bench: Bench) -> None:
    with pytest.raises(NotFound, match="no fault speed_sensor"):
        bench.moment("dev", "speed_sensor")
