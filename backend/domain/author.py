"""Who did something: a name, and how it is known.

There is no sign-in yet: a name is what somebody says of themselves, and is kept marked as that.
"""

from __future__ import annotations

AUTHOR_MAX = 128
"""Characters of a name, as many as the store keeps."""

STATED = "stated"
"""The name is what its owner says it is; nobody checked it."""


def proof_of(author: str) -> str | None:
    """How an author is known; None where there is no author."""
    return STATED if author else None


def tidy_author(name: str) -> str:
    """A name as it is kept: one line, no characters that cannot be seen, not too long."""
    seen = "".join(character if character.isprintable() else " " for character in name)
    return " ".join(seen.split())[:AUTHOR_MAX].strip()
