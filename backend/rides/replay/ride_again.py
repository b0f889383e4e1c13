"""The same road again with another table: what a ride would come to if the bike answered.

Only where the twin, without any change, comes to what the ride was; everything else is refused with
its reason. What nobody recorded, above all what the rider does at another speed, is in the band.

A question apart from the replay (open loop): a page repeats this one with every edit of the rider's
mass, and a ride of hours takes a thread for some twenty seconds. It ends, before the next of its
rides, when the connection of the caller is gone.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from backend import law
from backend.core._generated import INPUT_FLAGS
from backend.core.channels import Values
from backend.core.energy import DELIVERED, SECONDS_PER_HOUR
from backend.errors import InvalidRequest
from backend.law.rider_and_bike import RiderAndBike
from backend.rides.replay.service import FLAGS, read_columns
from backend.rides.settings_in_force import ConfigOf, unchanged
from backend.store import RideReader, Store
from backend.tuning.preview import changed_config

WORK_ERROR_MAX = 0.01
TIME_ERROR_MAX = 0.03
HOLES_MAX = 0.01
LONGEST_S = 4 * SECONDS_PER_HOUR
"""A band of it takes some twenty seconds of a thread."""
SLOW_KMH = 6.0
SLOW_SHARE_MAX = 0.1
SLOW_LEAST_S = 60.0
BRAKE = "brake"
FAULTS = "fault_flags"
MEANING = (
    "Closed loop: the same road again with this table, ridden by a twin of the bike that was fitted"
    " to the ride. An estimate: nine of ten simulated rides lay within its band, which holds what"
    " nobody recorded, above all what the rider does at another speed. Gusts are averaged."
)

Columns = Mapping[str, Values]
Config = Mapping[str, Any]
Estimate = dict[str, float]
Samples = npt.NDArray[np.void]
CheckConnected = Callable[[], None]
NOTHING_TOLD = RiderAndBike()


def as_ever() -> None:
    """Somebody waits for the answer, however long it takes."""


class RideAgain:
    """Rides one ride again at a time; holds nothing of it. Safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(
        self,
        ride_id: int,
        told: RiderAndBike = NOTHING_TOLD,
        check_connected: CheckConnected = as_ever,
        **changes: Any,
    ) -> dict[str, Any]:
        """The estimate as the API tells it.

        told: of rider and bike. check_connected: called before every ride of the twin; what it
        raises ends the estimate. changes: as of `changed_config`. Raises NotFound; InvalidRequest
        with the reason where the ride cannot be trusted for that, or for settings the law refuses.
        """
        reader = self._store.rides.reader(ride_id)
        config, _ = unchanged(self._config_of, reader.ride)
        changed = changed_config(config, **changes)
        twin = twin_of(reader, config, told)
        check_connected()
        again, samples = twin.ridden(changed, twin.rider, sample_steps=1)
        if again.gave_up:
            raise InvalidRequest(
                f"Ride {ride_id} cannot be estimated with this table: with as little help the"
                " bike would have stood where it was ridden.",
                code="twin_stands",
            )
        own, own_samples = twin.ridden(config, twin.rider, sample_steps=1)
        return {
            "meaning": MEANING,
            **estimates(twin, again, twin.band(changed, check_connected)),
            "limits": limits(twin, own, again),
            "curves": curves(twin, own_samples, samples),
            "trust": trust(twin, own),
        }


def trust(twin: law.RoadTwin, own: law.Totals) -> dict[str, Any]:
    """How far the twin is off without any change, and what it rests on."""
    return {
        "no_change_error_pct": 100.0 * share_off(own.motor_work_j, twin.ride.motor_work_j),
        "no_change_time_error_pct": 100.0 * (own.duration_s / twin.ride.duration_s - 1.0),
        "one_gear": twin.one_gear,
        "mass_kg": twin.assumed.mass_kg,
        "drag_area_m2": twin.assumed.drag_area_m2,
    }


