"""Goal: a rider sees and changes what is theirs, and learns of nothing else, by any route.

Method: the description gives every route there is. Those with something of somebody's in their
address are asked by a rider for their own, for another's and for what does not exist; the others by
what their answers hold.
"""

from __future__ import annotations

import io
import sys
import zipfile
from typing import Any

import httpx
import pytest
from PIL import Image

from tests.fakes.api import description
from tests.fakes.track_files import gpx_file, gpx_track
from tests.fakes.workshop import Workshop

pytestmark = pytest.mark.slow
NOWHERE = {
    "ride_id": "999999",
    "bike_id": "999999",
    "upload_id": "A" * 22,
    "visit_id": "999999",
    "sha256": "0" * 64,
}
TUS = {"tus-resumable": "1.0.0", "upload-offset": "0"}


def with_something_of_somebodys() -> list[tuple[str, str, str]]:
    """Operation, method and path of every route with something of somebody's in its address."""
    return sorted(
        (operation["operationId"], method.upper(), path)
        for path, methods in description()["paths"].items()
        for method, operation in methods.items()
        if any(f"{{{name}}}" in path for name in NOWHERE)
    )


def mine(workshop: Workshop, who: str) -> dict[str, str]:
    return {
        "ride_id": str(workshop.rides[who]),
        "bike_id": str(workshop.bikes[who]),
        "upload_id": workshop.uploads[who],
        **visit_of(workshop, workshop.bikes[who]),
    }


def visit_of(workshop: Workshop, bike: int) -> dict[str, str]:
    """The visit of a bike, begun if there is none, and its photograph."""
    visits = workshop.ask("Ben", "GET", f"/bikes/{bike}/visits")["items"]
    if not visits:
        begun = workshop.ask("Ben", "POST", f"/bikes/{bike}/visits", json={"complaint": "creaks"})
        path = f"/visits/{begun['id']}/photos?name=crank.png"
        visits = [workshop.ask("Ben", "POST", path, content=png(str(bike)))]
    [photo] = visits[0]["content"]["photos"]
    return {"visit_id": str(visits[0]["id"]), "sha256": photo["sha256"]}


def png(number: str) -> bytes:
    picture = io.BytesIO()
    Image.new("RGB", (8 + 8 * int(number), 8)).save(picture, "PNG")
    return picture.getvalue()


def asked(client: httpx.Client, method: str, path: str, names: dict[str, str]) -> tuple[int, Any]:
    """Status and code; a body is of nothing, so that nothing is changed."""
    for name, value in names.items():
        path = path.replace(f"{{{name}}}", value)
    answer = client.request(method, path.removeprefix("/api/v1"), headers=TUS)
    problem = answer.content and "problem" in answer.headers.get("content-type", "")
    return answer.status_code, answer.json()["code"] if problem else None


def test_anothers_and_what_does_not_exist_are_the_same_by_every_route(workshop: Workshop) -> None:
    rita = workshop.clients["Rita"]
    lines, wrong = [], []
    # What would end what the rest of this test needs is tried for another's only.
    ends = {"delete_ride", "delete_upload", "leave_bike", "pair_bike"}
    for operation, method, path in with_something_of_somebodys():
        another_s = asked(rita, method, path, mine(workshop, "Olaf"))
        none_s = asked(rita, method, path, NOWHERE)
        own = (
            ("-", None) if operation in ends else asked(rita, method, path, mine(workshop, "Rita"))
        )
        lines.append(f"{operation:28}{another_s[0]:>6}{none_s[0]:>6}{own[0]:>6} {own[1] or ''}")
        is_closed = another_s[0] == own[0] == 403
        is_own = another_s[0] == 404 and own[0] not in (403, 404)
        if another_s != none_s or not (is_closed or is_own):
            wrong.append((operation, another_s, none_s, own))
    # Shown by `pytest -s`, and where the test fails.
    sys.stdout.write(f"{'':28}{'other':>6}{'none':>6}{'own':>6}\n" + "\n".join(lines) + "\n")

    assert len(lines) >= 29
    assert wrong == []
    assert workshop.ask("Olaf", "GET", f"/rides/{workshop.rides['Olaf']}")["name"] == "Olaf"


@pytest.mark.parametrize(
    "path",
    [
        "/rides",
        "/rides?q=Olaf",
        "/rides/home",
        "/uploads",
        "/bikes",
        "/keys",
        "/session",
    ],
)
def test_no_list_of_a_rider_names_another(workshop: Workshop, path: str) -> None:
    answer = workshop.clients["Rita"].get(path)

    assert answer.status_code == 200, answer.text
    assert "Olaf" not in answer.text


