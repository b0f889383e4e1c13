"""FIT files: the fast reader for whole ones, the salvaging reader for everything else.

fitfast (Rust) reads a sound file 58 times faster than pure Python but gives up at the first wrong
byte, and refuses some sound ones (a header checksum of 0 is legal). chiptime finds its way again
behind damage. What both give goes through our own rules (`columns`). A FIT file may be several
files in a row; each with records is a ride of its own.
"""

from __future__ import annotations

import struct
from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import floor

import numpy as np

from backend.domain.channels import Values
from backend.ingest.columns import EPOCH_S, FIT_FIELDS, ride_of_columns
from backend.ingest.outcome import COMPLETE, PARTIAL, ImportedRide, Outcome, rejected

HEADER_SIZES = (12, 14)
MAGIC = b".FIT"
CHECKSUM_BYTES = 2
SPORTS = {1: "running", 2: "cycling", 5: "swimming", 11: "walking", 17: "hiking"}
# 24 h at 10 Hz and more: beyond this a file is not a ride, or not meant well.
ROWS_MAX = 2_000_000
# A header that declares this many times the bytes there are is wrong, not truncated.
DECLARED_RATIO_MAX = 16
# Bytes behind the end the header names that are worth reading as part of the file.
TRAIL_WORTH_BYTES = 64

RECORD = 20
# file_id, session, lap, record, event, device_info, activity, developer and field descriptions:
# what records need to be understood, and what carries the time for compressed headers.
MESSAGES = frozenset({0, 18, 19, RECORD, 21, 23, 34, 206, 207})
WANTED = frozenset(name for rule in FIT_FIELDS for name in rule.sources)

REASONS = {
    "FIT_TRUNCATED": ("truncated", "the file ends in the middle"),
    "FIT_CRC_MISSING": ("truncated", "the file's checksum is missing at its end"),
    "FIT_CRC_MISMATCH": ("checksum_mismatch", "the file's checksum does not match"),
    "FIT_HEADER_INVALID": ("damaged", "a header is damaged"),
    "FIT_HEADER_CRC_MISMATCH": ("damaged", "a header's checksum does not match"),
    "FIT_DATA_SIZE_MISMATCH": ("damaged", "the header was never completed"),
    "FIT_UNDEFINED_LOCAL_TYPE": ("damaged", "a message of an unknown kind"),
    "FIT_DEFINITION_INVALID": ("damaged", "a definition that makes no sense"),
}


@dataclass
class Part:
    """Records of one file in the chain, column by column, as they are salvaged."""

    times: array[float] = field(default_factory=lambda: array("d"))
    columns: dict[str, array[float]] = field(default_factory=dict)
    sports: set[str] = field(default_factory=set)

    def add(self, time_s: float, values: dict[str, float]) -> None:
        """Add one record; channels it lacks are missing."""
        row = len(self.times)
        self.times.append(time_s)
        for name, value in values.items():
            column = self.columns.setdefault(name, array("d"))
            column.extend([np.nan] * (row - len(column)))
            column.append(value)

    def ride(self) -> ImportedRide | None:
        """The part as a ride, None when it has no usable record."""
        rows = len(self.times)
        columns: dict[str, Values] = {}
        for name, column in self.columns.items():
            padded = np.full(rows, np.nan)
            padded[: len(column)] = column
            columns[name] = padded
        sport = next(iter(self.sports)) if len(self.sports) == 1 else None
        return ride_of_columns(np.array(self.times), columns, sport=sport)


@dataclass
class Salvage:
    """What the salvaging reader found and met."""

    parts: list[Part] = field(default_factory=list)
    troubles: list[tuple[str, int]] = field(default_factory=list)
    skipped_bytes: int = 0
    expected_bytes: int = 0
    read_until: int = 0
    too_many: bool = False

    @property
    def records(self) -> int:
        """Records of all parts."""
        return sum(len(part.times) for part in self.parts)