def twin_of(reader: RideReader, config: Config, told: RiderAndBike) -> law.RoadTwin:
    """The ride's twin. config: the unit's on the ride. told: of rider and bike.

    Raises InvalidRequest with the reason where the ride cannot be trusted for that.
    """
    columns = read_columns(reader)
    refuse_what_cannot_be_laid_over(reader, columns)
    step_s = (reader.ride.period_us or 0) / 1e6
    ride = law.recorded_ride(with_brake(columns), config, step_s)
    twin = law.RoadTwin(ride, config, told)
    refuse_what_differs(reader.ride.id, twin)
    return twin


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
            f"{start} it took longer than {LONGEST_S / SECONDS_PER_HOUR:.0f} h.",
            code="ride_too_long",
        )
    missing = np.mean(~np.isfinite(columns["speed_kmh"])) if columns["speed_kmh"].size else 1.0
    if missing > HOLES_MAX:
        raise InvalidRequest(
            f"{start} {missing:.0%} of its speed is missing; a road with holes has no length.",
            code="holes",
        )
    if any(np.nan_to_num(faults).any() for faults in reader.values([FAULTS]).values()):
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


def refuse_what_differs(ride_id: int, twin: law.RoadTwin) -> None:
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
    return (told_j - recorded_j) / max(abs(recorded_j), law.WORK_LEAST_J)


def estimates(twin: law.RoadTwin, again: law.Totals, band: law.Band) -> dict[str, Estimate | None]:
    """Each figure of the ride with its band; None for what the ride did not record."""
    recorded, told = twin.recorded, twin.corrected(again)

    def of(name: str, factor: float = 1.0) -> Estimate | None:
        low, high = band[name]
        return estimate(*(factor * value for value in (recorded[name], told[name], low, high)))

    km = float(twin.ride.distance_m[-1]) / 1000.0
    per_wh = 1.0 / SECONDS_PER_HOUR
    battery = of("battery_j", per_wh)
    return {
        "wh_per_km": of("motor_work_j", per_wh / km),
        "motor_work_wh": of("motor_work_j", per_wh),
        "battery_wh": battery,
        "km_per_100_wh": battery and way_on(battery, 100.0 * km),
        "rider_work_wh": of("rider_work_j", per_wh),
        "duration_s": of("duration_s"),
        "motor_power_w_mean": of("motor_power_w"),
        "ripple_nm_per_s": of("ripple_nm_per_s"),
    }


def estimate(recorded: float, told: float, low: float, high: float) -> Estimate | None:
    """An estimate beside the record; None where nothing was recorded."""
    if not math.isfinite(recorded):
        return None
    return {
        "recorded": recorded,
        "replayed": told,
        "difference": told - recorded,
        "low": min(low, told),
        "high": max(high, told),
    }


def way_on(battery_wh: Estimate, wh_km: float) -> Estimate | None:
    """How far some energy of the battery goes: the more it takes, the less far."""
    if min(battery_wh["low"], battery_wh["recorded"]) <= 0.0:
        return None
    order = ("recorded", "replayed", "high", "low")
    return estimate(*(wh_km / battery_wh[name] for name in order))


def limits(twin: law.RoadTwin, own: law.Totals, again: law.Totals) -> list[dict[str, Any]]:
    """Seconds on the way that each limit was at work, where it was. What the record has on top of
    the twin without a change is on top of the estimate too."""
    recorded = law.limits_of_record(twin.ride)
    told = []
    for name, own_s in own.limit_s.items():
        recorded_s = None if recorded is None else recorded[name]
        beyond_s = 0.0 if recorded_s is None else recorded_s - own_s
        replayed_s = max(again.limit_s[name] + beyond_s, 0.0)
        if max(recorded_s or 0.0, replayed_s) > 0.0:
            told.append({"limit": name, "recorded_s": recorded_s, "replayed_s": replayed_s})
    return told


def curves(twin: law.RoadTwin, own: Samples, again: Samples) -> dict[str, Any]:
    """The three rides over the distance, as the API tells them."""
    turn_m = 2.0 * math.pi * twin.reach_m
    ends_km = law.places_km(twin.ride, turn_m)
    of = {
        "recorded": law.curves_of_record(twin.ride, ends_km),
        "unchanged": law.curves_of(own, ends_km),
        "replayed": law.curves_of(again, ends_km),
    }
    middles = 0.5 * (ends_km[1:] + ends_km[:-1])
    told = {
        ride: {name: nullable(values) for name, values in found.items()}
        for ride, found in of.items()
    }
    return {"distance_km": middles.tolist(), **told}


def nullable(values: Values) -> list[float | None]:
    """Rounded to what can be seen; missing as null."""
    return [round(value, 3) if math.isfinite(value) else None for value in values.tolist()]
