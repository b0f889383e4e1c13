"""The zero of a ride: what the torque sensor read while nobody could push.

Worked out from the rows once, kept beside the ride, and worked out anew by a newer ZERO_METHOD.
"""

from __future__ import annotations

from dataclasses import dataclass

ZERO_METHOD = 1
REASONS = (
    "no_torque",
    "no_cadence",
    "no_speed",
    "no_coasting",
    "not_still",
    "foot",
    "disagree",
    "unreadable",
)
"""Why a ride tells no zero: a channel that nobody recorded; never coasted long enough; the torque
moved, or was too great, whenever it did; its pieces disagree; its rows cannot be read."""


@dataclass(frozen=True, slots=True)
class RideZero:
    """zero_nm: by the unit's scale on that ride, with its standard uncertainty. zero_counts: raw.

    temperature_degc: of the sensor, then. pieces: of how many stretches of coasting. reason: one
    of REASONS where zero_nm is None.
    """

    zero_nm: float | None = None
    uncertainty_nm: float | None = None
    zero_counts: float | None = None
    temperature_degc: float | None = None
    pieces: int = 0
    reason: str | None = None


@dataclass(frozen=True, slots=True)
class ZeroOfRide:
    """A ride, when it began, and its zero. config_*: which configuration its unit had then; None
    where it is unknown."""

    ride_id: int
    started_us: int
    zero: RideZero
    config_generation: int | None = None
    config_crc32: int | None = None