def read_fit(data: bytes, fast: bool = True) -> Outcome:
    """A FIT file -> what came of it. Never raises on any bytes.

    fast: try fitfast first; a caller whose first try died passes False.
    """
    if fast and (parts := whole_parts(data)) and (outcome := read_fast(parts)):
        return outcome
    found = salvage(data)
    trail = trailing_bytes(data)
    if trail > TRAIL_WORTH_BYTES:
        longer = salvage(with_true_size(data))
        if longer.records > found.records:
            longer.troubles.insert(0, ("FIT_DATA_SIZE_MISMATCH", 4))
            found = longer
    return salvaged_outcome(data, found)


def whole_parts(data: bytes) -> list[bytes] | None:
    """The files of a chain when every header leads exactly to the next, else None."""
    parts, at = [], 0
    while at < len(data):
        end = declared_end(data, at)
        if end is None or end > len(data):
            return None
        parts.append(data[at:end])
        at = end
    return parts


def declared_end(data: bytes, at: int) -> int | None:
    """Where the header at `at` says its file ends, None when there is no header."""
    header = data[at : at + 12]
    if len(header) < 12 or header[0] not in HEADER_SIZES or header[8:12] != MAGIC:
        return None
    (size,) = struct.unpack_from("<I", header, 4)
    return at + header[0] + int(size) + CHECKSUM_BYTES


def trailing_bytes(data: bytes) -> int:
    """Bytes behind the end of the first file that are not another file."""
    end = declared_end(data, 0)
    if end is None or end >= len(data) or data[end] in HEADER_SIZES:
        return 0
    return len(data) - end


def with_true_size(data: bytes) -> bytes:
    """The same file with a header that declares all the bytes there are."""
    size = len(data) - data[0] - CHECKSUM_BYTES
    return data[:4] + struct.pack("<I", max(size, 0)) + data[8:]


def read_fast(parts: list[bytes]) -> Outcome | None:
    """Sound files through fitfast; None when it refuses one, so that salvage takes over."""
    import fitfast

    rides = []
    for part in parts:
        try:
            columns = fitfast.records(part)
            sessions = fitfast.records(part, message="session")
        except (KeyboardInterrupt, SystemExit):
            raise
        except BaseException:
            # A Rust panic is no Exception (seen: a division by zero inside its decoder).
            return None
        rows = len(columns.get("timestamp", ()))
        if rows > ROWS_MAX:
            return rejected("too_many_rows", f"{rows} records; at most {ROWS_MAX} are read.")
        sport = only_number(sessions.get("sport"))
        named = {name: values for name, values in columns.items() if name in WANTED}
        times = np.asarray(columns.get("timestamp", np.empty(0)), dtype=np.float64)
        ride = ride_of_columns(times, named, sport=SPORTS.get(sport or -1))
        if ride is not None:
            rides.append(ride)
    if not rides:
        return None
    return Outcome(COMPLETE, tuple(rides), completeness=1.0)


def only_number(values: Values | None) -> int | None:
    """The number all sessions agree on, None when they do not: a triathlon has no one sport."""
    if values is None:
        return None
    there = np.unique(values[np.isfinite(values)])
    return int(there[0]) if len(there) == 1 else None


def salvage(data: bytes) -> Salvage:
    """Everything chiptime can find, behind damage too."""
    from chiptime import iter_frames
    from chiptime.decode import Decoder
    from chiptime.errors import Defect
    from chiptime.frames import DataFrame, DefinitionFrame, FileHeader, SkippedBytes

    found = Salvage()
    decoder = Decoder()
    # The decoder knows a definition by its address, which must not be given to another one.
    definitions: list[DefinitionFrame] = []
    for event in iter_frames(data):
        if isinstance(event, FileHeader):
            decoder = Decoder()
            found.parts.append(Part())
            found.expected_bytes += event.size + event.data_size + CHECKSUM_BYTES
        elif isinstance(event, DefinitionFrame):
            definitions.append(event)
        elif isinstance(event, SkippedBytes):
            found.skipped_bytes += event.length
        elif isinstance(event, Defect):
            found.troubles.append((event.code, event.offset))
        elif isinstance(event, DataFrame) and found.parts:
            found.read_until = event.offset + 1 + len(event.payload)
            if event.definition.global_num not in MESSAGES:
                continue
            message = decoder.decode(event)
            # The decoder keeps every message for its own report: a day's ride would not fit.
            decoder.out.messages.clear()
            take_message(found.parts[-1], message)
            if found.records > ROWS_MAX:
                found.too_many = True
                return found
    return found


