"""Certificates: rows that follow from a configuration, kept as they were first made."""

from __future__ import annotations

import time

from sqlalchemy import Connection, insert, select, update

from backend.domain.certificate import Certificate
from backend.store.sql import tables as t
from backend.store.sql.database import Database


class CertificateStore:
    """By the hash of a configuration, the version of the method and the firmware."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def keep(self, made: Certificate) -> int:
        """Keep what was just made unless it is known; since when it is known, Unix microseconds.

        One that was worked out otherwise takes the place of what was there. Raises StoreError.
        """
        row = t.certificate.c
        mine = (
            (row.config_sha256 == made.config_sha256)
            & (row.method == made.method)
            & (row.firmware_version == made.firmware_version)
        )
        known = select(row.sha256, row.created_us).where(mine)

        found = self._database.read(lambda connection: connection.execute(known).first())
        if found is not None and found.sha256 == made.sha256:
            return int(found.created_us)

        def work(connection: Connection) -> int:
            found = connection.execute(known).first()
            if found is not None and found.sha256 == made.sha256:
                return int(found.created_us)
            now_us = time.time_ns() // 1000
            said = {"sha256": made.sha256, "body": made.body(), "created_us": now_us}
            if found is not None:
                connection.execute(update(t.certificate).where(mine).values(**said))
                return now_us
            connection.execute(
                insert(t.certificate).values(
                    config_sha256=made.config_sha256,
                    method=made.method,
                    firmware_version=made.firmware_version,
                    **said,
                )
            )
            return now_us

        return self._database.write(work)
