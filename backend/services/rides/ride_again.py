"""The same road again with another table: what a ride would come to if the bike answered.

Only where the twin, without any change, comes to what the ride was; everything else is refused with
its reason. What nobody recorded, above all what the rider does at another speed, is in the band.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from backend import control
from backend.domain._generated import INPUT_FLAGS
from backend.domain.channels import Values
from backend.domain.energy import DELIVERED, SECONDS_PER_HOUR
from backend.domain.rider_and_bike import RiderAndBike
from backend.errors import InvalidRequest
from backend.store import RideReader

WORK_ERROR_MAX = 0.01
TIME_ERROR_MAX = 0.03
WORK_LEAST_J = 180.0
"""A twentieth of a Wh: below it a share of the work says nothing."""
HOLES_MAX = 0.01
LONGEST_S = 4 * 3600.0
"""A band of it takes some twenty seconds of a thread."""
SLOW_KMH = 6.0
SLOW_SHARE_MAX = 0.1
SLOW_LEAST_S = 60.0
BRAKE = "brake"
FLAGS = "input_flags"
FAULTS = "fault_flags"
MEANING = (
    "Closed loop: the same road again with this table, ridden by a twin of the bike that was fitted"
    " to the ride. An estimate: nine of ten simulated rides lay within its band, which holds what"
    " nobody recorded, above all what the rider does at another speed. Gusts are averaged."
)

Columns = Mapping[str, Values]
Config = Mapping[str, Any]


def ridden_again(
    reader: RideReader,
    columns: Columns,
    config: Config,
    changed: Config,
    step_s: float,
    told: RiderAndBike,
) -> dict[str, Any]:
    """The estimate as the API tells it.

    columns: as the replay reads them. config: the unit's on the ride; changed: with what takes its
    place. told: of rider and bike. Raises InvalidRequest with the reason where the ride cannot be
    trusted for that.
    """
    refuse_what_cannot_be_laid_over(reader, columns)
    ride = control.recorded_ride(with_brake(columns), config, step_s)
    twin = control.RoadTwin(ride, config, told)
    unchanged = twin.self_replay
    refuse_what_differs(reader.ride.id, twin)
    again, _ = twin.ridden(changed, control.HOLDS_POWER)
    if again.gave_up:
        raise InvalidRequest(
            f"Ride {reader.ride.id} cannot be estimated with this table: with as little help the"
            " bike would have stood where it was ridden.",
            code="twin_stands",
        )
    band = twin.band(changed)
    distance_km = float(ride.distance_m[-1]) / 1000.0
    work = estimate(
        ride.motor_work_j, unchanged.motor_work_j, again.motor_work_j, band.motor_work_j
    )
    time = estimate(ride.duration_s, unchanged.duration_s, again.duration_s, band.duration_s)
    return {
        "meaning": MEANING,
        "wh_per_km": scaled(work, 1.0 / (SECONDS_PER_HOUR * distance_km)),
        "motor_work_wh": scaled(work, 1.0 / SECONDS_PER_HOUR),
        "duration_s": time,
        "trust": {
            "no_change_error_pct": 100.0 * share_off(unchanged.motor_work_j, ride.motor_work_j),
            "no_change_time_error_pct": 100.0 * (unchanged.duration_s / ride.duration_s - 1.0),
            "one_gear": twin.one_gear,
            "mass_kg": twin.assumed.mass_kg,
            "drag_area_m2": twin.assumed.drag_area_m2,
        },
    }


def with_brake(columns: Columns) -> dict[str, Values]:
    """The columns with the lever's own, where the ride has the law's inputs."""
    if FLAGS not in columns:
        return dict(columns)
    flags = np.nan_to_num(columns[FLAGS]).astype(np.uint16)
    return {**columns, BRAKE: (flags & INPUT_FLAGS[BRAKE] != 0).astype(np.float64)}


def refuse_what_cannot_be_laid_over(reader: RideReader, columns: Columns) -> None:
    """Raises InvalidRequest for a ride that lacks what a twin is made of."""
    ride = reader.ride
    start = f"Ride {ride.id} cannot be ridden again:"
    if ride.motor_torque_meaning != DELIVERED or "motor_torque_nm" not in columns:
        raise InvalidRequest(
            f"{start} it does not tell what the motor gave, only what was asked of it at most.",
            code="not_delivered",
        )
    seconds = columns["speed_kmh"].size * (ride.period_us or 0) / 1e6
    if seconds > LONGEST_S:
        raise InvalidRequest(
            f"{start} it took longer than {LONGEST_S / 3600.0:.0f} h.", code="ride_too_long"
        )
    missing = np.mean(~np.isfinite(columns["speed_kmh"])) if columns["speed_kmh"].size else 1.0
    if missing > HOLES_MAX:
        raise InvalidRequest(
            f"{start} {missing:.0%} of its speed is missing; a road with holes has no length.",
            code="holes",
        )
    offered = {channel.name: channel for channel in reader.ride.channels}
    if FAULTS in offered:
        counts = reader.counts([FAULTS], 0, reader.row_count)[FAULTS]
        if np.nan_to_num(offered[FAULTS].to_values(counts)).any():
            raise InvalidRequest(
                f"{start} the unit told faults on it, and a twin has none.", code="faults"
            )
    speed = columns["speed_kmh"]
    slow_s = np.count_nonzero((speed > 1.0) & (speed < SLOW_KMH)) * (ride.period_us or 0) / 1e6
    moving_s = np.count_nonzero(speed > 1.0) * (ride.period_us or 0) / 1e6
    if slow_s > SLOW_LEAST_S and slow_s > SLOW_SHARE_MAX * moving_s:
        raise InvalidRequest(
            f"{start} {slow_s:.0f} s of it were slower than {SLOW_KMH:.0f} km/h, where a stroke"
            " decides whether the bike moves at all.",
            code="too_slow_to_tell",
        )


def refuse_what_differs(ride_id: int, twin: control.RoadTwin) -> None:
    """Raises InvalidRequest if the twin, without a change, does not come to what the ride was."""
    again, ride = twin.self_replay, twin.ride
    work = share_off(again.motor_work_j, ride.motor_work_j)
    time = again.duration_s / ride.duration_s - 1.0
    if again.gave_up or abs(work) > WORK_ERROR_MAX or abs(time) > TIME_ERROR_MAX:
        raise InvalidRequest(
            f"Ride {ride_id} cannot be ridden again: without any change its twin takes"
            f" {work:+.1%} of the motor's work and {time:+.1%} of the time. Up to"
            f" {WORK_ERROR_MAX:.0%} and {TIME_ERROR_MAX:.0%} an estimate can be trusted.",
            code="twin_differs",
        )


def share_off(told_j: float, recorded_j: float) -> float:
    """How far a work is off, as a share of the recorded one."""
    return (told_j - recorded_j) / max(abs(recorded_j), WORK_LEAST_J)


def estimate(
    recorded: float, unchanged: float, told: float, band: tuple[float, float]
) -> dict[str, float]:
    """An estimate beside the record; the difference is the twin's own, with and without the
    change, so that what the twin errs by does not count as an effect."""
    low, high = min(band[0], told), max(band[1], told)
    return {
        "recorded": recorded,
        "replayed": told,
        "difference": told - unchanged,
        "low": low,
        "high": high,
    }


def scaled(values: Mapping[str, float], factor: float) -> dict[str, float]:
    """The same in another unit."""
    return {name: value * factor for name, value in values.items()}
