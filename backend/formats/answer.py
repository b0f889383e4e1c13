"""An outcome as bytes, from the child that read a file to the server that asked.

u32 header length, header JSON, then the arrays one after the other as the header's order tells.
The child read hostile bytes, so its answer is checked, not trusted.
"""

from __future__ import annotations

import json
import struct
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from backend.core.channels import Counts, channel_from_json, channel_to_json
from backend.core.device_metadata import metadata_from_json, metadata_to_json
from backend.core.intake import Intake
from backend.core.ride import RideContext, RideRows
from backend.core.ride_events import RideEvent
from backend.formats.outcome import ImportedRide, Outcome, rejected
from backend.formats.questions import question_from_json


def encode(outcome: Outcome) -> bytes:
    """An outcome as bytes, the inverse of `decode`."""
    arrays: list[bytes] = []
    rides = []
    for ride in outcome.rides:
        arrays.append(ride.rows.times_us.astype("<i8").tobytes())
        for channel in ride.rows.channels:
            counts = ride.rows.counts[channel.name]
            arrays.append(counts.astype(counts.dtype.newbyteorder("<")).tobytes())
        rides.append(
            {
                "started_us": ride.started_us,
                "period_us": ride.period_us,
                "sport": ride.sport,
                "notes": ride.notes,
                "context": asdict(ride.context),
                "start_known": ride.start_known,
                "events": [asdict(event) for event in ride.events],
                "intake": None if ride.intake is None else asdict(ride.intake),
                "noted": metadata_to_json(ride.metadata),
                "rows": len(ride.rows.times_us),
                "channels": [channel_to_json(channel) for channel in ride.rows.channels],
            }
        )
    facts = {key: value for key, value in asdict(_bare(outcome)).items() if key != "rides"}
    header = json.dumps({**facts, "rides": rides}).encode()
    return struct.pack("<I", len(header)) + header + b"".join(arrays)


def _bare(outcome: Outcome) -> Outcome:
    return replace(outcome, rides=())


def decode(answer: bytes) -> Outcome:
    """The child's answer. The child read hostile bytes, so its answer is checked, not trusted."""
    try:
        (length,) = struct.unpack_from("<I", answer)
        header = json.loads(answer[4 : 4 + length])
        at = 4 + length
        rides = []
        for entry in header["rides"]:
            ride, at = decode_ride(entry, answer, at)
            rides.append(ride)
        return Outcome(
            state=str(header["state"]),
            rides=tuple(rides),
            code=header["code"],
            detail=header["detail"],
            offset=header["offset"],
            completeness=header["completeness"],
            question=question_from_json(header["question"]) if header["question"] else None,
        )
    except (struct.error, ValueError, KeyError, TypeError) as error:
        return rejected("parser_crashed", f"The reader's answer makes no sense: {error}.")


def decode_ride(entry: dict[str, Any], answer: bytes, at: int) -> tuple[ImportedRide, int]:
    """One ride of the answer, and where the next begins. Raises ValueError when it is cut."""
    rows = int(entry["rows"])
    channels = tuple(channel_from_json(channel) for channel in entry["channels"])
    times_us = np.frombuffer(answer, "<i8", rows, at).astype(np.int64)
    at += 8 * rows
    counts: dict[str, Counts] = {}
    for channel in channels:
        kind = channel.dtype.newbyteorder("<")
        counts[channel.name] = np.frombuffer(answer, kind, rows, at).astype(channel.dtype)
        at += kind.itemsize * rows
    period_us = entry["period_us"]
    ride = ImportedRide(
        started_us=int(entry["started_us"]),
        period_us=None if period_us is None else int(period_us),
        rows=RideRows(channels, times_us, counts),
        sport=entry["sport"],
        notes=tuple(str(note) for note in entry["notes"]),
        context=RideContext(**entry["context"]),
        start_known=bool(entry["start_known"]),
        events=tuple(RideEvent(**event) for event in entry["events"]),
        intake=None if entry["intake"] is None else Intake(**entry["intake"]),
        metadata=metadata_from_json(entry["noted"]),
    )
    return ride, at
