"""Rides: summary, list, traces."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import Field

from backend.core.request_body import RequestBody
from backend.web.models import Answer


class RideSummary(Answer):
    """What a ride comes to; null where the ride lacks the channel.

    Rider and motor energy are never added up. `*_excluded_s` is time without the channel. The
    motor's energy and power are of the torque it delivered: null where the ride's
    `motor_torque_meaning` is `demanded`, unless a file told the power itself.
    """

    duration_s: float
    moving_s: float | None
    distance_km: float | None
    rider_wh: float | None
    rider_excluded_s: float | None
    motor_wh: float | None
    motor_excluded_s: float | None
    battery_wh: float | None
    battery_excluded_s: float | None
    speed_kmh_mean: float | None
    speed_kmh_max: float | None
    cadence_rpm_mean: float | None
    cadence_rpm_max: float | None
    rider_torque_nm_mean: float | None
    rider_torque_nm_max: float | None
    rider_power_w_mean: float | None
    rider_power_w_max: float | None
    motor_torque_nm_max: float | None
    motor_power_w_mean: float | None
    motor_power_w_max: float | None
    battery_soc_pct_used: float | None
    motor_temperature_degc_max: float | None


class Gap(Answer):
    """A stretch without samples; `rows_lost` where it is known."""

    from_s: float
    to_s: float
    rows_lost: int | None


class Filled(Answer):
    """A stretch the recording lacked, filled from the unit's own log at the log's rate.

    Of the `rows_lost` rows in it `rows_filled` have samples now; nothing was interpolated.
    """

    from_s: float
    to_s: float
    rows_lost: int
    rows_filled: int
    period_us: int = Field(description="Spacing of the source's rows.")
    source: Literal["unit_log"]


class Intake(Answer):
    """What became of every row and field of the file: kept, or counted here with the reason.

    rows_read = rows_kept + rows_joined + the sum of rows_dropped.
    """

    rows_read: int
    rows_kept: int
    rows_joined: int = Field(description="Of one time, each with a part of the values.")
    rows_spread: int = Field(
        description="Of one time with values of their own; they stand evenly within it."
    )
    rows_moved: int = Field(description="How often the clock went back.")
    rows_dropped: dict[str, int] = Field(
        description="By reason: no_time, clock_not_set, clock_jumped, no_value."
    )
    values_dropped: dict[str, int] = Field(
        description="By channel: what no bike can do, and single samples far from both neighbours."
    )
    fields_unread: dict[str, int] = Field(
        description="By name, in how many rows: text, bytes and lists of numbers."
    )
    taken_as: dict[str, str] = Field(
        description="What the file does not say, and what it was taken as: `time_zone`, "
        "`rows_per_second`, a column's unit. `start`: where its date is from. `clock`: the zone "
        "that its two clocks, one of UTC, are apart."
    )


class Lap(Answer):
    """A part of the ride that was marked off, in seconds after its start; null for untold."""

    from_s: float
    to_s: float
    trigger: str | None = Field(
        description="manual, time, distance, position, session_end, other; null for untold."
    )
    timer_s: float | None = Field(description="Time the device's timer ran.")
    distance_m: float | None
    calories_kcal: float | None


class Pause(Answer):
    """The timer of the device that recorded stood."""

    from_s: float
    to_s: float
    by_rider: bool | None = Field(description="False when the device stopped by itself.")


class Instrument(Answer):
    """The device that recorded, or one that it heard; null for what the file does not tell."""

    kind: str | None = Field(description="`recorder`, or what it measures: `bike_power`.")
    maker: str | None
    product: str | None
    serial_number: str | None
    software_version: str | None
    battery_v: float | None = Field(description="Of its own battery.")
    battery_status: str | None


class Stated(Answer):
    """A figure as the device that recorded stated it, by its own rules: none of `summary`."""

    name: str = Field(
        description="Of FIT's profile or of the file: `lev_battery_consumption`, `unknown_177`."
    )
    value: float
    unit: str = Field(description="Empty for none, and where nothing tells it.")


class Statement(Answer):
    """What the device stated of one whole session, which may reach beyond the ride."""

    from_s: float
    to_s: float
    figures: list[Stated]


class RideEvent(Answer):
    """A fault that came or went (value: bits of `fault_flags`), the mode chosen (its slot),
    settings that came into force (CRC-32 of the configuration), a moment that somebody marked (its
    number), or the host's clock set in mid-ride (by how many milliseconds, negative for back; the
    ride is dated by the clock as it was set)."""

    t_s: float
    kind: Literal["fault_set", "fault_cleared", "assist_mode", "settings", "mark", "clock_set"]
    value: int


class RideChannel(Answer):
    """A channel that can be asked for; `derived` ones are computed from recorded ones."""

    name: str
    unit: str
    scale: float
    derived: bool


class RideDevice(Answer):
    """What was true of the bike while the ride was made; null where nobody knows."""

    device_id: str | None = Field(description="The connection it was recorded over.")
    device_serial: str | None
    device_model: str | None
    firmware_version: str | None
    config_generation: int | None
    config_crc32: int | None
    gear_ratio: float | None


class RidePlace(Answer):
    """Where a ride began: the nearest town of GeoNames. Null for what nobody knows."""

    name: str | None
    country: str | None = Field(description="ISO 3166 code of two letters.")
    zone: str | None = Field(description="Of the IANA database: a local time is told by it.")
    is_loop: bool | None = Field(description="It ended where it began.")


class Ride(Answer):
    id: int
    state: Literal["live", "closing", "done", "bad"]
    origin: Literal["recorded", "imported"]
    name: str
    notes: str
    started_at: datetime
    row_count: int
    period_us: int | None = Field(description="Spacing of the rows; null when irregular.")
    channels: list[RideChannel]
    motor_torque_meaning: Literal["demanded", "delivered"] | None = Field(
        description="What `motor_torque_nm` of this ride is: what the motor gave, by its current; "
        "or only what was asked of it, as units of firmware before `motor_torque_demanded_nm` and "
        "most files have it. Null without that channel. The two are not compared or added."
    )
    unit_key: str | None = Field(description="The unit it was made with; null where nobody knows.")
    bike_id: int | None = Field(description="The bike that unit was on; null where nobody knows.")
    device: RideDevice
    gaps: list[Gap]
    filled: list[Filled]
    events: list[RideEvent]
    completeness: float | None = Field(
        description="Share of the rows that should be there, 0 to 1; what was filled from a log "
        "counts as there. Null when nobody can say."
    )
    cut_short: bool = Field(
        description="The recording ended while the bike moved, or with the server that recorded "
        "it: nobody knows what came after the last row. False for a ride that stood still at its "
        "end, was imported, is still being recorded, or was filled from the unit's own log since."
    )
    sport: str | None = Field(description="As the file calls it; null for none.")
    intake: Intake | None = Field(
        description="What became of the file's rows and fields; null for a ride that was recorded "
        "here, and for one that was read before this was counted."
    )
    laps: list[Lap] = Field(description="As the file tells them; empty for none.")
    pauses: list[Pause] = Field(description="Of the timer of the device that recorded.")
    instruments: list[Instrument] = Field(description="What recorded the file's ride.")
    statements: list[Statement] = Field(
        description="What that device stated of the whole ride; a session of several rides is with "
        "each. Never mixed with `summary`, which is of the ride's own rows."
    )
    upload_id: str | None
    object_bytes: int | None
    damage: Literal["missing", "wrong_size", "changed", "unreadable", "row"] | None = Field(
        description="What is wrong with the file of its samples, as far as it was looked at; then "
        "series, figure, replay and exports answer 500 `object_damaged`. The figures here stay. "
        "`row`, with the state `bad`: its row in the database is damaged, so nothing but number, "
        "start, name and notes is known until it is mended from that file, by itself."
    )
    summary: RideSummary | None = Field(
        description="Of a ride that is being recorded: so far, where this server records it."
    )
    same_ride_as: int | None = Field(
        description="Another device's recording of the same ride, which is kept beside it."
    )
    tags: list[str]
    place: RidePlace | None = Field(
        description="Null without positions, and until a moment after the ride came."
    )
    speed_line_kmh: list[float | None] = Field(
        description="Mean speeds over 64 equal times; empty without a speed."
    )


class RideList(Answer):
    items: list[Ride]
    next: str | None
    total: int | None = Field(description="Rides of this kind in all; with the first page only.")


class RidePatch(RequestBody):
    name: str | None = Field(default=None, max_length=200)
    notes: str | None = Field(default=None, max_length=20_000)
    tags: list[str] | None = Field(default=None, max_length=100, description="All of them, anew.")


class SeriesChannel(Answer):
    """Least and greatest value of each bin; a bin without a sample is null."""

    name: str
    unit: str
    min: list[float | None]
    max: list[float | None]


class Series(Answer):
    """Traces reduced to the plot's width; every extreme of the window is in them.

    `rows`: each bin is one sample, so min and max are the same. `minmax`: the least and greatest
    of the samples from the bin's first time to its last.
    """

    from_s: float
    to_s: float
    rows: int = Field(description="Samples in the bins.")
    bins: int
    kind: Literal["rows", "minmax"]
    axis: Literal["time", "moving", "distance"]
    t_first_s: list[float]
    t_last_s: list[float]
    x_first: list[float] | None = Field(
        description="As the times, in seconds in motion or metres; null for the axis `time`."
    )
    x_last: list[float] | None
    channels: list[SeriesChannel]


class Track(Answer):
    """Points of a ride in order of time; an array is null where the ride never tells it, and a
    position is null in a gap. Half of the points stand evenly in time, the others where the track
    bends most."""

    t_s: list[float]
    moving_s: list[float] | None = Field(description="Seconds in motion since the start.")
    distance_m: list[float] | None = Field(description="Way since the start.")
    latitude_deg: list[float | None] | None
    longitude_deg: list[float | None] | None


class Figure(Answer):
    """A Plotly figure, for `Plotly.newPlot`."""

    data: list[dict[str, Any]]
    layout: dict[str, Any]
