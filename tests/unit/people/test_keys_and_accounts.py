"""Goal: a key opens what it is for and nothing else, and no account or key outlives its end.

Method: the application with accounts on SQLite and nothing else, as in test_who_may_ask_what.
"""

from __future__ import annotations

from fastapi.testclient import TestClient

from backend.core.person import ROLES, Permission
from tests.fakes.house import ORIGIN, PASSWORD, House, bearer, new_key


def test_a_key_does_what_it_is_for_and_no_more(house: House) -> None:
    _, secret = new_key(house, "upload_files")
    client = house.client()

    upload = client.options("/api/v1/uploads", headers=bearer(secret))
    rides = client.get("/api/v1/rides", headers=bearer(secret))
    leave = client.delete("/api/v1/session?everywhere=true", headers=bearer(secret))

    assert upload.status_code == 204
    assert (rides.status_code, rides.json()["code"]) == (403, "not_allowed")
    assert leave.json()["code"] == "needs_session"


def test_a_key_never_allows_more_than_its_person(house: House) -> None:
    _, secret = new_key(house, *map(str, Permission), role="rider")

    answer = house.client().get("/api/v1/session", headers=bearer(secret)).json()

    assert answer["signed_in"]["permissions"] == sorted(ROLES["rider"])


def test_a_key_gives_nobody_a_way_in_and_no_more_than_it_has(
    house: House, admin: TestClient
) -> None:
    """Were its only scope a key to everything, a program's leak would be a house's."""
    _, secret = new_key(house, "manage_people", *ROLES["rider"])
    people = {one.name: one.id for one in house.people.accounts.list()}
    key = bearer(secret)

    def code(method: str, path: str, **body: object) -> object:
        answer = house.client().request(method, f"/api/v1{path}", json=body, headers=key)
        return answer.json()["code"] if answer.status_code >= 400 else answer.status_code

    fresh = {"name": "Eve", "role": "rider", "password": PASSWORD}
    assert code("POST", "/people", **fresh) == "needs_session"
    assert code("POST", "/keys", name="more", scopes=["back_up"]) == "needs_session"
    assert code("PATCH", f"/people/{people['rider']}", password=PASSWORD) == "needs_session"
    assert code("PATCH", f"/people/{people['rider']}", role="admin") == "more_than_yours"
    assert code("PATCH", f"/people/{people['admin']}", enabled=False) == "more_than_yours"
    assert code("DELETE", f"/people/{people['rider']}") == "needs_session"
    assert code("PATCH", f"/people/{people['rider']}", name="rider") == 200
    assert admin.get("/api/v1/session").json()["signed_in"] is not None


def test_everybody_makes_and_revokes_keys_of_their_own(house: House) -> None:
    dealer, rider = house.client("dealer"), house.client("rider")
    others, _ = new_key(house, "upload_files")
    mine = {"name": "workshop", "scopes": ["upload_files"]}
    own = dealer.post("/api/v1/keys", json=mine, headers=ORIGIN).json()["key"]
    too_much = dealer.post("/api/v1/keys", json=mine | {"scopes": ["back_up"]}, headers=ORIGIN)
    whose = {"person_id": own["person_id"] + 1000}
    for_another = dealer.post("/api/v1/keys", json=mine | whose, headers=ORIGIN)
    listed = dealer.get("/api/v1/keys").json()["items"]
    by_rider = rider.delete(f"/api/v1/keys/{own['id']}", headers=ORIGIN)
    anothers = dealer.delete(f"/api/v1/keys/{others}", headers=ORIGIN)
    ended = dealer.delete(f"/api/v1/keys/{own['id']}", headers=ORIGIN)

    assert {one["person_name"] for one in listed} == {"dealer"}
    assert too_much.json()["code"] == "more_than_yours"
    assert [one.status_code for one in (for_another, by_rider, anothers)] == [404] * 3
    assert ended.status_code == 204


