"""A ride as Mahle's My SmartBike exports it: whole, in part, or a question about its zone."""

from __future__ import annotations

import re
from dataclasses import replace
from math import floor

from backend.formats.mahle.document import KIND, QUESTION, Document
from backend.formats.mahle.walk import TRUNCATED, Listener, Walk, Walked
from backend.formats.outcome import (
    COMPLETE,
    NEEDS_MAPPING,
    PARTIAL,
    ImportedRide,
    Outcome,
    rejected,
)
from backend.formats.questions import TableAnswer

POINTS_MAX = 2_000_000
MEMBERS = re.compile(
    rb'"(activity_name|activity_difficulty|start_date|stop_date|ride_time|ride_distance|batteries|'
    rb'max_rider_watts|avg_rider_watts|min_rider_watts|locations|object_serial)"\s*:'
)
# Of these a file names so many in its head: one alone may stand in any document.
MEMBERS_LEAST = 4


def looks_like_mahle(head: bytes) -> bool:
    """Whether a file's first bytes are of such a ride."""
    begins = head.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{")
    return begins and len(set(MEMBERS.findall(head))) >= MEMBERS_LEAST


def read_mahle(data: bytes, answer: TableAnswer | None = None) -> Outcome:
    """Such a file -> what came of it. Never raises on any bytes. answer: the zone, where asked."""
    document = Document()
    data = data.removeprefix(b"\xef\xbb\xbf")
    walked = Walk(data, Listener(document.member, document.point)).run()
    if walked.points > POINTS_MAX:
        return rejected("too_many_rows", f"{walked.points} points; at most {POINTS_MAX} are read.")
    clock = document.clock(answer, walked.error is not None)
    if clock is None:
        detail = f"A {KIND} that does not say: time_zone. Say it once, and every such file is read."
        return replace(rejected(NEEDS_MAPPING, detail), question=QUESTION)
    outcome = outcome_of(document.rides(*clock), walked, document, len(data))
    return replace(outcome, question=QUESTION if "time_zone" in clock[1] else None)


def outcome_of(
    rides: list[ImportedRide], walked: Walked, document: Document, length: int
) -> Outcome:
    """Rides, reason and completeness."""
    where = "" if walked.offset is None else f" at byte {walked.offset} of {length}"
    cut = walked.error == TRUNCATED
    reason = "The file ends in the middle" if cut else "No JSON"
    if not rides:
        if walked.points:
            reason_text = f"None of the {walked.points} points has a believable time and a value."
            return rejected("no_valid_time", reason_text, walked.offset)
        reason_text = f"{reason}{where}, and no" if walked.error else "There is no"
        return rejected("no_records", f"{reason_text} point of a ride was found.", walked.offset)
    if walked.error is None:
        return Outcome(COMPLETE, tuple(rides), completeness=1.0)
    share = document.ridden_share() if cut else None
    about = "" if share is None else f", about {floor(1000.0 * share) / 10.0} % of the ride's time"
    detail = f"{reason}{where}. {walked.points} points were saved{about}."
    return Outcome(PARTIAL, tuple(rides), walked.error, detail, walked.offset, share)
