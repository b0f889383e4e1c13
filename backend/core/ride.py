"""A ride: rows of counts over time, what is known about it, and its figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np
import numpy.typing as npt

from backend.core._generated import MOVING_KMH
from backend.core.channels import ChannelSpec, Counts, Values, channel_to_json
from backend.core.described import described
from backend.core.device_metadata import DeviceMetadata, Pause, metadata_to_json
from backend.core.energy import (
    BATTERY_POWER,
    MOTOR_POWER,
    RIDER_POWER,
    energy,
    motor_torque_meaning,
    sample_seconds,
    weighted_sum,
)
from backend.core.filled import Filled
from backend.core.intake import Intake
from backend.core.moments import utc
from backend.core.ride_events import RideEvent, settings_changes
from backend.core.sphere import great_circle_m

TimesUs = npt.NDArray[np.int64]

LIVE, DONE, BAD = STATES = ("live", "done", "bad")
ORIGINS = ("recorded", "imported")

# A break in irregular rows longer than this many usual spacings, and than this time, is a pause.
PAUSE_SPACINGS = 5
PAUSE_MIN_US = 10_000_000


@dataclass(frozen=True)
class RideRows:
    """Rows of a ride, column by column.

    times_us: int64 (n,), since the ride's start, strictly increasing. counts: by channel name,
    each (n,) of the channel's dtype, its `missing` where there is no sample.
    """

    channels: tuple[ChannelSpec, ...]
    times_us: TimesUs
    counts: Mapping[str, Counts]


@described
class Gap:
    """A stretch without samples; `rows_lost` where it is known."""

    from_s: float
    to_s: float
    rows_lost: int | None = None


@described
class RideSummary:
    """What a ride comes to; null where the ride lacks the channel.

    Rider and motor energy are never added up. `*_excluded_s` is time without the channel. The
    motor's energy and power are of the torque it delivered: null where the ride's
    `motor_torque_meaning` is `demanded`, unless a file told the power itself.
    """

    duration_s: float
    moving_s: float | None = None
    distance_km: float | None = None
    rider_wh: float | None = None
    rider_excluded_s: float | None = None
    motor_wh: float | None = None
    motor_excluded_s: float | None = None
    battery_wh: float | None = None
    battery_excluded_s: float | None = None
    speed_kmh_mean: float | None = None
    speed_kmh_max: float | None = None
    cadence_rpm_mean: float | None = None
    cadence_rpm_max: float | None = None
    rider_torque_nm_mean: float | None = None
    rider_torque_nm_max: float | None = None
    rider_power_w_mean: float | None = None
    rider_power_w_max: float | None = None
    motor_torque_nm_max: float | None = None
    motor_power_w_mean: float | None = None
    motor_power_w_max: float | None = None
    battery_soc_pct_used: float | None = None
    motor_temperature_degc_max: float | None = None


@dataclass(frozen=True, slots=True)
class RideContext:
    """What was true of the bike while the ride was made; None where unknown.

    device_id: the connection it came over. unit_key: as of core.unit_key. boot_id, unit_t0_us:
    which start of the unit, and its clock at the ride's first row: together with the key they tell
    one ride from every other, whichever way it came.
    """

    device_id: str | None = None
    device_serial: str | None = None
    device_model: str | None = None
    firmware_version: str | None = None
    config_generation: int | None = None
    config_crc32: int | None = None
    gear_ratio: float | None = None
    boot_id: int | None = None
    unit_t0_us: int | None = None
    unit_key: str | None = None


@described
class RidePlace:
    """Where a ride began: the nearest town of GeoNames. Null for what is unknown."""

    name: str | None = None
    """The nearest town's."""
    country: str | None = None
    """ISO 3166 code of two letters."""
    zone: str | None = None
    """Of the IANA database: local times are in it."""
    is_loop: bool | None = None
    """It ended where it began."""


