"""Goal: nobody asks for what their role or key does not allow, and no operation was forgotten.

Method: the application's description and its WebSockets give every route there is; each is asked
by a stranger, by every role, by a key and by a forged cookie. What a role may, `EXPECTED` says
again in another way than the table: by the first of the four roles that may. Behind the
application are accounts on SQLite and nothing else: who is let through meets a missing service.
"""

from __future__ import annotations

import functools
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, cast

import pytest
from fastapi.testclient import TestClient
from starlette.testclient import WebSocketDenialResponse

from backend.app import NEEDED, STRANGERS, build_api
from backend.people.service import PeopleService
from backend.services import Services
from backend.store import open_store
from backend.web.app import WebSettings
from backend.web.permissions import Anyone
from tests.fakes.api import description
from tests.fakes.house import ORDER, ORIGIN, PASSWORD, House, bearer, new_key, open_house

# Not described, because no program asks for them by its description.
BESIDE = {"get_not_built", "get_docs", "get_description", "live"}
# The first of rider, dealer, engineer, admin who may; everything else a dealer may.
ADMIN = {"get_backup", "list_people", "add_person", "change_person", "remove_person"}
ENGINEER = {"put_simulation", "advance_simulation"}
RIDER = {"compute_surface", "compute_points", "compute_torque_surface", "compute_mode_curves"}
RIDER |= {"lint_table", "why_steady", "evaluate_calibration", "read_fis", "list_scenarios"}
RIDER |= {"list_passkeys", "begin_passkey", "add_passkey", "remove_passkey"}
RIDER |= {"sign_out", "change_own_password", "give_ticket", "list_keys", "add_key", "revoke_key"}
# Of bikes, rides and files that are theirs; a bike is handed over by its owner.
RIDER |= {"list_bikes", "get_bike", "change_bike", "pair_bike", "leave_bike", "take_pairing"}
RIDER |= {"list_visits", "get_visit", "get_visit_photo", "get_bike_history", "consent_to_visit"}
RIDER |= {"list_rides", "rider_home", "export_rides", "tag_rides", "delete_rides", "sample_ride"}
RIDER |= {"get_ride", "get_ride_series", "get_ride_track", "get_ride_figure", "export_ride"}
RIDER |= {"energy_of_ride", "effort_of_ride", "pedalling_of_ride", "diagnosis_of_ride"}
RIDER |= {"report_of_ride", "replay_ride", "ride_again", "why_of_ride", "cuts_of_ride"}
RIDER |= {"ledger_of_ride", "patch_ride", "delete_ride"}
RIDER |= {"get_addresses", "compare_rides", "compare_ride_series", "compare_ride_crank"}
RIDER |= {"list_uploads", "import_ride", "describe_uploads", "create_upload", "append_upload"}
RIDER |= {"get_upload", "get_upload_offset", "delete_upload", "get_mapping", "put_mapping"}
STRANGER = {"get_healthz", "get_readyz", "get_session", "sign_in", "make_first_person"}
STRANGER |= {"get_pairing", "join_by_pairing"}
STRANGER |= {"begin_passkey_sign_in", "sign_in_with_passkey"}
# The codes of those who are refused for who they are.
CLOSED = {"sign_in_first", "not_allowed", "not_in_the_table"}


@functools.cache
def operations() -> dict[str, tuple[str, str]]:
    """Method and path of every operation that is described, by its id."""
    return {
        operation["operationId"]: (method.upper(), path)
        for path, methods in description()["paths"].items()
        for method, operation in methods.items()
    }


def first_who_may(operation: str) -> str:
    for names, who in ((STRANGER, "stranger"), (RIDER, "rider"), (ENGINEER, "engineer")):
        if operation in names:
            return who
    return "admin" if operation in ADMIN else "dealer"


