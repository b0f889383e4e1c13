"""Goal: a key that can only send files sends them for its bike, and opens nothing else.

Method: a workshop with two riders; the rule whose a ride is, in a database with two bikes.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import httpx
import pytest

from backend.core.person import Sender
from backend.core.ride import RideContext
from backend.core.unit_key import serial_key
from backend.store import open_store
from backend.store.bikes import bike_of_unit, whose_ride
from tests.fakes.house import bearer
from tests.fakes.track_files import gpx_file, gpx_track
from tests.fakes.workshop import Workshop

pytestmark = pytest.mark.slow


def logger(workshop: Workshop, who: str, bike: int | None = None) -> tuple[int, httpx.Client]:
    """A new key of somebody's, for all bikes or one, and a logger that has it."""
    body = {"name": "logger", "scopes": ["upload_files"], "bike_id": bike}
    made = workshop.ask(who, "POST", "/keys", json=body)
    url = f"{workshop.server.url}/api/v1"
    return made["key"]["id"], httpx.Client(
        base_url=url, headers=bearer(made["secret"]), timeout=30.0
    )


def sent(client: httpx.Client, minute: int) -> dict[str, Any]:
    """What became of a ride of two minutes."""
    track = gpx_file(gpx_track((60 * minute, 60 * minute + 120)))
    answer = client.post(f"/rides/import?name={minute}.gpx", content=track)
    assert answer.is_success, answer.text
    upload: dict[str, Any] = answer.json()
    return upload


def test_what_a_bikes_key_sends_is_its_owners_ride(workshop: Workshop) -> None:
    bike = workshop.old_bike("Rita")
    _, key = logger(workshop, "Ben", bike)

    [ride_id] = sent(key, 200)["ride_ids"]

    hers = workshop.ask("Rita", "GET", f"/rides?bike={bike}")["items"]
    assert ride_id in [ride["id"] for ride in hers]
    assert workshop.refused("Olaf", "GET", f"/rides/{ride_id}")[0] == 404


def test_a_key_that_sends_files_sees_those_it_sent_and_nothing_else(workshop: Workshop) -> None:
    """Also of the workshop, whose dealer sees everything."""
    for who in ("Ben", "Rita"):
        _, key = logger(workshop, who)
        own = sent(key, 300 if who == "Ben" else 400)
        _, other = logger(workshop, who)

        assert [one["id"] for one in key.get("/uploads").json()["items"]] == [own["id"]]
        assert other.get("/uploads").json()["items"] == []
        assert key.get(f"/uploads/{own['id']}").status_code == 200
        assert other.get(f"/uploads/{own['id']}").status_code == 404
        assert key.get(f"/uploads/{workshop.uploads['Rita']}").status_code == 404
        for path in ("/rides", f"/rides/{workshop.rides[who] if who == 'Rita' else 1}", "/bikes"):
            assert key.get(path).status_code == 403
        assert key.get(f"/uploads/{own['id']}/mapping").status_code == 403
        assert key.delete(f"/uploads/{own['id']}").status_code == 403
        # Who made the key sees what it sent.
        assert own["id"] in [one["id"] for one in workshop.ask(who, "GET", "/uploads")["items"]]


def test_a_rider_makes_keys_for_their_own_bikes(workshop: Workshop) -> None:
    body = {"name": "phone", "scopes": ["upload_files"], "bike_id": workshop.bikes["Rita"]}

    made = workshop.ask("Rita", "POST", "/keys", json=body)["key"]

    assert (made["bike_id"], made["bike_name"]) == (workshop.bikes["Rita"], "Rita's bike")
    assert workshop.refused("Olaf", "POST", "/keys", json=body) == (404, "not_found")
    more = body | {"scopes": ["upload_files", "see_rides"]}
    assert workshop.refused("Rita", "POST", "/keys", json=more) == (422, "only_files_of_a_bike")
    nothing = body | {"bike_id": 999_999}
    assert workshop.refused("Ben", "POST", "/keys", json=nothing) == (404, "not_found")


def test_a_file_goes_on_where_it_stood_by_its_hash_until_the_key_ends(workshop: Workshop) -> None:
    number, key = logger(workshop, "Ben", workshop.bikes["Olaf"])
    tus = {"tus-resumable": "1.0.0", "upload-length": "1000"}
    sha256 = "5" * 64
    # base64 of "5" * 64
    described = {"upload-metadata": "sha256 " + "NTU1" * 21 + "NQ=="}
    at = key.post("/uploads", headers=tus | described).headers["location"]
    part = {"content-type": "application/offset+octet-stream", "upload-offset": "0"}
    key.patch(f"/uploads/{at.rsplit('/', 1)[1]}", headers=tus | part, content=b"<gpx>" * 20)

    [found] = key.get(f"/uploads?sha256={sha256}").json()["items"]
    assert (found["state"], found["received"]) == ("receiving", 100)

    workshop.ask("Ben", "DELETE", f"/keys/{number}")
    goes_on = part | {"upload-offset": "100"}
    refused = key.patch(f"/uploads/{found['id']}", headers=tus | goes_on, content=b"x")
    assert refused.status_code == 401
    assert workshop.ask("Ben", "GET", f"/uploads/{found['id']}")["received"] == 100


def test_a_bike_with_a_key_of_its_own_stays(workshop: Workshop) -> None:
    bike = workshop.ask("Ben", "POST", "/bikes", json={"name": "rental 7"})["bike"]["id"]
    body = {"name": "logger", "scopes": ["upload_files"], "bike_id": bike}
    workshop.ask("Ben", "POST", "/keys", json=body)

    assert workshop.refused("Ben", "DELETE", f"/bikes/{bike}") == (409, "bike_in_use")


def test_whose_a_ride_is_by_its_sender_and_its_unit(tmp_path: Path) -> None:
    """Nobody adds rides to a bike that is not theirs, or not their key's."""
    on_first, on_second, unknown = (serial_key("ebl", f"SN{number}") for number in range(3))
    with open_store(f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "o").as_uri()) as store:
        write = store.database.write
        first, second = (
            write(lambda c, key=key: bike_of_unit(c, key, now_us=1))
            for key in (on_first, on_second)
        )

        def bike(key: str | None, sender: Sender) -> int | None:
            context = RideContext(unit_key=key)
            return write(lambda c: whose_ride(c, context, 1_000_000, sender))["bike_id"]

        of_first = Sender(key_id=9, bike_id=first)
        assert bike(None, of_first) == first
        assert bike(unknown, of_first) == first
        assert bike(on_first, of_first) == first
        assert bike(on_second, of_first) is None
        assert bike(on_second, Sender(key_id=9)) == second
        # A rider whose bike neither is.
        assert bike(None, Sender(owner_id=4, bike_id=first)) is None
        assert bike(on_second, Sender(owner_id=4)) is None