def test_what_is_named_in_a_body_has_to_be_the_rider_s_own_too(workshop: Workshop) -> None:
    own, another_s = workshop.rides["Rita"], workshop.rides["Olaf"]
    both = {"ride_ids": [own, another_s]}
    pair = f"a={own}&b={another_s}"

    refused = [
        workshop.refused("Rita", "POST", "/rides/tags", json={**both, "add": ["x"]}),
        *(
            workshop.refused("Rita", "GET", f"/rides/compare{what}?{pair}")
            for what in ("", "/series", "/crank")
        ),
        workshop.refused("Rita", "GET", f"/rides/archive?ids={own},{another_s}"),
    ]

    assert {status for status, _ in refused} == {404}
    # As one that is gone already.
    workshop.ask("Rita", "POST", "/rides/delete", json={"ride_ids": [another_s]})
    for who in ("Rita", "Olaf"):
        assert workshop.ask(who, "GET", f"/rides/{workshop.rides[who]}")["tags"] == []


def test_the_same_file_of_two_riders_is_a_ride_of_each(workshop: Workshop) -> None:
    """Nobody learns from a "duplicate" that somebody else was there."""
    track = gpx_file(gpx_track((5000, 5200)))
    first = workshop.send("Olaf", "there.gpx", track)
    second = workshop.send("Rita", "there.gpx", track)
    again = workshop.send("Rita", "again.gpx", track)

    assert (first["state"], second["state"]) == ("complete", "complete")
    assert second["duplicate_of"] is None
    assert again["duplicate_of"] == second["ride_ids"][0]
    rides = [workshop.ask("Ben", "GET", f"/rides/{one['ride_ids'][0]}") for one in (first, second)]
    assert rides[0]["id"] != rides[1]["id"]
    # Each has a file of its own: words and deletion of one are not the other's.
    workshop.ask("Rita", "PATCH", f"/rides/{rides[1]['id']}", json={"name": "mine"})
    workshop.ask("Rita", "DELETE", f"/rides/{rides[1]['id']}")
    assert workshop.ask("Olaf", "GET", f"/rides/{rides[0]['id']}")["name"] == "there"
    assert workshop.ask("Olaf", "GET", f"/rides/{rides[0]['id']}/series?px=10")


def test_what_is_in_a_rider_s_archive_is_theirs(workshop: Workshop) -> None:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for number in range(2):
            track = gpx_file(gpx_track((8000 + 300 * number, 8200 + 300 * number)))
            archive.writestr(f"{number}.gpx", track)

    sent = workshop.send("Rita", "rides.zip", packed.getvalue())

    assert len(sent["ride_ids"]) == 2
    for ride_id in sent["ride_ids"]:
        assert workshop.ask("Rita", "GET", f"/rides/{ride_id}")["id"] == ride_id
        assert workshop.refused("Olaf", "GET", f"/rides/{ride_id}") == (404, "not_found")
    parts = workshop.ask("Rita", "GET", f"/uploads?part_of={sent['id']}")["items"]
    assert len(parts) == 2
    hers = workshop.clients["Olaf"].get(f"/uploads?part_of={sent['id']}")
    assert "items" not in hers.json() or hers.json()["items"] == []


def test_riders_need_no_workshop_for_their_files_and_change_none_of_its(workshop: Workshop) -> None:
    table = b"t;v\n0;5\n1;6\n2;7\n3;6\n"
    sent = workshop.send("Rita", "mystery.csv", table)

    assert workshop.refused("Rita", "GET", "/tables")[0] == 403
    assert workshop.refused("Olaf", "GET", f"/uploads/{sent['id']}/mapping")[0] == 404
    assert workshop.refused("Rita", "GET", "/devices") == (403, "not_allowed")
    assert workshop.refused("Rita", "GET", "/library") == (403, "not_allowed")


def test_of_their_bike_a_rider_says_its_name_and_that_it_is_lost(workshop: Workshop) -> None:
    bike = f"/bikes/{workshop.bikes['Rita']}"

    renamed = workshop.ask("Rita", "PATCH", bike, json={"name": "Blue", "lost": True})
    frame = workshop.refused("Rita", "PATCH", bike, json={"frame_number": "WBK1"})
    unit = workshop.refused("Rita", "PATCH", bike, json={"unit_key": "ebl:A"})

    assert (renamed["bike"]["name"], renamed["bike"]["lost_at"] is not None) == ("Blue", True)
    assert (frame[0], unit[0]) == (403, 403)
    found = workshop.ask("Ben", "PATCH", bike, json={"frame_number": "WBK1", "lost": False})
    assert (found["bike"]["frame_number"], found["bike"]["lost_at"]) == ("WBK1", None)
    assert found["bike"]["owner"]["name"] == "Rita"
