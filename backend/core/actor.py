"""Who acts: found out where a request or a command comes in, known wherever a change is written.

A context variable carries it: into the thread pool, and with a transaction to the writing thread.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Literal, TypeAlias

from backend.core.person import Caller, Person

ActorKind: TypeAlias = Literal["person", "key", "server", "command"]


@dataclass(frozen=True)
class Actor:
    """Who makes a change.

    kind: a `person`, a program with a `key` of a person, the `server` by itself, or a `command` on
    its folder. name: of the account; where nobody signs in, as the request states it; of a command
    the system's user. account_id: None where nobody signed in. key: what the key is called.
    """

    kind: ActorKind
    name: str
    account_id: int | None = None
    key: str | None = None


SERVER = Actor("server", "")
ACTOR: ContextVar[Actor] = ContextVar("actor", default=SERVER)


def actor_now() -> Actor:
    """Who acts here; the server where nobody said otherwise."""
    return ACTOR.get()


def actor_of_caller(caller: Caller) -> Actor:
    """Who sends a request with a session or a key."""
    if caller.key_id is None:
        return actor_of_person(caller.person)
    return Actor("key", caller.person.name, caller.person.id, caller.key_name)


def actor_of_person(person: Person) -> Actor:
    """Somebody with an account who does something themselves."""
    return Actor("person", person.name, person.id)


@contextmanager
def acting(actor: Actor) -> Iterator[None]:
    """What is done in here is done by `actor`."""
    token = ACTOR.set(actor)
    try:
        yield
    finally:
        ACTOR.reset(token)
