"""Rides of given channels in a store, as a recorder puts them there and as a file becomes them; and
the channels of a ride that came out of a file.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from backend.core.channels import ChannelSpec, Values
from backend.core.ride import Ride, RideContext, RideRows
from backend.core.ride_events import RideEvent
from backend.formats import ImportedRide, Outcome
from backend.imports.service import Uploads
from backend.law import law_defaults
from backend.store import Store
from firmware_protocol._generated import CHANNELS

# Those of the unit.
SPECS = {row.name: ChannelSpec(row.name, row.unit, float(row.scale)) for row in CHANNELS}
STARTED_US = 1_700_000_000_000_000


def begun_ride(
    store: Store,
    columns: Mapping[str, Values],
    period_us: int,
    started_us: int = STARTED_US,
    events: Sequence[RideEvent] = (),
    **context: Any,
) -> int:
    """A ride that is recorded and going on. columns: of the unit's channels, (n,) each. context: as
    of RideContext."""
    specs = [SPECS[name] for name in columns]
    counts = np.stack([spec.to_counts(columns[spec.name]) for spec in specs], 1).astype(np.int16)
    ride_id = store.rides.start_live(specs, period_us, started_us, RideContext(**context), "a ride")
    store.rides.append_tail(ride_id, 0, counts, events).result()
    return ride_id


def recorded_ride(store: Store, *ride: Any, **more: Any) -> int:
    """A ride that is over; arguments as of `begun_ride`."""
    ride_id = begun_ride(store, *ride, **more)
    store.rides.finish(ride_id)
    return ride_id


def imported_ride(
    store: Store,
    columns: Mapping[str, Values],
    period_us: int,
    started_us: int = STARTED_US,
    specs: Mapping[str, ChannelSpec] = SPECS,
) -> int:
    """A ride that came as a file. specs: of the channels it has, the unit's."""
    channels = tuple(specs[name] for name in columns)
    counts = {spec.name: spec.to_counts(columns[spec.name]) for spec in channels}
    length = len(next(iter(columns.values())))
    rows = RideRows(channels, np.arange(length, dtype=np.int64) * period_us, counts)
    outcome = Outcome("complete", (ImportedRide(started_us, period_us, rows),))
    as_it_came = repr(started_us).encode() + b"".join(one.tobytes() for one in counts.values())
    uploads = Uploads(store, reader=lambda path, name: outcome)
    (ride_id,) = uploads.receive_file("a.csv", as_it_came).ride_ids
    uploads.close()
    return ride_id


def config_of(ride: Ride, t_s: float = 0.0) -> tuple[dict[str, Any], str]:
    """Of a ride whose configuration nobody kept: the law's own."""
    return law_defaults(), "defaults"


def values_of(ride: ImportedRide, name: str) -> Values:
    """A channel of a ride that was read, in its unit."""
    channel = next(channel for channel in ride.rows.channels if channel.name == name)
    return channel.to_values(ride.rows.counts[name])


def column_of(ride: ImportedRide, name: str) -> list[float]:
    """The same as numbers that compare as one."""
    found: list[float] = values_of(ride, name).tolist()
    return found
