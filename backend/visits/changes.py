"""What became of a unit during a visit: settings that are otherwise, faults that came and went."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime

from backend.core.revision import Revision
from backend.device.readings import Fault
from backend.visits.types import VisitChange, VisitFault


def changes_since(revisions: Sequence[Revision], seq: int | None) -> tuple[VisitChange, ...]:
    """Settings that are otherwise than in one configuration, each as it was last changed.

    revisions: newest first. seq: of that configuration; None where none was known, and then the
    first one is no change.
    """
    later = [one for one in revisions if seq is None or one.seq > seq]
    if seq is None:
        later = [one for one in later if one.seq > min(other.seq for other in later)]
    first: dict[str, object] = {}
    last: dict[str, tuple[object, Revision]] = {}
    for revision in reversed(later):
        for change in revision.changed:
            name = str(change["name"])
            first.setdefault(name, change.get("old"))
            last[name] = (change.get("new"), revision)
    return tuple(
        VisitChange(name, first[name], new, by.created_at, by.author, by.reason)
        for name, (new, by) in sorted(last.items())
        if first[name] != new
    )


def seen_faults(
    before: Sequence[VisitFault], current: Sequence[Fault], now: datetime
) -> tuple[VisitFault, ...]:
    """The faults of a visit after the unit has reported its present ones. One that comes again is
    there again; one that the unit only remembers is in it, too, as over."""
    by_name = {fault.name: fault for fault in current}

    def updated(seen: VisitFault) -> VisitFault:
        fault = by_name.get(seen.name)
        if fault is not None and fault.active:
            return replace(seen, count=fault.count, over_at=None)
        return replace(seen, over_at=seen.over_at or now)

    known = {seen.name for seen in before}
    fresh = (
        VisitFault(fault.name, fault.count, now, None if fault.active else now)
        for fault in current
        if fault.name not in known
    )
    return (*map(updated, before), *fresh)
