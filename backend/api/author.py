"""Whose a change is: who signed in, else by the name that comes with the request, else the name the
server was started with."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import unquote

from fastapi import Depends, Header, Request

from backend.api.permissions import caller_of
from backend.domain.author import AUTHOR_MAX, SignedInName, tidy_author


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
    """The author of a change; empty where nobody knows."""
    caller = caller_of(request)
    if caller is not None:
        return SignedInName(caller.person.name)
    named = tidy_author(unquote(spindle_author or ""))
    return named or str(request.app.state.author)


Author = Annotated[str, Depends(author_of)]
