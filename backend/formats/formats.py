"""Which kind of file it is, by its contents first and its name last; the table of readers."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from backend.formats.blocks import BLOCKS_SUFFIX, looks_like_blocks
from backend.formats.containers.gz import (
    GZIP,
    INFLATED_BYTES_MAX,
    TooLarge,
    inflate,
    inflated_head,
    inner_name,
)
from backend.formats.fit import HEADER_SIZES, MAGIC, read_fit
from backend.formats.mahle import looks_like_mahle, read_mahle
from backend.formats.outcome import PARTIAL, REJECTED, Outcome, rejected
from backend.formats.questions import TableAnswer
from backend.formats.ride_logs import read_blocks
from backend.formats.tables import looks_like_table, read_table
from backend.formats.tables.layouts import only_times
from backend.formats.tracks import read_gpx, read_tcx
from backend.formats.tracks.walk import as_utf8

SNIFFED_BYTES = 4096

ZIP_STARTS = (b"PK\x03\x04", b"PK\x05\x06")
# First bytes -> what people call it.
SIGNATURES: tuple[tuple[bytes, str], ...] = (
    (b"PK\x03\x04", "a ZIP archive"),
    (b"7z\xbc\xaf", "a 7z archive"),
    (b"\x28\xb5\x2f\xfd", "a zstd archive"),
    (b"\x89PNG", "a PNG image"),
    (b"\xff\xd8\xff", "a JPEG image"),
    (b"GIF8", "a GIF image"),
    (b"%PDF", "a PDF document"),
    (b"\x7fELF", "a program (ELF)"),
    (b"MZ", "a program (EXE)"),
    (b"SQLite format 3", "an SQLite database"),
    (b"PAR1", "a Parquet file"),
    (b"ULog", "a ULog flight log"),
)
MARKUP: tuple[tuple[bytes, str], ...] = (
    (b"<!doctype html", "an HTML page: perhaps an error page saved instead of the file"),
    (b"<html", "an HTML page: perhaps an error page saved instead of the file"),
    (b"<?xml", "an XML document"),
)
ADVICE = (
    "Spindle reads FIT, GPX, TCX, CSV, the JSON of Mahle's My SmartBike and its units' own logs; "
    "export the ride as one of these."
)

# A track by its root element, whatever prefix that has.
GPX_ROOT = re.compile(rb"<(?:[\w.-]+:)?gpx[\s>]")
TCX_ROOT = re.compile(rb"<(?:[\w.-]+:)?TrainingCenterDatabase[\s>]")

Reader = Callable[[bytes], Outcome]


def read_file(name: str, data: bytes, answer: TableAnswer | None = None) -> Outcome:
    """A file -> what came of it. Never raises on any bytes or name.

    answer: what its owner said of a table that does not say it.
    """
    if not data:
        return rejected("empty_file", "The file is empty.", 0)
    if data.startswith(GZIP):
        return read_gzip(name, data, answer)
    reader = reader_for(name, data[:SNIFFED_BYTES])
    if reader is None:
        return refusal(name, data[:SNIFFED_BYTES])
    if reader is read_table:
        return read_table(data, name, answer)
    if reader is read_mahle or reader is read_tcx:
        return reader(data, answer)
    return reader(data)


def read_gzip(name: str, data: bytes, answer: TableAnswer | None = None) -> Outcome:
    """The one file within a gzip file; `partial` where not all of it came out."""
    try:
        inflated = inflate(data)
    except TooLarge:
        sentence = f"It becomes more than {INFLATED_BYTES_MAX >> 20} MB, which no ride has."
        return rejected("expands_too_much", sentence)
    if inflated.data.startswith(GZIP):
        return rejected("nested_too_deep", "A gzip file within a gzip file: unpack it first.", 0)
    if not inflated.data and inflated.error:
        return rejected("container_damaged", inflated.error)
    outcome = read_file(inner_name(name), inflated.data, answer)
    if inflated.error is None or outcome.state == REJECTED:
        return outcome
    detail = f"{inflated.error} {outcome.detail or ''}".strip()
    code = outcome.code or "container_damaged"
    return replace(outcome, state=PARTIAL, code=code, detail=detail)


def refused_by_head(name: str, head: bytes) -> Outcome | None:
    """Why a file is no ride, told by its first SNIFFED_BYTES; None when a reader must look."""
    if is_archive(head):
        return None
    if head.startswith(GZIP):
        inner = inflated_head(head, SNIFFED_BYTES)
        other_kind = bool(inner) and not inner.startswith(GZIP)
        return refused_by_head(inner_name(name), inner) if other_kind else None
    return None if reader_for(name, head) is not None else refusal(name, head)


def refusal(name: str, head: bytes) -> Outcome:
    """Why nobody reads a file."""
    kind = kind_of_head(head)
    if kind is not None:
        return rejected("unsupported_format", f"This is {kind}. {ADVICE}", 0)
    only = only_times(head)
    if only is not None:
        detail = f"The only column is {only}: times, and nothing that was measured at them."
        return rejected("no_records", detail, 0)
    if name.lower().endswith((".csv", ".txt", ".tsv")):
        names = "time, timestamp, time_utc, or t_s and secs for seconds from the start"
        return rejected("unknown_format", f"No line of its head names a time column ({names}).", 0)
    return rejected(
        "unknown_format",
        f"The first bytes ({head[:8].hex(' ')}) are of no ride format we know. {ADVICE}",
        0,
    )


def is_archive(head: bytes) -> bool:
    """Whether a file begins as a ZIP does, with files or without any."""
    return head.startswith(ZIP_STARTS)


def reader_for(name: str, head: bytes) -> Reader | None:
    """The reader of a file by its first SNIFFED_BYTES, None when there is none."""
    if head[8:12] == MAGIC:
        return read_fit
    if looks_like_blocks(head) or name.lower().endswith(BLOCKS_SUFFIX):
        return read_blocks
    track = track_reader(head)
    if track is not None:
        return track
    if looks_like_mahle(head):
        return read_mahle
    if kind_of_head(head) is None:
        if looks_like_table(head):
            return read_table
        named_fit = name.lower().endswith(".fit")
        if MAGIC in head or (named_fit and head[:1] in map(int.to_bytes, HEADER_SIZES)):
            return read_fit
    return None


def track_reader(head: bytes) -> Reader | None:
    """The reader of an XML file of points, by its root element; None for other files."""
    text = as_utf8(head).lstrip()
    if not text.startswith(b"<"):
        return None
    if GPX_ROOT.search(text):
        return read_gpx
    return read_tcx if TCX_ROOT.search(text) else None


def kind_of_head(head: bytes) -> str | None:
    """What the file is when it is something well known that is not a ride."""
    for signature, kind in SIGNATURES:
        if head.startswith(signature):
            return kind
    head = head.lstrip(b"\xef\xbb\xbf \t\r\n").lower()
    for mark, kind in MARKUP:
        if head.startswith(b"<") and mark in head:
            return kind
    return "a JSON document" if head.startswith((b"{", b"[")) else None
