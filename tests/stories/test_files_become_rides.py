"""Goal: a head unit's file given to the server becomes a ride, and a broken one a clear reason.

The generated file is written by tests/fakes/fit_file.py from the format's public description. The
recorded ones, where this checkout has them beside it, are real head units' and real damage.
"""

from __future__ import annotations

import base64
import hashlib
from pathlib import Path
from typing import Any

import pytest

from tests.fakes.fit_file import fit_ride
from tests.fakes.server import SpindleServer

START_S = 1_700_000_000
RECORDED = Path(__file__).resolve().parents[3] / "shared" / "data" / "rides"
TUS = {"tus-resumable": "1.0.0"}
CHUNK = {**TUS, "content-type": "application/offset+octet-stream"}


def steady_ride(minutes: int = 10, power_w: int = 180) -> bytes:
    """Steady pedalling at 18 km/h, each length on a day of its own."""
    seconds = 60 * minutes
    return fit_ride(
        START_S + (10 - minutes) * 86_400, [18.0] * seconds, [80] * seconds, [power_w] * seconds
    )


def imported(server: SpindleServer, name: str, content: bytes) -> dict[str, Any]:
    answer: dict[str, Any] = server.ask(
        "POST", "/rides/import", params={"name": name}, content=content
    )
    return answer


def test_a_fit_file_becomes_a_ride_with_the_figures_it_was_written_with(
    server: SpindleServer,
) -> None:
    upload = imported(server, "evening loop.fit", steady_ride())

    assert upload["state"] == "complete"
    ride = server.get(f"/rides/{upload['ride_ids'][0]}")
    assert ride["origin"] == "imported"
    assert ride["name"] == "evening loop"
    assert ride["started_at"] == "2023-11-14T22:13:20Z"
    # 599 s at 18 km/h, 80 turns a minute, 180 W: 2.995 km and 29.95 Wh.
    assert ride["summary"]["distance_km"] == pytest.approx(2.995, rel=0.01)
    assert ride["summary"]["rider_wh"] == pytest.approx(29.95, rel=0.01)
    assert ride["summary"]["cadence_rpm_mean"] == pytest.approx(80.0)
    assert ride["summary"]["motor_wh"] is None
    series = server.get(f"/rides/{ride['id']}/series", params={"channels": "speed_kmh"})
    assert series["channels"][0]["max"][0] == pytest.approx(18.0, abs=0.01)


def test_a_page_saved_as_a_ride_is_refused_by_its_first_bytes(server: SpindleServer) -> None:
    upload = imported(server, "ride.fit", b"<!DOCTYPE html>" + bytes(3_000_000))

    assert (upload["state"], upload["code"]) == ("rejected", "unsupported_format")
    assert upload["received"] < 1_000_000


def test_the_same_bytes_twice_are_one_ride(server: SpindleServer) -> None:
    content = steady_ride(minutes=3)
    first = imported(server, "first.fit", content)

    second = imported(server, "again.fit", content)

    assert second["code"] == "duplicate"
    assert second["duplicate_of"] == first["ride_ids"][0]
    assert len([r for r in server.get("/rides")["items"] if r["name"] in ("first", "again")]) == 1


def test_the_original_comes_back_byte_for_byte(server: SpindleServer) -> None:
    content = steady_ride(minutes=4)
    upload = imported(server, "original.fit", content)

    exported = server.client.get(
        f"/rides/{upload['ride_ids'][0]}/export", params={"format": "original"}
    )

    assert exported.content == content


def test_a_file_cut_short_gives_what_can_be_saved_and_says_so(server: SpindleServer) -> None:
    whole = steady_ride(minutes=5, power_w=150)
    # After the records: definition and message of the session, and the checksum.
    record_bytes, tail_bytes = 10, 12 + 6 + 2
    records_before = len(whole) - tail_bytes - 300 * record_bytes

    upload = imported(server, "cut.fit", whole[: records_before + 150 * record_bytes + 4])

    assert upload["state"] == "partial"
    assert upload["code"]
    assert upload["detail"]
    assert 0.0 < upload["completeness"] < 1.0
    ride = server.get(f"/rides/{upload['ride_ids'][0]}")
    assert ride["row_count"] == 150


def imported_rides(server: SpindleServer) -> list[int]:
    """Rides that came from files; the unit may record one of its own meanwhile."""
    return [r["id"] for r in server.get("/rides")["items"] if r["origin"] == "imported"]


@pytest.mark.parametrize("content", [b"", b"not a ride at all", bytes(5000)])
def test_what_is_no_ride_is_rejected_with_a_reason(server: SpindleServer, content: bytes) -> None:
    before = imported_rides(server)

    upload = imported(server, "thing.fit", content)

    assert upload["state"] == "rejected"
    assert upload["detail"]
    assert upload["ride_ids"] == []
    assert imported_rides(server) == before


