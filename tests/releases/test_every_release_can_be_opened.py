"""Goal: what any released version left on a disk is opened by this one, and nothing of it is lost.

Method: `make release-data` keeps a data folder of every release with what that version said of it.
Here a copy is opened, every row of every ride read, and the server started on it with its unit,
whose flash lies in the folder too.
"""

from __future__ import annotations

import json
import tarfile
from pathlib import Path
from typing import Any

import pytest

from backend.store import open_store
from backend.store.upkeep.check import check_store
from tests.fakes.server import ServerHere
from tests.releases.make import BYTES_MAX, CHANGED, NAME, REASON, UNIT, lived, zeros

RELEASES = sorted(path.parent for path in Path(__file__).parent.glob("*/answers.json"))


@pytest.fixture(params=RELEASES, ids=lambda release: release.name)
def release(request: pytest.FixtureRequest) -> Path:
    path: Path = request.param
    return path


@pytest.fixture
def data(release: Path, tmp_path: Path) -> Path:
    """A copy of its data folder."""
    with tarfile.open(release / "data.tar.xz") as archive:
        # Python 3.11.2 has no filters; what comes later warns or refuses without one.
        archive.extraction_filter = getattr(tarfile, "data_filter", lambda member, path: member)
        archive.extractall(tmp_path)
    return tmp_path


@pytest.fixture
def answers(release: Path) -> dict[str, Any]:
    """What the version itself said of its data."""
    found: dict[str, Any] = json.loads((release / "answers.json").read_text(encoding="utf-8"))
    return found


def test_it_is_small(release: Path) -> None:
    assert sum(path.stat().st_size for path in release.iterdir()) < BYTES_MAX


def test_every_ride_is_read_row_by_row(data: Path, answers: dict[str, Any]) -> None:
    urls = (f"sqlite:///{data}/spindle.db", (data / "objects").as_uri())

    with open_store(*urls) as store:
        rides = {ride.id: ride for ride in store.rides.list().items}
        for known in answers["rides"]:
            ride = rides.pop(known["id"])
            reader = store.rides.reader(ride.id)
            counts = reader.counts([channel.name for channel in ride.channels], 0, ride.row_count)

            assert (ride.name, ride.origin) == (known["name"], known["origin"])
            assert {len(rows) for rows in counts.values()} == {known["row_count"]}
            if ride.upload_id is not None:
                upload = store.uploads.get(ride.upload_id)
                assert upload is not None
                assert upload.object_key is not None
                assert (data / "objects" / upload.object_key).is_file()

    assert rides == {}
    assert NAME in [known["name"] for known in answers["rides"]]
    assert check_store(*urls).is_fine


@pytest.mark.slow
@pytest.mark.long
def test_what_the_next_release_leaves_holds_calibrations_and_a_zero(tmp_path: Path) -> None:
    said = lived(tmp_path)

    assert [one["state"] for one in said["calibrations"]] == ["capturing", "closed"]
    assert [len(one["captures"]) for one in said["calibrations"]] == [2, 10]
    assert [one["zero_nm"] is not None for one in said["zeros"]] == [True]
    with ServerHere(tmp_path, [UNIT]) as server:
        jobs = [server.get(f"/calibrations/{one['id']}") for one in said["calibrations"]]
    assert kept_of(jobs, said["calibrations"]) == said["calibrations"]


def kept_of(now: Any, before: Any) -> Any:
    """The part of an answer that an older version had, too: a later one may have more.

    What another Python works out of the same readings may differ in its last digit.
    """
    if isinstance(before, dict):
        return {name: kept_of(now[name], value) for name, value in before.items()}
    if isinstance(before, list) and len(now) == len(before):
        return [kept_of(one, other) for one, other in zip(now, before, strict=True)]
    if isinstance(before, float) and now == pytest.approx(before, rel=1e-9):
        return before
    return now


PER_K = ("sensor_offset_counts_per_k", "sensor_gain_share_per_k")


@pytest.mark.slow
def test_the_server_starts_on_it_and_the_unit_keeps_its_settings(
    data: Path, answers: dict[str, Any]
) -> None:
    with ServerHere(data, [UNIT]) as server:
        device = server.ready_device()
        parameters = server.get(f"/devices/{device}/config")["parameters"]
        revisions = server.get(f"/devices/{device}/config/revisions")["items"]
        rides = server.get("/rides")["items"]
        series = [server.get(f"/rides/{ride['id']}/series?channels=speed_kmh") for ride in rides]
        # Release 0.5 had no calibrations and did not watch the zero.
        jobs = [server.get(f"/calibrations/{one['id']}") for one in answers.get("calibrations", ())]
        seen = zeros(server, device)
        own = {one["id"]: server.get(f"/library/{one['id']}") for one in answers["library"]}

    kept = {name: value for name, value in answers["parameters"].items() if name in parameters}
    assert set(CHANGED) <= set(kept)
    assert {name: parameters[name] for name in kept} == kept
    assert parameters["fuzzy_inference"] == "mamdani_centroid"
    if "sensor_reference_degc" not in kept:
        # Such firmware corrected the readings itself, for 0.02 Nm/K and 0.02 %/K above 20 degrees.
        now = [parameters[name] for name in ("sensor_reference_degc", *PER_K)]
        assert now == [20.0, 2.0, -0.0002]
    for known in answers["revisions"]:
        assert known in [
            {"generation": one["generation"], "reason": one["reason"]} for one in revisions
        ]
    assert REASON in [one["reason"] for one in revisions]
    assert {ride["id"]: ride["name"] for ride in rides} == {
        known["id"]: known["name"] for known in answers["rides"]
    }
    for before, now in zip(answers.get("calibrations", ()), jobs, strict=True):
        assert kept_of(now, before) == before
    assert [one for one in answers.get("zeros", ()) if one not in seen] == []
    for one in series:
        assert one["channels"][0]["max"]
    assert own == {one["id"]: one["document"] for one in answers["library"]}
