"""What a ride's file says of the ride beside its rows, so that a lost database can be made again.

Version 2 says everything that is not in the rows or in a sidecar. Version 1 had the start, the
period, the gear ratio, the serial number and what was filled; the channels it has always had in
its columns. A sidecar may hold the facts that a file of version 1 lacks.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, TypeVar

from backend.core.channels import ChannelSpec, channel_to_json
from backend.core.energy import derivable
from backend.core.filled import Filled
from backend.core.intake import Intake
from backend.core.noted import noted_from_json, noted_to_json
from backend.core.ride import ORIGINS, Gap, Ride, RideContext
from backend.core.ride_events import RideEvent
from backend.core.ride_tags import clean_tags
from backend.core.unit_key import ebl_key

Item = TypeVar("Item", Filled, Gap, Intake, RideContext, RideEvent)

# What every file of version 2 says, and what else only such a one can: a ride that was recorded
# here came from no file and has no words but those of its sidecar.
SAID = ("origin", "context", "gaps", "events", "completeness", "cut_short")
WORDS = ("name", "notes")


@dataclass(frozen=True)
class Original:
    """The file a ride came from, and the one that this came in."""

    sha256: str
    name: str
    container: Original | None = None


@dataclass(frozen=True)
class KeptRide:
    """A ride as its file and sidecar tell it.

    lacks: what neither says. filled_from: files that filled it. earlier: files it was made of
    before a fuller one came. replaces: hashes of the objects it is a fuller version of.
    """

    ride: Ride
    lacks: tuple[str, ...]
    gaps: tuple[Gap, ...] | None
    events: tuple[RideEvent, ...] | None
    original: Original | None
    filled_from: tuple[Original, ...]
    earlier: tuple[Original, ...]
    replaces: tuple[str, ...]


def facts_of(ride: Ride) -> dict[str, object]:
    """The facts of a ride with its figures, as plain JSON for its file."""
    return {
        "started_us": ride.started_us,
        "period_us": ride.period_us,
        "gear_ratio": ride.context.gear_ratio,
        "device_serial": ride.context.device_serial,
        "origin": ride.origin,
        "motor_torque_meaning": ride.motor_torque_meaning,
        "channels": [
            {
                **channel_to_json(channel),
                "kind": channel.dtype.name,
                "missing": channel.missing,
            }
            for channel in ride.channels
        ],
        "context": asdict(ride.context),
        "gaps": [asdict(gap) for gap in ride.gaps],
        "filled": [asdict(span) for span in ride.filled],
        "events": [asdict(event) for event in ride.events],
        "summary": asdict(ride.summary) if ride.summary else None,
        "completeness": ride.completeness,
        "cut_short": ride.cut_short,
        "sport": ride.sport,
        "intake": asdict(ride.intake) if ride.intake else None,
        "noted": noted_to_json(ride.noted),
    }


def kept_ride(
    facts: Mapping[str, Any],
    sidecar: Mapping[str, Any],
    channels: tuple[ChannelSpec, ...],
    row_count: int,
    key: str,
) -> KeptRide:
    """A ride from the facts of its file, completed by its sidecar.

    channels: as the file's columns have them. Raises KeyError, TypeError or ValueError when the
    facts make no sense.
    """
    known = {**sidecar.get("facts", {}), **facts}
    words = {**known, **{name: sidecar[name] for name in WORDS if name in sidecar}}
    lacks = [name for name in SAID if name not in known]
    if "origin" in lacks:
        lacks += [name for name in (*WORDS, "original") if name not in words]
        # What has a unit's number was nearly always recorded here.
        known["origin"] = ORIGINS[known.get("device_serial") is None]
    context = known_fields(RideContext, known.get("context") or known)
    if context.unit_key is None:
        # A file of before units had keys.
        context = replace(context, unit_key=ebl_key(context.device_serial))
    ride = Ride(
        id=0,
        state="done",
        origin=ORIGINS[ORIGINS.index(known["origin"])],
        name=str(words.get("name", "")),
        notes=str(words.get("notes", "")),
        started_us=int(known["started_us"]),
        row_count=row_count,
        period_us=None if known.get("period_us") is None else int(known["period_us"]),
        channels=channels,
        derived=derivable([channel.name for channel in channels], context.gear_ratio),
        context=context,
        filled=tuple(known_fields(Filled, span) for span in known.get("filled", ())),
        completeness=known.get("completeness"),
        object_key=key,
        cut_short=bool(known.get("cut_short", False)),
        sport=known.get("sport"),
        intake=known_fields(Intake, known["intake"]) if known.get("intake") else None,
        noted=noted_from_json(known.get("noted")),
        tags=clean_tags(sidecar.get("tags", ())),
    )
    return KeptRide(
        ride=ride,
        lacks=tuple(lacks),
        gaps=items(Gap, known.get("gaps")),
        events=items(RideEvent, known.get("events")),
        original=original_of(known.get("original")),
        filled_from=originals_of(known.get("filled_from", ())),
        earlier=originals_of(known.get("earlier", ())),
        replaces=tuple(str(sha256) for sha256 in known.get("replaces", ())),
    )


def known_fields(kind: type[Item], body: Mapping[str, Any]) -> Item:
    """A dataclass from the members it has; a newer version's file may tell more."""
    names = {field.name for field in fields(kind)}
    return kind(**{name: value for name, value in body.items() if name in names})


def items(kind: type[Item], bodies: Any) -> tuple[Item, ...] | None:
    return None if bodies is None else tuple(known_fields(kind, body) for body in bodies)


def originals_of(bodies: Iterable[Mapping[str, Any]]) -> tuple[Original, ...]:
    return tuple(found for found in map(original_of, bodies) if found)


def original_of(body: Mapping[str, Any] | None) -> Original | None:
    if body is None:
        return None
    return Original(str(body["sha256"]), str(body["name"]), original_of(body.get("container")))
