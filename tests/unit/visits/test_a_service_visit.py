"""Goal: a service visit goes from what the customer says to the owner's consent; what is closed
stays; each sees of it what is theirs.

Method: the workshop's dealer and its riders over HTTP, with a simulated unit in virtual time.
"""

from __future__ import annotations

import io
import itertools
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from tests.fakes.server import eventually
from tests.fakes.workshop import Workshop, open_workshop
from tests.unit.visits.kept_visits import files_of_visits, picture

pytestmark = pytest.mark.slow
Visit = dict[str, Any]
SIGNATURE = {"name": "Rita Müller", "strokes": [[0.1, 0.2, 0.5, 0.6], [0.4, 0.4, 0.41, 0.42]]}
NUMBERS = itertools.count(1)


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Workshop]:
    with open_workshop(tmp_path_factory.mktemp("workshop")) as opened:
        # What is asked without a name is Anna's, who may break a simulated bike.
        opened.server.client = opened.clients["Anna"]
        yield opened


@pytest.fixture
def bike(workshop: Workshop) -> int:
    """A bike without a unit and without an owner."""
    name = f"bike {next(NUMBERS)}"
    return int(workshop.ask("Ben", "POST", "/bikes", json={"name": name})["bike"]["id"])


@pytest.fixture
def device(workshop: Workshop) -> str:
    """A unit, ready, on a bike of its own."""
    number = next(NUMBERS)
    url = f"sim:visit{number}?seed={number}&clock=virtual&scenario=none"
    body = {"url": url, "name": f"City {number}"}
    device = str(workshop.ask("Ben", "POST", "/devices", json=body)["id"])
    eventually(
        lambda: workshop.ask("Ben", "GET", f"/devices/{device}"),
        lambda found: found["state"] == "ready" and found["bike_id"] is not None,
    )
    revisions = f"/devices/{device}/config/revisions"
    eventually(lambda: workshop.ask("Ben", "GET", revisions)["items"])
    return device


def bike_of(workshop: Workshop, device: str) -> int:
    return int(workshop.ask("Ben", "GET", f"/devices/{device}")["bike_id"])


def opened(workshop: Workshop, bike: int, **words: Any) -> Visit:
    visit: Visit = workshop.ask("Ben", "POST", f"/bikes/{bike}/visits", json=words)
    return visit


def seen(workshop: Workshop, visit: Visit, who: str = "Ben") -> Visit:
    found: Visit = workshop.ask(who, "GET", f"/visits/{visit['id']}")
    return found


def closed(workshop: Workshop, visit: Visit) -> Visit:
    found: Visit = workshop.ask("Ben", "POST", f"/visits/{visit['id']}/close")
    return found


def with_photo(workshop: Workshop, visit: Visit, shade: int = 90) -> Visit:
    path = f"/visits/{visit['id']}/photos?name=fork.jpg"
    found: Visit = workshop.ask("Ben", "POST", path, content=picture(shade))
    return found


def consent(workshop: Workshop, visit: Visit, who: str = "Ben", **other: Any) -> Visit:
    body = {"content_sha256": seen(workshop, visit, who)["content_sha256"]}
    body |= other or ({} if who != "Ben" else SIGNATURE)
    found: Visit = workshop.ask(who, "POST", f"/visits/{visit['id']}/consent", json=body)
    return found


def test_a_visit_begins_with_what_the_customer_says_and_what_the_unit_reads(
    workshop: Workshop, device: str
) -> None:
    bike = bike_of(workshop, device)

    words = {"job": "4711", "customer": "Herr Meier", "complaint": "it bucks", "counter_km": 812.5}
    visit = opened(workshop, bike, device_id=device, **words)

    content = visit["content"]
    assert (visit["state"], visit["version"], visit["opened_by"]) == ("open", 1, "Ben")
    assert {name: content[name] for name in words} == words
    unit = workshop.ask("Ben", "GET", f"/devices/{device}")
    before = content["before"]
    assert content["unit_key"] == before["unit_key"] == unit["unit_key"]
    assert before["serial_number"] == unit["identity"]["serial_number"]
    assert (before["generation"], before["crc32"]) == (
        unit["config"]["generation"],
        unit["config"]["crc32"],
    )
    assert "zero" in [one["name"] for one in before["checks"]]
    assert (content["after"], content["changes"], content["faults"]) == (None, [], [])
    assert workshop.refused("Ben", "POST", f"/bikes/{bike}/visits", json={}) == (409, "visit_open")


