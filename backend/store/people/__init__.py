"""People with accounts, the browsers they signed in with, and the keys of their programs."""

from backend.store.people.accounts import AccountStore
from backend.store.people.keys import KeyStore
from backend.store.people.sessions import SessionStore

__all__ = ["AccountStore", "KeyStore", "SessionStore"]
