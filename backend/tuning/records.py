"""Every configuration each unit has had: who, when, why; and what is proven of each.

A proof follows from a configuration and is kept as it was first made.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

from sqlalchemy import Connection, Row, Select, insert, select, update

from backend.core.actor import Actor
from backend.core.audit import Action, AuditEntry, Members, differing
from backend.core.author import proof_of
from backend.core.canonical_json import sha256_of
from backend.core.revision import Revision
from backend.law.limit_proof import LimitProof
from backend.store import audit
from backend.store.bikes import bike_of_unit
from backend.store.sql import tables as t
from backend.store.sql.database import Database

REVISIONS_MAX = 1000
# Of these the reason is their author's; of others it is Spindle's own.
GIVEN_A_REASON = (Action.CONFIGURATION_WRITTEN, Action.CONFIGURATION_TRIED)


class RevisionStore:
    """Configurations by the unit's key, appended and never changed."""

    def __init__(self, database: Database) -> None:
        self._database = database

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
        action: Action = Action.CONFIGURATION_FOUND,
        actor: Actor | None = None,
    ) -> Revision:
        """Add a configuration that the unit has; returns it with its number.

        parameters: the whole configuration as plain JSON. only_if_changed: nothing is added where
        the newest has the same checksum, whoever added it just now; that one is returned. action,
        actor: for the audit; None for who acts here. Raises StoreError.
        """
        values = {
            "body": dict(parameters),
            "sha256": sha256_of(parameters),
            "generation": generation,
            "crc32": crc32,
            "changed": [dict(change) for change in changed],
            "author": str(author),
            "author_proof": proof_of(author),
            "reason": reason,
            "state": state,
            "created_us": time.time_ns() // 1000,
        }

        def work(connection: Connection) -> Revision:
            bike_of_unit(connection, unit_key)
            last = connection.execute(newest_of(unit_key, 1)).first()
            if last is not None and only_if_changed and last.crc32 == crc32:
                return revision_from(last)
            place = {
                "unit_key": unit_key,
                "parent_id": last.id if last else None,
                "seq": last.seq + 1 if last else 1,
            }
            added = insert(t.revision).values(**place, **values).returning(t.revision)
            revision = revision_from(connection.execute(added).one())
            old, new = sides_of(revision, last)
            why = reason if action in GIVEN_A_REASON else ""
            entry = AuditEntry(action, revision.seq, None, old, new, why, unit_key)
            audit.append(connection, entry, actor)
            return revision

        return self._database.write(work)

    def list(self, unit_key: str, limit: int = REVISIONS_MAX) -> tuple[Revision, ...]:
        """Configurations of a unit, newest first; empty for an unknown one."""
        query = newest_of(unit_key, min(limit, REVISIONS_MAX))
        rows = self._database.read(lambda c: c.execute(query).all())
        return tuple(map(revision_from, rows))


def sides_of(revision: Revision, last: Row[Any] | None) -> tuple[Members, Members]:
    """Before and after of a configuration: as its author changed it, else against the one before,
    if that is known."""
    if revision.changed or last is None:
        changed = revision.changed
        old = {change["name"]: change["old"] for change in changed}
        return old, {change["name"]: change["new"] for change in changed}
    return differing(last.body, revision.parameters)


def newest_of(unit_key: str, limit: int) -> Select[Any]:
    """The newest configurations of a unit, newest first."""
    mine = select(t.revision).where(t.revision.c.unit_key == unit_key)
    return mine.order_by(t.revision.c.seq.desc()).limit(limit)


def revision_from(row: Row[Any]) -> Revision:
    return Revision(
        seq=row.seq,
        created_us=row.created_us,
        author=row.author,
        author_proof=row.author_proof,
        reason=row.reason,
        state=row.state,
        generation=row.generation,
        crc32=row.crc32,
        changed=row.changed,
        parameters=row.body,
        unit_key=row.unit_key,
    )


class LimitProofStore:
    """By the hash of a configuration, the version of the method and the firmware."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def save(self, made: LimitProof) -> int:
        """Keep what was just made unless it is known; since when it is known, Unix microseconds.

        One that was worked out otherwise takes the place of what was there. Raises StoreError.
        """
        row = t.limit_proof.c
        mine = (
            (row.config_sha256 == made.config_sha256)
            & (row.method == made.method)
            & (row.firmware_version == made.firmware_version)
        )
        query = select(row.sha256, row.created_us).where(mine)

        existing = self._database.read(lambda connection: connection.execute(query).first())
        if existing is not None and existing.sha256 == made.sha256:
            return int(existing.created_us)

        def work(connection: Connection) -> int:
            existing = connection.execute(query).first()
            if existing is not None and existing.sha256 == made.sha256:
                return int(existing.created_us)
            now_us = time.time_ns() // 1000
            values = {"sha256": made.sha256, "body": made.body(), "created_us": now_us}
            if existing is not None:
                connection.execute(update(t.limit_proof).where(mine).values(**values))
                return now_us
            connection.execute(
                insert(t.limit_proof).values(
                    config_sha256=made.config_sha256,
                    method=made.method,
                    firmware_version=made.firmware_version,
                    **values,
                )
            )
            return now_us

        return self._database.write(work)
