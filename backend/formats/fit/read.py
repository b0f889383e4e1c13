"""A FIT file to rides.

A sound file is walked from its first message to its last; for a damaged one every place where
reading can go on is looked for (`salvage`). Both give the same messages to the same code, so that
what a sample is does not depend on who found it. A FIT file may be several files in a row; each
with records is at least one ride.
"""

from __future__ import annotations

from dataclasses import replace
from math import floor

import numpy as np

from backend.core.device_metadata import within
from backend.formats.columns import Places, rides_of_columns
from backend.formats.fit.balance import with_leg
from backend.formats.fit.developer import descriptions
from backend.formats.fit.device_figures import statements_of
from backend.formats.fit.fields import Table, table_of
from backend.formats.fit.layout import CHECKSUM_BYTES, Part
from backend.formats.fit.mend import mended
from backend.formats.fit.metadata import metadata_of
from backend.formats.fit.profile import RECORD_FIELDS, SPORTS, ProfileField
from backend.formats.fit.salvage import Salvage, Salvaging
from backend.formats.fit.walk import sound_parts
from backend.formats.fit_numbers import EPOCH_S, FIELD_DESCRIPTION, RECORD, SESSION
from backend.formats.outcome import COMPLETE, PARTIAL, ImportedRide, Outcome, rejected
from backend.formats.own_channels import rules_of, values_of

# 24 h at 10 Hz and more: beyond this a file is not a ride, or not meant well.
ROWS_MAX = 2_000_000
# A header that declares this many times the bytes there are is wrong, not truncated.
DECLARED_RATIO_MAX = 16

SESSION_FIELDS = {
    2: ProfileField("start_time"),
    5: ProfileField("sport"),
}
# Trouble -> its code for programs, and its reason for people. The first that was met of the first
# kind here is reported: lost rows before doubtful ones.
TROUBLES: dict[str, tuple[str, str]] = {
    "damaged": ("damaged", "bytes that are no message"),
    "header": ("damaged", "a file header is damaged"),
    "flipped_bit": ("damaged", "one bit was flipped, which the checksum found and put right,"),
    "trailing": ("damaged", "bytes behind the end that are no FIT file"),
    "truncated": ("truncated", "the file ends in the middle"),
    "checksum_mismatch": ("checksum_mismatch", "the file's checksum does not match"),
}


def read_fit(data: bytes) -> Outcome:
    """A FIT file -> what came of it. Never raises on any bytes."""
    parts = sound_parts(data)
    return read_damaged(data) if parts is None else outcome_of(data, parts, None)


def read_damaged(data: bytes) -> Outcome:
    """A FIT file that is not sound -> what can be read of it; of a sound one everything."""
    salvage = Salvaging(data).run()
    outcome = outcome_of(data, salvage.parts, salvage)
    if salvage.walked and outcome.rides:
        return outcome
    right = mended(data, salvage.structure)
    if right is None:
        return outcome
    data, parts, place = right
    salvage = Salvage(parts, [("flipped_bit", place)], read_until=len(data))
    return outcome_of(data, parts, salvage)


def outcome_of(data: bytes, parts: list[Part], salvage: Salvage | None) -> Outcome:
    """Rides, reason and completeness of what was read. salvage: None for a sound file."""
    records = sum(part.count(RECORD) for part in parts)
    if records > ROWS_MAX:
        return rejected("too_many_rows", f"{records} records; at most {ROWS_MAX} are read.")
    cells = np.frombuffer(data, dtype=np.uint8)
    rides = tuple(ride for part in parts for ride in rides_of(data, cells, part))
    code, reason, offset = worst_problem(salvage)
    if not rides:
        return nothing_saved(len(data), records, code, reason, offset)
    if code is None or salvage is None:
        return Outcome(COMPLETE, rides, completeness=1.0)
    share = completeness(len(data), salvage)
    rows = sum(len(ride.rows.times_us) for ride in rides)
    # Rounded down: a file that lacks a byte is not at 100 %.
    about = "" if share is None else f", about {floor(1000.0 * share) / 10.0} % of the file"
    detail = f"{located(reason, offset, len(data))}. {rows} records were saved{about}."
    return Outcome(PARTIAL, rides, code, detail, offset, share)


def rides_of(data: bytes, cells: np.typing.NDArray[np.uint8], part: Part) -> list[ImportedRide]:
    """The rides of one file of the chain."""
    described = descriptions(data, part.of(FIELD_DESCRIPTION))
    records = table_of(cells, part.of(RECORD), RECORD_FIELDS, described)
    statements, unread = statements_of(cells, part, described, records.time_s)
    metadata = replace(metadata_of(data, cells, part), statements=statements)
    rides: list[ImportedRide] = []
    for sport, rows in legs_of(records, table_of(cells, part.of(SESSION), SESSION_FIELDS)):
        leg = records.of_rows(rows)
        columns = with_leg(leg.columns)
        rides += rides_of_columns(
            leg.time_s + EPOCH_S,
            values_of(columns),
            rules_of(columns, sport),
            sport,
            leg.unread if rides else leg.unread | unread,
        )
    return [replace(ride, metadata=within(metadata, *ride.span_s)) for ride in rides]


def legs_of(records: Table, sessions: Table) -> list[tuple[str | None, Places]]:
    """Sport and rows of each leg: one, unless a file's sessions are of several sports."""
    names = [sport_name(number) for number in sessions.values("sport")]
    starts_s = sessions.values("start_time")
    if len(set(names)) < 2 or not np.isfinite(starts_s).all():
        return [(names[0] if len(set(names)) == 1 else None, np.arange(len(records)))]
    order = np.argsort(starts_s, kind="stable")
    # What is before the first session is of its leg, what has no time, too.
    leg = np.searchsorted(starts_s[order], np.nan_to_num(records.time_s), side="right") - 1
    leg = np.maximum(leg, 0)
    return [(names[which], np.flatnonzero(leg == number)) for number, which in enumerate(order)]


def sport_name(number: float) -> str | None:
    """FIT's sport in a word, None for none."""
    return SPORTS.get(int(number), f"sport_{int(number)}") if np.isfinite(number) else None


def worst_problem(salvage: Salvage | None) -> tuple[str | None, str, int | None]:
    """Code, reason and byte of the trouble that cost most: lost rows before doubtful ones."""
    for kind, (code, reason) in TROUBLES.items():
        for met, offset in salvage.troubles if salvage is not None else ():
            if met == kind:
                return code, reason, offset
    return None, "", None


def completeness(length: int, salvage: Salvage) -> float | None:
    """Share of the file's bytes that were read as messages; None when its size is unknown."""
    expected = max(salvage.expected_bytes, length)
    if salvage.expected_bytes > DECLARED_RATIO_MAX * length:
        return None
    read = min(salvage.read_until + CHECKSUM_BYTES, length) - salvage.skipped_bytes
    return min(max(read / expected, 0.0), 1.0)


def located(reason: str, offset: int | None, length: int) -> str:
    """A reason as the beginning of a sentence, with its place."""
    where = "" if offset is None else f" at byte {offset} of {length}"
    return f"{reason[0].upper()}{reason[1:]}{where}"


def nothing_saved(
    length: int, records: int, code: str | None, reason: str, offset: int | None
) -> Outcome:
    """Why there is no ride."""
    if records:
        return rejected(
            "no_valid_time",
            f"None of the {records} records has a believable time and a value.",
            offset,
        )
    if code is not None:
        sentence = located(reason, offset, length)
        return rejected("no_records", f"{sentence}, and no record was found.", offset)
    return rejected("no_records", "The file holds no records: it is not an activity.")
