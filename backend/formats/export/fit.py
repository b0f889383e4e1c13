"""A ride as a FIT activity that bike computers' sites take: a record a second.

The rider's power is `power`, the motor's `motor_power`: the two are never one number. What the
profile has no field for (torque, current, voltage, gain) are developer fields, float32 in their own
unit, because readers differ about developer fields with a scale. After Garmin's public description
of the format and profile 21.218.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from fastcrc import crc16

from backend.core.breaks import DISTANCE
from backend.core.channels import Values
from backend.core.energy import DEMANDED, KMH_PER_MS, MOTOR_POWER, MOTOR_TORQUE, RIDER_POWER
from backend.core.ride import Ride
from backend.formats.export.seconds import SECOND_US, BySecond
from backend.formats.fit_numbers import (
    ACTIVITY,
    BASE_TYPES,
    BYTES,
    DEVELOPER_DATA_ID,
    ENUM,
    EPOCH_S,
    EVENT,
    FIELD_DESCRIPTION,
    FILE_ID,
    FLOAT32,
    LAP,
    RECORD,
    SESSION,
    SINT8,
    SINT32,
    TEXT,
    TIMESTAMP,
    UINT8,
    UINT16,
    UINT32,
    UINT32Z,
)

TIME_CELL = (TIMESTAMP, UINT32)
ACTIVITY_FILE, DEVELOPMENT, CYCLING, E_BIKE_FITNESS = 4, 255, 2, 28
TIMER, LAP_EVENT, SESSION_EVENT, START, STOP, STOP_ALL = 0, 9, 8, 0, 1, 4


@dataclass(frozen=True)
class Native:
    """A field of the profile. raw = (value x factor + offset) x scale."""

    channel: str
    number: int
    base: int
    scale: float = 1.0
    offset: float = 0.0
    factor: float = 1.0


SEMICIRCLES = 2**31 / 180.0
NATIVE = (
    Native("latitude_deg", 0, SINT32, SEMICIRCLES),
    Native("longitude_deg", 1, SINT32, SEMICIRCLES),
    Native("altitude_m", 78, UINT32, 5, 500),
    Native("heart_rate_bpm", 3, UINT8),
    Native("cadence_rpm", 4, UINT8),
    Native(DISTANCE, 5, UINT32, 100),
    Native("speed_kmh", 73, UINT32, 1000, factor=1 / KMH_PER_MS),
    Native(RIDER_POWER.name, 7, UINT16),
    Native(MOTOR_POWER.name, 82, UINT16),
    Native("temperature_degc", 13, SINT8),
    Native("range_km", 117, UINT16),
    Native("battery_soc_pct", 118, UINT8),
    Native("assist_mode", 119, UINT8),
    Native("assist_level_pct", 120, UINT8),
)
# Channel -> name and unit of a developer field; our own importer knows them again.
DEVELOPER = {
    "rider_torque_nm": ("rider_torque", "Nm"),
    MOTOR_TORQUE: ("motor_torque", "Nm"),
    "motor_torque_demanded_nm": ("motor_torque_demanded", "Nm"),
    "motor_current_a": ("motor_current", "A"),
    "battery_current_a": ("battery_current", "A"),
    "battery_voltage_v": ("battery_voltage", "V"),
    "motor_temperature_degc": ("motor_temperature", "degC"),
    "fuzzy_gain": ("fuzzy_gain", ""),
}
CHANNELS = (*(one.channel for one in NATIVE), *DEVELOPER)

Cell = tuple[int, int, float | None]


def fit_file(ride: Ride, ridden: BySecond) -> bytes:
    """The ride as bytes of a FIT activity.

    ridden: of those of CHANNELS the ride has, at least one second. Raises nothing for any values:
    what a field cannot hold is missing in it.
    """
    own = {name: field for name, field in DEVELOPER.items() if name in ridden.values}
    if ride.motor_torque_meaning == DEMANDED and MOTOR_TORQUE in own:
        own[MOTOR_TORQUE] = DEVELOPER["motor_torque_demanded_nm"]
    start_s, end_s = int(ridden.unix_s[0]), int(ridden.unix_s[-1])
    body = [
        message(FILE_ID, [(0, ENUM, ACTIVITY_FILE), (1, UINT16, DEVELOPMENT), (2, UINT16, 0),
                          (4, UINT32, start_s - EPOCH_S)]),
        *descriptions(own),
        timer(start_s, START),
        records(ridden, own, pauses(ride, ridden)),
        timer(end_s, STOP_ALL),
        *summaries(ride, ridden, start_s, end_s),
    ]  # fmt: skip
    return enclosed(b"".join(body))


def descriptions(own: dict[str, tuple[str, str]]) -> list[bytes]:
    """What the developer fields mean."""
    if not own:
        return []
    messages = [defined(DEVELOPER_DATA_ID, [(1, 16, BYTES), (3, 1, UINT8)])]
    messages.append(b"\x00" + b"spindle-ride-fit"[:16] + b"\x00")
    fields = [(0, 1, UINT8), (1, 1, UINT8), (2, 1, UINT8), (3, 24, TEXT), (8, 8, TEXT)]
    messages.append(defined(FIELD_DESCRIPTION, fields))
    for number, (name, unit) in enumerate(own.values()):
        texts = name.encode().ljust(24, b"\0") + unit.encode().ljust(8, b"\0")
        messages.append(struct.pack("<BBBB", 0, 0, number, FLOAT32) + texts)
    return messages


def records(ridden: BySecond, own: dict[str, tuple[str, str]], breaks: list[int]) -> bytes:
    """A record a second; where the ride has a gap the timer stops before it and starts behind."""
    native = [one for one in NATIVE if one.channel in ridden.values]
    kinds = [("head", "u1"), ("time", "<u4")]
    kinds += [(one.channel, f"<{np.dtype(BASE_TYPES[one.base].code).str[1:]}") for one in native]
    kinds += [(f"own {name}", "<f4") for name in own]
    rows = np.zeros(len(ridden), dtype=kinds)
    rows["time"] = ridden.unix_s - EPOCH_S
    for one in native:
        rows[one.channel] = raw(one, ridden[one.channel])
    for name in own:
        rows[f"own {name}"] = ridden[name].astype(np.float32)
    head = struct.pack("<BBBHB", 0x60, 0, 0, RECORD, 1 + len(native))
    head += struct.pack("BBB", TIMESTAMP, 4, UINT32)
    for one in native:
        head += struct.pack("BBB", one.number, BASE_TYPES[one.base].size, one.base)
    head += bytes([len(own)])
    head += b"".join(struct.pack("BBB", number, 4, 0) for number in range(len(own)))
    chunks, begun = [], 0
    for at in [*breaks, len(rows)]:
        chunks.append(head + rows[begun:at].tobytes())
        if at < len(rows):
            chunks.append(timer(int(ridden.unix_s[at - 1]), STOP_ALL))
            chunks.append(timer(int(ridden.unix_s[at]), START))
        begun = at
    return b"".join(chunks)


def raw(one: Native, values: Values) -> Values:
    """Values (n,) as a field's whole numbers; its "no value" for what is missing or too large."""
    if one.channel == DISTANCE:
        # A session's distance begins at 0; an odometer does not.
        values = values - next(iter(values[np.isfinite(values)]), 0.0)
    numbers = np.rint((values * one.factor + one.offset) * one.scale)
    limits = np.iinfo(np.dtype(BASE_TYPES[one.base].code))
    beyond = ~np.isfinite(numbers) | (numbers < limits.min) | (numbers >= limits.max)
    encoded: Values = np.where(beyond, BASE_TYPES[one.base].invalid or 0, numbers)
    return encoded


