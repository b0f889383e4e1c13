"""A part of a ride as a measurement reads it: rows that tell all of some channels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from backend.domain.channels import Values
from backend.domain.ride import Ride
from backend.errors import FieldError, InvalidRequest
from backend.services.rides.insight.rows import Window, columns_from
from backend.store import Store
from backend.views.trace import row_window

GAP_S_MAX = 2.5
"""Over a longer silence nobody knows what the bike did; a head unit tells one row a second."""


@dataclass(frozen=True)
class Rows:
    """time_s: since the ride's start, (n,). values: (n,) each, none missing."""

    ride: Ride
    time_s: Values
    values: dict[str, Values]

    def __getitem__(self, name: str) -> Values:
        return self.values[name]


def rows_of(store: Store, window: Window, field: str, names: Sequence[str]) -> Rows:
    """The rows of a window that have all of `names`.

    field: of the question, for refusals. Raises NotFound, ObjectDamaged, and InvalidRequest for
    a channel that the ride lacks (`missing_channel`) and for silences (`missing_rows`).
    """
    reader = store.rides.reader(window.ride_id)
    offered = {channel.name for channel in reader.ride.offered}
    lacking = [name for name in names if name not in offered]
    if lacking:
        listed = ", ".join(lacking)
        raise refusal(field, "missing_channel", f"ride {window.ride_id} has no {listed}")
    start, stop, _ = row_window(reader, window.from_s, window.to_s)
    rows = columns_from(reader, names, start, stop)
    whole = np.ones(stop - start, np.bool_)
    for name in names:
        whole &= np.isfinite(rows.values[name])
    time_s = rows.start_s[whole]
    edges = np.concatenate([rows.start_s[:1], time_s, rows.start_s[-1:]])
    if len(time_s) < 2 or np.diff(edges).max() > GAP_S_MAX:
        message = f"ride {window.ride_id} tells nothing there for more than {GAP_S_MAX:g} s"
        raise refusal(field, "missing_rows", message)
    return Rows(reader.ride, time_s, {name: rows.values[name][whole] for name in names})


def refusal(field: str, code: str, message: str) -> InvalidRequest:
    """One fault of a question, by its name."""
    return InvalidRequest(f"{field}: {message}", fields=[FieldError(field, code, message)])
