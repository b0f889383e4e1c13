"""What became of a file's rides, as a code and a sentence."""

from __future__ import annotations

from dataclasses import dataclass, field

from backend.core.ride import Ride, iso_utc
from backend.formats import ImportedRide, Outcome


@dataclass
class ImportResult:
    """The rides of a file, by what became of them.

    fresh: new ones, each with the ride that another device recorded meanwhile. existing: those that
    are here. completed: those of which the file had more. rows_filled: by a log.
    """

    fresh: list[tuple[ImportedRide, Ride | None]] = field(default_factory=list)
    existing: list[Ride] = field(default_factory=list)
    completed: list[Ride] = field(default_factory=list)
    rows_filled: int = 0


def describe_result(result: ImportResult, outcome: Outcome) -> tuple[str | None, str | None]:
    """Code and sentence of an upload; the reader's own where the file is a new ride."""
    if result.completed:
        return "made_whole", describe_completed(result.completed[0])
    if result.fresh:
        other = next((ride for _, ride in result.fresh if ride is not None), None)
        if other is None or outcome.code is not None:
            return outcome.code, outcome.detail
        return "same_ride", describe_second_recording(other)
    if result.existing:
        code = "filled" if result.rows_filled else "duplicate"
        return code, describe_duplicate(result.existing[0], result.rows_filled)
    return outcome.code, outcome.detail


def describe_duplicate(ride: Ride, rows_filled: int) -> str:
    """What became of a file whose ride is here."""
    sentence = f"This is ride {ride.id} of {iso_utc(ride.started_us)[:10]}, which is here already"
    if rows_filled:
        return f"{sentence}; {rows_filled} rows it lacked were filled from the file, which is kept."
    return f"{sentence}; the file is kept beside it and nothing is stored twice."


def describe_completed(ride: Ride) -> str:
    """What became of a ride of which only a part was here."""
    return (
        f"This is ride {ride.id} of {iso_utc(ride.started_us)[:10]}, of which less was here: it "
        "has everything of this file now. Its name, notes and number stay, and both files are kept."
    )


def describe_second_recording(ride: Ride) -> str:
    """What became of a ride that was recorded twice."""
    return (
        f"Ride {ride.id} was recorded at the same time on the same road, perhaps by another "
        "device. Neither has all of the other, so both are kept."
    )