def asked(client: TestClient, operation: str, **request: Any) -> Any:
    """A request for an operation. Its numbers are of nothing; its body is refused later."""
    method, path = operations()[operation]
    where = re.sub(r"{[^}]*}", "999", path)
    answer = client.request(method, where, headers=ORIGIN, **request)
    content = answer.content and "problem" in answer.headers.get("content-type", "")
    return answer.status_code, answer.json()["code"] if content else None


def test_every_operation_is_in_the_table_and_the_table_has_no_other() -> None:
    assert set(NEEDED) == set(operations()) | BESIDE


def test_what_a_stranger_may_is_the_same_at_the_door_and_in_the_table() -> None:
    described = {route for name, route in operations().items() if NEEDED[name] is Anyone.STRANGER}

    assert described == STRANGERS


def test_the_matrix_of_routes_and_roles(house: House) -> None:
    clients = [house.client(), *(house.client(role) for role in ORDER)]
    lines, wrong = [], []
    for operation in sorted(operations()):
        # Signing out would end what the rest of this test needs.
        if operation in ("sign_out", "change_own_password"):
            continue
        first = ["stranger", *ORDER].index(first_who_may(operation))
        row = [asked(client, operation) for client in clients]
        # What answers a HEAD has no body, and so no code.
        let_in = [
            code not in CLOSED and (status, code) not in ((401, None), (403, None))
            for status, code in row
        ]
        lines.append(f"{operation:34}" + "".join(f"{'yes' if one else '-':>10}" for one in let_in))
        if let_in != [number >= first for number in range(5)] or (first and row[0][0] != 401):
            wrong.append((operation, row))
    # Shown by `pytest -s`, and where the test fails.
    sys.stdout.write(f"{'':34}" + "".join(f"{who:>10}" for who in ["stranger", *ORDER]))
    sys.stdout.write("\n" + "\n".join(lines) + "\n")

    assert wrong == []


@pytest.mark.parametrize("path", ["/api/v1/nothing", "/metrics", "/api/docs", "/api"])
def test_a_stranger_learns_not_even_what_is_there(house: House, path: str) -> None:
    answer = house.client().get(path)

    assert answer.status_code == 401
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.headers["www-authenticate"] == "Bearer"


def test_the_description_is_for_whoever_signed_in(house: House) -> None:
    told = house.client("rider").get("/api/v1/openapi.json")

    assert told.status_code == 200
    assert told.json()["paths"].keys() == description()["paths"].keys()


def test_an_operation_that_nobody_listed_is_refused_even_where_nobody_signs_in() -> None:
    app = build_api(WebSettings("test"))

    @app.get("/api/v1/new", operation_id="brand_new")
    async def new() -> None:
        return None

    # The pages, which take every path that is left, came before it.
    app.router.routes.insert(0, app.router.routes.pop())
    answer = TestClient(app, base_url="http://127.0.0.1").get("/api/v1/new")

    assert answer.status_code == 403
    assert answer.json()["code"] == "not_in_the_table"


def test_a_body_of_a_stranger_is_not_even_read(house: House) -> None:
    def body() -> Iterator[bytes]:
        yield b"x"
        raise AssertionError("The body was read.")

    answer = house.client().post("/api/v1/uploads", content=body())

    assert answer.status_code == 401


@pytest.mark.parametrize("cookie", ["", "x", "A" * 43, "' OR 1=1 --"])
def test_a_forged_cookie_is_nobody_s(house: House, cookie: str) -> None:
    client = house.client()
    client.cookies.set("spindle_session", cookie)

    assert client.get("/api/v1/rides").status_code == 401


def test_a_change_by_cookie_says_which_page_it_comes_from(admin: TestClient) -> None:
    body = {"name": "Eve", "role": "rider", "password": PASSWORD}

    bare = admin.post("/api/v1/people", json=body)
    foreign = admin.post("/api/v1/people", json=body, headers={"origin": "http://evil.example"})
    site = admin.post("/api/v1/people", json=body, headers={"sec-fetch-site": "cross-site"})

    assert [bare.json()["code"], foreign.json()["code"], site.json()["code"]] == [
        "no_origin",
        "foreign_origin",
        "no_origin",
    ]
    assert "Eve" not in admin.get("/api/v1/people").text