def test_two_who_write_at_once_do_not_overwrite_each_other(workshop: Workshop, bike: int) -> None:
    visit = opened(workshop, bike, complaint="it bucks")
    path = f"/visits/{visit['id']}"
    parts = [{"name": "chain", "number": "CN-1", "quantity": 2}, {"name": "pads"}]

    first = workshop.ask("Ben", "PATCH", path, json={"version": 1, "parts": parts})
    late = workshop.refused("Anna", "PATCH", path, json={"version": 1, "done": "oiled"})
    second = workshop.ask("Anna", "PATCH", path, json={"version": 2, "done": "oiled"})

    assert late == (409, "visit_changed")
    assert (first["version"], second["version"]) == (2, 3)
    content = second["content"]
    assert (content["complaint"], content["done"]) == ("it bucks", "oiled")
    assert content["parts"] == [parts[0], {"name": "pads", "number": None, "quantity": 1}]
    wrong = {"version": 3, "parts": [{"name": "x"}] * 51}
    assert workshop.refused("Ben", "PATCH", path, json=wrong)[0] == 422


def test_another_bike_on_the_cable_is_not_taken_for_this_one(
    workshop: Workshop, bike: int, device: str
) -> None:
    refused = workshop.refused("Ben", "POST", f"/bikes/{bike}/visits", json={"device_id": device})
    visit = opened(workshop, bike)
    path = f"/visits/{visit['id']}/readings"
    later = workshop.refused("Ben", "POST", path, json={"device_id": device})
    nobody = workshop.refused("Ben", "POST", path, json={"device_id": "none"})

    assert refused == later == (409, "other_bike")
    assert nobody[0] == 404
    assert seen(workshop, visit)["content"]["before"] is None


def test_a_setting_changed_during_a_visit_is_in_it_and_one_taken_back_is_not(
    workshop: Workshop, device: str
) -> None:
    server = workshop.server
    was = workshop.ask("Ben", "GET", f"/devices/{device}/config")["parameters"]
    stop, torque = was["pedal_stop_ms"], was["motor_torque_nm_max"]
    visit = opened(workshop, bike_of(workshop, device))
    server.configure(device, "it ran on", pedal_stop_ms=420)
    server.configure(device, "tried", motor_torque_nm_max=1.5)

    during = seen(workshop, visit)["content"]["changes"]
    tried = [one["parameter"] for one in during]
    assert tried == ["motor_torque_nm_max", "pedal_stop_ms"]
    assert (during[0]["old"], during[0]["new"]) == (torque, 1.5)
    server.configure(device, "and back", pedal_stop_ms=stop)

    [change] = closed(workshop, visit)["content"]["changes"]
    assert (change["parameter"], change["old"], change["new"]) == (
        "motor_torque_nm_max",
        torque,
        1.5,
    )
    assert (change["author"], change["reason"]) == ("Anna", "tried")
    server.configure(device, "on the next day", pedal_stop_ms=440)
    assert len(seen(workshop, visit)["content"]["changes"]) == 1


def test_a_fault_is_seen_before_and_gone_after(workshop: Workshop, device: str) -> None:
    server, path = workshop.server, f"/devices/{device}"

    def active() -> list[str]:
        server.advance(device, 1.0)
        found: list[str] = server.get(path)["faults_active"]
        return found

    server.simulate(device, faults={"torque_sensor": "open_high"})
    [fault] = eventually(active, lambda names: len(names) == 1)
    visit = opened(workshop, bike_of(workshop, device), device_id=device)
    assert visit["content"]["before"]["faults_active"] == [fault]
    assert [(one["name"], one["over_at"]) for one in visit["content"]["faults"]] == [(fault, None)]

    server.simulate(device, faults={"torque_sensor": "sound"}, brake=True)

    def cleared() -> list[str]:
        server.advance(device, 2.0)
        workshop.ask("Ben", "POST", f"{path}/faults/clear")
        found: list[str] = server.get(path)["faults_active"]
        return found

    eventually(cleared, lambda names: names == [])
    body = {"device_id": device}
    after = workshop.ask("Ben", "POST", f"/visits/{visit['id']}/readings", json=body)["content"]

    assert after["before"] == visit["content"]["before"]
    assert after["after"]["faults_active"] == []
    [seen_fault] = after["faults"]
    assert seen_fault["over_at"] >= after["after"]["at"]


