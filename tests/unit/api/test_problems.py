"""Goal: every refusal is one shape (RFC 9457), names what is at fault, and gives nothing away.

The statuses are the contract's: 404, 409, 412, 403, 422, 504.
"""

from __future__ import annotations

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from pydantic import BaseModel

from backend import errors
from backend.tuning.models.config import ConfigPatch
from backend.web import problem as api_errors


class Body(BaseModel):
    rules: list[list[int]]


def app_that_raises(error: Exception) -> TestClient:
    app = FastAPI()
    api_errors.install(app)

    @app.get("/raise")
    async def raise_it() -> None:
        raise error

    @app.post("/body")
    async def body(body: Body) -> None:
        return None

    return TestClient(app, raise_server_exceptions=False)


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (errors.NotFound("There is no ride 7."), 404),
        (errors.NotStandingStill("The wheel turns; stop the bike."), 409),
        (errors.Conflict("Ride 7 is being recorded."), 409),
        (errors.ConfigConflict("Somebody changed it."), 412),
        (errors.AccessDenied("gear_ratio needs factory access."), 403),
        (errors.LimitViolation("Too much."), 422),
        (errors.InvalidRequest("No."), 422),
        (errors.NoAnswer("The unit on /dev/ttyUSB0 is silent."), 504),
        (errors.LinkError("/dev/ttyUSB0 is gone."), 503),
        (errors.PeerProtocolError("The unit sent nonsense."), 502),
        (errors.BadFile("ride.fit breaks off at byte 7."), 422),
        (errors.StoreError("The disk is full."), 500),
    ],
)
def test_each_error_has_the_status_of_the_contract(error: errors.SpindleError, status: int) -> None:
    response = app_that_raises(error).get("/raise")

    assert response.status_code == status
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["status"] == status
    assert response.json()["detail"] == error.message


def test_every_class_of_the_tree_has_a_status() -> None:
    tree = [value for value in vars(errors).values() if isinstance(value, type)]
    ours = [kind for kind in tree if issubclass(kind, errors.SpindleError)]

    assert set(ours) == set(api_errors.STATUS_OF)


def test_every_field_at_fault_is_named() -> None:
    fields = [
        errors.FieldError("mode_ratios[4]", "above_max", "mode_ratios[4] is 9, at most 3."),
        errors.FieldError("fuzzy_gain_points[0]", "not_increasing", "0.3 is not above 0.4."),
    ]
    problem = app_that_raises(errors.LimitViolation("Two values.", fields=fields)).get("/raise")

    assert [item["field"] for item in problem.json()["errors"]] == [
        "mode_ratios[4]",
        "fuzzy_gain_points[0]",
    ]


def test_a_body_of_the_wrong_shape_names_the_cell_and_does_not_echo_it() -> None:
    client = app_that_raises(errors.NotFound(""))

    response = client.post("/body", json={"rules": [[1], ["<script>"]]})

    assert response.status_code == 422
    assert response.json()["errors"][0]["field"] == "rules[1][0]"
    assert "script" not in response.text


def test_a_thousand_wrong_fields_do_not_make_a_huge_answer() -> None:
    client = app_that_raises(errors.NotFound(""))

    response = client.post("/body", json={"rules": [["x"] * 1000]})

    assert len(response.json()["errors"]) == api_errors.FIELD_ERRORS_MAX


def test_an_unknown_route_and_a_wrong_method_are_problems_too() -> None:
    client = app_that_raises(errors.NotFound(""))

    assert client.get("/nowhere").json()["code"] == "not_found"
    assert "/nowhere" in client.get("/nowhere").json()["detail"]
    assert client.delete("/body").json()["code"] == "method_not_allowed"


def test_text_that_is_not_json_is_a_problem() -> None:
    client = app_that_raises(errors.NotFound(""))

    response = client.post("/body", content=b"{", headers={"content-type": "application/json"})

    assert response.status_code == 400
    assert response.json()["code"] == "not_json"
    assert response.json()["errors"][0]["field"] == "body"


def test_json_of_another_shape_is_another_refusal_than_no_json() -> None:
    client = app_that_raises(errors.NotFound(""))

    assert client.post("/body", json=[1]).status_code == 422
    assert client.post("/body", content=b"{}").status_code == 422


def test_a_bug_of_ours_is_a_problem_without_its_insides() -> None:
    response = app_that_raises(RuntimeError("secret path")).get("/raise")

    assert response.status_code == 500
    assert response.headers["content-type"] == "application/problem+json"
    assert "secret" not in response.text


@pytest.mark.parametrize(
    "content",
    [b"[" * 200_000, b'{"rules":' * 100_000, b'{"rules": ' + b"9" * 6000 + b"}", b"\xff\xfe{"],
    ids=["deep list", "deep object", "endless number", "no text"],
)
def test_a_body_made_to_break_the_reader_is_a_problem(content: bytes) -> None:
    client = app_that_raises(errors.NotFound(""))

    response = client.post("/body", content=content, headers={"content-type": "application/json"})

    assert (response.status_code, response.json()["code"]) == (400, "not_json")
    assert response.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize("value", ["true", "[true, true]", "{}"])
def test_a_value_of_no_kind_is_refused_once_and_by_its_own_name(value: str) -> None:
    app = FastAPI()
    api_errors.install(app)

    @app.patch("/config")
    async def patch(body: ConfigPatch) -> None:
        """Takes what the configuration takes."""

    body = f'{{"parameters": {{"fuzzy_gain_points": {value}}}}}'
    json_type = {"content-type": "application/json"}
    response = TestClient(app).patch("/config", content=body, headers=json_type)

    assert response.status_code == 422
    named = {error["field"] for error in response.json()["errors"]}
    assert {field.split("[")[0] for field in named} == {"parameters.fuzzy_gain_points"}
    assert not any(kind in field for field in named for kind in (".int", ".float", ".str", ".list"))
