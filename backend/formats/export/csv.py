"""A ride as CSV: ISO time, seconds, then every channel under its name; missing is empty."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from backend.core.channels import ChannelSpec, Values
from backend.core.energy import DEMANDED, MOTOR_TORQUE, MOTOR_TORQUE_DEMANDED
from backend.core.ride import Ride, RideRows, iso_utc


def csv_chunks(ride: Ride, rows_of_ride: Iterable[RideRows]) -> Iterator[bytes]:
    """The ride's rows as lines. rows_of_ride: of all its recorded channels, in order."""
    header = ["time_utc", "t_s", *export_names(ride).values()]
    yield (",".join(header) + "\r\n").encode()
    for rows in rows_of_ride:
        seconds = (rows.times_us / 1e6).tolist()
        columns = [texts(c, c.to_values(rows.counts[c.name])) for c in rows.channels]
        lines = (
            ",".join(
                (
                    iso_utc(ride.started_us + int(t * 1e6)),
                    f"{t:.6f}".rstrip("0").rstrip("."),
                    *cells,
                )
            )
            for t, *cells in zip(seconds, *columns, strict=True)
        )
        yield ("\r\n".join(lines) + "\r\n").encode()


def texts(channel: ChannelSpec, values: Values) -> list[str]:
    """Values as decimal text, as many digits as the scale carries."""
    digits = max(0, int(np.ceil(-np.log10(channel.scale))))
    exact = np.isclose(channel.scale * 10**digits, round(channel.scale * 10**digits))
    places = digits if exact else digits + 3
    return ["" if np.isnan(v) else f"{v:.{places}f}" for v in values.tolist()]


def export_names(ride: Ride) -> dict[str, str]:
    """The name in a file of every recorded channel."""
    renamed = {MOTOR_TORQUE: MOTOR_TORQUE_DEMANDED} if ride.motor_torque_meaning == DEMANDED else {}
    return {channel.name: renamed.get(channel.name, channel.name) for channel in ride.channels}
