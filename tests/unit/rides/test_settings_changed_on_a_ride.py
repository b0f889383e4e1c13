"""Goal: a ride on which the settings were changed is told by those of each moment, from the
recording to every answer.

Method: events as a unit tells them, and rows made here, in a real store. The first half was ridden
by one configuration, the second by another; an answer for a part is that of a ride of this part.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pytest

from backend.core.ride import Ride, RideContext
from backend.core.ride_events import SETTINGS, RideEvent
from backend.device.states import LinkState, StateChanged, UnitEvent
from backend.errors import InvalidRequest, StoreError
from backend.law import law_defaults
from backend.rides.comparison.service import RideComparison
from backend.rides.insight.ledger import EnergyLedger
from backend.rides.insight.table_use import UseOfTable
from backend.rides.recording.marks import MarkMoment
from backend.rides.recording.recorder import Recorder
from backend.rides.replay.service import RideReplay
from backend.rides.replay.why_ride import WhyRide
from backend.rides.rows import Window
from backend.rides.settings_in_force import all_through, unchanged
from backend.store import Store
from backend.tuning.preview import Preview
from tests.fakes.kept_rides import recorded_ride
from tests.unit.rides.test_recording import SETTINGS as RECORDING
from tests.unit.rides.test_recording import blocks, riding
from tests.unit.rides.test_why_a_moment_was_as_it_was import PERIOD_US, PUSHING

# A store for every test: left out of `make test-fast`.
pytestmark = pytest.mark.slow

OLD, NEW, OTHER = 0x11, 0xFFFF_FFF0, 0x33
WRAP_US = 1 << 32
BEGAN_US = WRAP_US - 20_000_000
"""The unit's clock when it is ridden: its low 32 bits begin again after 20 s."""


@dataclass
class Bike:
    """A unit that is recorded, and what Spindle knows of its configuration."""

    store: Store
    crc32: int | None = OLD
    recorder: Recorder = field(init=False)

    def __post_init__(self) -> None:
        def context_of(unit: str) -> RideContext:
            return RideContext(
                unit, gear_ratio=40.0, boot_id=7, config_crc32=self.crc32, config_generation=4
            )

        self.recorder = Recorder(self.store.rides, context_of, RECORDING)

    def ride(self, seconds: float, after_s: float = 0.0) -> None:
        for block in blocks(riding(seconds), BEGAN_US + round(after_s * 1e6)):
            self.recorder.watch("u1", block)

    def tells(self, name: str, at_s: float, **fields: int) -> None:
        t_us = (BEGAN_US + round(at_s * 1e6)) % WRAP_US
        self.recorder.watch("u1", UnitEvent(name, t_us, fields))

    def changes(self, at_s: float, crc32: int, name: str = "CONFIG_COMMITTED") -> None:
        self.crc32 = crc32
        self.tells(name, at_s, generation=5, crc32=crc32)

    def rides(self) -> list[Ride]:
        self.recorder.close()
        return list(reversed(self.store.rides.list().items))


def test_a_change_is_kept_at_its_moment_by_the_units_own_clock(store: Store) -> None:
    bike = Bike(store)
    bike.ride(25.0)
    bike.changes(24.0, NEW)
    bike.ride(10.0, after_s=25.0)

    (ride,) = bike.rides()

    assert [event.kind for event in ride.events] == [SETTINGS]
    assert ride.settings_spans() == [(0.0, OLD), (pytest.approx(24.0), NEW)]
    assert (ride.context.config_crc32, ride.context.config_generation) == (OLD, 4)


def test_a_trial_that_is_kept_is_one_change_and_one_that_went_back_two(store: Store) -> None:
    bike = Bike(store)
    bike.ride(5.0)
    bike.changes(5.0, NEW, "CONFIG_PROVISIONAL")
    bike.ride(5.0, after_s=5.0)
    bike.changes(10.0, NEW)
    bike.ride(5.0, after_s=10.0)
    bike.changes(15.0, OTHER, "CONFIG_PROVISIONAL")
    bike.ride(5.0, after_s=15.0)
    bike.changes(20.0, NEW, "CONFIG_ROLLED_BACK")
    bike.ride(5.0, after_s=20.0)

    (ride,) = bike.rides()

    spans = [(round(from_s, 3), crc32) for from_s, crc32 in ride.settings_spans()]
    assert spans == [(0.0, OLD), (5.0, NEW), (15.0, OTHER), (20.0, NEW)]


