"""What configurations there were: those of each unit, and those of the library under a name."""

from backend.store.configurations.library import LibraryStore
from backend.store.configurations.revisions import RevisionLog

__all__ = ["LibraryStore", "RevisionLog"]