def test_signing_in_gives_a_new_token_whatever_the_browser_came_with(house: House) -> None:
    client = house.client()
    client.cookies.set("spindle_session", "planted-by-somebody-else")

    answer = client.post("/api/v1/sign-in", json={"name": "rider", "password": PASSWORD})
    token = answer.cookies["spindle_session"]

    assert token != "planted-by-somebody-else"
    assert len(token) >= 43  # 256 bits
    said = [one.lower() for one in answer.headers.get_list("set-cookie")]
    assert all(word in said[0] for word in ("httponly", "samesite=strict", "path=/"))
    # The other one is for the page, and opens nothing.
    assert token not in said[1]


def test_with_tls_the_cookie_is_for_this_host_alone(house: House) -> None:
    client = house.client(base="https://workshop")
    answer = client.post("/api/v1/sign-in", json={"name": "rider", "password": PASSWORD})
    said = answer.headers.get_list("set-cookie")[0]

    assert said.startswith("__Host-spindle_session=")
    assert "; Secure" in said
    assert "Domain" not in said
    # A plain connection cannot plant what an encrypted one believes.
    planted = house.client(base="https://workshop")
    planted.cookies.set("spindle_session", house.cookies["admin"])
    assert planted.get("/api/v1/people").status_code == 401


def test_who_signed_out_is_out_everywhere_they_said(house: House) -> None:
    here, there = house.client(), house.client()
    for one in (here, there):
        one.post("/api/v1/sign-in", json={"name": "engineer", "password": PASSWORD})
    token = here.cookies["spindle_session"]
    assert here.delete("/api/v1/session", headers=ORIGIN).status_code == 204
    assert "spindle_session" not in here.cookies
    here.cookies.set("spindle_session", token)
    assert here.get("/api/v1/session").json()["signed_in"] is None
    assert there.get("/api/v1/session").json()["signed_in"]["person"]["name"] == "engineer"

    there.delete("/api/v1/session?everywhere=true", headers=ORIGIN)

    assert there.get("/api/v1/session").json()["signed_in"] is None
    # For the tests after this one.
    house.cookies["engineer"], _ = house.people.sign_in.sign_in("engineer", PASSWORD, "here")


def test_another_password_signs_out_every_other_browser(house: House) -> None:
    house.people.accounts.add("Greta", "dealer", PASSWORD)
    here, there = house.client(), house.client()
    for one in (here, there):
        one.post("/api/v1/sign-in", json={"name": "Greta", "password": PASSWORD})
    body = {"old": PASSWORD, "new": "ein noch längerer Tag"}

    assert here.put("/api/v1/session/password", json=body, headers=ORIGIN).status_code == 204

    assert here.get("/api/v1/session").json()["signed_in"] is not None
    assert there.get("/api/v1/session").json()["signed_in"] is None


def test_a_name_that_exists_and_one_that_does_not_get_the_same_answer(house: House) -> None:
    client = house.client()
    answers = [
        client.post("/api/v1/sign-in", json={"name": name, "password": "wrong wrong"})
        for name in ("dealer", "nobody at all")
    ]

    assert answers[0].json() == answers[1].json()
    assert [one.status_code for one in answers] == [401, 401]


def test_wrong_passwords_wait_and_are_told_how_long(tmp_path: Path) -> None:
    body = {"name": "Mallory's guess", "password": "wrong wrong"}
    with open_house(tmp_path, now_s=lambda: 0.0) as house:
        client = house.client()
        statuses = [client.post("/api/v1/sign-in", json=body).status_code for _ in range(5)]
        refused = client.post("/api/v1/sign-in", json=body)

    assert statuses == [401] * 5
    assert (refused.status_code, refused.json()["code"]) == (429, "too_many_tries")
    assert int(refused.headers["retry-after"]) >= 1


