"""Goal: one ride that comes again is one ride, and two rides never become one.

Method: generated rides with known numbers through the real store, in every way a ride comes again:
saved anew, cut and whole, in Spindle's own exports, from a second device. The second device has
errors of its own, as receivers have; the same road on another day has another time.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest

from backend.core.channels import ChannelSpec
from backend.core.ride import RideContext
from backend.imports.service import Uploads
from backend.rebuild import rebuild_store
from backend.rides.service import Rides
from backend.store import Store, Upload, open_store
from tests.fakes.fit_file import START_S, commute, fit_file
from tests.fakes.uploading import read_here

DAY_S = 86_400
LENGTH_S = 600
Rows = list[dict[str, float | None]]


def ridden(start_s: int = START_S, seed: int = 1, offset_m: float = 0.0) -> Rows:
    """Ten minutes along a road that bends, with everything changing from second to second.

    offset_m: how far east of the road a receiver sees itself, with a metre of noise besides.
    """
    dice = random.Random(seed)
    rows = []
    metres = 0.0
    for second in range(LENGTH_S):
        speed_ms = 5.0 + 2.0 * np.sin(second / 40.0)
        metres += speed_ms
        stray = dice.gauss(offset_m, 1.0) if offset_m else 0.0
        rows.append(
            {
                "timestamp": start_s + second,
                "position_lat": 48.0 + metres / 111_195.0,
                "position_long": 11.0 + 0.001 * np.sin(second / 90.0) + stray / 74_400.0,
                "cadence": 70 + second % 20,
                "distance": round(metres, 2),
                "speed": round(speed_ms, 3),
                "power": 120 + dice.randrange(60),
            }
        )
    return rows


def without(rows: Sequence[dict[str, float | None]], *names: str) -> bytes:
    return fit_file([{k: v for k, v in row.items() if k not in names} for row in rows])


RIDDEN = ridden()
WHOLE = fit_file(RIDDEN)
CUT = WHOLE[: len(WHOLE) * 6 // 10]


class Shop:
    def __init__(self, store: Store) -> None:
        self.store = store
        self.uploads = Uploads(store, reader=read_here)
        self.rides = Rides(store)

    def take(self, name: str, data: bytes) -> Upload:
        return self.uploads.receive_file(name, data)

    def exported(self, ride_id: int, file_format: str) -> bytes:
        return b"".join(self.rides.export(ride_id, file_format).chunks)

    @property
    def ride_ids(self) -> list[int]:
        return sorted(ride.id for ride in self.store.rides.list().items)


@pytest.fixture
def shop(tmp_path: Path) -> Iterator[Shop]:
    with open_store(f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects") as store:
        opened = Shop(store)
        yield opened
        opened.uploads.close()


def test_a_file_that_was_saved_again_is_here_already(shop: Shop) -> None:
    (first,) = shop.take("a.fit", WHOLE).ride_ids
    again = fit_file(RIDDEN, header_crc=False)
    assert again != WHOLE

    sent = shop.take("again.fit", again)

    assert (sent.state, sent.code, sent.duplicate_of) == ("complete", "duplicate", first)
    assert shop.ride_ids == [first]
    assert shop.store.objects.local_path(str(sent.object_key)).read_bytes() == again


@pytest.mark.parametrize("file_format", ["fit", "csv", "gpx"])
def test_spindle_s_own_export_of_a_ride_is_here_already(shop: Shop, file_format: str) -> None:
    (first,) = shop.take("a.fit", WHOLE).ride_ids

    sent = shop.take(f"export.{file_format}", shop.exported(first, file_format))

    assert (sent.code, sent.duplicate_of) == ("duplicate", first)
    assert shop.ride_ids == [first]


def test_the_export_of_a_ride_recorded_here_is_here_already(shop: Shop) -> None:
    channels = (ChannelSpec("speed_kmh", "km/h", 0.01), ChannelSpec("cadence_rpm", "rpm", 1.0))
    ride_id = shop.store.rides.start_live(
        channels, 10_000, START_S * 1_000_000 + 250_000, RideContext()
    )
    seconds = np.arange(12_000) / 100
    rows = np.stack([2000 + 500 * np.sin(seconds / 9), 70 + seconds % 20], axis=1)
    shop.store.rides.append_tail(ride_id, 0, rows.round().astype(np.int16)).result()
    shop.store.rides.finish(ride_id)

    sent = shop.take("export.fit", shop.exported(ride_id, "fit"))

    assert (sent.code, sent.duplicate_of, shop.ride_ids) == ("duplicate", ride_id, [ride_id])


def test_a_whole_file_makes_the_ride_of_a_cut_one_whole(shop: Shop, tmp_path: Path) -> None:
    cut = shop.take("a.fit", CUT)
    (ride_id,) = cut.ride_ids
    assert cut.state == "partial"
    shop.store.rides.patch(ride_id, name="Canal", notes="wind", tags=["work"])

    sent = shop.take("whole.fit", WHOLE)

    ride = shop.store.rides.get(ride_id)
    assert (sent.state, sent.code, sent.ride_ids) == ("complete", "made_whole", (ride_id,))
    assert shop.ride_ids == [ride_id]
    assert (ride.row_count, ride.completeness) == (LENGTH_S, 1.0)
    assert (ride.name, ride.notes, ride.tags) == ("Canal", "wind", ("work",))
    assert shop.exported(ride_id, "original") == WHOLE
    assert shop.store.objects.local_path(str(cut.object_key)).read_bytes() == CUT
    assert ride.summary is not None
    metres = [float(row["distance"] or 0) for row in (RIDDEN[0], RIDDEN[-1])]
    assert ride.summary.distance_km == pytest.approx((metres[1] - metres[0]) / 1000)


def test_a_cut_file_after_the_whole_one_is_here_already(shop: Shop) -> None:
    (first,) = shop.take("whole.fit", WHOLE).ride_ids

    sent = shop.take("cut.fit", CUT)

    assert (sent.state, sent.code, sent.duplicate_of) == ("partial", "duplicate", first)
    assert shop.store.rides.get(first).row_count == LENGTH_S


def test_a_file_with_more_channels_replaces_one_with_fewer_and_not_the_other_way(
    shop: Shop,
) -> None:
    (ride_id,) = shop.take("track.fit", without(RIDDEN, "power", "cadence")).ride_ids

    richer = shop.take("all.fit", WHOLE)
    poorer = shop.take("speed.fit", without(RIDDEN, "power"))

    assert (richer.code, poorer.code, shop.ride_ids) == ("made_whole", "duplicate", [ride_id])
    channels = {channel.name for channel in shop.store.rides.get(ride_id).channels}
    assert {"rider_power_w", "cadence_rpm"} <= channels


def test_a_file_without_a_wrong_position_replaces_one_with_it(shop: Shop) -> None:
    """A receiver that was a degree off for a second: nobody rides 111 km in it."""
    jumped = [dict(row) for row in RIDDEN]
    jumped[300]["position_lat"] = 49.0
    (ride_id,) = shop.take("jumped.fit", fit_file(jumped)).ride_ids

    sent = shop.take("right.fit", WHOLE)

    assert (sent.code, shop.ride_ids) == ("made_whole", [ride_id])
    assert shop.take("jumped again.fit", fit_file(jumped[:-1])).code == "duplicate"
    reader = shop.store.rides.reader(ride_id)
    assert np.isfinite(reader.values(["latitude_deg"])["latitude_deg"]).all()


def test_parts_that_each_have_what_the_other_lacks_are_both_kept(shop: Shop) -> None:
    (first,) = shop.take("begin.fit", fit_file(RIDDEN[:400])).ride_ids

    sent = shop.take("end.fit", fit_file(RIDDEN[150:]))

    (second,) = sent.ride_ids
    assert (sent.code, shop.ride_ids) == ("same_ride", [first, second])
    assert shop.store.rides.get(second).same_ride_as == first
    assert shop.store.rides.get(first).same_ride_as == second


@pytest.mark.parametrize("offset_m", [2.5, 4.0])
def test_two_devices_on_one_handlebar_are_two_rides_that_know_of_each_other(
    shop: Shop, offset_m: float
) -> None:
    (first,) = shop.take("head unit.fit", WHOLE).ride_ids

    sent = shop.take("watch.fit", fit_file(ridden(START_S + 3, 2, offset_m)))

    (second,) = sent.ride_ids
    assert (sent.state, sent.code) == ("complete", "same_ride")
    assert shop.store.rides.get(second).same_ride_as == first
    shop.store.rides.delete(first)
    assert shop.store.rides.get(second).same_ride_as is None


def test_a_commute_each_day_at_the_same_time_is_a_ride_each_day(shop: Shop) -> None:
    for day in range(5):
        sent = shop.take(f"{day}.fit", fit_file(ridden(START_S + day * DAY_S)))
        assert (sent.state, sent.code) == ("complete", None)

    assert len(shop.ride_ids) == 5


def test_there_and_back_within_the_hour_are_two_rides(shop: Shop) -> None:
    shop.take("there.fit", WHOLE)

    sent = shop.take("back.fit", fit_file(ridden(START_S + LENGTH_S + 60)))

    assert (sent.code, len(shop.ride_ids)) == (None, 2)


def test_two_riders_at_one_time_on_other_roads_have_nothing_to_do_with_each_other(
    shop: Shop,
) -> None:
    shop.take("mine.fit", WHOLE)
    elsewhere = [{**row, "position_lat": float(row["position_lat"] or 0) + 0.1} for row in RIDDEN]

    sent = shop.take("hers.fit", fit_file(elsewhere))

    assert (sent.code, len(shop.ride_ids)) == (None, 2)
    assert shop.store.rides.get(sent.ride_ids[0]).same_ride_as is None


def test_indoors_without_a_position_the_samples_decide(shop: Shop) -> None:
    indoors = [{k: row[k] for k in ("timestamp", "power", "cadence")} for row in RIDDEN]
    other = [{**row, "power": float(row["power"] or 0) + 9} for row in indoors]
    (first,) = shop.take("a.fit", fit_file(indoors)).ride_ids

    same = shop.take("b.fit", fit_file(indoors[:300]))
    two = shop.take("c.fit", fit_file(other))

    assert (same.code, same.duplicate_of) == ("duplicate", first)
    assert two.code is None
    assert len(shop.ride_ids) == 2


def test_a_ride_made_whole_is_whole_in_a_rebuilt_store(tmp_path: Path) -> None:
    objects, fresh = f"file://{tmp_path}/objects", f"sqlite:///{tmp_path}/new"
    with open_store(f"sqlite:///{tmp_path}/db", objects) as store:
        shop = Shop(store)
        (ride_id,) = shop.take("a.fit", CUT).ride_ids
        store.rides.patch(ride_id, name="Canal")
        shop.take("whole.fit", WHOLE)
        shop.uploads.close()

    report = rebuild_store(fresh, objects)

    assert (report.rides, len(report.superseded)) == (1, 1)
    assert (report.originals_without_ride, report.originals_missing) == ([], [])
    with open_store(fresh, objects) as store:
        (ride,) = store.rides.list().items
        assert (ride.name, ride.row_count) == ("Canal", LENGTH_S)
        assert {upload.name for upload in store.uploads.list()} == {"a.fit", "whole.fit"}


def test_the_steady_commute_of_other_tests_is_one_ride_too(shop: Shop) -> None:
    (first,) = shop.take("a.fit", fit_file(commute(200))).ride_ids

    assert shop.take("b.fit", fit_file(commute(100))).duplicate_of == first


def table(name: str, values: Sequence[float], note: str = "") -> bytes:
    """Rides of one channel a second, besides a steady speed where `note` is none."""
    times = [f"2026-07-01T10:{at // 60:02}:{at % 60:02}Z" for at in range(len(values))]
    head, speed = (f"time_utc,{name},speed_kmh", ",20") if not note else (f"time_utc,{name}", "")
    lines = [f"{at},{value}{speed}" for at, value in zip(times, values, strict=True)]
    return "\n".join([head, *lines, note]).encode()


def test_the_same_way_with_another_motor_is_another_recording(shop: Shop) -> None:
    """What the motor gave is not thrown away because the rider and the road were alike."""
    helped = shop.take("a.csv", table("motor_torque_nm", [0.5] * 300))
    unhelped = shop.take("b.csv", table("motor_torque_nm", [0.0] * 300))

    assert (helped.state, unhelped.state) == ("complete", "complete")
    assert len(shop.ride_ids) == 2


def test_rides_of_nothing_that_could_tell_them_apart_are_both_kept(shop: Shop) -> None:
    first = shop.take("a.csv", table("altitude_m", [70.0] * 60, note=" "))
    second = shop.take("b.csv", table("altitude_m", [70.0] * 60, note="  "))

    assert (first.state, second.state) == ("complete", "complete")
    assert len(shop.ride_ids) == 2
