"""What configurations there were, of each unit and in the library, and what is proven of them."""

from backend.store.configurations.certificates import CertificateStore
from backend.store.configurations.library import LibraryStore
from backend.store.configurations.revisions import RevisionLog

__all__ = ["CertificateStore", "LibraryStore", "RevisionLog"]
