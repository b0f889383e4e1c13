"""Goal: an owner can say what a table's columns are, or its zone, after it has become a ride; the
ride becomes that, with its number and words, and an answer that it cannot bear changes nothing.

Method: the real store and the real reader, in this process; tables written here.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.errors import Conflict, InvalidRequest
from backend.imports.mapping import TableMapping
from backend.imports.service import Uploads
from backend.rebuild import rebuild_store
from backend.store import Store, Upload, open_store
from tests.fakes.fit_file import commute, fit_file
from tests.unit.imports.conftest import reader

# A store for every test: left out of `make test-fast`.
pytestmark = pytest.mark.slow

ROWS = 40
PULSE = {"channels": {"pulses": "heart_rate_bpm"}}
BERLIN, LISBON = {"time_zone": "Europe/Berlin"}, {"time_zone": "Europe/Lisbon"}


def table(day: int = 1, zone: str = "Z") -> bytes:
    """Says all that must be known of it; nobody would take its last column for a heart rate."""
    rows = (f"2025-05-{day:02}T10:00:{n:02}{zone},{20 + day},{100 + n}" for n in range(ROWS))
    return "\n".join(["time,speed (km/h),pulses", *rows, ""]).encode()


def channels(store: Store, upload: Upload) -> set[str]:
    (ride_id,) = upload.ride_ids
    return {channel.name for channel in store.rides.get(ride_id).channels}


def start_s(store: Store, upload: Upload) -> float:
    return store.rides.get(upload.ride_ids[0]).started_us / 1e6


def test_a_ride_becomes_what_is_said_and_keeps_number_and_words(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    read = uploads.receive_file("1.csv", table())
    store.rides.patch(read.ride_ids[0], "To work", "rain")
    asked = mapping.question(read.id)

    became = mapping.say(read.id, PULSE)

    ride = store.rides.get(became.ride_ids[0])
    assert (read.code, read.has_columns) == (None, True)
    assert (asked["answer"], asked["files_read"]) == (None, 0)
    assert (became.state, became.code, became.ride_ids) == ("complete", None, read.ride_ids)
    assert (ride.name, ride.notes, ride.row_count) == ("To work", "rain", ROWS)
    assert store.rides.reader(ride.id).values(["heart_rate_bpm"])["heart_rate_bpm"][-1] == 139


def test_a_database_made_anew_knows_the_ride_as_it_became(tmp_path: Path) -> None:
    urls = f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects"
    with open_store(*urls) as store:
        uploads = Uploads(store, reader=reader)
        read = uploads.receive_file("1.csv", table())
        TableMapping(store, uploads).say(read.id, PULSE)
    (tmp_path / "db").unlink()

    rebuild_store(*urls)

    with open_store(*urls) as store:
        (upload,) = store.uploads.list()
        assert (upload.sha256, len(upload.ride_ids)) == (read.sha256, 1)
        assert "heart_rate_bpm" in channels(store, upload)


def test_a_zone_that_was_wrong_is_put_right(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    asking = uploads.receive_file("1.csv", table(zone=""))
    at_home = mapping.say(asking.id, BERLIN)
    home_s = start_s(store, at_home)

    became = mapping.say(asking.id, LISBON)

    assert became.ride_ids == at_home.ride_ids
    assert start_s(store, became) - home_s == 3600


def test_the_zone_of_a_tcx_can_be_put_right_too(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    points = "".join(
        f"<Trackpoint><Time>2025-05-01T10:00:{n:02}</Time><DistanceMeters>{5 * n}</DistanceMeters>"
        "</Trackpoint>"
        for n in range(30)
    )
    tcx = (
        "<TrainingCenterDatabase><Activities><Activity Sport='Biking'><Lap><Track>"
        f"{points}</Track></Lap></Activity></Activities></TrainingCenterDatabase>"
    )
    asking = uploads.receive_file("1.tcx", tcx.encode())
    home_s = start_s(store, mapping.say(asking.id, BERLIN))

    became = mapping.say(asking.id, LISBON)

    assert became.has_columns
    assert start_s(store, became) - home_s == 3600


def test_other_files_of_the_header_become_it_only_where_that_is_said(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    first, other = (uploads.receive_file(f"{day}.csv", table(day)) for day in (1, 2))

    mapping.say(first.id, PULSE)
    left = channels(store, other)
    mapping.say(first.id, {"channels": {"pulses": "cadence_rpm"}}, read_again=True)
    uploads.recover()

    assert mapping.question(first.id)["files_read"] == 1
    assert "heart_rate_bpm" not in left
    assert uploads.get(other.id).state == "complete"
    for upload in (first, other):
        assert "cadence_rpm" in channels(store, upload)


def test_the_same_bytes_sent_again_are_asked_about_as_the_first(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    read, again = (uploads.receive_file(name, table()) for name in ("1.csv", "again.csv"))

    became = mapping.say(again.id, PULSE)

    assert (again.code, became.id) == ("duplicate", read.id)
    assert "heart_rate_bpm" in channels(store, read)


def test_a_stop_before_the_file_is_read_again_loses_nothing(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    read = uploads.receive_file("1.csv", table())
    mapping.say(read.id, PULSE)
    # As a server leaves it that is killed behind the answer: it waits to be read.
    store.uploads.wait_again(read.id, "answered_anew")
    (waiting,) = store.uploads.waiting()

    (became,) = Uploads(store, reader=reader).recover()

    assert (waiting.id, waiting.ride_ids) == (read.id, read.ride_ids)
    assert (became.state, became.code, became.ride_ids) == ("complete", None, read.ride_ids)


def test_an_answer_that_the_rides_cannot_bear_changes_nothing(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    """Past midnight, days that are taken for months are two rides."""
    late = [f"04/05/2025 23:59:{40 + n},20" for n in range(20)]
    early = [f"05/05/2025 00:00:{n:02},20" for n in range(20)]
    rows = "\n".join(["timestamp,speed (km/h)", *late, *early, ""])
    asking = uploads.receive_file("night.csv", rows.encode())
    read = mapping.say(asking.id, BERLIN | {"date_order": "day_first"})
    before = store.rides.get(read.ride_ids[0])

    with pytest.raises(Conflict, match="holds 2 rides, and 1 made of it are here") as refused:
        mapping.say(asking.id, BERLIN | {"date_order": "month_first"})
    with pytest.raises(InvalidRequest) as lacks:
        mapping.say(asking.id, BERLIN)
    store_answer = mapping.question(asking.id)["answer"]

    assert (refused.value.code, lacks.value.code) == ("left_as_read", "answer_incomplete")
    assert isinstance(store_answer, dict)
    assert store_answer["date_order"] == "day_first"
    assert store.rides.get(before.id) == before


def test_another_file_that_does_not_fit_the_answer_stays_as_it_was_read(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    header = "timestamp,speed (km/h)"
    evening = [f"04/05/2025 20:00:{n:02},20" for n in range(40)]
    night = [f"04/05/2025 23:59:{40 + n},20" for n in range(20)]
    night += [f"05/05/2025 00:00:{n:02},20" for n in range(20)]
    files = ["\n".join([header, *rows, ""]).encode() for rows in (evening, night)]
    first, other = (uploads.receive_file("1.csv", file) for file in files)
    mapping.say(first.id, BERLIN | {"date_order": "day_first"})
    uploads.recover()
    before = store.rides.get(uploads.get(other.id).ride_ids[0])

    became = mapping.say(first.id, BERLIN | {"date_order": "month_first"}, read_again=True)
    uploads.recover()

    left = uploads.get(other.id)
    assert start_s(store, became) == 1_743_876_000  # 5 April 20:00 in Berlin
    assert (left.state, left.code) == ("complete", "left_as_read")
    assert "holds 2 rides" in str(left.detail)
    assert store.rides.get(before.id) == before


def test_a_question_that_an_answer_opens_is_refused_of_a_ride(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    """With a voltage beside it, the power may be anybody's."""
    rows = [f"2025-05-01T10:00:{n:02}Z,20,36,1{n:02}" for n in range(ROWS)]
    body = "\n".join(["time,speed (km/h),pack,power", *rows, ""])
    read = uploads.receive_file("1.csv", body.encode())
    pack = {"pack": "battery_voltage_v"}

    with pytest.raises(InvalidRequest, match="power") as refused:
        mapping.say(read.id, {"channels": pack})
    became = mapping.say(read.id, {"channels": pack | {"power": "motor_power_w"}})

    assert refused.value.code == "answer_incomplete"
    assert channels(store, became) >= {"battery_voltage_v", "motor_power_w"}


