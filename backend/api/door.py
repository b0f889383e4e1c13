"""Who is at the door: finds out who asks before any body is read, and lets nobody else further in.

    Authorization: Bearer sp_...   a program with a key
    Cookie                         a browser that signed in
    ?ticket=                       a WebSocket of a program; a ticket opens one

Without any of them there are only the pages, which hold nothing of anybody, and the few operations
a stranger needs. Which of the rest a caller may ask for, `permissions` says.
"""

from __future__ import annotations

from starlette.concurrency import run_in_threadpool
from starlette.datastructures import QueryParams
from starlette.requests import HTTPConnection
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from backend.api.errors import spindle_problem
from backend.api.pages import NO_PAGES
from backend.api.permissions import SIGN_IN_FIRST
from backend.api.problem import problem_response, refuse
from backend.api.session_cookie import token_in
from backend.domain.people.person import Caller
from backend.errors import NotSignedIn, SpindleError
from backend.services.people.people import People

# What the table of `permissions` calls a stranger's, by its path; a test compares them.
STRANGERS = frozenset(
    {
        ("GET", "/healthz"),
        ("GET", "/readyz"),
        ("GET", "/api/v1/session"),
        ("POST", "/api/v1/sign-in"),
        ("POST", "/api/v1/first-person"),
    }
)
SAFE = frozenset({"GET", "HEAD", "OPTIONS"})
BEARER = "bearer "
BAD_KEY = "This key is not known here, is over, or was revoked: an administrator makes a new one."


class Door:
    """Puts the caller into the scope, and refuses with 401 who has none and needs one."""

    def __init__(self, app: ASGIApp, people: People) -> None:
        self.app = app
        self.people = people

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket") or is_page(scope["path"]):
            await self.app(scope, receive, send)
            return
        refusal: Response | None
        try:
            # It asks the database.
            caller = await run_in_threadpool(self._caller, HTTPConnection(scope))
            refusal = refusal_of(scope, caller)
        except SpindleError as error:
            refusal = spindle_problem(None, error)
        else:
            scope.setdefault("state", {})["caller"] = caller
        if refusal is None:
            await self.app(scope, receive, send)
        else:
            await refuse(refusal, scope, receive, send)

    def _caller(self, connection: HTTPConnection) -> Caller | None:
        given = connection.headers.get("authorization", "")
        if given[: len(BEARER)].lower() == BEARER:
            # A wrong key is not made good by a cookie.
            return self.people.keys.caller(given[len(BEARER) :].strip())
        ticket = QueryParams(connection.scope["query_string"]).get("ticket")
        if ticket is not None and connection.scope["type"] == "websocket":
            return self.people.tickets.take(ticket)
        token = token_in(connection)
        return None if token is None else self.people.sign_in.of_token(token)


def is_page(path: str) -> bool:
    """Whether a path is one of the browser's files, which everybody may have."""
    first = path.lstrip("/").split("/", 1)[0]
    return first not in NO_PAGES


def refusal_of(scope: Scope, caller: Caller | None) -> Response | None:
    """Why a request goes no further; None if it does."""
    method = scope.get("method", "GET")
    if caller is None:
        if (method, scope["path"]) in STRANGERS:
            return None
        with_key = "authorization" in HTTPConnection(scope).headers
        return spindle_problem(None, NotSignedIn(BAD_KEY if with_key else SIGN_IN_FIRST))
    # A cookie comes with whatever makes a browser ask; that it was a page of ours shows here. That
    # an Origin is ours was looked at before.
    is_unsafe = method not in SAFE or scope["type"] == "websocket"
    if caller.by_cookie and is_unsafe and not from_our_page(scope):
        return problem_response(
            403,
            "no_origin",
            "A change with a cookie must say which page it comes from (Origin); a program sends a "
            "key instead.",
        )
    return None


def from_our_page(scope: Scope) -> bool:
    """Whether a browser says that a page of this server asks."""
    headers = HTTPConnection(scope).headers
    return "origin" in headers or headers.get("sec-fetch-site") == "same-origin"
