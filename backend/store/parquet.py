"""A finished ride as a Parquet file: raw counts, missing as null, the scale in the schema.

The settings are measured. No dictionaries, and for each channel the encoding that makes a sample
of it smallest: deltas for what is noisy, plain or split bytes for what holds its value between
pulses. On a 12 channel ride that is 6.0 bytes a row where deltas for all give 7.1 and pyarrow's
own choice 11. Row groups of 16384 rows keep a one-minute window under two milliseconds, and page
checksums turn silent damage into an error.
pyarrow is loaded on first use: it costs some 60 MB, which an idle server need not hold.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from backend.core.channels import ChannelSpec, Counts
from backend.core.ride import RideRows, TimesUs
from backend.errors import StoreError
from backend.store.pipe import Pipe

ROW_GROUP_ROWS = 16384
COMPRESSION_LEVEL = 9
ENCODINGS = ("DELTA_BINARY_PACKED", "PLAIN", "BYTE_STREAM_SPLIT")
TIME_COLUMN = "t_us"
SCHEMA_VERSION = 2
FACTS_KEY = b"spindle"
EXPORT_KEY = b"spindle-export"


@dataclass(frozen=True)
class Span:
    """Rows [start, stop) of one row group."""

    group: int
    start: int
    stop: int


def arrow() -> tuple[Any, Any]:
    """pyarrow and its Parquet part, loaded on first use.

    The system's allocator gives memory back; pyarrow's own kept 20 MB more after a two-hour ride.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    pa.set_memory_pool(pa.system_memory_pool())
    return pa, pq


def write_rows(
    path: Path,
    channels: Sequence[ChannelSpec],
    chunks: Iterable[RideRows],
    facts: Mapping[str, object],
    sample: RideRows | None = None,
    draft: bool = False,
) -> int:
    """Write rows to a new Parquet file, one row group at a time; returns the number of rows.

    facts: plain JSON kept in the file's metadata, so that a file alone tells what it is. sample:
    rows typical of the ride, by which each channel's encoding is chosen. The same rows, facts and
    sample give the same bytes. draft: quick rather than small. Raises StoreError when the disk
    refuses.
    """
    pa, pq = arrow()
    encodings = dict.fromkeys([TIME_COLUMN, *(c.name for c in channels)], ENCODINGS[0])
    if sample is not None:
        encodings |= {channel.name: best_encoding(channel, sample) for channel in channels}
    schema = ride_schema(channels, facts)
    written = 0
    try:
        with pq.ParquetWriter(
            path,
            schema,
            compression="none" if draft else "zstd",
            compression_level=None if draft else COMPRESSION_LEVEL,
            use_dictionary=False,
            column_encoding=encodings,
            write_page_checksum=True,
            write_statistics=False,
        ) as writer:
            for rows in regrouped(channels, chunks):
                columns = [pa.array(rows.times_us)] + [
                    pa.array(counts, mask=counts == channel.missing)
                    for channel in channels
                    for counts in (rows.counts[channel.name],)
                ]
                writer.write_table(
                    pa.Table.from_arrays(columns, schema=schema), row_group_size=ROW_GROUP_ROWS
                )
                written += len(rows.times_us)
    except pa.ArrowException as error:
        raise StoreError(f"The ride was not written to {path.name}: {error}") from error
    return written


def physical_chunks(
    started_us: int,
    names: Mapping[str, str],
    facts: Mapping[str, object],
    rows_of_ride: Iterable[RideRows],
) -> Iterator[bytes]:
    """A ride for others as Parquet: `time_utc`, `t_s`, then channels in their own units as doubles.

    started_us: Unix time of the first row. names: what each channel is called in the file, in
    order. facts: plain JSON, kept under a key of its own, as this is no object of a store. Missing
    is null; a column's metadata tells its unit.
    """
    pa, pq = arrow()
    file, writer = Pipe(), None
    for rows in rows_of_ride:
        if writer is None:
            units = {channel.name: channel.unit for channel in rows.channels}
            schema = pa.schema(
                [
                    pa.field("time_utc", pa.timestamp("us", tz="UTC"), nullable=False),
                    pa.field("t_s", pa.float64(), nullable=False, metadata={"unit": "s"}),
                    *(
                        pa.field(written_name, pa.float64(), metadata={"unit": units[name]})
                        for name, written_name in names.items()
                    ),
                ],
                metadata={EXPORT_KEY: json.dumps(facts, sort_keys=True)},
            )
            writer = pq.ParquetWriter(
                file, schema, compression="zstd", use_dictionary=False, write_page_checksum=True
            )
        values = {c.name: c.to_values(rows.counts[c.name]) for c in rows.channels}
        columns = [
            pa.array(started_us + rows.times_us, pa.timestamp("us", tz="UTC")),
            pa.array(rows.times_us / 1e6),
            *(pa.array(values[name], mask=np.isnan(values[name])) for name in names),
        ]
        writer.write_table(pa.Table.from_arrays(columns, schema=writer.schema))
        yield file.taken()
    if writer is not None:
        writer.close()
        yield file.taken()
    release_memory()


def best_encoding(channel: ChannelSpec, sample: RideRows) -> str:
    """The encoding that makes the sample of a channel smallest."""
    pa, pq = arrow()
    counts = sample.counts[channel.name]
    table = pa.table({channel.name: pa.array(counts, mask=counts == channel.missing)})

    def size(encoding: str) -> int:
        sink = pa.BufferOutputStream()
        pq.write_table(
            table,
            sink,
            compression="zstd",
            compression_level=COMPRESSION_LEVEL,
            use_dictionary=False,
            column_encoding={channel.name: encoding},
            write_statistics=False,
        )
        return int(sink.tell())

    return min(ENCODINGS, key=size)