def test_a_change_whose_event_was_lost_is_found_out_within_a_second(store: Store) -> None:
    bike = Bike(store)
    bike.ride(10.0)
    bike.crc32 = NEW
    bike.ride(10.0, after_s=10.0)

    (ride,) = bike.rides()

    (_, (from_s, crc32)) = ride.settings_spans()
    assert crc32 == NEW
    assert from_s == pytest.approx(10.5, abs=0.51)


def test_an_event_that_comes_late_has_its_own_time(store: Store) -> None:
    bike = Bike(store)
    bike.ride(10.0)
    bike.crc32 = NEW
    bike.ride(5.0, after_s=10.0)
    bike.changes(10.0, NEW)
    bike.ride(5.0, after_s=15.0)

    (ride,) = bike.rides()

    assert ride.settings_spans() == [(0.0, OLD), (pytest.approx(10.0), NEW)]


def test_settings_known_only_on_the_way_were_so_from_the_start(store: Store) -> None:
    bike = Bike(store, crc32=None)
    bike.ride(5.0)
    bike.crc32 = OLD
    bike.ride(5.0, after_s=5.0)

    (ride,) = bike.rides()

    assert ride.settings_spans()[-1] == (0.0, OLD)


def test_a_change_survives_a_store_that_refuses(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    bike = Bike(store)
    bike.ride(5.0)
    append, refused = store.rides.append_tail, True

    def append_tail(*given: Any) -> Any:
        if refused:
            raise StoreError("no room")
        return append(*given)

    monkeypatch.setattr(store.rides, "append_tail", append_tail)
    bike.changes(5.0, NEW)
    bike.ride(5.0, after_s=5.0)
    refused = False
    bike.ride(5.0, after_s=10.0)

    (ride,) = bike.rides()

    assert ride.settings_spans() == [(0.0, OLD), (pytest.approx(5.0), NEW)]
    assert ride.completeness == 1.0


def test_marks_are_counted_by_themselves(store: Store) -> None:
    bike = Bike(store)
    bike.ride(5.0)
    bike.changes(5.0, NEW)
    bike.ride(5.0, after_s=5.0)
    mark = MarkMoment(bike.recorder, store.marks, lambda unit: None)

    assert mark("u1").number == 1
    bike.changes(10.0, OTHER)
    bike.ride(5.0, after_s=10.0)
    assert mark("u1").number == 2


def test_what_a_unit_tells_after_a_restart_is_not_of_the_ride_before(store: Store) -> None:
    bike = Bike(store)
    bike.ride(15.0)
    bike.recorder.watch("u1", StateChanged(LinkState.LOST, "restarted"))
    bike.recorder.watch("u1", UnitEvent("BOOT", 5_000, {"boot_id": 8}))
    bike.recorder.watch("u1", UnitEvent("CONFIG_DEFAULTED", 6_000, {"crc32": OTHER}))

    (ride,) = bike.rides()

    assert ride.settings_spans() == [(0.0, OLD)]


# What the answers make of it: the second half of a ride by a table that gives more everywhere.
ROWS = 4000
HALF_S = ROWS * PERIOD_US / 2e6
STEADY = PUSHING | {"torque_rate": 0.0, "fuzzy_gain": 0.2}
BASE = law_defaults()
CONFIGS = {
    OLD: {**BASE, "mode_names": ["OFF", "ECO", "TOUR", "SPORT", "BOOST"]},
    NEW: {**BASE, "fuzzy_rules": [["PB"] * 5 for _ in range(5)]},
    OTHER: {**BASE, "mode_names": ["OFF", "A", "B", "C", "D"]},
}


def config_of(ride: Ride, t_s: float = 0.0) -> tuple[dict[str, Any], str]:
    in_force = [crc32 for from_s, crc32 in ride.settings_spans() if from_s <= t_s]
    return CONFIGS[in_force[-1] or OLD], "ride"


def kept(store: Store, first: int, second: int | None = None) -> int:
    """A ride by one configuration, and by a second one from its middle on."""
    columns = {name: np.full(ROWS, value) for name, value in STEADY.items()}
    events = [] if second is None else [RideEvent(HALF_S, SETTINGS, second)]
    context = {"unit_key": "ebl:SP-1", "config_crc32": first, "config_generation": 4}
    return recorded_ride(store, columns, PERIOD_US, events=events, **context)


def test_a_moment_is_explained_by_the_table_it_was_ridden_by(store: Store) -> None:
    why, ride = WhyRide(store, config_of), kept(store, OLD, NEW)

    before, after = why(ride, HALF_S - 1.0), why(ride, HALF_S + 1.0)

    assert before["table"]["rules"] == BASE["fuzzy_rules"]
    assert after["table"]["rules"] == CONFIGS[NEW]["fuzzy_rules"]
    assert before["gain"] == WhyRide(store, config_of)(kept(store, OLD), HALF_S - 1.0)["gain"]
    assert after["gain"] > before["gain"]


def test_where_the_unit_told_otherwise_it_is_said(store: Store) -> None:
    told = WhyRide(store, config_of)(kept(store, NEW), 30.0)

    figures = {one["figure"]: one for one in told["differs"]}
    assert figures["fuzzy_gain"]["recorded"] == pytest.approx(0.2)
    assert figures["fuzzy_gain"]["worked_out"] == told["gain"]


def test_a_replay_goes_by_each_table_where_it_was_in_force(store: Store) -> None:
    replay = RideReplay(Preview(), config_of)

    def work_wh(*configs: int) -> float:
        told = replay(store.rides.reader(kept(store, *configs)))
        return float(told["motor_work_wh"]["replayed"])

    old, new, both = work_wh(OLD), work_wh(NEW), work_wh(OLD, NEW)

    # The first half is the old one's, the second the new one's; only the start's ramp is apart.
    assert old < both < new
    assert both == pytest.approx((old + new) / 2, rel=0.02)


def test_the_use_of_a_table_and_the_ledger_count_each_part_by_its_own(store: Store) -> None:
    ride = kept(store, OLD, NEW)

    rules = EnergyLedger(store, config_of)(ride)["rules"]

    of_cell: dict[tuple[int, int], dict[str, float]] = {}
    for rule in rules:
        of_cell.setdefault((rule["row"], rule["column"]), {})[rule["label"]] = rule["motor_wh"]
    changed = [labels for labels in of_cell.values() if len(labels) == 2]
    assert changed, "a rule that was changed is told twice: before, and after"
    for labels in changed:
        before, after = labels.values()
        assert before == pytest.approx(after, rel=0.01), "each half has half of the work"

    use = UseOfTable(store, config_of, lambda device: None)
    points = BASE["fuzzy_speed_points_kmh"], BASE["fuzzy_torque_rate_points"]
    assert use(*points, ride_ids=[ride])["assisted_s"] == pytest.approx(2 * HALF_S, rel=0.01)


def test_a_comparison_is_of_the_settings_in_the_windows(store: Store) -> None:
    ride, compare = kept(store, OLD, NEW), RideComparison(store, config_of)

    halves = compare(Window(ride, 0.0, HALF_S - 1.0), Window(ride, HALF_S + 1.0))["settings"]
    whole = compare(Window(ride), Window(kept(store, OLD)))["settings"]

    assert {one.name for one in halves["differences"]} == {"fuzzy_rules", "mode_names"}
    assert [halves[side]["changed_at_s"] for side in "ab"] == [[], []]
    assert (halves["a"]["generation"], halves["b"]["generation"]) == (4, None)
    assert (whole["differences"], whole["a"]["changed_at_s"]) == ((), [HALF_S])


def test_a_ride_with_two_settings_has_no_twin_but_new_names_change_nothing(store: Store) -> None:
    changed, renamed = (store.rides.get(kept(store, OLD, crc32)) for crc32 in (NEW, OTHER))

    with pytest.raises(InvalidRequest, match="were changed at 20 s") as refused:
        unchanged(config_of, changed)

    assert refused.value.code == "settings_changed"
    assert unchanged(config_of, renamed)[0] == CONFIGS[OLD]


def test_what_was_so_all_through_is_what_both_agree_on(store: Store) -> None:
    def half_known(ride: Ride, t_s: float = 0.0) -> tuple[dict[str, Any], str]:
        return config_of(ride, t_s)[0], "ride" if t_s < HALF_S else "defaults"

    ride = store.rides.get(kept(store, OLD, NEW))

    shared, source = all_through(config_of, ride)
    assert source == "ride"
    assert shared == {k: v for k, v in BASE.items() if k not in ("fuzzy_rules", "mode_names")}
    assert all_through(half_known, ride) == ({}, "defaults")


def test_a_ride_that_was_not_changed_is_told_as_ever(store: Store) -> None:
    ride = store.rides.get(kept(store, OLD))
    same = replace(ride, events=(*ride.events, RideEvent(3.0, SETTINGS, OLD)))

    assert ride.settings_spans() == same.settings_spans() == [(0.0, OLD)]
