"""The one shape of every refusal: application/problem+json (RFC 9457), 422 included."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from http import HTTPStatus
from typing import Any

from fastapi.responses import JSONResponse
from pydantic import BaseModel, Field
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from backend.errors import Outcome

MEDIA_TYPE = "application/problem+json"


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
    told = "websocket.http.response" in scope.get("extensions", {})
    if scope["type"] == "websocket" and not told:
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
