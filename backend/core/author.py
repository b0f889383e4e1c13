"""Who did something: a name, and how it is known.

On a server without accounts a name is what somebody says of themselves, and is kept marked as that.
"""

from __future__ import annotations

from typing import Literal

AUTHOR_MAX = 128
"""Characters of a name, as many as the store keeps."""

AuthorProof = Literal["stated", "signed_in"]

STATED: AuthorProof = "stated"
"""The name is what its owner says it is; nobody checked it."""

SIGNED_IN: AuthorProof = "signed_in"
"""The name is that of an account, and its owner had signed in or used a key of it."""


class SignedInName(str):
    """A name that sign-in proved: a word like any other, and it carries its proof to the store."""

    __slots__ = ()


def proof_of(author: str) -> AuthorProof | None:
    """How an author is known; None where there is no author."""
    if isinstance(author, SignedInName):
        return SIGNED_IN
    return STATED if author else None


def tidy_author(name: str) -> str:
    """A name as it is kept: one line, no characters that cannot be seen, not too long."""
    printable = "".join(character if character.isprintable() else " " for character in name)
    return " ".join(printable.split())[:AUTHOR_MAX].strip()
