"""From the blocks of a unit's log to a ride.

A ride is the DATA of one log of one boot, put in order by block number, on a grid of its period:
what is missing is missing, never filled in. Its completeness is the share of its blocks that are
here; a log that the unit did not end has lost its last second or so with the power.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from backend.core.channels import MISSING_INT16, ChannelSpec
from backend.core.moments import set_by_us
from backend.core.ride import RideContext, RideRows
from backend.core.ride_events import (
    ASSIST_MODE,
    CLOCK_SET,
    EVENTS_MAX,
    FAULT_CLEARED,
    FAULT_SET,
    SETTINGS,
    EventKind,
    RideEvent,
    settings_changes,
)
from backend.core.unit_key import ebl_key
from backend.formats.blocks import (
    CONFIG,
    CONFIG_REST,
    DATA,
    END,
    EVENT,
    EVENT_FIELDS,
    EVENT_FLAGS_HIGH,
    HOST_SEQ,
    SCHEMA,
    SYNC,
    SYNC_FIELDS,
    VERSION,
    Block,
    Scan,
    scan,
)
from backend.formats.columns import LATEST_S
from backend.formats.fit_numbers import EPOCH_S
from backend.formats.outcome import COMPLETE, PARTIAL, ImportedRide, Outcome, rejected
from firmware_protocol._generated import CHANNELS, PARAMETER_BY_NAME, LogEvent
from firmware_protocol.layout import HALF_BITS

CONFIG_HEAD = struct.Struct("<12s8sII")
REST_HEAD = struct.Struct("<I")
SCHEMA_HEAD = struct.Struct("<IB")
SCHEMA_CHANNEL = struct.Struct("<Bf")
GEAR_RATIO = struct.Struct("<f")
END_FIELDS = struct.Struct("<IIB")
# Behind the reason; a log of an older unit ends before it.
END_EVENTS_LOST = struct.Struct("<I")
# A day and more of 10 Hz, and the bound of every other format.
ROWS_MAX = 2_000_000
LOGS_MAX = 64
# No ride lasts longer; a clock that says so is wrong.
SPAN_S_MAX = 7 * 86_400
PERIOD_US_MIN = 1_000
PERIOD_US_MAX = 60_000_000
EVENT_KINDS: dict[int, EventKind] = {
    LogEvent.FAULT_SET: FAULT_SET,
    LogEvent.FAULT_CLEARED: FAULT_CLEARED,
    LogEvent.ASSIST_MODE: ASSIST_MODE,
}
REGISTERED = {channel.id: channel for channel in CHANNELS}

Rows16 = npt.NDArray[np.int16]


@dataclass(frozen=True)
class Group:
    """A SCHEMA: channels that are recorded together, and how often."""

    period_us: int
    channels: tuple[ChannelSpec, ...]


@dataclass(frozen=True)
class LogRide:
    """What one log became. complete_share: of its blocks, those present; ended: by the unit."""

    ride: ImportedRide | None
    complete_share: float
    ended: bool


def read_blocks(data: bytes) -> Outcome:
    """A file of blocks -> what came of it. Never raises on any bytes."""
    scanned = scan(data)
    logs: dict[tuple[int, int], dict[int, Block]] = {}
    for block in scanned.blocks:
        if block.version == VERSION and block.log_id:
            # The first of equals: a log fetched twice into one file is one log.
            logs.setdefault((block.boot_id, block.log_id), {}).setdefault(block.seq, block)
    if len(logs) > LOGS_MAX:
        return rejected("damaged", f"The file names {len(logs)} logs; at most {LOGS_MAX} are read.")
    results = [ride_of_log([blocks[key] for key in sorted(blocks)]) for blocks in logs.values()]
    rides = tuple(result.ride for result in results if result.ride is not None)
    if not rides:
        return rejected("no_records", "No block of the file holds rows that can be read.", 0)
    return concluded(scanned, results, rides)


def concluded(
    scanned: Scan, results: Sequence[LogRide], rides: tuple[ImportedRide, ...]
) -> Outcome:
    """The outcome of the logs of a file."""
    complete_share = min(result.complete_share for result in results)
    if scanned.damaged or complete_share < 1.0:
        detail = f"{complete_share:.1%} of the log's blocks are here"
        if scanned.damaged:
            detail += f"; {scanned.damaged} bytes from byte {scanned.first_damage} on are damaged"
        return Outcome(
            PARTIAL, rides, "damaged", f"{detail}.", scanned.first_damage, complete_share
        )
    if not all(result.ended for result in results):
        detail = (
            "The log has no end. The unit lost its power before it was closed, and at most a "
            "second is missing; or only its beginning was fetched."
        )
        return Outcome(PARTIAL, rides, "truncated", detail, None, complete_share)
    return Outcome(COMPLETE, rides, completeness=1.0)


def ride_of_log(blocks: Sequence[Block]) -> LogRide:
    """One log's blocks in the order of their numbers -> its ride."""
    own = [block for block in blocks if block.seq != HOST_SEQ]
    ends = [block for block in own if block.type == END and len(block.payload) >= END_FIELDS.size]
    highest = max((block.seq for block in own), default=0)
    complete_share = len(own) / (highest + 1)
    notes: list[str] = []
    context = context_of(own, notes)
    read = [(group, block) for block, group in grouped(own, notes) if group is not None]
    if not read:
        return LogRide(None, complete_share, bool(ends))
    group = most_rows(read, notes)
    mine = [block for one, block in read if one == group]
    laid = laid_out(group, mine, notes)
    if laid is None:
        return LogRide(None, complete_share, bool(ends))
    t0_us, rows = laid
    if ends:
        notes += lost_in_the_unit(ends[-1].payload)
    started_us = start_of(blocks, t0_us)
    if started_us is None:
        notes.append("the unit had no clock: when it was ridden is not known")
    ride = ImportedRide(
        started_us=started_us or 0,
        period_us=group.period_us,
        rows=rows,
        notes=tuple(notes),
        context=replace(context, boot_id=mine[0].boot_id, unit_t0_us=t0_us),
        start_known=started_us is not None,
        events=tuple(events_of(own, t0_us, int(rows.times_us[-1]))),
    )
    return LogRide(ride, complete_share, bool(ends))


