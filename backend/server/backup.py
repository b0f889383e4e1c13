"""Where everything is kept, and a backup of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime

from backend.core.audit import Action, AuditEntry, Note, no_note
from backend.store import Store, StorePlace, backup_of, place_of


@dataclass(frozen=True)
class Backup:
    """A zip of the store; `chunks` is read once."""

    file_name: str
    chunks: Iterator[bytes]


class StoreService:
    """The store as a whole. For any thread; both raise StoreError. version: of this Spindle.
    note: adds to the audit."""

    def __init__(self, store: Store, version: str, note: Note = no_note) -> None:
        self._store = store
        self._note = note
        self._version = version

    def place(self) -> StorePlace:
        """Where it is, what it holds, and how much room there is."""
        return place_of(self._store)

    def backup(self) -> Backup:
        """All of it at this moment."""
        made = datetime.now(UTC).strftime("%Y-%m-%dT%H%MZ")
        file_name = f"spindle-backup-{made}.zip"
        chunks = backup_of(self._store, self._version)
        # Copied, and nothing of it has left yet. It is not in the copy itself.
        self._note(AuditEntry(Action.STORE_BACKED_UP, name=file_name))
        return Backup(file_name, chunks)
