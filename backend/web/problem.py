"""Refusals as application/problem+json (RFC 9457): their one shape, and the error tree as HTTP."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Mapping
from http import HTTPStatus
from math import ceil
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel, Field
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from backend import errors
from backend.errors import Outcome

MEDIA_TYPE = "application/problem+json"
# nginx's word for it, in logs alone.
CLIENT_GONE = 499


class FieldProblem(BaseModel):
    """One field at fault."""

    field: str
    code: str
    message: str


class TokenChallenge(BaseModel):
    """What a maker signs with `spindle unlock sign`; bytes in hex."""

    uid: str
    nonce: str
    level: str
    ttl_s: int
    expires_us: int = Field(description="Of the unit's clock.")
    image: str = Field(description="The whole configuration that is to become active.")
    image_sha512: str = Field(description="What of the image goes under the signature.")


class Problem(BaseModel):
    """Why a request was refused, what is at fault, and what to do about it."""

    type: str = Field(
        description="Stable name of the kind of problem: `urn:spindle:` and the code."
    )
    title: str
    status: int
    detail: str
    code: str
    errors: list[FieldProblem]
    challenge: TokenChallenge | None = Field(
        default=None, description="Only with the code `token_needed`."
    )
    outcome: Outcome | None = Field(
        default=None,
        description="With 504 of a change: whether the unit has it, as far as could be found out.",
    )


def problem_response(
    status: int,
    code: str,
    detail: str,
    errors: Iterable[FieldProblem] = (),
    headers: dict[str, str] | None = None,
    challenge: Mapping[str, str | int] | None = None,
    outcome: Outcome | None = None,
) -> JSONResponse:
    """The response for one refusal. code: lower-case word for programs; detail: for people."""
    problem = Problem(
        type=f"urn:spindle:{code}",
        title=HTTPStatus(status).phrase,
        status=status,
        detail=detail,
        code=code,
        errors=list(errors),
        challenge=None if challenge is None else TokenChallenge.model_validate(challenge),
        outcome=outcome,
    )
    return JSONResponse(
        problem.model_dump(exclude_none=True), status, headers=headers, media_type=MEDIA_TYPE
    )


async def refuse(refusal: Response, scope: Scope, receive: Receive, send: Send) -> None:
    """Answers a request or a WebSocket's handshake; a server that cannot tell the second why only
    closes it."""
    can_answer = "websocket.http.response" in scope.get("extensions", {})
    if scope["type"] == "websocket" and not can_answer:
        await send({"type": "websocket.close", "code": 1008})
    else:
        await refusal(scope, receive, send)


def refusals(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """The `responses=` of a route: each status described by the same Problem model.

    422 is always in it, because every route can be asked wrongly, and FastAPI would otherwise
    describe its own shape for it.
    """
    return refusals_only(422, *statuses)


def refusals_only(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """The same for a route that takes nothing and so cannot be asked wrongly."""
    schema = {"$ref": "#/components/schemas/Problem"}
    return {
        status: {
            "description": HTTPStatus(status).phrase,
            "content": {MEDIA_TYPE: {"schema": schema}},
        }
        for status in sorted(set(statuses))
    }


# Whatever is made of a ride's samples is refused, whole, when they are not what was written.
DAMAGED: dict[int | str, dict[str, Any]] = {
    500: refusals(500)[500] | {"description": "`object_damaged`: the ride's file is not as written"}
}


LOG = logging.getLogger(__name__)

# The most exact class wins; a class that is absent has the status of its nearest ancestor.
STATUS_OF: dict[type[errors.SpindleError], int] = {
    errors.SpindleError: 500,
    errors.LinkError: 503,
    errors.NoAnswer: 504,
    errors.PeerProtocolError: 502,
    errors.OurProtocolError: 500,
    errors.DeviceRefused: 409,
    errors.RequestRefused: 409,
    errors.InvalidRequest: 422,
    errors.LimitViolation: 422,
    errors.ConfigConflict: 412,
    errors.OtherUnit: 412,
    errors.AccessDenied: 403,
    errors.TokenNeeded: 403,
    errors.NotSignedIn: 401,
    errors.NotAllowed: 403,
    errors.TooManyTries: 429,
    errors.NotStandingStill: 409,
    errors.CapabilityMissing: 409,
    errors.NameFirst: 409,
    errors.Conflict: 409,
    errors.NotFound: 404,
    errors.BadFile: 422,
    errors.StoreError: 500,
    errors.ObjectsAway: 503,
    errors.StoreFull: 507,
    errors.ObjectDamaged: 500,
}
# What the validator puts into a location for each kind of value it tries.
KINDS = frozenset({"int", "float", "str", "bool"})
KIND_STARTS = ("list[", "constrained-", "function-")
CODE_OF_STATUS = {
    404: "not_found",
    405: "method_not_allowed",
    413: "too_large",
    415: "unsupported_media_type",
}
# What the framework says of a body that makes its JSON reader fail in any way but a syntax error.
UNREADABLE_BODY = "There was an error parsing the body"
# What an error list may hold: a table of 25 rules with every cell wrong still fits, and a hostile
# body with a million bad fields does not become a response of that size.
FIELD_ERRORS_MAX = 100


def status_of(error: errors.SpindleError) -> int:
    """The HTTP status of an error of the tree."""
    return next(STATUS_OF[kind] for kind in type(error).__mro__ if kind in STATUS_OF)


def spindle_problem(_: Request | None, error: Exception) -> JSONResponse:
    """An error of our tree, with every field at fault."""
    assert isinstance(error, errors.SpindleError)
    status = status_of(error)
    if status >= HTTPStatus.INTERNAL_SERVER_ERROR:
        LOG.warning("%s: %s", type(error).__name__, error.message)
    fields = [FieldProblem(field=f.field, code=f.code, message=f.message) for f in error.fields]
    challenge = error.challenge if isinstance(error, errors.TokenNeeded) else None
    outcome = error.outcome if isinstance(error, errors.NoAnswer) else None
    return problem_response(
        status,
        error.code,
        error.message,
        fields[:FIELD_ERRORS_MAX],
        headers_of(error),
        challenge=challenge,
        outcome=outcome,
    )


def headers_of(error: errors.SpindleError) -> dict[str, str] | None:
    """What HTTP has a header for: RFC 9110, 11.6.1 and 10.2.3."""
    if isinstance(error, errors.NotSignedIn):
        return {"www-authenticate": "Bearer"}
    if isinstance(error, errors.TooManyTries):
        return {"retry-after": str(ceil(error.wait_s))}
    return None


def validation_problem(_: Request, error: Exception) -> JSONResponse:
    """A request that does not have the declared shape. Values are not echoed."""
    assert isinstance(error, RequestValidationError)
    if any(item["type"] == "json_invalid" for item in error.errors()):
        return not_json_problem()
    named: dict[str, FieldProblem] = {}
    for item in error.errors():
        field = field_path(tuple(part for part in item["loc"] if not is_kind(part)))
        # The kinds a value may have fail one by one; a person asked for one value.
        named[field] = (
            FieldProblem(field=field, code="not_accepted", message="is no value this can have")
            if field in named
            else FieldProblem(field=field, code=item["type"], message=item["msg"])
        )
    faults = list(named.values())
    fields = faults[:FIELD_ERRORS_MAX]
    detail = "; ".join(f"{field.field}: {field.message}" for field in fields[:3])
    more = f" and {len(faults) - 3} more" if len(faults) > 3 else ""
    return problem_response(422, "invalid", f"{detail}{more}", fields)


def not_json_problem() -> JSONResponse:
    """A body that is not JSON, or more than a reader of JSON takes; of another shape is a 422."""
    message = "The body is not JSON that can be read."
    return problem_response(
        400, "not_json", message, [FieldProblem(field="body", code="not_json", message=message)]
    )


def is_kind(part: int | str) -> bool:
    """Whether a part of a location is not a field but a kind that a value was tried as."""
    return isinstance(part, str) and (part in KINDS or part.startswith(KIND_STARTS))


def field_path(location: tuple[int | str, ...]) -> str:
    """`("body", "rules", 2, 0)` as a person writes it: `rules[2][0]`."""
    if len(location) < 2 or (location[0] == "body" and isinstance(location[1], int)):
        # The body as a whole; a number after it is where its JSON breaks off.
        return str(location[0]) if location else ""
    parts = location[1:]
    path = ""
    for part in parts:
        path += f"[{part}]" if isinstance(part, int) else f".{part}" if path else part
    return path


def http_problem(request: Request, error: Exception) -> JSONResponse:
    """What the framework refuses itself: unknown routes, wrong methods, unreadable bodies."""
    assert isinstance(error, HTTPException)
    status = error.status_code
    if status == HTTPStatus.BAD_REQUEST and error.detail == UNREADABLE_BODY:
        return not_json_problem()
    code = CODE_OF_STATUS.get(status, HTTPStatus(status).name.lower())
    detail = str(error.detail)
    if status == HTTPStatus.NOT_FOUND and detail == HTTPStatus.NOT_FOUND.phrase:
        detail = f"There is nothing at {request.url.path}; /api/docs lists what there is."
    return problem_response(status, code, detail, headers=dict(error.headers or {}))


def left_before_the_end(_: Request, __: Exception) -> Response:
    """The other end is gone; nobody reads this, and nothing went wrong here."""
    return Response(status_code=CLIENT_GONE)


def unexpected_problem(_: Request, __: Exception) -> JSONResponse:
    """A bug of ours. uvicorn logs the trace; the answer does not give the insides away."""
    detail = "Something unexpected went wrong in the server; its log has the details."
    return problem_response(500, "internal", detail)


def install(app: FastAPI) -> None:
    """Makes every error of the application a problem+json response."""
    app.add_exception_handler(errors.SpindleError, spindle_problem)
    app.add_exception_handler(RequestValidationError, validation_problem)
    app.add_exception_handler(HTTPException, http_problem)
    app.add_exception_handler(ClientDisconnect, left_before_the_end)
    app.add_exception_handler(Exception, unexpected_problem)
