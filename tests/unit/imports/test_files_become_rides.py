"""Goal: a file sent whole or in pieces, once or twice, sound or damaged, ends in rides or a reason.

Method: the real store and the real child process; real recorded files too where they are at hand.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from backend.errors import Conflict, InvalidRequest, NotFound
from backend.formats import Outcome
from backend.imports.service import Uploads, UploadSettings
from backend.rides.files import safe_name
from backend.rides.service import Rides
from backend.store import Store
from tests.fakes.fit_file import START_S, commute, fit_file

# Processes, compilers or hundreds of files: left out of `make test-fast`.
pytestmark = pytest.mark.slow

RECORDED = Path(__file__).resolve().parents[4] / "shared" / "data" / "rides"
SOUND = fit_file(commute(200))


@pytest.fixture
def uploads(store: Store) -> Uploads:
    return Uploads(store)


@pytest.fixture
def rides(store: Store) -> Rides:
    return Rides(store)


def test_a_file_becomes_a_ride_with_figures_and_its_original(
    uploads: Uploads, rides: Rides, store: Store
) -> None:
    upload = uploads.receive_file("Morning.fit", SOUND)

    assert (upload.state, upload.code, upload.completeness) == ("complete", None, 1.0)
    (ride_id,) = upload.ride_ids
    ride = store.rides.get(ride_id)
    assert (ride.name, ride.origin, ride.row_count) == ("Morning", "imported", 200)
    assert ride.summary is not None
    assert ride.summary.distance_km == pytest.approx(0.995)
    assert ride.summary.rider_wh == pytest.approx(150 * 200 / 3600)
    assert ride.summary.motor_wh == pytest.approx(200 * 200 / 3600)
    assert ride.summary.cadence_rpm_mean == pytest.approx(75.0)
    assert b"".join(rides.export(ride_id, "original").chunks) == SOUND


def test_the_same_bytes_are_kept_once_and_the_twin_is_named(uploads: Uploads) -> None:
    first = uploads.receive_file("a.fit", SOUND)

    second = uploads.receive_file("renamed.fit", SOUND)

    assert second.code == "duplicate"
    assert second.duplicate_of == first.ride_ids[0]
    assert second.ride_ids == first.ride_ids
    assert "2023-11-14" in str(second.detail)


def test_a_deleted_ride_may_come_back(uploads: Uploads, rides: Rides) -> None:
    first = uploads.receive_file("a.fit", SOUND)
    rides.delete(first.ride_ids[0])

    again = uploads.receive_file("a.fit", SOUND)

    assert again.state == "complete"
    assert again.code is None
    assert len(again.ride_ids) == 1


def test_pieces_join_to_the_same_ride_wherever_the_line_was_cut(
    uploads: Uploads, store: Store
) -> None:
    upload = uploads.create("a.fit", len(SOUND), hashlib.sha256(SOUND).hexdigest())
    offset = uploads.append(upload.id, 0, SOUND[:1000])
    spooled = store.objects.root / ".spool" / upload.id
    with spooled.open("ab") as file:
        file.write(b"bytes of a piece that was cut before it was counted")

    with pytest.raises(Conflict, match="stands at byte 1000"):
        uploads.append(upload.id, 900, SOUND[900:])
    with pytest.raises(Conflict, match="too many"):
        uploads.append(upload.id, offset, SOUND[offset:] + b"more")
    assert uploads.append(upload.id, offset, SOUND[offset:]) == len(SOUND)

    assert uploads.get(upload.id).state == "complete"


def test_damage_is_told_and_the_rest_is_saved(uploads: Uploads, store: Store) -> None:
    upload = uploads.receive_file("cut.fit", SOUND[: len(SOUND) // 2])

    assert (upload.state, upload.code) == ("partial", "truncated")
    assert upload.completeness == pytest.approx(0.5, abs=0.02)
    ride = store.rides.get(upload.ride_ids[0])
    assert 80 <= ride.row_count <= 110
    assert ride.completeness == upload.completeness


def test_a_file_too_large_is_refused_before_a_byte_moves(store: Store) -> None:
    uploads = Uploads(store, UploadSettings(length_max=1000))

    with pytest.raises(InvalidRequest, match="at most 1000"):
        uploads.create("a.fit", 1001)


def test_an_unfinished_upload_can_be_given_up_and_one_with_a_ride_not(uploads: Uploads) -> None:
    upload = uploads.create("a.fit", 100)
    uploads.remove(upload.id)

    with pytest.raises(NotFound):
        uploads.get(upload.id)
    with pytest.raises(Conflict):
        uploads.remove(uploads.receive_file("a.fit", SOUND).id)


def test_a_file_that_arrived_before_a_crash_is_looked_at_afterwards(store: Store) -> None:
    class Crash(Exception):
        pass

    def crashing(path: Path, name: str) -> Outcome:
        raise Crash

    with pytest.raises(Crash):
        Uploads(store, reader=crashing).receive_file("a.fit", SOUND)

    (upload,) = Uploads(store).recover()

    assert upload.state == "complete"
    assert len(upload.ride_ids) == 1


def test_an_export_as_csv_is_imported_as_the_same_ride(
    uploads: Uploads, rides: Rides, store: Store
) -> None:
    (first,) = uploads.receive_file("a.fit", SOUND).ride_ids
    text = b"".join(rides.export(first, "csv").chunks)

    (second,) = uploads.receive_file("a.csv", text).ride_ids

    one, two = store.rides.get(first), store.rides.get(second)
    assert one.summary is not None
    assert two.summary is not None
    assert (two.started_us, two.row_count) == (START_S * 1_000_000, one.row_count)
    assert two.summary.rider_wh == pytest.approx(one.summary.rider_wh)
    assert two.summary.speed_kmh_mean == pytest.approx(one.summary.speed_kmh_mean, abs=0.01)


def test_a_ride_can_be_looked_at_as_series_figure_and_json(uploads: Uploads, rides: Rides) -> None:
    (ride_id,) = uploads.receive_file("a.fit", SOUND).ride_ids

    shown = rides.series(ride_id, ["rider_power_w"], 10.0, 20.0, 100)
    drawn = rides.figure(ride_id)
    listed = rides.list()

    assert shown.to_json()["bins"] == 11
    names = [curve["name"] for curve in drawn["data"]]  # type: ignore[attr-defined]
    assert names == ["speed_kmh", "rider_power_w", "motor_power_w"]
    assert listed["items"] == [rides.get(ride_id)]
    assert rides.get(ride_id)["started_at"] == "2023-11-14T22:13:20.000Z"
    with pytest.raises(InvalidRequest, match="csv"):
        rides.export(ride_id, "tcx")


@pytest.mark.parametrize(
    ("name", "safe"),
    [
        ("../../etc/passwd", "passwd"),
        ('a"\r\nX-Evil: 1.fit', "a___X-Evil_ 1.fit"),
        ("骑行.fit", "__.fit"),
        ("...", "ride"),
    ],
)
def test_a_file_name_cannot_become_more_than_a_name(name: str, safe: str) -> None:
    assert safe_name(name) == safe


REAL = {
    "fit/2019-02-17-062644-ELEMNT-297E-195-0.fit": ("complete", None, 13_471),
    "fit/Edge810-Vector-2013-08-16-15-35-10.fit": ("complete", None, 4_700),
    "fit/edge530_garmin.fit": ("complete", None, 8_823),
    "fit/null_compressed_speed_dist.fit": ("complete", None, 1_808),
    "fit_broken/activity-settings-corruptheader.fit": ("partial", "damaged", 14),
    "fit_broken/activity-settings-nodata.fit": ("partial", "truncated", 14),
    "fit_broken/activity-unexpected-eof.fit": ("partial", "truncated", 14),
    "fit_broken/coros-pace-2-cycling-misaligned-fields.fit": ("complete", None, 11_272),
    # 14,391 records, of which one has the values of the one before in the same second.
    "fit_broken/nick.fit": ("partial", "truncated", 14_390),
    "fit_broken/sample_mulitple_header.fit": ("complete", None, 1_773),
}


@pytest.mark.parametrize("name", REAL)
def test_files_of_real_head_units_give_all_there_is_in_them(
    name: str, uploads: Uploads, rides: Rides, store: Store
) -> None:
    path = RECORDED / name
    if not path.is_file():
        pytest.skip("the recorded rides are not on this machine")

    upload = uploads.receive_file(path.name, path)

    state, code, rows = REAL[name]
    assert (upload.state, upload.code) == (state, code)
    assert (upload.detail is None) == (code is None)
    assert sum(store.rides.get(ride_id).row_count for ride_id in upload.ride_ids) == rows
    assert rides.series(upload.ride_ids[0], pixels=800).to_json()["bins"]
    assert rides.figure(upload.ride_ids[0])["data"]
