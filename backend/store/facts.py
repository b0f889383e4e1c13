"""What a ride's file says of the ride beside its rows, so that a lost database can be made again.

Everything that is not in the rows or in a sidecar. Schema version 2 is the only one there is.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from backend.core.channels import ChannelSpec, channel_to_json
from backend.core.described import from_members
from backend.core.device_metadata import metadata_from_json, metadata_to_json
from backend.core.energy import derivable
from backend.core.filled import Filled
from backend.core.intake import Intake
from backend.core.ride import ORIGINS, Gap, Ride, RideContext
from backend.core.ride_events import RideEvent
from backend.core.ride_tags import clean_tags

WORDS = ("name", "notes")


@dataclass(frozen=True)
class Original:
    """The file a ride came from, and the one that this came in."""

    sha256: str
    name: str
    container: Original | None = None


@dataclass(frozen=True)
class StoredRide:
    """A ride as its file and sidecar tell it.

    lost_words: why what a person wrote is not known, None where it is. filled_from: files that
    filled it. earlier: files it was made of before a fuller one came. replaces: hashes of the
    objects it is a fuller version of.
    """

    ride: Ride
    gaps: tuple[Gap, ...]
    events: tuple[RideEvent, ...]
    original: Original | None
    filled_from: tuple[Original, ...]
    earlier: tuple[Original, ...]
    replaces: tuple[str, ...]
    lost_words: str | None = None


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
        "noted": metadata_to_json(ride.metadata),
    }


def stored_ride(
    facts: Mapping[str, Any],
    sidecar: Mapping[str, Any],
    channels: tuple[ChannelSpec, ...],
    row_count: int,
    key: str,
) -> StoredRide:
    """A ride from the facts of its file, with the words of its sidecar.

    channels: as the file's columns have them. Raises KeyError, TypeError or ValueError when the
    facts make no sense.
    """
    words = {**facts, **{name: sidecar[name] for name in WORDS if name in sidecar}}
    context = from_members(RideContext, facts["context"])
    ride = Ride(
        id=0,
        state="done",
        origin=ORIGINS[ORIGINS.index(facts["origin"])],
        name=str(words.get("name", "")),
        notes=str(words.get("notes", "")),
        started_us=int(facts["started_us"]),
        row_count=row_count,
        period_us=None if facts.get("period_us") is None else int(facts["period_us"]),
        channels=channels,
        derived=derivable([channel.name for channel in channels], context.gear_ratio),
        context=context,
        filled=tuple(from_members(Filled, span) for span in facts.get("filled", ())),
        completeness=facts.get("completeness"),
        object_key=key,
        cut_short=bool(facts.get("cut_short", False)),
        sport=facts.get("sport"),
        intake=from_members(Intake, facts["intake"]) if facts.get("intake") else None,
        metadata=metadata_from_json(facts.get("noted")),
        tags=clean_tags(sidecar.get("tags", ())),
        accepted_doubts=tuple(sidecar.get("accepted_doubts", ())),
    )
    return StoredRide(
        ride=ride,
        gaps=tuple(from_members(Gap, body) for body in facts["gaps"]),
        events=tuple(from_members(RideEvent, body) for body in facts["events"]),
        original=original_of(facts.get("original")),
        filled_from=originals_of(facts.get("filled_from", ())),
        earlier=originals_of(facts.get("earlier", ())),
        replaces=tuple(str(sha256) for sha256 in facts.get("replaces", ())),
    )


def originals_of(bodies: Iterable[Mapping[str, Any]]) -> tuple[Original, ...]:
    return tuple(original for original in map(original_of, bodies) if original)


def original_of(body: Mapping[str, Any] | None) -> Original | None:
    if body is None:
        return None
    return Original(str(body["sha256"]), str(body["name"]), original_of(body.get("container")))