def pauses(ride: Ride, ridden: BySecond) -> list[int]:
    """Places (of seconds) before which the ride has a gap."""
    start_s = ride.started_us / SECOND_US
    starts_s = np.array([gap.from_s for gap in ride.gaps]) + start_s
    ends_s = np.maximum.accumulate([gap.to_s for gap in ride.gaps]) + start_s
    jumps = np.flatnonzero(np.diff(ridden.unix_s) > 1)
    middles_s = (ridden.unix_s[jumps] + ridden.unix_s[jumps + 1]) / 2
    before = np.searchsorted(starts_s, middles_s) - 1
    within = [at >= 0 and middle < ends_s[at] for at, middle in zip(before, middles_s, strict=True)]
    return [int(at) + 1 for at in jumps[within]]


def summaries(ride: Ride, ridden: BySecond, start_s: int, end_s: int) -> list[bytes]:
    """The lap, the session and the activity: one of each."""
    elapsed_ms = 1000 * (end_s - start_s + 1)
    timer_ms = 1000 * len(ridden)
    summary = ride.summary
    distance_km = None if summary is None else summary.distance_km
    speed, rider, motor = ridden["speed_kmh"], ridden[RIDER_POWER.name], ridden[MOTOR_POWER.name]
    common: list[Cell] = [
        (*TIME_CELL, end_s - EPOCH_S),
        (2, UINT32, start_s - EPOCH_S),
        (7, UINT32, elapsed_ms),
        (8, UINT32, timer_ms),
        (9, UINT32, None if distance_km is None else distance_km * 1e5),
    ]
    kind = E_BIKE_FITNESS if MOTOR_POWER.name in ridden.values else 0
    session: list[Cell] = [
        *common,
        (0, ENUM, SESSION_EVENT),
        (1, ENUM, STOP),
        (5, ENUM, CYCLING),
        (6, ENUM, kind),
        (14, UINT16, scaled(np.mean, speed, 1000 / KMH_PER_MS)),
        (15, UINT16, scaled(np.max, speed, 1000 / KMH_PER_MS)),
        (16, UINT8, scaled(np.mean, ridden["heart_rate_bpm"])),
        (17, UINT8, scaled(np.max, ridden["heart_rate_bpm"])),
        (18, UINT8, scaled(np.mean, ridden["cadence_rpm"])),
        (19, UINT8, scaled(np.max, ridden["cadence_rpm"])),
        (20, UINT16, scaled(np.mean, rider)),
        (21, UINT16, scaled(np.max, rider)),
        (129, UINT16, scaled(np.mean, motor)),
        (130, UINT16, scaled(np.max, motor)),
    ]
    return [
        message(LAP, [*common, (0, ENUM, LAP_EVENT), (1, ENUM, STOP)]),
        message(SESSION, session),
        message(ACTIVITY, [(*TIME_CELL, end_s - EPOCH_S), (0, UINT32, timer_ms),
                           (1, UINT16, 1), (2, ENUM, 0), (3, ENUM, 26), (4, ENUM, STOP)]),
    ]  # fmt: skip