def test_what_is_closed_stays_and_only_the_consent_is_added(
    workshop: Workshop, device: str
) -> None:
    visit = with_photo(workshop, opened(workshop, bike_of(workshop, device), complaint="it bucks"))
    photo = visit["content"]["photos"][0]["sha256"]
    over = closed(workshop, visit)
    path = f"/visits/{visit['id']}"

    refused = [
        workshop.refused("Ben", "PATCH", path, json={"version": 1, "done": "oiled"}),
        workshop.refused("Ben", "POST", f"{path}/readings", json={"device_id": device}),
        workshop.refused("Ben", "POST", f"{path}/close"),
        workshop.refused("Ben", "POST", f"{path}/photos?name=x.jpg", content=picture(1)),
        workshop.refused("Ben", "DELETE", f"{path}/photos/{photo}"),
        workshop.refused("Ben", "DELETE", path),
    ]

    assert set(refused) == {(409, "visit_closed")}
    assert seen(workshop, visit) == over
    assert (over["state"], over["closed_at"] is not None) == ("closed", True)
    agreed = consent(workshop, visit)
    assert agreed["content"] == over["content"]
    assert agreed["consent_holds"] is True
    # The next visit may begin.
    assert opened(workshop, over["bike_id"])["id"] > over["id"]


def test_a_visit_begun_by_mistake_goes_without_a_trace(workshop: Workshop, bike: int) -> None:
    objects = workshop.server.services.store._store.objects.root
    before = files_of_visits(objects)
    visit = with_photo(workshop, opened(workshop, bike))
    assert len(files_of_visits(objects)) == len(before) + 2

    workshop.ask("Ben", "DELETE", f"/visits/{visit['id']}")

    assert workshop.refused("Ben", "GET", f"/visits/{visit['id']}") == (404, "not_found")
    assert workshop.ask("Ben", "GET", f"/bikes/{bike}/visits")["items"] == []
    assert files_of_visits(objects) == before
    assert opened(workshop, bike)["id"]


def test_the_owner_signs_in_the_workshop(workshop: Workshop, bike: int) -> None:
    visit = opened(workshop, bike, complaint="it bucks")

    agreed = consent(workshop, visit)

    given = agreed["consent"]
    assert (given["by"], given["name"], given["person_id"]) == ("signature", "Rita Müller", None)
    assert given["strokes"] == SIGNATURE["strokes"]
    assert given["content_sha256"] == agreed["content_sha256"]
    path = f"/visits/{visit['id']}/consent"
    sha256 = agreed["content_sha256"]
    for lacking in (
        {"name": "", "strokes": SIGNATURE["strokes"]},
        {"name": "Rita", "strokes": []},
        {"name": "Rita", "strokes": [[0.1, 0.2]]},
        {"name": "Rita", "strokes": [[0.1, 0.2, 0.3]]},
    ):
        answer = workshop.clients["Ben"].post(path, json={"content_sha256": sha256, **lacking})
        assert answer.status_code == 422
        assert [one["code"] for one in answer.json()["errors"]] == ["no_signature"]
    outside = {"content_sha256": sha256, "name": "Rita", "strokes": [[0.1, 0.2, 1.3, 0.2]]}
    assert workshop.refused("Ben", "POST", path, json=outside)[0] == 422
    other = {"content_sha256": sha256, "name": "Olaf", "strokes": [[0.5, 0.5, 0.6, 0.6]]}
    assert workshop.refused("Ben", "POST", path, json=other) == (409, "consented_already")
    assert seen(workshop, visit)["consent"] == given


