"""What the device that recorded a ride's file noted beside its rows: laps, pauses, instruments,
and figures of the whole ride.

A ride that was recorded here has none of these. Times are seconds since the ride's start.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from backend.core.described import described, from_members

# More than any ride has; a file may say anything.
LAPS_MAX, PAUSES_MAX, INSTRUMENTS_MAX = 1000, 2000, 64
STATEMENTS_MAX, FIGURES_MAX = 16, 200
# What shares less than this with a ride ended as the ride began: files tell whole seconds.
LEAST_S = 1.0


@described
class Lap:
    """A part of the ride that was marked off, in seconds after its start; null for untold."""

    from_s: float
    to_s: float
    trigger: str | None = None
    """manual, time, distance, position, session_end, other; null for untold."""
    timer_s: float | None = None
    """Time the device's timer ran."""
    distance_m: float | None = None
    """As the device counted it; null where it did not."""
    calories_kcal: float | None = None
    """As the device counted them; null where it did not."""


@described
class Pause:
    """The timer of the device that recorded stood."""

    from_s: float
    to_s: float
    by_rider: bool | None = None
    """False when the device stopped by itself."""


@described
class Instrument:
    """The device that recorded, or one that it heard; null for what the file does not tell."""

    kind: str | None = None
    """`recorder`, or what it measures: `bike_power`."""
    maker: str | None = None
    product: str | None = None
    serial_number: str | None = None
    software_version: str | None = None
    battery_v: float | None = None
    """Of its own battery."""
    battery_status: str | None = None
    """The last that was reported."""


@described
class DeviceFigure:
    """A figure as the device that recorded stated it, by its own rules: none of `summary`."""

    name: str
    """Of FIT's profile or of the file: `lev_battery_consumption`, `unknown_177`."""
    value: float
    unit: str = ""
    """Empty for none, and where nothing tells it."""


@described
class DeviceSession:
    """What the device stated of one whole session, which may reach beyond the ride."""

    from_s: float
    to_s: float
    figures: tuple[DeviceFigure, ...] = ()


@dataclass(frozen=True, slots=True)
class DeviceMetadata:
    """All of it, each in the order of time or of the file."""

    laps: tuple[Lap, ...] = ()
    pauses: tuple[Pause, ...] = ()
    instruments: tuple[Instrument, ...] = ()
    statements: tuple[DeviceSession, ...] = ()


def metadata_to_json(metadata: DeviceMetadata) -> dict[str, object]:
    """Plain JSON, the inverse of `metadata_from_json`."""
    return asdict(metadata)


def metadata_from_json(body: Mapping[str, Any] | None) -> DeviceMetadata:
    """From the members it has; a newer version may have told more. Raises TypeError, ValueError."""
    body = body or {}
    return DeviceMetadata(
        laps=_items(Lap, body.get("laps", ())),
        pauses=_items(Pause, body.get("pauses", ())),
        instruments=_items(Instrument, body.get("instruments", ())),
        statements=tuple(
            DeviceSession(
                statement["from_s"],
                statement["to_s"],
                _items(DeviceFigure, statement.get("figures", ())),
            )
            for statement in body.get("statements", ())
        ),
    )


def _items(kind: type[Any], bodies: Sequence[Mapping[str, Any]]) -> tuple[Any, ...]:
    return tuple(from_members(kind, body) for body in bodies)


def within(metadata: DeviceMetadata, started_s: float, duration_s: float) -> DeviceMetadata:
    """What of a file's notes is of one ride of it.

    metadata: with times as Unix seconds. started_s: Unix time of the ride's first row. What reaches
    beyond the ride is cut to it, but for statements: their figures are of all of their session.
    What lies outside is of another ride.
    """

    def cut(item: Any) -> Any:
        from_s = max(item.from_s - started_s, 0.0)
        to_s = min(item.to_s - started_s, duration_s)
        changed = {"from_s": round(from_s, 6), "to_s": round(to_s, 6)}
        return type(item)(**{**asdict(item), **changed})

    laps = [cut(lap) for lap in metadata.laps if _touches(lap, started_s, duration_s)]
    pauses = [cut(pause) for pause in metadata.pauses if _touches(pause, started_s, duration_s)]
    laps.sort(key=lambda lap: (lap.from_s, lap.to_s))
    statements = [
        DeviceSession(round(s.from_s - started_s, 6), round(s.to_s - started_s, 6), s.figures)
        for s in metadata.statements
        if _touches(s, started_s, duration_s)
    ]
    return DeviceMetadata(
        tuple(laps[:LAPS_MAX]),
        tuple(pauses[:PAUSES_MAX]),
        metadata.instruments,
        tuple(statements[:STATEMENTS_MAX]),
    )


def _touches(item: Lap | Pause | DeviceSession, started_s: float, duration_s: float) -> bool:
    shared_s = min(item.to_s, started_s + duration_s) - max(item.from_s, started_s)
    return shared_s > 0 and shared_s >= min(LEAST_S, 0.5 * (item.to_s - item.from_s))
