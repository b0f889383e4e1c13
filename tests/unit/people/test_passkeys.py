"""Goal: a passkey signs in its person, at the name it is for, and nobody else anywhere else.

Method: the application with accounts on SQLite and nothing else; an authenticator of the tests,
which can be made to lie; a clock of ours.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient
from sqlalchemy import select

from backend.core.audit import Action
from backend.core.person import RoleName
from backend.people.passkeys.proof import Credential
from backend.people.passkeys.records import PASSKEYS_MAX
from backend.people.passkeys.relying_party import RelyingParty, relying_party
from backend.people.passkeys.service import VALID_S
from backend.people.sign_in import FREE_BY_ADDRESS
from backend.people.throttle import FORGET_S
from backend.store.sql import tables as t
from tests.fakes.authenticator import PRESENT, Authenticator
from tests.fakes.house import PASSWORD, House, bearer, new_key, open_house

HERE = "http://localhost"
ORIGIN = {"origin": HERE}
OWN = "/api/v1/session/passkeys"
SIGN_IN = "/api/v1/sign-in/passkey"
NUMBERS = count(1)


@dataclass
class Hall(House):
    """A house whose clock is ours."""

    now_s: float = 1000.0

    def person(self, role: RoleName = "rider") -> tuple[int, TestClient]:
        """Somebody new, and a browser that they are signed in with at localhost."""
        name = f"Rita {next(NUMBERS)}"
        number = self.people.accounts.add(name, role, PASSWORD).id
        browser = self.client(base=HERE)
        answer = browser.post("/api/v1/sign-in", json={"name": name, "password": PASSWORD})
        assert answer.status_code == 200
        return number, browser

    def rider(self) -> tuple[int, Authenticator, TestClient]:
        """Somebody new with a passkey, in a browser that they are signed in with."""
        number, browser = self.person()
        authenticator = Authenticator(HERE)
        assert added(browser, authenticator).status_code == 201
        return number, authenticator, browser

    def events(self, account_id: int) -> list[Any]:
        """What the audit has of an account."""
        database = self.people.passkeys._passkeys._database
        query = select(t.audit_event).where(t.audit_event.c.object_id == str(account_id))
        rows = database.read(lambda c: c.execute(query.order_by(t.audit_event.c.id)).all())
        return list(rows)


@pytest.fixture(scope="module")
def hall(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Hall]:
    clock: list[Hall] = []
    folder = tmp_path_factory.mktemp("hall")
    with open_house(folder, lambda: clock[0].now_s if clock else 0.0) as house:
        clock.append(Hall(house.app, house.people, house.cookies))
        yield clock[0]


@pytest.fixture(autouse=True)
def later(hall: Hall) -> None:
    """What was wrong in another test is forgotten."""
    hall.now_s += 2 * FORGET_S


def begun(browser: TestClient, password: str = PASSWORD) -> Any:
    """What `begin_passkey` answers."""
    return browser.post(f"{OWN}/challenges", json={"password": password}, headers=ORIGIN)


def added(browser: TestClient, authenticator: Authenticator, **instead: str) -> Any:
    """What `add_passkey` answers."""
    made = authenticator.make(begun(browser).json(), **instead)
    return browser.post(OWN, json={"name": "phone", **made}, headers=ORIGIN)


def origin_of(browser: TestClient) -> dict[str, str]:
    """What a page that the browser shows says of itself."""
    return {"origin": str(browser.base_url).rstrip("/")}


def asked(browser: TestClient) -> dict[str, Any]:
    """What `begin_passkey_sign_in` gives."""
    answer = browser.post(f"{SIGN_IN}/challenges", headers=origin_of(browser))
    assert answer.status_code == 201
    return dict(answer.json())


def proved(browser: TestClient, proof: dict[str, str]) -> Any:
    """What `sign_in_with_passkey` answers to a proof."""
    return browser.post(SIGN_IN, json=proof, headers=origin_of(browser))


def signed_in(
    browser: TestClient,
    authenticator: Authenticator,
    tampered: dict[str, str] | None = None,
    **it: str,
) -> Any:
    """What `sign_in_with_passkey` answers."""
    proof = authenticator.prove(asked(browser), **it)
    return proved(browser, proof | (tampered or {}))


def code(answer: Any) -> tuple[int, str]:
    return answer.status_code, answer.json()["code"]


REFUSED = (401, "wrong_passkey")
OVER = (409, "challenge_over")
BAD = (422, "bad_passkey")


def test_a_passkey_is_added_listed_signs_in_and_is_removed(hall: Hall) -> None:
    number, authenticator, browser = hall.rider()
    [before] = browser.get(OWN).json()["items"]
    stranger = hall.client(base=HERE)
    stranger.cookies.set("spindle_session", "planted-by-somebody-else")

    answer = signed_in(stranger, authenticator)
    [after] = stranger.get(OWN).json()["items"]
    removed = browser.delete(f"{OWN}/{before['id']}", headers=ORIGIN)

    assert (answer.status_code, answer.json()["id"]) == (200, number)
    assert answer.cookies["spindle_session"] != "planted-by-somebody-else"
    words = answer.headers.get_list("set-cookie")[0].lower()
    assert all(word in words for word in ("httponly", "samesite=strict", "path=/"))
    assert stranger.get("/api/v1/session").json()["signed_in"]["person"]["id"] == number
    assert (before["name"], before["rp_id"], before["used_at"]) == ("phone", "localhost", None)
    assert after["used_at"] is not None
    assert removed.status_code == 204
    assert browser.get(OWN).json()["items"] == []
    assert code(signed_in(hall.client(base=HERE), authenticator)) == REFUSED


def test_each_leaves_its_event_and_no_key(hall: Hall) -> None:
    number, authenticator, browser = hall.rider()
    signed_in(hall.client(base=HERE), authenticator)
    [passkey] = browser.get(OWN).json()["items"]
    browser.delete(f"{OWN}/{passkey['id']}", headers=ORIGIN)

    events = hall.events(number)

    told = {"passkey": "phone", "rp_id": "localhost"}
    assert [(one.action, one.before, one.after) for one in events[2:]] == [
        (Action.ACCOUNT_PASSKEY_ADDED, None, json.dumps(told, separators=(",", ":"))),
        (Action.ACCOUNT_SIGNED_IN, None, '{"passkey":"phone"}'),
        (Action.ACCOUNT_PASSKEY_REMOVED, json.dumps(told, separators=(",", ":")), None),
    ]
    assert {one.actor_id for one in events[1:]} == {number}


def test_who_finds_an_open_browser_cannot_leave_a_way_in(hall: Hall) -> None:
    _, browser = hall.person()

    wrong = begun(browser, "wrong wrong")
    for _ in range(4):
        begun(browser, "wrong wrong")
    waits = begun(browser, PASSWORD)

    assert wrong.status_code == 422
    assert wrong.json()["errors"][0] | {"message": ""} == {
        "field": "password",
        "code": "wrong_password",
        "message": "",
    }
    assert code(waits) == (429, "too_many_tries")


def test_a_key_has_no_passkeys(hall: Hall) -> None:
    _, secret = new_key(hall, "see_rides")
    client, key = hall.client(base=HERE), bearer(secret)
    made = {"name": "phone", "client_data": "AA", "attestation": "AA"}

    answers = [
        client.get(OWN, headers=key),
        client.post(f"{OWN}/challenges", json={"password": PASSWORD}, headers=key),
        client.post(OWN, json=made, headers=key),
        client.delete(f"{OWN}/1", headers=key),
    ]

    assert [code(one) for one in answers] == [(403, "needs_session")] * 4


def test_a_challenge_is_for_one_answer(hall: Hall) -> None:
    _, authenticator, browser = hall.rider()
    stranger = hall.client(base=HERE)
    challenge = asked(stranger)
    proof = authenticator.prove(challenge)
    made = Authenticator(HERE).make(begun(browser).json())
    body = {"name": "one", **made}

    first, again = (proved(stranger, proof) for _ in range(2))
    newer = proved(stranger, authenticator.prove(challenge))
    assert (first.status_code, code(again), code(newer)) == (200, OVER, OVER)
    first, again = (browser.post(OWN, json=body, headers=ORIGIN) for _ in range(2))
    assert (first.status_code, code(again)) == (201, OVER)


def test_a_wrong_answer_uses_its_challenge_up(hall: Hall) -> None:
    _, authenticator, _ = hall.rider()
    stranger = hall.client(base=HERE)
    challenge = asked(stranger)
    proof = authenticator.prove(challenge)

    wrong = proved(stranger, proof | {"signature": "AAAA"})

    assert code(wrong) == REFUSED
    assert code(proved(stranger, proof)) == OVER


def test_a_challenge_is_over_after_five_minutes(hall: Hall) -> None:
    _, authenticator, browser = hall.rider()
    stranger = hall.client(base=HERE)
    early, late = (asked(stranger) for _ in range(2))
    to_add = begun(browser).json()
    assert early["valid_s"] == to_add["valid_s"] == VALID_S == 300.0

    hall.now_s += VALID_S - 1.0
    in_time = proved(stranger, authenticator.prove(early))
    hall.now_s += 2.0

    assert in_time.status_code == 200
    assert code(proved(stranger, authenticator.prove(late))) == OVER
    body = {"name": "late", **Authenticator(HERE).make(to_add)}
    assert code(browser.post(OWN, json=body, headers=ORIGIN)) == OVER


def test_a_challenge_adds_in_the_browser_alone_that_it_was_given_to(hall: Hall) -> None:
    _, browser = hall.person()
    _, another = hall.person()
    to_add = begun(browser).json()
    to_sign_in = asked(another)
    body = {"name": "theirs", **Authenticator(HERE).make(to_add)}
    mixed = {"name": "mixed", **Authenticator(HERE).make(to_add | to_sign_in)}

    assert code(another.post(OWN, json=body, headers=ORIGIN)) == OVER
    assert code(another.post(OWN, json=mixed, headers=ORIGIN)) == OVER


@pytest.mark.parametrize("origin", ["http://localhost:1", "https://localhost", "http://evil.org"])
def test_a_page_of_another_origin_gets_nothing_signed(hall: Hall, origin: str) -> None:
    """Its browser tells whose page asked, and an authenticator signs it."""
    _, authenticator, browser = hall.rider()
    authenticator.origin = origin

    assert code(signed_in(hall.client(base=HERE), authenticator)) == REFUSED
    assert code(added(browser, Authenticator(origin))) == BAD


def test_a_passkey_for_another_name_is_none(hall: Hall) -> None:
    _, authenticator, browser = hall.rider()

    lied = signed_in(hall.client(base=HERE), authenticator, rp_id="workshop")
    other = Authenticator("https://workshop")
    made = added(browser, Authenticator(HERE), rp_id="workshop")
    # A passkey of localhost, at the other name of the same server.
    other.key, other.credential_id = authenticator.key, authenticator.credential_id
    other.user_handle = authenticator.user_handle
    elsewhere = signed_in(hall.client(base="https://workshop"), other)

    assert [code(lied), code(made), code(elsewhere)] == [REFUSED, BAD, REFUSED]


def test_each_name_of_the_server_has_passkeys_of_its_own(hall: Hall) -> None:
    name = f"Rita {next(NUMBERS)}"
    hall.people.accounts.add(name, "rider", PASSWORD)
    there, own = "https://workshop", {"origin": "https://workshop"}
    browser = hall.client(base=there)
    browser.post("/api/v1/sign-in", json={"name": name, "password": PASSWORD})
    body = {"password": PASSWORD}
    challenge = browser.post(f"{OWN}/challenges", json=body, headers=own).json()
    authenticator = Authenticator(there)
    made = {"name": "phone", **authenticator.make(challenge)}

    assert browser.post(OWN, json=made, headers=own).json()["rp_id"] == "workshop"
    again = browser.post(f"{OWN}/challenges", json=body, headers=own).json()
    assert len(again["known"]) == 1
    answer = signed_in(hall.client(base=there), authenticator)
    assert answer.headers["set-cookie"].startswith("__Host-spindle_session=")


def test_a_counter_that_goes_back_is_a_copy_of_the_authenticator(hall: Hall) -> None:
    _, authenticator, _ = hall.rider()
    copied = authenticator.copy()
    assert signed_in(hall.client(base=HERE), authenticator).status_code == 200

    same, then_on = (signed_in(hall.client(base=HERE), copied) for _ in range(2))

    assert code(same) == REFUSED
    # Which of the two is the thief's nobody knows: whoever counts on is let in.
    assert then_on.status_code == 200
    assert code(signed_in(hall.client(base=HERE), authenticator)) == REFUSED


def test_an_authenticator_that_does_not_count_is_fine(hall: Hall) -> None:
    """Passkeys that are on several devices of a person do not."""
    _, browser = hall.person()
    authenticator = Authenticator(HERE, count=None)
    added(browser, authenticator)

    answers = [signed_in(hall.client(base=HERE), authenticator) for _ in range(2)]

    assert [one.status_code for one in answers] == [200, 200]


def test_the_person_has_to_be_verified(hall: Hall) -> None:
    _, authenticator, browser = hall.rider()
    authenticator.flags = PRESENT

    assert code(signed_in(hall.client(base=HERE), authenticator)) == REFUSED
    assert code(added(browser, Authenticator(HERE, flags=PRESENT))) == BAD


def test_unknown_forged_and_another_s_get_the_same_answer(hall: Hall) -> None:
    _, authenticator, _ = hall.rider()
    _, another, _ = hall.rider()
    stranger = hall.client(base=HERE)
    handle = {"user_handle": another.user_handle}

    answers = [
        signed_in(stranger, Authenticator(HERE, user_handle=authenticator.user_handle)),
        signed_in(stranger, authenticator, {"signature": "AAAA"}),
        signed_in(stranger, authenticator, {"authenticator_data": "AAAA"}),
        signed_in(stranger, authenticator, handle),
    ]

    assert [code(one) for one in answers] == [REFUSED] * 4
    assert len({one.text for one in answers}) == 1


@pytest.mark.parametrize(
    "junk", ["A", "AAAA", "W1tbW1tb", "bnVsbA", "eyJjaGFsbGVuZ2UiOjF9", "W" * 8000]
)
def test_what_is_no_answer_at_all_is_refused(hall: Hall, junk: str) -> None:
    _, authenticator, browser = hall.rider()
    stranger = hall.client(base=HERE)
    made = Authenticator(HERE).make(begun(browser).json())
    body = {"name": "junk", **made}

    assert code(signed_in(stranger, authenticator, {"client_data": junk})) == OVER
    assert code(browser.post(OWN, json=body | {"client_data": junk}, headers=ORIGIN)) == OVER
    assert code(browser.post(OWN, json=body | {"attestation": junk}, headers=ORIGIN)) == BAD


def test_nobody_removes_another_s(hall: Hall) -> None:
    _, authenticator, browser = hall.rider()
    [passkey] = browser.get(OWN).json()["items"]
    where = f"{OWN}/{passkey['id']}"
    _, another = hall.person("admin")

    assert code(another.delete(where, headers=ORIGIN)) == (404, "not_found")
    assert another.get(OWN).json()["items"] == []
    assert signed_in(hall.client(base=HERE), authenticator).status_code == 200


def test_a_credential_is_one_person_s_and_one_person_has_so_many(hall: Hall) -> None:
    _, authenticator, _ = hall.rider()
    number, browser = hall.person()

    assert code(added(browser, authenticator)) == (409, "passkey_known")
    for turn in range(PASSKEYS_MAX):
        credential = Credential(f"{number}-{turn}", b"", 0)
        hall.people.passkeys._passkeys.add(number, "old", "localhost", credential, 0)
    assert code(added(browser, Authenticator(HERE))) == (409, "passkeys_full")


def test_a_disabled_person_is_out_until_enabled_again(hall: Hall) -> None:
    number, authenticator, _ = hall.rider()
    admin = hall.client("admin", HERE)
    where = f"/api/v1/people/{number}"

    admin.patch(where, json={"enabled": False}, headers=ORIGIN)
    refused = signed_in(hall.client(base=HERE), authenticator)
    admin.patch(where, json={"enabled": True}, headers=ORIGIN)

    assert code(refused) == REFUSED
    assert signed_in(hall.client(base=HERE), authenticator).status_code == 200


def test_another_password_by_an_administrator_removes_the_passkeys(hall: Hall) -> None:
    number, authenticator, _ = hall.rider()
    admin = hall.client("admin", HERE)
    body = {"password": "ein noch längerer Tag"}

    assert admin.patch(f"/api/v1/people/{number}", json=body, headers=ORIGIN).status_code == 200

    assert code(signed_in(hall.client(base=HERE), authenticator)) == REFUSED
    assert [one.action for one in hall.events(number)[-2:]] == [
        Action.ACCOUNT_PASSWORD_SET,
        Action.ACCOUNT_PASSKEY_REMOVED,
    ]


def test_another_password_of_one_s_own_keeps_them(hall: Hall) -> None:
    _, authenticator, browser = hall.rider()
    body = {"old": PASSWORD, "new": "ein noch längerer Tag"}

    assert browser.put("/api/v1/session/password", json=body, headers=ORIGIN).status_code == 204

    assert signed_in(hall.client(base=HERE), authenticator).status_code == 200


def test_they_go_with_the_account(hall: Hall) -> None:
    number, authenticator, _ = hall.rider()
    admin = hall.client("admin", HERE)

    assert admin.delete(f"/api/v1/people/{number}", headers=ORIGIN).status_code == 204

    assert code(signed_in(hall.client(base=HERE), authenticator)) == REFUSED


def test_wrong_passkeys_wait_by_their_address(tmp_path: Path) -> None:
    with open_house(tmp_path, lambda: 0.0) as house:
        stranger = house.client(base=HERE)
        stranger_s = Authenticator(HERE, user_handle="AA")
        wrong = [code(signed_in(stranger, stranger_s)) for _ in range(FREE_BY_ADDRESS)]
        waits = signed_in(stranger, stranger_s)

    assert set(wrong) == {REFUSED}
    assert code(waits) == (429, "too_many_tries")
    assert int(waits.headers["retry-after"]) >= 1


@pytest.mark.parametrize("base", ["http://127.0.0.1", "https://127.0.0.1", "http://workshop"])
def test_where_no_browser_has_passkeys_none_are_offered(hall: Hall, base: str) -> None:
    browser, own = hall.client(base=base), {"origin": base}
    browser.post("/api/v1/sign-in", json={"name": "rider", "password": PASSWORD})
    proof = Authenticator(base, user_handle="AA").prove({"challenge": "AA", "rp_id": "localhost"})

    assert browser.get("/api/v1/session").json()["passkeys"] is False
    assert browser.get(OWN).json() == {"items": []}
    body = {"password": PASSWORD}
    for answer in (
        browser.post(f"{OWN}/challenges", json=body, headers=own),
        browser.post(f"{SIGN_IN}/challenges", headers=own),
        proved(browser, proof),
    ):
        assert code(answer) == (409, "no_passkeys_here")


@pytest.mark.parametrize("base", [HERE, "https://localhost", "https://workshop"])
def test_where_they_work_the_page_learns_it(hall: Hall, base: str) -> None:
    assert hall.client(base=base).get("/api/v1/session").json()["passkeys"] is True


@pytest.mark.parametrize(
    ("host", "encrypted", "party"),
    [
        ("localhost:8750", False, RelyingParty("localhost", "http://localhost:8750")),
        ("shop.localhost", False, RelyingParty("shop.localhost", "http://shop.localhost")),
        ("Bikes.Example.org", True, RelyingParty("bikes.example.org", "https://bikes.example.org")),
        (
            "bikes.example.org:8750",
            True,
            RelyingParty("bikes.example.org", "https://bikes.example.org:8750"),
        ),
        ("bikes.example.org", False, None),
        ("bikes.example.org.", True, None),
        ("localhost.:80", False, None),
        ("192.168.1.4", True, None),
        ("[::1]:8750", True, None),
        ("", True, None),
        ("[", True, None),
    ],
)
def test_a_browser_has_passkeys_for_a_name_on_a_page_that_is_secure(
    host: str, encrypted: bool, party: RelyingParty | None
) -> None:
    assert relying_party(host, encrypted) == party


def test_a_page_of_ours_may_use_them(hall: Hall) -> None:
    policy = hall.client(base=HERE).get("/api/v1/session").headers["permissions-policy"]

    assert "publickey-credentials-create=(self)" in policy
    assert "publickey-credentials-get=(self)" in policy
