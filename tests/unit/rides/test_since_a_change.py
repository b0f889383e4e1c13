"""Goal: the rides since a change are told beside those before it, with what they can tell and what
they cannot.

Method: rides of a minute at 36 km/h, 600 m each, in a real store; the motor gives a known power
on each, and the rider 20 Nm at 60 r/min.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from backend.core.revision import Revision
from backend.core.ride_events import SETTINGS, RideEvent
from backend.errors import NotFound
from backend.rides.comparison.since_change import RidesSinceChange
from backend.store import Store, open_store
from tests.fakes.kept_rides import recorded_ride

# A store for every test: left out of `make test-fast`.
pytestmark = pytest.mark.slow

PERIOD_US = 100_000
HOUR_US = 3_600_000_000
UNIT = "ebl:SP-1"
RIDER_W = 20.0 * 60.0 * 2.0 * np.pi / 60.0
MOTOR_RAD_S = 2400.0 * 2.0 * np.pi / 60.0


class Workshop:
    """A store of rides, an hour apart, and the history of the unit they were made with."""

    def __init__(self, folder: Path) -> None:
        self.store: Store = open_store(f"sqlite:///{folder}/db", f"file://{folder}/objects")
        self.history: list[Revision] = []
        self.now_us = 1_700_000_000_000_000
        self.since = RidesSinceChange(self.store, lambda device_id: self.history)

    def ride(
        self,
        motor_w: float | None,
        seconds: int = 60,
        unit: str = UNIT,
        changed_s: float | None = None,
    ) -> int:
        """motor_w: None for a unit that does not measure what its motor gives. changed_s: when on
        the ride the next configuration came into force."""
        values = {"speed_kmh": 36.0, "cadence_rpm": 60.0, "rider_torque_nm": 20.0}
        if motor_w is not None:
            delivered_nm = motor_w / MOTOR_RAD_S
            values |= {"motor_torque_nm": delivered_nm, "motor_torque_demanded_nm": delivered_nm}
            values |= {"motor_speed_rpm": 2400.0}
        columns = {name: np.full(seconds * 1_000_000 // PERIOD_US, v) for name, v in values.items()}
        self.now_us += HOUR_US
        events = [] if changed_s is None else [RideEvent(changed_s, SETTINGS, self.next_seq)]
        return recorded_ride(self.store, columns, PERIOD_US, self.now_us, events, unit_key=unit)

    @property
    def next_seq(self) -> int:
        """Number and CRC-32 of the next configuration."""
        return len(self.history) + 1

    def change(self) -> int:
        """Another configuration, half an hour after the last ride began; its number."""
        seq = self.next_seq
        when_us = self.now_us + HOUR_US // 2
        made = Revision(seq, when_us, "", "", "verified", seq, seq, (), {}, UNIT)
        self.history.insert(0, made)
        return seq


@pytest.fixture
def workshop(tmp_path: Path) -> Iterator[Workshop]:
    opened = Workshop(tmp_path)
    yield opened
    opened.store.close()


def test_rides_on_either_side_of_a_change_are_told_by_distance(workshop: Workshop) -> None:
    before = [workshop.ride(180.0), workshop.ride(216.0), workshop.ride(198.0)]
    seq = workshop.change()
    after = [workshop.ride(144.0), workshop.ride(108.0), workshop.ride(162.0)]

    answer = workshop.since("dev1", seq)

    then, now = answer.before, answer.after
    assert then.ride_ids == before[::-1]
    assert now.ride_ids == after[::-1]
    # Watts over 36 km/h are Wh for a kilometre.
    assert then.motor_wh_per_km == pytest.approx(198.0 / 36.0, rel=0.02)
    assert now.motor_wh_per_km_least == pytest.approx(108.0 / 36.0, rel=0.02)
    assert now.motor_wh_per_km_most == pytest.approx(162.0 / 36.0, rel=0.02)
    assert now.rider_wh_per_km == pytest.approx(RIDER_W / 36.0, rel=0.02)
    assert now.assist_ratio == pytest.approx(138.0 / RIDER_W, rel=0.02)
    assert now.speed_kmh_mean == pytest.approx(36.0, rel=0.01)
    assert answer.motor_wh_per_km_after == "less"
    assert answer.other_changes == 0


def test_what_cannot_be_told_is_said(workshop: Workshop) -> None:
    first = workshop.change()
    workshop.ride(180.0)
    workshop.ride(100.0, seconds=20)  # 200 m
    workshop.ride(100.0, unit="ebl:SP-2")
    second = workshop.change()
    for motor_w in (170.0, 190.0, None):
        workshop.ride(motor_w)

    answer = workshop.since("dev1", second)

    assert len(answer.before.ride_ids) == 1
    assert answer.motor_wh_per_km_after == "too_few"
    assert (len(answer.after.ride_ids), answer.after.motor_rides) == (3, 2)
    # Nothing was ridden before the first; the second lies within what was ridden since.
    answer = workshop.since("dev1", first)
    nothing = answer.before
    assert nothing.ride_ids == []
    assert {nothing.motor_wh_per_km, nothing.assist_ratio, nothing.speed_kmh_mean} == {None}
    assert answer.other_changes == 1


def test_rides_that_overlap_are_told_so(workshop: Workshop) -> None:
    for motor_w in (150.0, 180.0, 210.0):
        workshop.ride(motor_w)
    seq = workshop.change()
    for motor_w in (140.0, 160.0, 120.0):
        workshop.ride(motor_w)

    assert workshop.since("dev1", seq).motor_wh_per_km_after == "mixed"


def test_a_ride_on_which_it_was_changed_is_on_neither_side(workshop: Workshop) -> None:
    whole = workshop.ride(motor_w=100.0)
    ridden = workshop.ride(motor_w=100.0, changed_s=30.0)
    seq = workshop.change()
    after = workshop.ride(motor_w=80.0)

    told = workshop.since("u1", seq)

    assert (told.before.ride_ids, told.during_ids) == ([whole], [ridden])
    assert told.after.ride_ids == [after]


def test_a_change_while_the_bike_stood_at_the_end_is_after_the_ride(workshop: Workshop) -> None:
    ridden = workshop.ride(motor_w=100.0, seconds=120, changed_s=110.0)
    seq = workshop.change()

    told = workshop.since("u1", seq)

    assert (told.before.ride_ids, told.during_ids) == ([ridden], [])


def test_a_configuration_that_never_was_is_not_found(workshop: Workshop) -> None:
    with pytest.raises(NotFound, match="no configuration 7"):
        workshop.since("dev1", 7)