def test_nobody_consents_to_what_they_have_not_seen(workshop: Workshop, bike: int) -> None:
    visit = opened(workshop, bike, complaint="it bucks", customer="Rita")
    stale = visit["content_sha256"]
    path = f"/visits/{visit['id']}"
    # Who brought it is no part of what was done.
    named = workshop.ask("Ben", "PATCH", path, json={"version": 1, "customer": "Rita Müller"})
    assert named["content_sha256"] == stale
    workshop.ask("Ben", "PATCH", path, json={"version": 2, "done": "oiled"})

    body = {"content_sha256": stale, **SIGNATURE}
    refused = workshop.refused("Ben", "POST", f"{path}/consent", json=body)

    assert refused == (409, "visit_changed")
    assert consent(workshop, visit)["consent_holds"] is True
    changed = workshop.ask("Ben", "PATCH", path, json={"version": 3, "done": "oiled, adjusted"})
    assert (changed["consent"]["by"], changed["consent_holds"]) == ("signature", False)
    assert consent(workshop, visit)["consent_holds"] is True


def test_a_setting_that_is_changed_ends_a_consent_too(workshop: Workshop, device: str) -> None:
    visit = opened(workshop, bike_of(workshop, device))
    assert consent(workshop, visit)["consent_holds"] is True

    workshop.server.configure(device, "later", pedal_stop_ms=430)

    assert seen(workshop, visit)["consent_holds"] is False


def test_an_owner_consents_with_their_own_account_and_not_by_a_key(workshop: Workshop) -> None:
    bike = workshop.bikes["Rita"]
    visit = opened(workshop, bike, customer="Herr Meier", complaint="it bucks")
    path = f"/visits/{visit['id']}/consent"
    scopes = {"name": "program", "scopes": ["change_register", "see_register"]}
    secret = workshop.ask("Rita", "POST", "/keys", json=scopes)["secret"]
    sha256 = seen(workshop, visit, "Rita")["content_sha256"]

    with httpx.Client(
        base_url=f"{workshop.server.url}/api/v1", trust_env=False, timeout=30.0
    ) as program:
        headers = {"authorization": f"Bearer {secret}"}
        body = {"content_sha256": sha256}
        by_key = program.post(path, json=body, headers=headers)
        looked = program.get(f"/visits/{visit['id']}", headers=headers)
    agreed = consent(workshop, visit, "Rita")

    assert (by_key.status_code, by_key.json()["code"]) == (403, "needs_session")
    assert looked.status_code == 200
    given = agreed["consent"]
    person = workshop.people["Rita"]
    assert (given["by"], given["name"], given["person_id"]) == ("account", "Rita", person.id)
    assert (given["strokes"], agreed["content"]["customer"]) == ([], "")
    assert workshop.refused("Olaf", "POST", path, json=body)[0] == 404
    workshop.ask("Ben", "DELETE", f"/visits/{visit['id']}")


def test_a_rider_sees_the_visits_of_their_bike_alone_and_changes_none(workshop: Workshop) -> None:
    bike = workshop.bikes["Olaf"]
    visit = with_photo(workshop, opened(workshop, bike, customer="Frau Secret", done="oiled"))
    path, photo = f"/visits/{visit['id']}", visit["content"]["photos"][0]["sha256"]

    [listed] = workshop.ask("Olaf", "GET", f"/bikes/{bike}/visits")["items"]
    assert listed == seen(workshop, visit, "Olaf")
    assert (listed["content"]["customer"], listed["content"]["done"]) == ("", "oiled")
    assert seen(workshop, visit)["content"]["customer"] == "Frau Secret"
    found = workshop.clients["Olaf"].get(f"{path}/photos/{photo}")
    assert (found.status_code, found.headers["content-type"]) == (200, "image/jpeg")
    assert found.content.startswith(b"\xff\xd8\xff")
    for method, where in (
        ("GET", path),
        ("GET", f"{path}/photos/{photo}"),
        ("GET", f"/bikes/{bike}/visits"),
        ("GET", f"/bikes/{bike}/history"),
        ("POST", f"{path}/consent"),
    ):
        assert workshop.refused("Rita", method, where)[0] == 404
    for method, where in (
        ("POST", f"/bikes/{bike}/visits"),
        ("POST", f"/bikes/{bike}/history"),
        ("PATCH", path),
        ("DELETE", path),
        ("POST", f"{path}/close"),
        ("POST", f"{path}/readings"),
        ("POST", f"{path}/photos?name=x"),
        ("DELETE", f"{path}/photos/{photo}"),
    ):
        assert workshop.refused("Olaf", method, where)[0] == 403
    workshop.ask("Ben", "DELETE", path)


