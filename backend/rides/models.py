"""Rides: summary, list, traces."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.core.device_metadata import DeviceSession, Instrument, Lap, Pause
from backend.core.doubts import Doubt
from backend.core.filled import Filled
from backend.core.intake import Intake
from backend.core.ride import Gap, RidePlace, RideSummary
from backend.core.ride_events import RideEvent


class RideChannel(Answer):
    """A channel that can be asked for; `derived` ones are computed from recorded ones."""

    name: str
    unit: str
    scale: float
    derived: bool


class RideDevice(Answer):
    """What was true of the bike while the ride was made; null where unknown."""

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
    owner_id: int | None = Field(
        description="The account whose ride it is: its bike's owner when it began, or who sent the "
        "file, if that is a rider. Null for nobody's."
    )
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
    statements: list[DeviceSession] = Field(
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
    outdone: bool = Field(
        description="A better recording of the same ride counts in sums and records in its place."
    )
    tags: list[str]
    place: RidePlace | None = Field(
        description="Null without positions, and until a moment after the ride came."
    )
    speed_line_kmh: list[float | None] = Field(
        description="Mean speeds over 64 equal times; empty without a speed."
    )
    doubts: list[Doubt] = Field(
        description="Figures that disagree or cannot be. The ride is in no record until somebody "
        "accepts them. Empty until a moment after the ride came."
    )


class RideList(Answer):
    items: list[Ride]
    next: str | None
    total: int | None = Field(description="Rides of this kind in all; with the first page only.")


class RidePatch(RequestBody):
    name: str | None = Field(default=None, max_length=200)
    notes: str | None = Field(default=None, max_length=20_000)
    tags: list[str] | None = Field(default=None, max_length=100, description="All of them, anew.")
    doubts_accepted: bool | None = Field(
        default=None, description="Whether somebody accepts all that is doubtful of the ride."
    )


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