def lost_in_the_unit(payload: bytes) -> list[str]:
    """What an END block says that the unit itself could not keep, in words."""
    notes = []
    if rows := END_FIELDS.unpack_from(payload)[1]:
        notes.append(f"the unit's flash was too slow for {rows} rows since it was switched on")
    if len(payload) >= END_FIELDS.size + END_EVENTS_LOST.size:
        (events,) = END_EVENTS_LOST.unpack_from(payload, END_FIELDS.size)
        if events:
            notes.append(f"{events} events came too fast to be kept since it was switched on")
    return notes


def context_of(blocks: Sequence[Block], notes: list[str]) -> RideContext:
    """Unit and configuration from the first CONFIG block; empty where there is none."""
    configs = [b for b in blocks if b.type == CONFIG and len(b.payload) >= CONFIG_HEAD.size]
    if not configs:
        notes.append("which unit it was is not known: no configuration block is whole")
        return RideContext()
    payload = configs[0].payload
    uid, _schema_hash, generation, crc32 = CONFIG_HEAD.unpack_from(payload)
    image = payload[CONFIG_HEAD.size :] + rest_of_image(blocks, crc32)
    gear_ratio = gear_ratio_in(image) if zlib.crc32(image) == crc32 else None
    return RideContext(
        unit_key=ebl_key(uid.hex()),
        device_serial=uid.hex(),
        config_generation=generation,
        config_crc32=crc32,
        gear_ratio=gear_ratio,
    )


def rest_of_image(blocks: Sequence[Block], crc32: int) -> bytes:
    """What of this configuration's image a CONFIG block had no room for; nothing of a short one."""
    head = REST_HEAD.pack(crc32)
    rests = (b.payload for b in blocks if b.type == CONFIG_REST)
    return next((payload[len(head) :] for payload in rests if payload.startswith(head)), b"")


def gear_ratio_in(image: bytes) -> float | None:
    """The gear ratio of a configuration, of an earlier version's too.

    Its place is the same in all of them: parameters of later versions follow by id.
    """
    row = PARAMETER_BY_NAME["gear_ratio"]
    if len(image) < row.image_offset + row.size or row.min is None or row.max is None:
        return None
    (ratio,) = GEAR_RATIO.unpack_from(image, row.image_offset)
    # Seven digits are what a float32 has: 40.34, not 40.3400001.
    return float(f"{ratio:.7g}") if row.min <= ratio <= row.max else None