def take_message(part: Part, message: object) -> None:
    """Keep what a message tells of the ride."""
    from chiptime.message import Message

    if not isinstance(message, Message):
        return
    if message.name == "session":
        part.sports.add(str(message.get("sport")))
    if message.name != "record":
        return
    values = dict(numbers(message.fields))
    part.add(fit_time_s(message.get_raw("timestamp")), values)


def numbers(fields: dict[str, object]) -> Iterator[tuple[str, float]]:
    """The fields we know that are plain numbers."""
    for name in WANTED & fields.keys():
        value = getattr(fields[name], "value", None)
        if isinstance(value, int | float) and not isinstance(value, bool):
            yield name, float(value)


def fit_time_s(raw: object) -> float:
    """A FIT time -> Unix seconds; NaN for none."""
    return float(raw) + EPOCH_S if isinstance(raw, int | float) and raw else np.nan


def salvaged_outcome(data: bytes, found: Salvage) -> Outcome:
    """Rides, reason and completeness of what was salvaged."""
    if found.too_many:
        return rejected("too_many_rows", f"More than {ROWS_MAX} records; no ride is that long.")
    rides = tuple(ride for part in found.parts if (ride := part.ride()) is not None)
    code, reason, offset = first_trouble(found)
    if not rides:
        return nothing_saved(data, found, code, reason, offset)
    if code is None:
        return Outcome(COMPLETE, rides, completeness=1.0)
    share = completeness(data, found)
    rows = sum(len(ride.rows.times_us) for ride in rides)
    # Rounded down: a file that lacks a byte is not at 100 %.
    about = "" if share is None else f", about {floor(1000.0 * share) / 10.0} % of the file"
    where = "" if offset is None else f" at byte {offset} of {len(data)}"
    sentence = f"{reason[0].upper()}{reason[1:]}{where}. {rows} records were saved{about}."
    return Outcome(PARTIAL, rides, code, sentence, offset, share)


def first_trouble(found: Salvage) -> tuple[str | None, str, int | None]:
    """Code, reason and byte of the trouble that cost most: lost rows before doubtful ones."""
    ranked = sorted(
        (REASONS.get(code, ("damaged", "the file is damaged")), offset)
        for code, offset in found.troubles
    )
    for wanted in ("damaged", "truncated", "checksum_mismatch"):
        for (code, reason), offset in sorted(ranked, key=lambda entry: entry[1]):
            if code == wanted:
                return code, reason, offset
    return None, "", None


def completeness(data: bytes, found: Salvage) -> float | None:
    """Share of the file's bytes that were read as messages; None when its size is unknown."""
    expected = max(found.expected_bytes, len(data))
    if found.expected_bytes > DECLARED_RATIO_MAX * len(data):
        return None
    read = min(found.read_until + CHECKSUM_BYTES, len(data)) - found.skipped_bytes
    return min(max(read / expected, 0.0), 1.0)


def nothing_saved(
    data: bytes, found: Salvage, code: str | None, reason: str, offset: int | None
) -> Outcome:
    """Why there is no ride."""
    if found.records:
        return rejected(
            "no_valid_time", f"None of the {found.records} records has a believable time.", offset
        )
    if code is not None:
        where = "" if offset is None else f" at byte {offset} of {len(data)}"
        return rejected(
            "no_records",
            f"{reason[0].upper()}{reason[1:]}{where}, and no record was found.",
            offset,
        )
    return rejected("no_records", "The file holds no records: it is not an activity.")