def test_the_next_owner_sees_the_visits_without_the_names_of_the_one_before(
    workshop: Workshop, bike: int
) -> None:
    workshop.pair(bike, "Rita")
    by_account = opened(workshop, bike, customer="Rita Müller")
    closed(workshop, by_account)
    consent(workshop, by_account, "Rita")
    by_hand = opened(workshop, bike)
    closed(workshop, by_hand)
    consent(workshop, by_hand)
    assert workshop.refused("Olaf", "GET", f"/visits/{by_hand['id']}")[0] == 404

    workshop.ask("Ben", "DELETE", f"/bikes/{bike}/owner")
    workshop.pair(bike, "Olaf")

    visits = workshop.ask("Olaf", "GET", f"/bikes/{bike}/visits")["items"]
    assert [one["id"] for one in visits] == [by_hand["id"], by_account["id"]]
    for visit in visits:
        who = (visit["consent"]["name"], visit["consent"]["person_id"], visit["consent"]["strokes"])
        assert who == (None, None, [])
        assert (visit["consent_holds"], visit["content"]["customer"]) == (True, "")
        path, body = f"/visits/{visit['id']}/consent", {"content_sha256": visit["content_sha256"]}
        assert workshop.refused("Olaf", "POST", path, json=body) == (409, "consented_already")
    assert workshop.refused("Rita", "GET", f"/visits/{by_hand['id']}")[0] == 404
    assert workshop.refused("Rita", "GET", f"/bikes/{bike}/visits")[0] == 404
    history = workshop.clients["Olaf"].get(f"/bikes/{bike}/history")
    assert history.status_code == 200
    assert "Rita" not in text_in(history.content)


def text_in(data: bytes) -> str:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return archive.read("history.json").decode()


def test_pictures_that_are_none_and_bodies_that_never_end_are_refused(
    workshop: Workshop, bike: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    visit = opened(workshop, bike)
    path = f"/visits/{visit['id']}/photos?name=x.jpg"
    objects = workshop.server.services.store._store.objects.root
    before = files_of_visits(objects)

    def codes(answer: httpx.Response) -> tuple[int, list[str]]:
        body = answer.json()
        return answer.status_code, [body["code"], *(one["code"] for one in body.get("errors", []))]

    none = workshop.clients["Ben"].post(path, content=b"<svg/>")
    monkeypatch.setattr("backend.visits.visits_api.PHOTO_BYTES_MAX", 1000)
    large = workshop.clients["Ben"].post(path, content=bytes(1001))

    assert codes(none) == (422, ["invalid", "no_picture"])
    assert codes(large) == (422, ["too_large"])
    assert workshop.refused("Ben", "POST", f"/bikes/{bike}/history", content=b"x") == (
        422,
        "no_history",
    )
    assert files_of_visits(objects) == before


def test_a_history_goes_from_one_server_to_another(
    workshop: Workshop, bike: int, tmp_path: Path
) -> None:
    visit = with_photo(workshop, opened(workshop, bike, complaint="it bucks", customer="Meier"))
    over = closed(workshop, visit)
    consent(workshop, visit)
    answer = workshop.clients["Ben"].get(f"/bikes/{bike}/history")
    assert answer.headers["content-type"] == "application/zip"
    assert f"spindle-bike-{bike}.zip" in answer.headers["content-disposition"]

    with open_workshop(tmp_path) as other:
        there = other.bikes["Rita"]
        path = f"/bikes/{there}/history"
        added = other.ask("Ben", "POST", path, content=answer.content)
        again = other.ask("Ben", "POST", path, content=answer.content)
        [found] = other.ask("Rita", "GET", f"/bikes/{there}/visits")["items"]
        sha256 = found["content"]["photos"][0]["sha256"]
        photo = other.clients["Rita"].get(f"/visits/{found['id']}/photos/{sha256}").content

    assert (added, again) == ({"added": 1, "known": 0}, {"added": 0, "known": 1})
    assert (found["imported"], found["consent_holds"]) == (True, True)
    assert found["content_sha256"] == over["content_sha256"]
    assert photo == workshop.clients["Ben"].get(f"/visits/{visit['id']}/photos/{sha256}").content
