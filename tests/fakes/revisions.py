"""A revision log in memory, with the methods of the store's."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from backend.core.revision import Revision
from backend.errors import StoreError


class MemoryRevisions:
    """Newest first; `full` makes it refuse like a full disk."""

    def __init__(self) -> None:
        self.kept: dict[str, list[Revision]] = {}
        self.full = False

    def append(
        self,
        unit_key: str,
        parameters: Mapping[str, Any],
        changed: Sequence[Mapping[str, Any]] = (),
        reason: str = "",
        author: str = "",
        generation: int | None = None,
        crc32: int | None = None,
        state: str = "verified",
        only_if_changed: bool = False,
    ) -> Revision:
        if self.full:
            raise StoreError("The disk is full.")
        rows = self.kept.setdefault(unit_key, [])
        if only_if_changed and rows and rows[-1].crc32 == crc32:
            return rows[-1]
        revision = Revision(
            len(rows) + 1,
            1_700_000_000_000_000,
            author,
            reason,
            state,
            generation,
            crc32,
            changed,
            dict(parameters),
            unit_key,
        )
        rows.append(revision)
        return revision

    def list(self, unit_key: str, limit: int = 1000) -> Sequence[Revision]:
        return self.kept.get(unit_key, [])[::-1][:limit]
