"""Devices that were seen, and every configuration each of them has had: who, when, why."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Mapping, Sequence
from typing import Any

from sqlalchemy import Connection, insert, select, update

from backend.domain.revision import Revision
from backend.store import tables as t
from backend.store.database import Database

REVISIONS_MAX = 1000


class RevisionLog:
    """Configurations by device serial, appended and never changed."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def append(
        self,
        device_serial: str,
        parameters: Mapping[str, Any],
        changed: Sequence[Mapping[str, Any]] = (),
        reason: str = "",
        author: str = "",
        generation: int | None = None,
        crc32: int | None = None,
        state: str = "verified",
    ) -> Revision:
        """Add a configuration that the device has; returns it with its number.

        parameters: the whole configuration as plain JSON. Raises StoreError.
        """
        body = json.dumps(parameters, sort_keys=True, separators=(",", ":"))
        values = {
            "body": dict(parameters),
            "sha256": hashlib.sha256(body.encode()).hexdigest(),
            "generation": generation,
            "crc32": crc32,
            "changed": [dict(change) for change in changed],
            "author": author,
            "reason": reason,
            "state": state,
            "created_us": time.time_ns() // 1000,
        }

        def work(connection: Connection) -> int:
            device_id = device_key(connection, device_serial)
            last = connection.execute(
                select(t.config_revision.c.id, t.config_revision.c.seq)
                .where(t.config_revision.c.device_id == device_id)
                .order_by(t.config_revision.c.seq.desc())
                .limit(1)
            ).first()
            seq = last.seq + 1 if last else 1
            parent_id = last.id if last else None
            connection.execute(
                insert(t.config_revision).values(
                    device_id=device_id, parent_id=parent_id, seq=seq, **values
                )
            )
            return seq

        seq = self._database.write(work)
        return next(found for found in self.list(device_serial, 1) if found.seq == seq)

    def list(self, device_serial: str, limit: int = REVISIONS_MAX) -> tuple[Revision, ...]:
        """Configurations of a device, newest first; empty for an unknown one."""
        query = (
            select(t.config_revision)
            .join(t.device, t.device.c.id == t.config_revision.c.device_id)
            .where(t.device.c.serial == device_serial)
            .order_by(t.config_revision.c.seq.desc())
            .limit(min(limit, REVISIONS_MAX))
        )
        rows = self._database.read(lambda c: c.execute(query).all())
        return tuple(
            Revision(
                seq=row.seq,
                created_us=row.created_us,
                author=row.author,
                reason=row.reason,
                state=row.state,
                generation=row.generation,
                crc32=row.crc32,
                changed=row.changed,
                parameters=row.body,
            )
            for row in rows
        )

    def device_seen(
        self, serial: str, model: str | None = None, firmware_version: str | None = None
    ) -> None:
        """Note that a device was there now."""

        def work(connection: Connection) -> None:
            connection.execute(
                update(t.device)
                .where(t.device.c.id == device_key(connection, serial))
                .values(
                    model=model,
                    firmware_version=firmware_version,
                    last_seen_us=time.time_ns() // 1000,
                )
            )

        self._database.write(work)


def device_key(connection: Connection, serial: str) -> int:
    """The row id of a device, which is added when it is new."""
    found = connection.execute(select(t.device.c.id).where(t.device.c.serial == serial)).scalar()
    if found is not None:
        return int(found)
    now_us = time.time_ns() // 1000
    result = connection.execute(
        insert(t.device)
        .values(serial=serial, created_us=now_us, last_seen_us=now_us)
        .returning(t.device.c.id)
    )
    return int(result.scalar_one())