def ride_schema(channels: Sequence[ChannelSpec], facts: Mapping[str, object]) -> Any:
    """The Arrow schema of a ride: time, then a column for each channel."""
    pa, _ = arrow()
    fields = [pa.field(TIME_COLUMN, pa.int64(), nullable=False, metadata={"unit": "us"})]
    for channel in channels:
        kind = pa.int32() if channel.wide else pa.int16()
        about = {"unit": channel.unit, "scale": repr(channel.scale)}
        fields.append(pa.field(channel.name, kind, metadata=about))
    text = json.dumps({"schema_version": SCHEMA_VERSION, **facts}, sort_keys=True)
    return pa.schema(fields, metadata={FACTS_KEY: text})


def read_facts(path: Path) -> tuple[dict[str, Any], tuple[ChannelSpec, ...], int]:
    """What a ride's file says of itself: its facts, its columns as channels, its rows.

    Raises StoreError when it is no ride's file.
    """
    pa, pq = arrow()
    try:
        footer = pq.read_metadata(path)
        schema = footer.schema.to_arrow_schema()
        facts = json.loads(footer.metadata[FACTS_KEY])
        channels = tuple(
            ChannelSpec(
                field.name,
                field.metadata[b"unit"].decode(),
                float(field.metadata[b"scale"]),
                wide=field.type == pa.int32(),
            )
            for field in schema
            if field.name != TIME_COLUMN
        )
    except (OSError, pa.ArrowException, KeyError, TypeError, ValueError) as error:
        raise StoreError(f"{path.name} is no ride's file: {error}") from error
    return facts, channels, int(footer.num_rows)


def regrouped(channels: Sequence[ChannelSpec], chunks: Iterable[RideRows]) -> Iterable[RideRows]:
    """The same rows in chunks of exactly one row group, the last one shorter."""
    waiting: list[RideRows] = []
    count = 0
    for chunk in chunks:
        waiting.append(chunk)
        count += len(chunk.times_us)
        if count < ROW_GROUP_ROWS:
            continue
        combined = joined(channels, waiting)
        cut = count - count % ROW_GROUP_ROWS
        for start in range(0, cut, ROW_GROUP_ROWS):
            yield sliced(combined, start, start + ROW_GROUP_ROWS)
        waiting, count = [sliced(combined, cut, count)], count - cut
    if count:
        yield joined(channels, waiting)


def joined(channels: Sequence[ChannelSpec], parts: Sequence[RideRows]) -> RideRows:
    """Rows of all parts, one after the other."""
    return RideRows(
        channels=tuple(channels),
        times_us=np.concatenate([part.times_us for part in parts]),
        counts={
            channel.name: np.concatenate([part.counts[channel.name] for part in parts])
            for channel in channels
        },
    )


def sliced(rows: RideRows, start: int, stop: int) -> RideRows:
    """Rows [start, stop)."""
    return RideRows(
        rows.channels,
        rows.times_us[start:stop],
        {name: counts[start:stop] for name, counts in rows.counts.items()},
    )


def release_memory() -> None:
    """Give back what pyarrow keeps for its next file: an idle server has no use for it."""
    pa, _ = arrow()
    pa.default_memory_pool().release_unused()


class RideFile:
    """A ride's Parquet file, its footer read once. Safe to use from several threads."""

    def __init__(self, path: Path, channels: Sequence[ChannelSpec]) -> None:
        pa, pq = arrow()

        self._path = path
        self._channels = {channel.name: channel for channel in channels}
        try:
            self._footer: Any = pq.read_metadata(path)
        except (OSError, pa.ArrowException) as error:
            raise StoreError(f"The ride's object {path.name} cannot be read: {error}") from error
        self.row_count = int(self._footer.num_rows)

    def times_us(self, start: int, stop: int) -> TimesUs:
        """Times of rows [start, stop), int64 microseconds since the ride's start."""
        times: TimesUs = self._read([TIME_COLUMN], start, stop)[TIME_COLUMN].to_numpy()
        return times

    def counts(self, names: Sequence[str], start: int, stop: int) -> dict[str, Counts]:
        """Counts of rows [start, stop) by channel name, missing as the channel's `missing`."""
        if not names:
            return {}
        table = self._read(list(names), start, stop)
        columns: dict[str, Counts] = {}
        for name in names:
            column = table[name]
            if column.null_count:
                column = column.fill_null(self._channels[name].missing)
            columns[name] = column.to_numpy()
        return columns

    def verify(self) -> None:
        """Read every page. Raises StoreError when one is damaged."""
        columns = [TIME_COLUMN, *self._channels]
        for start in range(0, self.row_count, ROW_GROUP_ROWS):
            self._read(columns, start, start + ROW_GROUP_ROWS)

    def _read(self, columns: list[str], start: int, stop: int) -> Any:
        """The table of rows [start, stop); every page's checksum is verified."""
        pa, pq = arrow()

        last = max(start, stop - 1)
        groups = range(start // ROW_GROUP_ROWS, last // ROW_GROUP_ROWS + 1)
        try:
            with pq.ParquetFile(
                self._path,
                metadata=self._footer,
                page_checksum_verification=True,
                pre_buffer=False,
            ) as file:
                present = [group for group in groups if group < file.num_row_groups]
                table = file.read_row_groups(present, columns=columns, use_threads=False)
        except (OSError, pa.ArrowException) as error:
            raise StoreError(
                f"The ride's object {self._path.name} is damaged: {error}. "
                "Restore it from a backup; the rows were not shown."
            ) from error
        return table.slice(start - groups.start * ROW_GROUP_ROWS, stop - start)
