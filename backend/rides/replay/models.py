"""A ride with other settings: replayed, ridden again; and what the rides made of a table."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.core.parameter_value import Parameters
from backend.law.rider_and_bike import RiderAndBike
from backend.rides.models import Series
from backend.tuning.models.law import AssistModes, FivePoints, FuzzyTable, Table


class OtherSettings(RequestBody):
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

    def rider_and_bike(self) -> RiderAndBike:
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

    Peak torque and its steepest rise are not reported: they cannot be forecast.
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


class TableUseRequest(RequestBody):
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
