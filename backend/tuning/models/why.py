"""Why the motor gives what it gives: a control step explained, cuts, and who carried the energy."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from backend.core.api_models import Answer, RequestBody
from backend.core.fuzzy_table import Label
from backend.law.why import FiredRule, WhyStep
from backend.tuning.models.law import AssistModes, FuzzyTable, Law, Table, UnitLimits

CHANGES = {"fuzzy_table", "second_table", "assist_modes", "limits"}


class WhyRequest(RequestBody):
    """A steady state: nothing changes but that the torque keeps rising at `torque_rate`.

    Tables, modes and limits take the place of the unit's, or of the law's defaults.
    """

    speed_kmh: float = Field(ge=0.0, le=100.0)
    torque_rate: float = Field(
        default=0.0, gt=-1.0, le=100.0, description="Below 0 the torque falls."
    )
    rider_torque_nm: float = Field(default=30.0, ge=0.0, le=300.0)
    cadence_rpm: float = Field(default=60.0, ge=-200.0, le=200.0)
    mode: int | None = Field(
        default=None, ge=0, le=4, description="Slot; without it the one at start."
    )
    motor_speed_rpm: float | None = Field(
        default=None, ge=0.0, le=10_000.0, description="Without it the motor follows the crank."
    )
    battery_voltage_v: float | None = Field(default=None, ge=0.0, le=100.0)
    battery_current_a: float | None = Field(default=None, ge=-100.0, le=100.0)
    motor_temperature_degc: float | None = Field(default=None, ge=-60.0, le=300.0)
    controller_temperature_degc: float | None = Field(default=None, ge=-60.0, le=300.0)
    brake: bool = False
    walk_button: bool = False
    hold_s: float = Field(
        default=10.0, ge=0.1, le=600.0, description="For how long, from rest, at 100 steps a second"
    )
    fuzzy_table: FuzzyTable | None = None
    second_table: FuzzyTable | None = Field(
        default=None, description="Shares speed and torque-rate points with the first."
    )
    assist_modes: AssistModes | None = None
    limits: UnitLimits | None = None

    def parts(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """The state, and what takes the place of the configuration's."""
        changes = self.model_dump(include=CHANGES)
        if self.limits is not None:
            changes["limits"].pop("effective_assist_cutoff_kmh")
        return self.model_dump(exclude=CHANGES), changes


class WhyMoment(Answer):
    """`steady`: held for `hold_s`, nobody rode it. `ride`: `t_s` after its start."""

    kind: Literal["steady", "ride"]
    ride_id: int | None
    t_s: float | None
    hold_s: float | None


class WhySettings(Answer):
    """What the steps after the law go by in this mode."""

    gear_ratio: float
    mode_ratio: float
    pedal_torque_nm_min: float
    cutoff_kmh: float
    ramp_up_nm_per_s: float
    ramp_down_nm_per_s: float
    motor_torque_nm_max: float = Field(description="The mode's share of it, at the motor's shaft.")
    battery_current_a_max: float
    battery_voltage_v_min: float
    motor_speed_rpm_max: float


class WhyRecorded(Answer):
    """What the unit itself told at that moment; the motor's torque at its shaft."""

    fuzzy_gain: float | None
    assist_ratio: float | None
    motor_torque_demanded_nm: float | None


class WhyDiffers(Answer):
    figure: Literal["fuzzy_gain", "assist_ratio"]
    recorded: float
    worked_out: float


class Why(Answer):
    """A control step in the unit's own order. Torques are at the crank, missing is null.

    The torques of `steps` add up to `delivered_nm`, by a last step `current_control`: what the
    motor gave less what it was told. Where nothing was measured there is no such step, and they
    add up to `commanded_nm`. Where the input was refused the one step says so.
    """

    moment: WhyMoment
    config_source: Literal["ride", "unit", "given"]
    engine: str
    warmed_up_s: float | None = Field(
        default=None, description="Of the ride before the moment, from which the law remembers."
    )
    result: Literal["ok", "input_refused", "result_lost"]
    law: Literal["off", "fixed", "fuzzy", "walk"]
    mode: int
    mode_name: str
    table: FuzzyTable | None = Field(description="The mode's; null where its law has none.")
    speed_kmh: float | None
    cadence_rpm: float | None
    rider_torque_nm: float | None = Field(description="As the law averages it over the stroke.")
    torque_rate: float | None
    rules: list[FiredRule]
    gain: float | None = Field(description="Null where the mode has none.")
    assist_ratio: float | None
    crank_rad_per_s: float | None
    steps: list[WhyStep]
    commanded_nm: float
    available_nm: float | None = Field(
        description="What motor, heat, battery and back-EMF allow; null for a refused input."
    )
    delivered_nm: float | None
    limit_flags: list[str]
    readings: dict[str, float | None] = Field(description="The inputs of the law that are known.")
    settings: WhySettings
    recorded: WhyRecorded | None
    differs: list[WhyDiffers] = Field(
        description="What the unit told otherwise than it is worked out here, by more than "
        "rounding: settings that were only on trial are in no configuration, and after a change "
        "the unit still remembers what was before.",
    )


class Cut(Answer):
    """A stretch in which limits held the motor back, seconds since the ride's start."""

    from_s: float
    to_s: float
    at_s: float = Field(description="Near its middle, where a limit is at work.")
    limits: list[str]


class Cuts(Answer):
    items: list[Cut]


class ModeShare(Answer):
    mode: int
    name: str | None = Field(description="Null where nobody kept the ride's configuration.")
    law: Law | None
    seconds: float
    motor_wh: float | None
    share: float | None = Field(description="Of the ride's motor energy, 0 to 1.")


class RuleShare(Answer):
    """A rule of the table the ride was ridden with: its cell is `rules[row][column]`."""

    table: Table
    row: int
    column: int
    label: Label
    speed_point_kmh: float
    torque_rate_point: float
    seconds: float
    motor_wh: float
    share: float | None = Field(description="Of the ride's motor energy, 0 to 1.")


class Ledger(Answer):
    """Who carried the motor's energy, delivered at its shaft. Missing is null.

    The modes' energies add up to `motor_wh`, and so do those of the rules and `without_rule_wh`:
    what fixed modes, walk assist and a motor that runs out gave.
    """

    ride_id: int
    config_source: Literal["ride", "defaults"]
    motor_wh: float | None = Field(
        description="Null for a ride that tells only what was asked of its motor."
    )
    motor_excluded_s: float = Field(description="Time in which the motor's power is not known.")
    modes: list[ModeShare]
    rules: list[RuleShare] | None = Field(
        description="The most first; null where the ride's configuration or its motor's energy is "
        "not known."
    )
    without_rule_wh: float | None
