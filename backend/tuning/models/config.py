"""The configuration of a unit: whole, parameter by parameter, and as typed views."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.core.parameter_value import TOKEN, TOKEN_PATTERN, Parameters, ParameterValue
from backend.device.configuration import Free

CONFIRM_S_MAX = 255
CONFIRM_S = (
    "0 commits for good; else the unit returns to what it had after so many seconds, at a restart "
    "or power loss, unless `POST .../config/confirm` comes first."
)


class Parameter(Answer):
    """What a parameter is, and its value in the unit now.

    `min`, `max` and `choices` are the unit's own bounds. Choices are in lower case, but for the
    labels of rules, NB NS ZO PS PB; they are taken in any case.
    """

    id: int
    name: str
    group: str
    type: str
    shape: list[int]
    unit: str
    min: float | None
    max: float | None
    default: ParameterValue
    access: Literal["rider", "dealer", "factory"]
    value: ParameterValue
    may_be_none: bool = Field(
        default=False, description="Whether `null` is a value: a correction that is not known."
    )
    of_the_unit: bool = Field(
        default=False,
        description="Whether it was measured or set for this one unit and its bike, as the "
        "sensor's calibration and the wheel: no part of a set-up for another one.",
    )
    free: Free | None = Field(
        default=None, description="Only of parameters that are held near the factory's value."
    )
    choices: list[str] | None = None
    description: str


class ParameterList(Answer):
    items: list[Parameter]
    next: str | None = None


class LastKnown(Answer):
    """What a unit was last known to be set to. Nothing can be written on it: it has no ETag."""

    unit_key: str
    seen_at: datetime | None = Field(description="When the unit was last there.")
    recorded_at: datetime = Field(description="When this configuration was read from it.")
    generation: int | None
    crc32: int | None
    parameters: list[Parameter]


class Config(Answer):
    unit_key: str = Field(description="Of the unit that has it.")
    generation: int
    crc32: int
    parameters: Parameters


class ConfigPatch(RequestBody):
    parameters: Parameters = Field(min_length=1, max_length=400)
    reason: str = Field(default="", max_length=400)
    confirm_s: int = Field(default=0, ge=0, le=CONFIRM_S_MAX, description=CONFIRM_S)
    token: str | None = Field(
        default=None,
        pattern=TOKEN_PATTERN,
        description=TOKEN,
    )
    read_from: str | None = Field(
        default=None,
        max_length=400,
        description="The `unit_key` of the unit that the values were read from, where they come "
        "from a backup or a revision. What stays with a unit (`of_the_unit`) is refused of another "
        "one, the record of a calibration also where this is not told: 422 `of_another_unit`.",
    )


class LiveRequest(RequestBody):
    """Values to try at once, in the unit's memory alone."""

    parameters: Parameters = Field(min_length=1, max_length=400)
    ttl_s: int = Field(ge=1, le=255, description="The unit ends it after so many seconds.")


class Live(Answer):
    """What is tried on top of the configuration: the values in force that differ from it."""

    parameters: Parameters
    remaining_s: float | None
    expires_at: datetime | None


class ParameterChange(Answer):
    name: str
    old: ParameterValue
    new: ParameterValue


class ConfigChange(Answer):
    """A change that the unit took, read back and compared field by field."""

    unit_key: str = Field(description="Of the unit that took it.")
    generation: int
    crc32: int
    state: Literal["committed", "provisional", "needs_restart"] = Field(
        description="`provisional`: given up at `expires_at` unless it is confirmed. "
        "`needs_restart`: holds from the unit's next start on."
    )
    verified: bool = Field(
        description="Whether the last comparison that this make of unit allows was made."
    )
    changed: list[ParameterChange]
    expires_at: datetime | None
    parameters: Parameters = Field(description="The whole configuration as it was read back.")


class Revision(Answer):
    """Who changed what, when and why."""

    seq: int = Field(description="Counts the configurations of one unit from 1.")
    created_at: datetime
    author: str = Field(description="Empty where nobody knows.")
    author_proof: Literal["stated", "signed_in"] | None = Field(
        description="How the author is known: `stated` is by their own word, `signed_in` by an "
        "account or a key."
    )
    reason: str
    state: str
    generation: int | None
    crc32: int | None
    changed: list[ParameterChange]
    unit_key: str = Field(description="Whose configuration it was, over whatever connection.")


class RidesTogether(Answer):
    """What some rides of a unit come to together; null where none of them tells it.

    Rider and motor energy are never added up: `assist_ratio` is the motor's over the rider's.
    """

    ride_ids: list[int] = Field(description="Newest first; at most 20, each of 500 m and more.")
    distance_km: float
    speed_kmh_mean: float | None = Field(description="While moving.")
    motor_rides: int = Field(description="Of the rides those whose motor work was measured.")
    motor_wh_per_km: float | None = Field(description="Work at the motor's shaft.")
    motor_wh_per_km_least: float | None = Field(description="Of one ride.")
    motor_wh_per_km_most: float | None
    rider_wh_per_km: float | None
    battery_wh_per_km: float | None
    assist_ratio: float | None


class SinceChange(Answer):
    """The rides since a change beside those before it."""

    seq: int
    created_at: datetime
    meaning: str = Field(description="What it cannot tell, in English.")
    before: RidesTogether
    after: RidesTogether
    motor_wh_per_km_after: Literal["more", "less", "mixed", "too_few"] = Field(
        description="`more`, `less`: every ride since took more, or less, than every ride before. "
        "`mixed`: they overlap. `too_few`: fewer than 3 on a side."
    )
    during_ids: list[int] = Field(
        description="Rides on which the change was made: they are on neither side."
    )
    other_changes: int = Field(
        description="How many other configurations the unit got between the first and the last of "
        "these rides: what moved may be theirs."
    )


class RevisionList(Answer):
    items: list[Revision]
    next: str | None = None