@dataclass(frozen=True)
class Ride:
    """One ride as the store knows it.

    state: `live` while it is recorded, `done` when its object is written, `bad` where the store
    cannot read its own entry of it: then only id, start, name and notes mean something. origin:
    `recorded` or `imported`. period_us: spacing of the rows, None when they are irregular.
    completeness: share of the rows that should be there (0..1), None when nobody can say; a stretch
    filled from a log counts as there. filled: those stretches. events: what happened. cut_short:
    the recording ended while the bike moved, or with its server, so that nobody knows what came
    after. bike_id: the bike its unit was on; None where the unit is unknown. sport: as the file
    calls it, None for none. intake: what became of the file's rows and fields, None for what came
    from no file. metadata: what the device that made the file told beside its rows. same_ride_as:
    another device's recording of the same ride. tags: words its rider gave it. place,
    speed_line_kmh: of its card, once that is made.
    """

    id: int
    state: str
    origin: str
    name: str
    notes: str
    started_us: int
    row_count: int
    period_us: int | None
    channels: tuple[ChannelSpec, ...]
    derived: tuple[ChannelSpec, ...]
    context: RideContext
    gaps: tuple[Gap, ...] = ()
    filled: tuple[Filled, ...] = ()
    events: tuple[RideEvent, ...] = ()
    completeness: float | None = None
    upload_id: str | None = None
    source_sha256: str | None = None
    object_key: str | None = None
    object_bytes: int | None = None
    summary: RideSummary | None = None
    cut_short: bool = False
    bike_id: int | None = None
    sport: str | None = None
    intake: Intake | None = None
    metadata: DeviceMetadata = DeviceMetadata()  # noqa: RUF009 - frozen
    same_ride_as: int | None = None
    tags: tuple[str, ...] = ()
    place: RidePlace | None = None
    speed_line_kmh: tuple[float | None, ...] = ()

    @property
    def motor_torque_meaning(self) -> str | None:
        """`demanded` or `delivered`: what its motor torque is. None without one."""
        return motor_torque_meaning([channel.name for channel in self.channels])

    def settings_spans(self) -> list[tuple[float, int | None]]:
        """When each configuration came into force, s after the start, and its CRC-32: the first at
        0, None where it is unknown."""
        first = self.context.config_crc32
        later = settings_changes(self.events, first)
        return [(0.0, first), *((event.t_s, event.value) for event in later)]

    @property
    def offered(self) -> tuple[ChannelSpec, ...]:
        """Every channel that can be asked for: recorded first, then derived."""
        return self.channels + self.derived

    def as_json(self) -> dict[str, object]:
        """The ride as the API shows it: ISO times, null for missing."""
        return {
            "id": self.id,
            "state": self.state,
            "origin": self.origin,
            "name": self.name,
            "notes": self.notes,
            "started_at": iso_utc(self.started_us),
            "row_count": self.row_count,
            "period_us": self.period_us,
            "channels": [
                {**channel_to_json(channel), "derived": channel in self.derived}
                for channel in self.offered
            ],
            "motor_torque_meaning": self.motor_torque_meaning,
            "unit_key": self.context.unit_key,
            "bike_id": self.bike_id,
            "device": asdict(self.context),
            "gaps": [asdict(gap) for gap in self.gaps],
            "filled": [asdict(span) for span in self.filled],
            "events": [asdict(event) for event in self.events],
            "completeness": self.completeness,
            "cut_short": self.cut_short,
            "sport": self.sport,
            "intake": asdict(self.intake) if self.intake else None,
            **metadata_to_json(self.metadata),
            "upload_id": self.upload_id,
            "object_bytes": self.object_bytes,
            "summary": asdict(self.summary) if self.summary else None,
            "same_ride_as": self.same_ride_as,
            "tags": list(self.tags),
            "place": asdict(self.place) if self.place else None,
            "speed_line_kmh": list(self.speed_line_kmh),
        }


# Letters to Unicode, and nothing to the eye: the fillers of Hangul and the empty cell of Braille.
BLANK_LETTERS = frozenset("\u115f\u1160\u2800\u3164\uffa0")


def readable_name(name: str) -> str:
    """A name as it was given; empty where nothing of it can be seen, so that the ride is called by
    its time of day."""
    is_visible = any(c.isprintable() and not c.isspace() and c not in BLANK_LETTERS for c in name)
    return name if is_visible else ""


def iso_utc(time_us: int) -> str:
    """Microseconds since 1970 UTC -> ISO 8601 with `Z`. Raises OverflowError past the year 9999."""
    return utc(time_us).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def pause_us(times_us: TimesUs, period_us: int | None) -> int:
    """Longest spacing of rows that still counts as one recording, in microseconds."""
    if period_us is not None:
        return period_us
    usual = float(np.median(np.diff(times_us))) if len(times_us) > 1 else 0.0
    return max(PAUSE_MIN_US, int(PAUSE_SPACINGS * usual))


def find_gaps(
    times_us: TimesUs,
    empty: npt.NDArray[np.bool_],
    period_us: int | None,
    pauses: Sequence[Pause] = (),
) -> tuple[Gap, ...]:
    """Where samples are missing: pauses in the time, and runs of rows without any sample.

    times_us: int64 (n,). empty: bool (n,), rows in which every channel is missing. pauses: of the
    device's timer; a break between two rows that one of them covers is a gap however short it is.
    """
    if len(times_us) == 0:
        return ()
    long = np.diff(times_us) > pause_us(times_us, period_us)
    for pause in pauses:
        middle_us = 5e5 * (pause.from_s + pause.to_s)
        behind = int(np.searchsorted(times_us, middle_us))
        if 0 < behind < len(times_us):
            stood_us = times_us[behind] - times_us[behind - 1]
            long[behind - 1] |= stood_us >= 1e6 * (pause.to_s - pause.from_s) > 0
    paused = np.flatnonzero(long)
    gaps = [Gap(float(times_us[i]) / 1e6, float(times_us[i + 1]) / 1e6) for i in paused]
    edges = np.flatnonzero(np.diff(np.concatenate(([False], empty, [False])).astype(np.int8)))
    for start, stop in edges.reshape(-1, 2):
        ends_us = times_us[min(stop, len(times_us) - 1)]
        lost = int(stop - start)
        gaps.append(Gap(float(times_us[start]) / 1e6, float(ends_us) / 1e6, rows_lost=lost))
    return tuple(sorted(gaps, key=lambda gap: gap.from_s))


