"""Who sends a request: found out before any body is read; nobody else gets further in.

    Authorization: Bearer sp_...   a program with a key
    Cookie                         a browser that signed in
    ?ticket=                       a WebSocket of a program; a ticket opens one

Without any of them there are only the pages, which hold nothing of anybody, and the few operations
a stranger needs. Which of the rest a caller may request, `permissions` says.
"""

from __future__ import annotations

import re
from typing import Annotated, Protocol
from urllib.parse import unquote

from fastapi import Depends, Header, Request
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import QueryParams
from starlette.requests import HTTPConnection
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from backend.core.actor import Actor, acting, actor_of_caller
from backend.core.author import AUTHOR_MAX, SignedInName, tidy_author
from backend.core.person import Caller
from backend.errors import NotSignedIn, SpindleError
from backend.web.pages import NO_PAGES
from backend.web.permissions import SIGN_IN_FIRST, caller_of
from backend.web.problem import problem_response, refuse, spindle_problem
from backend.web.session_cookie import token_in

SAFE = frozenset({"GET", "HEAD", "OPTIONS"})
BEARER = "bearer "
BAD_KEY = "This key is not known here, is over, or was revoked: an administrator makes a new one."


class Authenticator(Protocol):
    """Knows who is behind a proof; None where it is none, or is over. Each raises StoreError."""

    def of_key(self, key: str) -> Caller | None: ...
    def of_ticket(self, ticket: str) -> Caller | None: ...
    def of_session(self, token: str) -> Caller | None: ...
    def renewed(self, caller: Caller) -> Caller | None: ...


class AuthMiddleware:
    """Puts the caller into the scope, and refuses with 401 who has none and needs one.

    strangers: method and path of what needs no account, `{code}` in it for one piece of a path.
    """

    def __init__(
        self, app: ASGIApp, authenticator: Authenticator, strangers: frozenset[tuple[str, str]]
    ) -> None:
        self.app = app
        self.authenticator = authenticator
        forms = (f"{method} {re.sub('{[a-z]+}', '[^/]+', path)}" for method, path in strangers)
        self._strangers = re.compile("|".join(sorted(forms)))

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket") or is_page(scope["path"]):
            await self.app(scope, receive, send)
            return
        refusal: Response | None
        try:
            # It asks the database.
            caller = await run_in_threadpool(self._caller, HTTPConnection(scope))
            refusal = self._refusal(scope, caller)
        except SpindleError as error:
            refusal = spindle_problem(None, error)
        else:
            scope.setdefault("state", {})["caller"] = caller
        if refusal is None:
            await self.app(scope, receive, send)
        else:
            await refuse(refusal, scope, receive, send)

    def _refusal(self, scope: Scope, caller: Caller | None) -> Response | None:
        """Why a request goes no further; None if it does."""
        if caller is not None:
            return refusal_of_caller(scope, caller)
        if self._strangers.fullmatch(f"{scope.get('method', 'GET')} {scope['path']}"):
            return None
        with_key = "authorization" in HTTPConnection(scope).headers
        return spindle_problem(None, NotSignedIn(BAD_KEY if with_key else SIGN_IN_FIRST))

    def _caller(self, connection: HTTPConnection) -> Caller | None:
        header = connection.headers.get("authorization", "")
        if header[: len(BEARER)].lower() == BEARER:
            # A wrong key is not made good by a cookie.
            return self.authenticator.of_key(header[len(BEARER) :].strip())
        ticket = QueryParams(connection.scope["query_string"]).get("ticket")
        if ticket is not None and connection.scope["type"] == "websocket":
            return self.authenticator.of_ticket(ticket)
        token = token_in(connection)
        return None if token is None else self.authenticator.of_session(token)


class ActorMiddleware:
    """Says who acts in a request, to whatever writes. author: as of `WebSettings`."""

    def __init__(self, app: ASGIApp, author: str, signs_in: bool) -> None:
        self.app = app
        self.author = author
        self.signs_in = signs_in

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        with acting(self._actor(scope)):
            await self.app(scope, receive, send)

    def _actor(self, scope: Scope) -> Actor:
        caller: Caller | None = scope.get("state", {}).get("caller")
        if caller is not None:
            return actor_of_caller(caller)
        if self.signs_in:
            # A stranger is nobody until they are let in.
            return Actor("person", "")
        named = HTTPConnection(scope).headers.get("spindle-author", "")
        return Actor("person", tidy_author(unquote(named)) or self.author)


def is_page(path: str) -> bool:
    """Whether a path is one of the browser's files, which everybody may have."""
    first = path.lstrip("/").split("/", 1)[0]
    return first not in NO_PAGES


def refusal_of_caller(scope: Scope, caller: Caller) -> Response | None:
    """Why a request of somebody known goes no further; None if it does."""
    method = scope.get("method", "GET")
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


def author_of(
    request: Request,
    spindle_author: Annotated[
        str | None,
        Header(
            description="Whose change this is, percent-encoded UTF-8; without it that of the "
            "server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key "
            "is the author, whatever this says.",
            max_length=12 * AUTHOR_MAX,
        ),
    ] = None,
) -> str:
    """The author of a change: who signed in, else whom the request names, else the name the server
    was started with; empty where unknown."""
    caller = caller_of(request)
    if caller is not None:
        return SignedInName(caller.person.name)
    named = tidy_author(unquote(spindle_author or ""))
    return named or str(request.app.state.author)


Author = Annotated[str, Depends(author_of)]