def test_a_unit_counts_as_far_as_it_is_of_what_a_column_is(
    store: Store, uploads: Uploads, mapping: TableMapping
) -> None:
    """A header's own unit, that of a logger's format, and none where it is of another quantity."""
    header = (
        "date,time,speed,voltage,phase_current,current,power,totaldistance,system_temp,trip (mA)"
    )
    rows = [f"2025-05-10,14:03:{n:02}.000,36.00,80,9,9,720,{n},31,{5 * n}" for n in range(ROWS)]
    asking = uploads.receive_file("w.csv", "\n".join([header, *rows, ""]).encode())
    meanings = {"power": "motor_power_w", "trip (mA)": "heart_rate_bpm", "speed": "speed_kmh"}

    became = mapping.say(asking.id, BERLIN | {"channels": meanings})

    reader = store.rides.reader(became.ride_ids[0])
    last = {name: values[-1] for name, values in reader.values(list(meanings.values())).items()}
    assert last == {"motor_power_w": 720, "heart_rate_bpm": 195, "speed_kmh": pytest.approx(36)}


def test_of_a_file_without_columns_nothing_can_be_said(
    uploads: Uploads, mapping: TableMapping
) -> None:
    read = uploads.receive_file("1.fit", fit_file(commute(60)))

    assert not read.has_columns
    with pytest.raises(Conflict) as refused:
        mapping.question(read.id)
    assert refused.value.code == "nothing_asked"