def test_an_account_is_renamed_and_removed(house: House, admin: TestClient) -> None:
    number = house.people.accounts.add("Hannah", "dealer", PASSWORD).id
    hers = house.client()
    hers.post("/api/v1/sign-in", json={"name": "Hannah", "password": PASSWORD})
    secret = hers.post(
        "/api/v1/keys", json={"name": "hers", "scopes": ["upload_files"]}, headers=ORIGIN
    ).json()["secret"]
    where = f"/api/v1/people/{number}"

    taken = admin.patch(where, json={"name": "ＲＩＤＥＲ"}, headers=ORIGIN)
    renamed = admin.patch(where, json={"name": "Hanna"}, headers=ORIGIN)
    as_new = hers.get("/api/v1/session").json()["signed_in"]
    removed = admin.delete(where, headers=ORIGIN)

    assert (taken.status_code, taken.json()["code"]) == (409, "name_taken")
    assert (renamed.json()["name"], as_new["person"]["name"]) == ("Hanna", "Hanna")
    assert removed.status_code == 204
    assert hers.get("/api/v1/session").json()["signed_in"] is None
    assert house.client().get("/api/v1/rides", headers=bearer(secret)).status_code == 401
    assert admin.delete(where, headers=ORIGIN).status_code == 404
    last = next(one.id for one in house.people.accounts.list() if one.role == "admin")
    alone = admin.delete(f"/api/v1/people/{last}", headers=ORIGIN)
    assert (alone.status_code, alone.json()["code"]) == (409, "last_admin")


def test_a_key_is_shown_once_and_noted_when_used(house: House, admin: TestClient) -> None:
    number, secret = new_key(house, "upload_files")
    house.client().get("/api/v1/session", headers=bearer(secret))

    told = admin.get("/api/v1/keys")
    row = next(one for one in told.json()["items"] if one["id"] == number)

    assert secret.rsplit("_", 1)[1] not in told.text
    assert secret.startswith(f"sp_{row['prefix']}_")


def test_a_revoked_an_expired_and_a_damaged_key_open_nothing(
    house: House, admin: TestClient
) -> None:
    number, secret = new_key(house, "see_rides")
    assert house.client().get("/api/v1/tables", headers=bearer(secret)).status_code != 401
    admin.delete(f"/api/v1/keys/{number}", headers=ORIGIN)
    past = {"name": "late", "scopes": ["upload_files"], "expires_at": "2020-01-01T00:00:00Z"}

    for wrong in (secret, secret[:-1] + "0", secret[:-1], "sp_", "x", ""):
        answer = house.client("admin").get("/api/v1/tables", headers=bearer(wrong))
        # Not even the cookie that came with it helps.
        assert (answer.status_code, answer.json()["code"]) == (401, "sign_in_first")
    late = admin.post("/api/v1/keys", json=past, headers=ORIGIN)
    assert (late.status_code, late.json()["code"]) == (422, "in_the_past")


def test_a_person_who_is_disabled_is_out_with_their_keys(house: House, admin: TestClient) -> None:
    house.people.accounts.add("Frieda", "dealer", PASSWORD)
    frieda = house.client()
    number = frieda.post("/api/v1/sign-in", json={"name": "Frieda", "password": PASSWORD}).json()[
        "id"
    ]
    body = {"name": "hers", "scopes": ["upload_files"], "person_id": number}
    secret = admin.post("/api/v1/keys", json=body, headers=ORIGIN).json()["secret"]

    admin.patch(f"/api/v1/people/{number}", json={"enabled": False}, headers=ORIGIN)

    assert frieda.get("/api/v1/tables").status_code == 401
    assert house.client().get("/api/v1/tables", headers=bearer(secret)).status_code == 401
    again = frieda.post("/api/v1/sign-in", json={"name": "Frieda", "password": PASSWORD})
    assert (again.status_code, again.json()["code"]) == (401, "wrong_password")
