"""The cookie of a session: no script reads it, no other site's request carries it.

With TLS it has the prefix `__Host-`, by which browsers refuse one that another host of the domain
or a plain connection planted. A second cookie holds no secret: it tells the page that somebody is
signed in, so that a server without accounts is asked nothing.
"""

from __future__ import annotations

from starlette.requests import HTTPConnection
from starlette.responses import Response

NAME = "spindle_session"
HINT = "spindle_signed_in"
AGE_MAX_S = 30 * 24 * 3600


def is_encrypted(connection: HTTPConnection) -> bool:
    """Whether the request came by TLS, as far as this server or its proxy says."""
    return connection.scope.get("scheme") in ("https", "wss")


def name_of(connection: HTTPConnection) -> str:
    """What the cookie is called on this connection."""
    return f"__Host-{NAME}" if is_encrypted(connection) else NAME


def token_in(connection: HTTPConnection) -> str | None:
    """The token that came with a request."""
    return connection.cookies.get(name_of(connection))


def set_cookie(connection: HTTPConnection, response: Response, token: str) -> None:
    """Signs a browser in."""
    secure = is_encrypted(connection)
    response.set_cookie(
        name_of(connection),
        token,
        max_age=AGE_MAX_S,
        path="/",
        secure=secure,
        httponly=True,
        samesite="strict",
    )
    response.set_cookie(
        HINT, "1", max_age=AGE_MAX_S, path="/", secure=secure, httponly=False, samesite="strict"
    )


def take_away(connection: HTTPConnection, response: Response) -> None:
    """Signs a browser out."""
    secure = is_encrypted(connection)
    for name, hidden in ((name_of(connection), True), (HINT, False)):
        response.delete_cookie(name, "/", secure=secure, httponly=hidden, samesite="strict")