def test_the_first_administrator_comes_by_a_link_that_works_once(tmp_path: Path) -> None:
    with open_store(f"sqlite:///{tmp_path}/s.db", (tmp_path / "o").as_uri()) as store:
        people = PeopleService(store.database)
        client = TestClient(
            build_api(WebSettings("test"), cast(Services, None), people),
            base_url="http://127.0.0.1",
        )
        earlier = people.accounts.first_token()
        token = people.accounts.first_token()
        body = {"name": "Anna", "password": PASSWORD}

        old = client.post("/api/v1/first-person", json={**body, "token": earlier})
        weak = {"name": "Anna", "password": "12345678", "token": token}
        short = client.post("/api/v1/first-person", json=weak)
        made = client.post("/api/v1/first-person", json={**body, "token": token})
        twice = client.post("/api/v1/first-person", json={**body, "name": "M", "token": token})

        assert [old.status_code, short.status_code] == [403, 422]
        assert (made.status_code, made.json()["role"]) == (201, "admin")
        assert twice.status_code == 403
        assert client.get("/api/v1/session").json()["signed_in"]["person"]["name"] == "Anna"
        assert people.accounts.first_token() is None


def opens(client: TestClient, path: str, **headers: str) -> bool:
    """Whether a WebSocket gets as far as its route, which has no service behind it here."""
    try:
        with client.websocket_connect(f"ws://127.0.0.1{path}", headers=headers):
            return True
    except WebSocketDenialResponse as refused:
        return refused.status_code not in (401, 403)
    except AttributeError:
        return True


def test_a_ticket_opens_one_socket(house: House, admin: TestClient) -> None:
    live = "/api/v1/devices/999/live"
    _, secret = new_key(house, "see_bikes")
    client = house.client()
    give = client.post("/api/v1/tickets", headers=bearer(secret))
    ticket = give.json()["ticket"]

    assert not opens(client, live)
    assert opens(client, f"{live}?ticket={ticket}")
    assert not opens(client, f"{live}?ticket={ticket}")
    assert opens(client, live, authorization=f"Bearer {secret}")
    assert opens(admin, live, **ORIGIN)
    assert not opens(admin, live)
    assert not opens(house.client("rider"), live, **ORIGIN)


def test_a_ticket_is_over_after_half_a_minute(house: House) -> None:
    from backend.people.tokens import VALID_S, Tickets

    now_s = 100.0
    tickets = Tickets(lambda: now_s)
    caller = house.people.sign_in.of_token(house.cookies["dealer"])
    assert caller is not None
    early, late = tickets.give(caller), tickets.give(caller)
    now_s += VALID_S - 0.1
    assert tickets.take(early) is not None
    now_s += 0.2
    assert tickets.take(late) is None


@pytest.mark.parametrize("how", ["revoked", "disabled", "lower role"])
def test_a_ticket_opens_nothing_once_its_key_does_not(
    house: House, admin: TestClient, how: str
) -> None:
    person = house.people.accounts.add(how, "dealer", PASSWORD)
    client = house.client()
    client.post("/api/v1/sign-in", json={"name": how, "password": PASSWORD})
    made = client.post("/api/v1/keys", json={"name": "w", "scopes": ["see_bikes"]}, headers=ORIGIN)
    give = client.post("/api/v1/tickets", headers=bearer(made.json()["secret"]))
    if how == "revoked":
        admin.delete(f"/api/v1/keys/{made.json()['key']['id']}", headers=ORIGIN)
    else:
        change = {"enabled": False} if how == "disabled" else {"role": "rider"}
        admin.patch(f"/api/v1/people/{person.id}", json=change, headers=ORIGIN)

    assert not opens(client, f"/api/v1/devices/999/live?ticket={give.json()['ticket']}")
