"""What the audit tells of a ride: that it was changed or deleted, and never a word of it.

What people write of a ride goes with the ride, from every file; the audit stays. So it tells which
of name, notes and tags were changed, and of a deleted ride when it began.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sqlalchemy import Connection, select

from backend.core.audit import Action, AuditEntry
from backend.core.ride import Ride, iso_utc
from backend.store import audit
from backend.store.inspect_schema import TIME_MAX_US
from backend.store.sql import tables as t

WORDS = ("name", "notes", "tags")


def note_changed(
    connection: Connection, ride: Ride, given: Mapping[str, object], accepted: Iterable[str] | None
) -> None:
    """Note that words of a ride were changed, or its doubts accepted.

    ride: as it was. given: name, notes and tags as they are now, where they were given. accepted:
    codes of the doubts that are accepted now, None where nobody asked.
    """
    changed = [name for name in WORDS if given.get(name) not in (None, getattr(ride, name))]
    before: dict[str, object] = {}
    after: dict[str, object] = {"changed": changed} if changed else {}
    if accepted is not None and set(accepted) != set(ride.accepted_doubts):
        before["doubts_accepted"] = sorted(ride.accepted_doubts)
        after["doubts_accepted"] = sorted(accepted)
    if after:
        entry = AuditEntry(Action.RIDE_CHANGED, ride.id, None, before, after, bike_id=ride.bike_id)
        audit.append(connection, entry)


def deletion_of(connection: Connection, ride_id: int) -> AuditEntry:
    """What the deletion of a ride is to the audit, while it is still there."""
    columns = (t.ride.c.started_us, t.ride.c.bike_id)
    row = connection.execute(select(*columns).where(t.ride.c.id == ride_id)).one()
    # A damaged row may hold anything.
    is_time = isinstance(row.started_us, int) and abs(row.started_us) < TIME_MAX_US
    before = {"started_at": iso_utc(row.started_us)} if is_time else None
    bike_id = row.bike_id if isinstance(row.bike_id, int) else None
    return AuditEntry(Action.RIDE_DELETED, ride_id, before=before, bike_id=bike_id)
