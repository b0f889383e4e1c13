"""All that is asked of people and their keys, in one place for the API."""

from __future__ import annotations

from dataclasses import dataclass

from backend.services.people.manage import Keys, Managed
from backend.services.people.sign_in import SignIn
from backend.services.people.tickets import Tickets
from backend.store.people.passwords import Passwords
from backend.store.store import Store


@dataclass(frozen=True)
class People:
    """sign_in: browsers. keys: programs. tickets: sockets of programs. managed: accounts."""

    sign_in: SignIn
    keys: Keys
    tickets: Tickets
    managed: Managed


def people_of(store: Store) -> People:
    """Over the accounts of a store."""
    passwords = Passwords()
    return People(
        sign_in=SignIn(store.accounts, store.sessions, passwords),
        keys=Keys(store.keys),
        tickets=Tickets(),
        managed=Managed(store.accounts, passwords),
    )
