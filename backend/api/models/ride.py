"""Rides: summary, list, traces, replay; and files on their way to becoming rides."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import Field

from backend.api.models.base import Answer, Question
from backend.api.models.config import Parameters
from backend.api.models.law import AssistModes, FivePoints, FuzzyTable, Table
from backend.domain.rider_and_bike import RiderAndBike


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


class RideEvent(Answer):
    """A fault that came or went (value: bits of `fault_flags`), the mode chosen (its slot), or a
    moment that somebody marked (its number)."""

    t_s: float
    kind: Literal["fault_set", "fault_cleared", "assist_mode", "mark"]
    value: int


class RideMark(Answer):
    """A moment that was marked, t_s seconds after the start of its ride."""

    ride_id: int
    t_s: float
    number: int = Field(description="From 1, in its ride.")


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
    upload_id: str | None
    object_bytes: int | None
    damage: Literal["missing", "wrong_size", "changed", "unreadable"] | None = Field(
        description="What is wrong with the file of its samples, as far as it was looked at; then "
        "series, figure, replay and exports answer 500 `object_damaged`. The figures here stay."
    )
    summary: RideSummary | None


class RideList(Answer):
    items: list[Ride]
    next: str | None


class RidePatch(Question):
    name: str | None = Field(default=None, max_length=200)
    notes: str | None = Field(default=None, max_length=20_000)


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
    t_first_s: list[float]
    t_last_s: list[float]
    channels: list[SeriesChannel]


class Figure(Answer):
    """A Plotly figure, for `Plotly.newPlot`."""

    data: list[dict[str, Any]]
    layout: dict[str, Any]


class OtherSettings(Question):
    """What takes the place of what the ride was made with; what is not told stays."""

    parameters: Parameters = Field(
        default_factory=dict,
        max_length=400,
        description="By registry name, as a unit's configuration or an entry of the library has "
        "them. Those of sensor, wheel and drivetrain stay as they were on the ride.",
    )
    fuzzy_table: FuzzyTable | None = None
    second_table: FuzzyTable | None = Field(
        default=None, description="Shares speed and torque-rate points with the first."
    )
    assist_modes: AssistModes | None = None

    def changes(self) -> dict[str, Any]:
        """The settings alone."""
        return self.model_dump(include=set(OtherSettings.model_fields))


class ReplayRequest(OtherSettings):
    mode: Literal["open_loop"] = "open_loop"


class AgainRequest(OtherSettings):
    mass_kg: float | None = Field(
        default=None,
        ge=30.0,
        le=400.0,
        description="Rider, bike and load. Without it 92 kg, and a wider band.",
    )
    drag_area_m2: float | None = Field(
        default=None,
        ge=0.1,
        le=2.0,
        description="Drag coefficient times frontal area; 0.4 bent low to 0.6 upright. Without it "
        "0.5, and a wider band.",
    )

    def told(self) -> RiderAndBike:
        """Of rider and bike."""
        return RiderAndBike(self.mass_kg, self.drag_area_m2)


class Compared(Answer):
    recorded: float | None
    replayed: float
    difference: float | None


class Estimate(Answer):
    """recorded: as ridden. replayed: with the change, less what the twin errs by without it.
    difference: what the change makes. low, high: the band, in which nine of ten simulated rides
    lay."""

    recorded: float
    replayed: float
    difference: float
    low: float
    high: float


class Trust(Answer):
    """How far the twin is off without any change, and what it rests on."""

    no_change_error_pct: float = Field(description="Of the motor's work.")
    no_change_time_error_pct: float
    mass_kg: float = Field(description="As told, or as assumed.")
    drag_area_m2: float = Field(description="As told, or as assumed.")
    one_gear: bool = Field(
        description="False where the rider shifted: then he shifts again so that the cranks turn "
        "as they did there, and the band is wider by those who shift less."
    )


class TimeAtLimit(Answer):
    """Seconds on the way that a limit of the registry was at work; an estimate without a band."""

    limit: str
    recorded_s: float | None = Field(description="Null where the ride does not tell its limits.")
    replayed_s: float


class RideCurve(Answer):
    """Means over each stretch of the road, null where there is no sample."""

    t_s: list[float | None] = Field(description="Since the ride's own start.")
    speed_kmh: list[float | None]
    motor_torque_nm: list[float | None] = Field(description="At the motor's shaft.")


class RideCurves(Answer):
    """The same road three times: as recorded, by the twin without any change, and with it."""

    distance_km: list[float] = Field(
        description="Middle of each stretch; at most 400, none shorter than a turn of the crank."
    )
    recorded: RideCurve
    unchanged: RideCurve
    replayed: RideCurve


class ClosedLoop(Answer):
    """The same road again with other settings: an estimate with its band.

    Peak torque and its steepest rise are not told: they cannot be forecast.
    """

    meaning: str = Field(description="What it is and what it leaves out, in English.")
    wh_per_km: Estimate = Field(description="Work at the motor's shaft for a kilometre.")
    motor_work_wh: Estimate
    battery_wh: Estimate | None = Field(
        description="What leaves the battery, also at a stand; null where voltage or current was "
        "not recorded."
    )
    km_per_100_wh: Estimate | None = Field(
        description="Range: how far 100 Wh of the battery go on this road. Null as `battery_wh`."
    )
    rider_work_wh: Estimate
    duration_s: Estimate
    motor_power_w_mean: Estimate = Field(description="At the shaft, while the bike moves.")
    ripple_nm_per_s: Estimate = Field(
        description="Rms of how fast the motor's torque changes, while the bike moves."
    )
    limits: list[TimeAtLimit] = Field(description="Those that were at work, in either ride.")
    curves: RideCurves
    trust: Trust


class Replay(Answer):
    """What the motor would have done with other settings, beside what it did.

    `series` has each compared channel as recorded, and as replayed under `replayed_` and its name.
    `limit_shares`: part of the samples, 0 to 1, in which each limit of the registry held the motor
    back.
    """

    ride_id: int
    mode: Literal["open_loop"]
    meaning: str = Field(description="What the open loop leaves out, in English.")
    config_source: Literal["ride", "defaults"] = Field(
        description="Whose parameters the rest of the law ran with."
    )
    engine: str
    inputs_missing: list[str] = Field(
        description="Channels of the law's inputs that the ride lacks. Without `input_flags` the "
        "brake is off, the walk button not held and no fault forbids torque; without "
        "`torque_age_ms` the torque is fresh, without `controller_temperature_degc` the controller "
        "cool, without `motor_temperature_degc` the motor hot for the battery's limit; without "
        "`motor_speed_rpm` the motor follows the crank."
    )
    rows: int
    motor_torque_meaning: Literal["demanded", "delivered"] | None = Field(
        description="What the recorded motor torque is; where it is only `demanded`, there is no "
        "recorded work."
    )
    wh_per_km: Compared | None = Field(
        description="Work at the motor's shaft for a kilometre, the figure to compare by; null "
        "where the ride went less than 10 m."
    )
    distance_km: float = Field(description="As recorded.")
    duration_s: float = Field(description="As recorded: in open loop the road takes as long.")
    range_km: float | None = Field(
        description="Null in open loop: shaft work is not what leaves the battery."
    )
    motor_work_wh: Compared
    motor_torque_nm_max: Compared = Field(
        description="At the motor's shaft, as delivered; nothing is recorded where it is only "
        "`demanded`."
    )
    motor_power_w_mean: Compared | None = Field(
        description="At the shaft, while the bike moves; null where it never does."
    )
    ripple_nm_per_s: Compared | None = Field(
        description="Rms of how fast the motor's torque changes, while the bike moves; null as "
        "`motor_power_w_mean`."
    )
    motor_torque_nm_difference_max: float | None
    limit_shares: dict[str, float]
    limit_shares_recorded: dict[str, float] | None = Field(
        description="The same as the unit told it on the ride; null where it did not."
    )
    series: Series


class TableUseRequest(Question):
    """Which rides, and the table as it is edited: its points may differ from those ridden with."""

    ride_ids: list[int] | None = Field(
        default=None,
        min_length=1,
        max_length=20,
        description="Without it the latest 20 rides that are over.",
    )
    device: str | None = Field(
        default=None,
        max_length=500,
        description="Whose latest rides: a unit's key or serial number, or a device's id. Without "
        "it every unit's. Not together with `ride_ids`.",
    )
    table: Table = Field(
        default="first", description="Counted is what modes gave that ran by this one then."
    )
    speed_points_kmh: FivePoints
    torque_rate_points: FivePoints


class RideWithout(Answer):
    """A ride that says nothing about the table, and why.

    `missing_channel`: it lacks what the law's inputs are known by, as files of head units do.
    `not_assisted`: no mode gave assist by this table. `object_damaged`: its file is not as written.
    """

    id: int
    code: Literal["missing_channel", "not_assisted", "object_damaged"]
    message: str


class UseOfPoint(Answer):
    """A row or column of the table: its cells together."""

    point: float = Field(description="Speed in km/h of a row, torque rate of a column.")
    seconds: float
    share: float | None = Field(description="Of `assisted_s`, 0 to 1; null where that is 0.")
    motor_wh: float | None


class UseOfCells(Answer):
    """`[speed][torque rate]`, as the rules."""

    seconds: list[list[float]]
    motor_wh: list[list[float]] | None


class TableUse(Answer):
    """Where in the table the rides were: time and motor energy of each cell.

    Counted are the moments in which the rider pedalled and the table said what the motor was asked
    for. Each belongs to the at most four cells whose rules fired, in the shares of the law's sets,
    so the cells' seconds add up to `assisted_s`. A recorded torque rate never exceeds the last
    point of the table ridden with. `motor_wh` is work at the motor's shaft, null where no ride has
    a torque that the motor delivered.
    """

    table: Table
    rides: list[int] = Field(description="Ids of the rides counted, newest first.")
    rides_without: list[RideWithout]
    rides_by_defaults: list[int] = Field(
        description="Of the rides counted those whose configuration nobody kept; the law's "
        "defaults say which of their modes ran by the table."
    )
    more: bool = Field(description="There are older rides, which were not looked at.")
    since: datetime | None = Field(description="Start of the oldest ride counted.")
    assisted_s: float
    motor_excluded_s: float = Field(
        description="Part of `assisted_s` whose motor power is not known: not in `motor_wh`."
    )
    torque_rate_points_proposed: list[float] | None = Field(
        description="Points that these rides use evenly, from 0 on: they divide the time in which "
        "the torque rose by 25, 50, 75 and 98 %. Null where it rose for less than a minute."
    )
    columns: list[UseOfPoint]
    rows: list[UseOfPoint]
    cells: UseOfCells


class Upload(Answer):
    """Where a file stands. `code` and `detail` say why it is not a whole ride.

    A file that rides came from lives as long as one of them; any other can be removed.
    """

    id: str
    name: str
    length: int
    received: int
    state: Literal["receiving", "queued", "complete", "partial", "rejected"]
    code: str | None
    detail: str | None
    ride_ids: list[int]
    completeness: float | None
    duplicate_of: int | None = Field(description="The ride the same bytes became before.")
    expires_at: datetime | None = Field(
        description="When it goes by itself; null while a ride lives on it or it waits to be read."
    )


class UploadList(Answer):
    items: list[Upload]
    next: str | None
