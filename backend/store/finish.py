"""From rows to a finished ride's object: a draft, the figures, the file, and the file read back.

The file says of the ride what its rows say, so the rows come first, as a draft that is quick to
write and to read. Reading the file back is on purpose: what the ride shows from now on was really
on the disk, with every page's checksum verified.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace

from backend.core.channels import ChannelSpec, Counts
from backend.core.ride import Ride, RideRows, TimesUs
from backend.store.digest import Digest, digest
from backend.store.facts import facts_of
from backend.store.objects import RIDE_SUFFIX, Objects, content_key, file_sha256
from backend.store.parquet import ROW_GROUP_ROWS, RideFile, write_rows
from backend.store.reader import RowSource

# Rows by which a ride's encodings are chosen.
SAMPLE_ROWS = ROW_GROUP_ROWS


@dataclass(frozen=True)
class WrittenObject:
    """A ride's object, safely on the disk, and what is computed from it."""

    key: str
    sha256: str
    size_bytes: int
    row_count: int
    digest: Digest
    completeness: float | None


class RowsInMemory:
    """Rows as a source of rows."""

    def __init__(self, rows: RideRows) -> None:
        self._rows = rows

    @property
    def row_count(self) -> int:
        return len(self._rows.times_us)

    def times_us(self, start: int, stop: int) -> TimesUs:
        return self._rows.times_us[start:stop]

    def counts(self, names: Sequence[str], start: int, stop: int) -> dict[str, Counts]:
        return {name: self._rows.counts[name][start:stop] for name in names}


@contextmanager
def drafted(
    objects: Objects, channels: tuple[ChannelSpec, ...], chunks: Iterable[RideRows]
) -> Iterator[RideFile]:
    """Rows that come once, in a file beside the objects that can be read again and again."""
    staged = objects.stage()
    try:
        write_rows(staged, channels, chunks, {}, draft=True)
        yield RideFile(staged, channels)
    finally:
        staged.unlink(missing_ok=True)


def write_object(
    objects: Objects, ride: Ride, source: RowSource, counted: bool, more: Mapping[str, object]
) -> WrittenObject:
    """Write a ride's rows as an object under its content's hash. Safe to repeat: the same rows and
    the same facts are the same object.

    counted: the rows tell how complete the ride is, else the ride does. more: facts that neither
    the ride nor its rows tell. Raises StoreError.
    """
    found = digest(source, ride)
    completeness = 1.0 - found.rows_empty / source.row_count if counted else ride.completeness
    middle = max(0, source.row_count // 2 - SAMPLE_ROWS // 2)
    sample = rows_of(source, ride.channels, middle, middle + SAMPLE_ROWS)
    told = replace(
        ride,
        gaps=found.gaps,
        events=found.events,
        summary=found.summary,
        completeness=completeness,
    )
    facts = {**facts_of(told), **more}
    staged = objects.stage()
    try:
        with objects.watch.writing("objects", f"Ride {ride.id} was not written"):
            chunks = chunks_of(source, ride.channels)
            rows = write_rows(staged, ride.channels, chunks, facts, sample)
        RideFile(staged, ride.channels).verify()
        sha256, size = file_sha256(staged), staged.stat().st_size
        key = content_key("rides", sha256, RIDE_SUFFIX)
        objects.publish(staged, key)
    finally:
        staged.unlink(missing_ok=True)
    return WrittenObject(key, sha256, size, rows, found, completeness)


def rows_of(
    source: RowSource, channels: tuple[ChannelSpec, ...], start: int, stop: int
) -> RideRows:
    """Rows [start, stop), or up to the end."""
    end = min(stop, source.row_count)
    counts = source.counts([channel.name for channel in channels], start, end)
    return RideRows(channels, source.times_us(start, end), counts)


def chunks_of(source: RowSource, channels: tuple[ChannelSpec, ...]) -> Iterator[RideRows]:
    """All rows, a row group at a time."""
    for start in range(0, source.row_count, ROW_GROUP_ROWS):
        yield rows_of(source, channels, start, start + ROW_GROUP_ROWS)