def grouped(blocks: Sequence[Block], notes: list[str]) -> list[tuple[Block, Group | None]]:
    """Each DATA block with the SCHEMA before it, or the next one where that is lost."""
    schemas: dict[int, list[tuple[int, Group]]] = {}
    for block in blocks:
        if block.type == SCHEMA and (group := group_of(block.payload)) is not None:
            schemas.setdefault(block.schema_id, []).append((block.seq, group))
    pairs: list[tuple[Block, Group | None]] = []
    unread = 0
    for block in blocks:
        if block.type != DATA:
            continue
        schema_groups = schemas.get(block.schema_id, [])
        before = [group for seq, group in schema_groups if seq < block.seq]
        group = before[-1] if before else (schema_groups[0][1] if schema_groups else None)
        if group is not None and len(block.payload) != 2 * block.n * len(group.channels):
            group = None
        unread += group is None
        pairs.append((block, group))
    if unread:
        notes.append(f"{unread} blocks of rows cannot be read: what they hold is not described")
    return pairs


def group_of(payload: bytes) -> Group | None:
    """The SCHEMA in a payload, None when it makes no sense."""
    if len(payload) < SCHEMA_HEAD.size:
        return None
    period_us, count = SCHEMA_HEAD.unpack_from(payload)
    body = payload[SCHEMA_HEAD.size : SCHEMA_HEAD.size + count * SCHEMA_CHANNEL.size]
    if not PERIOD_US_MIN <= period_us <= PERIOD_US_MAX or count == 0:
        return None
    if len(body) != count * SCHEMA_CHANNEL.size:
        return None
    rows = list(SCHEMA_CHANNEL.iter_unpack(body))
    ids = [channel_id for channel_id, _ in rows]
    scales = [scale for _, scale in rows]
    if len(set(ids)) != len(ids) or not all(math.isfinite(s) and s > 0 for s in scales):
        return None
    return Group(period_us, tuple(channel_of(*row) for row in rows))


def channel_of(channel_id: int, scale: float) -> ChannelSpec:
    """A channel by its id: names never change, a scale is the one the counts were made with."""
    shortest = float(str(np.float32(scale)))
    registered = REGISTERED.get(channel_id)
    if registered is None:
        return ChannelSpec(f"channel_{channel_id}", "", shortest)
    return ChannelSpec(registered.name, registered.unit, shortest)


def most_rows(read: Sequence[tuple[Group, Block]], notes: list[str]) -> Group:
    """The group with the most rows; a ride has one."""
    rows: dict[Group, int] = {}
    for group, block in read:
        rows[group] = rows.get(group, 0) + block.n
    if len(rows) > 1:
        notes.append(f"{len(rows) - 1} other groups of channels are kept in the original only")
    return max(rows, key=lambda group: rows[group])


def laid_out(
    group: Group, blocks: Sequence[Block], notes: list[str]
) -> tuple[int, RideRows] | None:
    """Blocks on a grid of the group's period -> unit time of the first row, and rows.

    None when nothing believable is left.
    """
    middle_us = int(np.median(np.array([block.t0_us for block in blocks], dtype=np.float64)))
    span_us = int(SPAN_S_MAX * 1e6)
    near = [b for b in blocks if b.n > 0 and abs(b.t0_us - middle_us) < span_us]
    if len(near) < len(blocks):
        notes.append(f"{len(blocks) - len(near)} blocks without a believable time were left out")
    if not near:
        return None
    t0_us = min(block.t0_us for block in near)
    firsts = [round((block.t0_us - t0_us) / group.period_us) for block in near]
    count = max(first + block.n for first, block in zip(firsts, near, strict=True))
    if count > ROWS_MAX:
        notes.append(f"rows after the first {ROWS_MAX} were left out")
        count = ROWS_MAX
    width = len(group.channels)
    grid: Rows16 = np.full((count, width), MISSING_INT16, np.int16)
    for first, block in zip(firsts, near, strict=True):
        rows = np.frombuffer(block.payload, "<i2").reshape(block.n, width)[: max(0, count - first)]
        grid[first : first + len(rows)] = rows
    times_us = np.arange(count, dtype=np.int64) * group.period_us
    counts = {
        channel.name: np.ascontiguousarray(grid[:, index])
        for index, channel in enumerate(group.channels)
    }
    return t0_us, RideRows(group.channels, times_us, counts)


