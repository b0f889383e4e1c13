"""A revision log in memory, with the methods of the store's."""

from __future__ import annotations

from collections.abc import Sequence
from inspect import signature
from typing import Any

from backend.core.revision import Revision, RevisionLog
from backend.errors import StoreError

APPENDED = signature(RevisionLog.append)
CREATED_US = 1_700_000_000_000_000


class MemoryRevisions(RevisionLog):
    """Oldest first in `kept`; `full` makes it refuse like a full disk. Arguments as of
    RevisionLog."""

    def __init__(self) -> None:
        self.kept: dict[str, list[Revision]] = {}
        self.full = False

    def append(self, *arguments: Any, **named: Any) -> Revision:
        if self.full:
            raise StoreError("The disk is full.")
        bound = APPENDED.bind(self, *arguments, **named)
        bound.apply_defaults()
        noted = dict(bound.arguments)
        del noted["self"]
        del noted["action"], noted["actor"]
        unless_known = noted.pop("only_if_changed")
        rows = self.kept.setdefault(noted["unit_key"], [])
        if unless_known and rows and rows[-1].crc32 == noted["crc32"]:
            return rows[-1]
        rows.append(Revision(len(rows) + 1, CREATED_US, **noted))
        return rows[-1]

    def list(self, unit_key: str, limit: int = 1000) -> Sequence[Revision]:
        return self.kept.get(unit_key, [])[::-1][:limit]