def summarise(
    values: Mapping[str, Values],
    times_us: TimesUs,
    period_us: int | None,
    seconds: Values | None = None,
) -> RideSummary:
    """The ride's figures from physical values by channel name, each (n,), missing as NaN.

    values: recorded and derived channels; only those present are used. times_us: int64 (n,).
    seconds: how long each sample holds, float64 (n,), where the times alone do not tell.
    """
    if seconds is None:
        seconds = sample_seconds(times_us, pause_us(times_us, period_us))
    duration_s = float(times_us[-1] - times_us[0]) / 1e6 if len(times_us) else 0.0
    figures: dict[str, float | None] = {}
    figures |= movement_figures(values, seconds)
    if "distance_km" not in figures and "latitude_deg" in values and "longitude_deg" in values:
        positions = values["latitude_deg"], values["longitude_deg"]
        figures["distance_km"] = track_km(*positions, times_us, pause_us(times_us, period_us))
    for owner, channel in (("rider", RIDER_POWER), ("motor", MOTOR_POWER)):
        figures |= power_figures(owner, values.get(channel.name), seconds)
    if BATTERY_POWER.name in values:
        spent = energy(values[BATTERY_POWER.name], seconds)
        figures |= {"battery_wh": spent.wh, "battery_excluded_s": spent.excluded_s}
    figures |= crank_figures(values)
    figures["motor_torque_nm_max"] = largest(values.get("motor_torque_nm"))
    figures["motor_temperature_degc_max"] = largest(values.get("motor_temperature_degc"))
    charge = present(values.get("battery_soc_pct"))
    if len(charge):
        figures["battery_soc_pct_used"] = float(charge[0] - charge[-1])
    return RideSummary(duration_s=duration_s, **figures)


def movement_figures(values: Mapping[str, Values], seconds: Values) -> dict[str, float | None]:
    """Distance, moving time, speeds. An odometer wins over the integral; the mean is of moving."""
    speed = values.get("speed_kmh")
    figures: dict[str, float | None] = {}
    if speed is not None and np.isfinite(speed).any():
        moving = speed > MOVING_KMH
        moving_s = float(np.sum(seconds[moving]))
        ridden = weighted_sum(speed[moving], seconds[moving])
        figures |= {
            "moving_s": moving_s,
            "distance_km": weighted_sum(speed, seconds) / 3600.0,
            "speed_kmh_mean": ridden / moving_s if moving_s > 0 else None,
            "speed_kmh_max": largest(speed),
        }
    odometer = present(values.get("distance_m"))
    if len(odometer):
        figures["distance_km"] = float(np.max(odometer) - np.min(odometer)) / 1000.0
    return figures


def track_km(
    latitude_deg: Values, longitude_deg: Values, times_us: TimesUs, break_us: int
) -> float | None:
    """Length of a track (n,) over the ground.

    What lies between two positions further apart in time than break_us is not counted: nobody
    knows the way. None where no two positions follow each other.
    """
    valid = np.isfinite(latitude_deg) & np.isfinite(longitude_deg)
    latitude, longitude = latitude_deg[valid], longitude_deg[valid]
    follows = np.diff(times_us[valid]) <= break_us
    if not follows.any():
        return None
    steps_m = great_circle_m(latitude[:-1], longitude[:-1], latitude[1:], longitude[1:])
    return float(np.sum(steps_m[follows])) / 1000.0


def power_figures(owner: str, power_w: Values | None, seconds: Values) -> dict[str, float | None]:
    """Energy, mean and maximum of the rider's or the motor's power."""
    if power_w is None or not np.isfinite(power_w).any():
        return {}
    total = energy(power_w, seconds)
    included_s = float(np.sum(seconds)) - total.excluded_s
    return {
        f"{owner}_wh": total.wh,
        f"{owner}_excluded_s": total.excluded_s,
        f"{owner}_power_w_mean": total.wh * 3600.0 / included_s if included_s > 0 else None,
        f"{owner}_power_w_max": largest(power_w),
    }


def crank_figures(values: Mapping[str, Values]) -> dict[str, float | None]:
    """Cadence and rider torque; means over turning cranks only, as head units do."""
    cadence, torque = values.get("cadence_rpm"), values.get("rider_torque_nm")
    figures: dict[str, float | None] = {
        "cadence_rpm_max": largest(cadence),
        "rider_torque_nm_max": largest(torque),
    }
    if cadence is not None:
        turning = cadence > 0
        if turning.any():
            figures["cadence_rpm_mean"] = float(np.mean(cadence[turning]))
            torques = present(torque[turning]) if torque is not None else present(None)
            if len(torques):
                figures["rider_torque_nm_mean"] = float(np.mean(torques))
    return figures


def present(values: Values | None) -> Values:
    """The samples that are there."""
    return values[np.isfinite(values)] if values is not None else np.empty(0)


def largest(values: Values | None) -> float | None:
    """Largest sample, None when there is none."""
    numbers = present(values)
    return float(np.max(numbers)) if len(numbers) else None