def events_of(blocks: Sequence[Block], t0_us: int, length_us: int) -> list[RideEvent]:
    """What EVENT blocks tell of the ride that begins at unit time `t0_us`, which settings were in
    force by its CONFIG blocks, and when its clock was set; in order of time."""
    events: list[RideEvent] = []
    for block in blocks:
        if block.type != EVENT:
            continue
        for t_us, code, value in events_in(block):
            kind = EVENT_KINDS.get(code)
            if kind is not None and 0 <= t_us - t0_us <= length_us:
                events.append(RideEvent((t_us - t0_us) / 1e6, kind, value))
    events = sorted(events, key=lambda event: event.t_s)[:EVENTS_MAX]
    markers = [*settings_of(blocks, t0_us, length_us), *clock_of(blocks, t0_us, length_us)]
    return sorted([*events, *markers], key=lambda event: event.t_s)


def settings_of(blocks: Sequence[Block], t0_us: int, length_us: int) -> list[RideEvent]:
    """The changes of settings by the CONFIG blocks, which a unit writes again at each of them. What
    was changed before the ride was in force at its start."""
    settings = [
        RideEvent(max(0, block.t0_us - t0_us) / 1e6, SETTINGS, CONFIG_HEAD.unpack_from(config)[3])
        for block in blocks
        if block.type == CONFIG and len(config := block.payload) >= CONFIG_HEAD.size
    ]
    in_force = settings[0].value if settings else None
    return [event for event in settings_changes(settings, in_force) if event.t_s <= length_us / 1e6]


def events_in(block: Block) -> Iterator[tuple[int, int, int]]:
    """Time in us, code and flags or slot of each event of an EVENT block."""
    count = min(block.n, len(block.payload) // EVENT_FIELDS.size)
    rows = EVENT_FIELDS.iter_unpack(block.payload[: count * EVENT_FIELDS.size])
    highs = block.payload[count * EVENT_FIELDS.size :][: count * EVENT_FLAGS_HIGH.size]
    if len(highs) < count * EVENT_FLAGS_HIGH.size:
        highs = bytes(count * EVENT_FLAGS_HIGH.size)
    for (t_us, code, value), (high,) in zip(rows, EVENT_FLAGS_HIGH.iter_unpack(highs), strict=True):
        yield t_us, code, value | high << HALF_BITS


def starts_of(blocks: Sequence[Block], t0_us: int) -> list[tuple[int, int]]:
    """By each believable SYNC, in their order: its unit time, and the Unix time of `t0_us`."""
    starts = []
    for block in blocks:
        if block.type == SYNC and len(block.payload) >= SYNC_FIELDS.size:
            unix_us, _ = SYNC_FIELDS.unpack_from(block.payload)
            started_us = int(unix_us) - (block.t0_us - t0_us)
            if EPOCH_S * 1e6 < started_us < LATEST_S * 1e6:
                starts.append((block.t0_us, started_us))
    return starts


def start_of(blocks: Sequence[Block], t0_us: int) -> int | None:
    """Unix time of unit time `t0_us`, None where no SYNC tells it.

    The unit's last SYNC: its clock was set again where the clock of its host was set. What
    the host appended later counts only without one.
    """
    own = starts_of([block for block in blocks if block.seq != HOST_SEQ], t0_us)
    starts = own or starts_of(blocks, t0_us)[:1]
    return starts[-1][1] if starts else None


def clock_of(blocks: Sequence[Block], t0_us: int, length_us: int) -> list[RideEvent]:
    """When the unit's clock was set to another time, by its SYNC blocks."""
    return [
        RideEvent(min(max(0, t_us - t0_us), length_us) / 1e6, CLOCK_SET, round(by_us / 1000))
        for (_, before_us), (t_us, after_us) in pairwise(starts_of(blocks, t0_us))
        if (by_us := set_by_us(before_us, after_us))
    ]
