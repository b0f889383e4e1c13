"""Where everything is kept, and a backup of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime

from backend.store import Store, StorePlace, backup_of, place_of


@dataclass(frozen=True)
class Backup:
    """A zip of the store; `chunks` is read once."""

    file_name: str
    chunks: Iterator[bytes]


class StoreService:
    """The store as a whole. For any thread; both raise StoreError. version: of this Spindle."""

    def __init__(self, store: Store, version: str) -> None:
        self._store = store
        self._version = version

    def place(self) -> StorePlace:
        """Where it is, what it holds, and how much room there is."""
        return place_of(self._store)

    def backup(self) -> Backup:
        """All of it at this moment."""
        made = datetime.now(UTC).strftime("%Y-%m-%dT%H%MZ")
        return Backup(f"spindle-backup-{made}.zip", backup_of(self._store, self._version))
