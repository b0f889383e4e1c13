"""What is said of events, and which are looked for."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from typing import Any

from backend.core.actor import ActorKind
from backend.core.audit import Action, ObjectKind
from backend.core.described import described


@described
class AuditEvent:
    """One change: who made it, when, to what, and what was otherwise before."""

    id: int
    """Counts from 1 without a gap."""
    at: datetime
    actor_kind: ActorKind
    """A `person`, a program with a `key`, the `server` by itself, a `command` on its folder."""
    actor_name: str
    """Of the account then; where nobody signs in, as the request states it; empty for nobody."""
    person_id: int | None
    """Null where nobody signed in."""
    key_name: str | None
    action: Action
    object_kind: ObjectKind
    object_id: str | None
    object_name: str | None
    """As it was called then."""
    unit_key: str | None
    bike_id: int | None
    bike_name: str | None
    """As it is called now; null once it is removed."""
    before: dict[str, Any] | None
    """What differs, by name; physical names carry their units."""
    after: dict[str, Any] | None
    reason: str | None
    sha256: str
    """Of this event and of all before it; `spindle audit verify --expect` finds it again."""


@described
class AuditPage:
    items: tuple[AuditEvent, ...]
    next: str | None
    """The cursor of the following page."""


@dataclass(frozen=True)
class AuditFilter:
    """Which events are looked for; None for whatever.

    who: part of an actor's or a key's name, whatever its case. from_us, to_us: Unix microseconds.
    with_people: also what was done to accounts and keys.
    """

    who: str | None = None
    action: Action | None = None
    object_kind: ObjectKind | None = None
    unit_key: str | None = None
    bike_id: int | None = None
    from_us: int | None = None
    to_us: int | None = None
    with_people: bool = True
