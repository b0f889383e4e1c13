"""An item of the library: a table or a configuration that somebody keeps under a name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from backend.core.author import AuthorProof
from backend.core.moments import utc


@dataclass(frozen=True)
class LibraryVersion:
    """One state of an item, as it is kept; the newest is what the item is.

    seq: counts an item's states from 1. deleted: the item was taken out of the library here; body
    is what it held. body: the whole document. author_proof: as of core.author.
    """

    item_id: int
    seq: int
    deleted: bool
    body: Mapping[str, Any]
    sha256: str
    author: str
    author_proof: AuthorProof | None
    made_us: int
    created_us: int

    @property
    def name(self) -> str:
        """What the item is called in this state."""
        return str(self.body["name"])

    @property
    def made_at(self) -> datetime:
        """When the item came into the library, in UTC."""
        return utc(self.made_us)

    @property
    def created_at(self) -> datetime:
        """When it came into this state, in UTC."""
        return utc(self.created_us)