def begin_upload(server: SpindleServer, name: str, length: int) -> str:
    described = f"filename {base64.b64encode(name.encode()).decode()}"
    response = server.client.post(
        "/uploads",
        headers={**TUS, "upload-length": str(length), "upload-metadata": described},
    )
    assert response.status_code == 201, response.text
    return response.headers["location"].removeprefix("/api/v1")


def test_an_upload_that_broke_off_goes_on_where_it_stood(server: SpindleServer) -> None:
    content = steady_ride(minutes=6)
    path = begin_upload(server, "resumed.fit", len(content))
    server.client.patch(path, headers={**CHUNK, "upload-offset": "0"}, content=content[:1000])

    stands = server.client.head(path, headers=TUS)
    offset = int(stands.headers["upload-offset"])
    rest = server.client.patch(
        path, headers={**CHUNK, "upload-offset": str(offset)}, content=content[offset:]
    )

    assert offset == 1000
    assert stands.headers["upload-length"] == str(len(content))
    assert (rest.status_code, rest.headers["upload-offset"]) == (204, str(len(content)))
    assert server.get(path)["state"] == "complete"


def test_a_piece_in_the_wrong_place_or_with_a_wrong_checksum_changes_nothing(
    server: SpindleServer,
) -> None:
    content = steady_ride(minutes=7)
    path = begin_upload(server, "careful.fit", len(content))
    wrong = base64.b64encode(hashlib.sha256(b"something else").digest()).decode()
    right = base64.b64encode(hashlib.sha256(content).digest()).decode()

    ahead = server.client.patch(path, headers={**CHUNK, "upload-offset": "5"}, content=content)
    damaged = server.client.patch(
        path,
        headers={**CHUNK, "upload-offset": "0", "upload-checksum": f"sha256 {wrong}"},
        content=content,
    )
    stands = server.client.head(path, headers=TUS).headers["upload-offset"]
    whole = server.client.patch(
        path,
        headers={**CHUNK, "upload-offset": "0", "upload-checksum": f"sha256 {right}"},
        content=content,
    )

    assert (ahead.status_code, damaged.status_code, stands) == (409, 460, "0")
    assert whole.status_code == 204


def test_an_upload_given_up_is_gone(server: SpindleServer) -> None:
    path = begin_upload(server, "given-up.fit", 1000)

    ended = server.client.delete(path, headers=TUS)

    assert ended.status_code == 204
    assert server.client.head(path, headers=TUS).status_code == 404


def test_a_rejected_file_is_listed_and_can_be_removed(server: SpindleServer) -> None:
    upload = imported(server, "no ride.fit", b"rejected and removed")
    assert upload["expires_at"]
    assert upload["id"] in [item["id"] for item in server.get("/uploads")["items"]]

    removed = server.client.delete(f"/uploads/{upload['id']}")

    assert removed.status_code == 204
    assert server.client.get(f"/uploads/{upload['id']}").status_code == 404
    assert server.client.delete(f"/uploads/{upload['id']}").status_code == 404


def test_a_file_goes_with_its_ride(server: SpindleServer) -> None:
    upload = imported(server, "to be deleted.fit", steady_ride(minutes=8))
    (ride_id,) = upload["ride_ids"]

    kept = server.client.delete(f"/uploads/{upload['id']}")
    server.ask("DELETE", f"/rides/{ride_id}")

    assert (kept.status_code, kept.json()["code"]) == (409, "has_rides")
    assert str(ride_id) in kept.json()["detail"]
    assert server.client.get(f"/uploads/{upload['id']}").status_code == 404


def test_another_version_of_tus_is_told_which_one_we_speak(server: SpindleServer) -> None:
    response = server.client.post(
        "/uploads", headers={"tus-resumable": "0.2.2", "upload-length": "10"}
    )

    assert response.status_code == 412
    assert response.headers["tus-version"] == "1.0.0"


def recorded_files(folder: str) -> list[Path]:
    return sorted((RECORDED / folder).glob("*.fit"))


@pytest.mark.skipif(not recorded_files("fit"), reason="the recorded rides are not beside us")
@pytest.mark.parametrize("file", recorded_files("fit"), ids=lambda file: file.stem)
def test_a_file_of_a_real_head_unit_becomes_a_ride(server: SpindleServer, file: Path) -> None:
    upload = imported(server, file.name, file.read_bytes())

    assert upload["state"] in ("complete", "partial"), upload["detail"]
    ride = server.get(f"/rides/{upload['ride_ids'][0]}")
    assert ride["summary"]["duration_s"] > 60.0
    assert server.get(f"/rides/{ride['id']}/figure")["data"]


@pytest.mark.skipif(not recorded_files("fit_broken"), reason="the broken rides are not beside us")
@pytest.mark.parametrize("file", recorded_files("fit_broken"), ids=lambda file: file.stem)
def test_a_really_damaged_file_gets_a_reason_and_never_a_crash(
    server: SpindleServer, file: Path
) -> None:
    upload = imported(server, file.name, file.read_bytes())

    assert upload["state"] in ("complete", "partial", "rejected")
    if upload["state"] != "complete":
        assert upload["detail"]
    assert server.get("/health")["status"] == "ok"
