"""A ride: rows of counts over time, what is known about it, and its figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np
import numpy.typing as npt

from backend.core._generated import MOVING_KMH
from backend.core.breaks import find_breaks
from backend.core.channels import ChannelSpec, Counts, Values, channel_to_json
from backend.core.charge_use import charge_use
from backend.core.described import described
from backend.core.device_metadata import DeviceMetadata, metadata_to_json
from backend.core.distance import DistanceSource, row_distances
from backend.core.doubts import Doubt
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

TimesUs = npt.NDArray[np.int64]

SUMMARY_METHOD = 1
"""Counted up when figures or gaps of the same rows become others: those of every ride are then
worked out anew."""
LIVE, DONE, BAD = STATES = ("live", "done", "bad")
ORIGINS = ("recorded", "imported")


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
    distance_source: DistanceSource | None = None
    """By what it was found: positions alone where there is neither odometer nor speed."""
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
    after. bike_id: the bike its unit was on; None where the unit is unknown. owner_id: the account
    whose ride it is; None for nobody's. sport: as the file
    calls it, None for none. intake: what became of the file's rows and fields, None for what came
    from no file. metadata: what the device that made the file told beside its rows. same_ride_as:
    another device's recording of the same ride. tags: words its rider gave it. place,
    speed_line_kmh, doubts: of its card, once that is made. accepted_doubts: codes of those that
    somebody accepted. outdone: a better recording of the same ride counts in its place.
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
    owner_id: int | None = None
    sport: str | None = None
    intake: Intake | None = None
    metadata: DeviceMetadata = DeviceMetadata()  # noqa: RUF009 - frozen
    same_ride_as: int | None = None
    tags: tuple[str, ...] = ()
    place: RidePlace | None = None
    speed_line_kmh: tuple[float | None, ...] = ()
    doubts: tuple[Doubt, ...] = ()
    accepted_doubts: tuple[str, ...] = ()
    outdone: bool = False

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
            "owner_id": self.owner_id,
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
            "outdone": self.outdone,
            "tags": list(self.tags),
            "place": asdict(self.place) if self.place else None,
            "speed_line_kmh": list(self.speed_line_kmh),
            "doubts": [
                {**asdict(doubt), "accepted": doubt.code in self.accepted_doubts}
                for doubt in self.doubts
            ],
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


def find_gaps(
    times_us: TimesUs, empty: npt.NDArray[np.bool_], breaks: npt.NDArray[np.bool_]
) -> tuple[Gap, ...]:
    """Where samples are missing: breaks in the time, and runs of rows without any sample.

    times_us: int64 (n,). empty: bool (n,), rows in which every channel is missing. breaks: bool
    (n - 1,), of the steps from row to row; see core.breaks.
    """
    if len(times_us) == 0:
        return ()
    gaps = [
        Gap(float(times_us[i]) / 1e6, float(times_us[i + 1]) / 1e6) for i in np.flatnonzero(breaks)
    ]
    edges = np.flatnonzero(np.diff(np.concatenate(([False], empty, [False])).astype(np.int8)))
    for start, stop in edges.reshape(-1, 2):
        ends_us = times_us[min(stop, len(times_us) - 1)]
        lost = int(stop - start)
        gaps.append(Gap(float(times_us[start]) / 1e6, float(ends_us) / 1e6, rows_lost=lost))
    return tuple(sorted(gaps, key=lambda gap: gap.from_s))


def breaks_at(gaps: Sequence[Gap], times_us: TimesUs) -> npt.NDArray[np.bool_]:
    """Which steps from row to row (n - 1,) are breaks, of a ride whose gaps are known."""
    breaks = np.zeros(max(len(times_us) - 1, 0), dtype=bool)
    middles_us = [5e5 * (gap.from_s + gap.to_s) for gap in gaps if gap.rows_lost is None]
    at = np.searchsorted(times_us, np.array(middles_us)) - 1
    breaks[at[(at >= 0) & (at < len(breaks))]] = True
    return breaks


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
        seconds = (
            sample_seconds(times_us, find_breaks(values, times_us))
            if period_us is None
            else np.broadcast_to(np.float64(period_us / 1e6), len(times_us))
        )
    duration_s = float(times_us[-1] - times_us[0]) / 1e6 if len(times_us) else 0.0
    figures: dict[str, float | None] = {}
    figures |= speed_figures(values.get("speed_kmh"), seconds)
    distances = row_distances(values, times_us / 1e6, seconds)
    if distances is not None:
        figures["distance_km"] = (float(distances.step_m.sum()) + distances.lost_m) / 1000.0
    for owner, channel in (("rider", RIDER_POWER), ("motor", MOTOR_POWER)):
        figures |= power_figures(owner, values.get(channel.name), seconds)
    if BATTERY_POWER.name in values:
        spent = energy(values[BATTERY_POWER.name], seconds)
        figures |= {"battery_wh": spent.wh, "battery_excluded_s": spent.excluded_s}
    figures |= crank_figures(values)
    figures["motor_torque_nm_max"] = largest(values.get("motor_torque_nm"))
    figures["motor_temperature_degc_max"] = largest(values.get("motor_temperature_degc"))
    charge = values.get("battery_soc_pct")
    if charge is not None and (use := charge_use(charge, times_us / 1e6)) is not None:
        figures["battery_soc_pct_used"] = use.used_pct
    source = distances.source if distances else None
    return RideSummary(duration_s=duration_s, distance_source=source, **figures)


def speed_figures(speed_kmh: Values | None, seconds: Values) -> dict[str, float | None]:
    """Moving time and speeds; the mean is of moving."""
    if speed_kmh is None or not np.isfinite(speed_kmh).any():
        return {}
    moving = speed_kmh > MOVING_KMH
    moving_s = float(np.sum(seconds[moving]))
    ridden = weighted_sum(speed_kmh[moving], seconds[moving])
    return {
        "moving_s": moving_s,
        "speed_kmh_mean": ridden / moving_s if moving_s > 0 else None,
        "speed_kmh_max": largest(speed_kmh),
    }


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