def scaled(of: Callable[[Values], Any], values: Values, scale: float = 1.0) -> float | None:
    """A figure of the samples that are there, None when there is none."""
    finite = values[np.isfinite(values)]
    return float(of(finite)) * scale if len(finite) else None


def timer(unix_s: int, event_type: int) -> bytes:
    """The timer starts or stops."""
    cells: list[Cell] = [(*TIME_CELL, unix_s - EPOCH_S), (0, ENUM, TIMER), (1, ENUM, event_type)]
    return message(EVENT, cells, local=1)


def defined(number: int, fields: list[tuple[int, int, int]], local: int = 0) -> bytes:
    """A definition; fields: number, size, base type."""
    head = struct.pack("<BBBHB", 0x40 | local, 0, 0, number, len(fields))
    return head + b"".join(struct.pack("BBB", *one) for one in fields)


def message(number: int, cells: list[Cell], local: int = 0) -> bytes:
    """One message with its definition; None is the field's "no value"."""
    encoded = defined(number, [(one, BASE_TYPES[base].size, base) for one, base, _ in cells], local)
    encoded += bytes([local])
    for _, base, value in cells:
        kind = BASE_TYPES[base]
        rounded = None if value is None else round(value)
        fits = rounded is not None and 0 <= rounded < (kind.invalid or 0)
        encoded += struct.pack(
            f"<{kind.code}", rounded if fits or base == UINT32Z else kind.invalid
        )
    return encoded


def enclosed(body: bytes) -> bytes:
    """Header, messages and checksum."""
    header = struct.pack("<BBHI4s", 14, 0x20, 21218, len(body), b".FIT")
    header += struct.pack("<H", crc16.arc(header))
    return header + body + struct.pack("<H", crc16.arc(header + body))
