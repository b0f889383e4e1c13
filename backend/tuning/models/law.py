"""The assist law as people edit it: table, modes, limits; and what the law's tools answer."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from backend.core.api_models import Answer, RequestBody
from backend.core.fuzzy_table import Label


def in_lower_case(value: Any) -> Any:
    """A choice as it is written; programs of version 0.2 send `JAPAN`."""
    return value.lower() if isinstance(value, str) else value


AnyCase = BeforeValidator(in_lower_case)
Table = Literal["first", "second"]
Inference = Annotated[Literal["mamdani_centroid", "weighted_average"], AnyCase]
Law = Annotated[Literal["off", "fixed", "fuzzy"], AnyCase]
Taper = Annotated[Literal["taper_speeds", "none", "japan_1_to_1", "japan_2_to_1"], AnyCase]
Market = Annotated[
    Literal["eu_epac", "uk", "us_class_1", "us_class_2", "us_class_3", "japan", "china"], AnyCase
]
TorqueFilter = Annotated[Literal["time_constant", "half_turn"], AnyCase]
Five = Field(min_length=5, max_length=5)
FivePoints = Annotated[list[float], Five]
RuleRow = Annotated[list[Label], Five]


class LawModel(BaseModel):
    """Goes both ways, so that what was read can be edited and written back as it is."""

    model_config = ConfigDict(from_attributes=True, extra="forbid", allow_inf_nan=False)


class FuzzyTable(LawModel):
    """Five by five rules: `rules[speed][torque rate]`."""

    name: str = Field(max_length=24)
    inference: Inference
    speed_points_kmh: FivePoints
    torque_rate_points: FivePoints
    gain_points: FivePoints
    rules: Annotated[list[RuleRow], Five]


class AssistMode(LawModel):
    """One of the five slots the rider's switch selects."""

    name: str = Field(max_length=16)
    law: Law
    ratio: float
    taper: Taper = Field(
        default="taper_speeds", description="How the fixed law's ratio falls with speed."
    )
    table: Table = Field(default="first", description="Which of the two fuzzy tables.")
    ramp_up_nm_per_s: int = Field(default=2000, ge=5, le=2000)
    ramp_down_nm_per_s: int = Field(default=2000, ge=20, le=2000)
    torque_pct: int = Field(
        default=100, ge=0, le=100, description="Of the unit's largest motor torque."
    )


class AssistModes(LawModel):
    modes: Annotated[list[AssistMode], Five]
    mode_at_start: int = Field(ge=0, le=4)


PER_K = "For each kelvin above `sensor_reference_degc`; null: not corrected."


class Calibration(LawModel):
    """How raw counts become newton metres, and how they are filtered.

    What has a default may be missing in what is written.
    """

    sensor_offset_counts: float
    sensor_gain_nm_per_count: float
    sensor_offset_counts_per_k: float | None = Field(default=None, description=PER_K)
    sensor_gain_share_per_k: float | None = Field(default=None, description=PER_K)
    sensor_reference_degc: float | None = Field(
        default=None, description="Null: nothing is corrected for temperature."
    )
    calibrated_at_utc_s: int | None = Field(
        default=None, ge=0, description="Seconds since 1970; 0 where it is not known."
    )
    calibration_number: int | None = Field(default=None, ge=0, description="0: the factory's.")
    calibration_certificate: list[int] | None = Field(
        default=None, description="First 8 bytes of its SHA-256; all 0 where there is none."
    )
    torque_filter: TorqueFilter | None = Field(
        default=None,
        description="Averages with `torque_filter_s`, or over the last half turn of the crank.",
    )
    torque_filter_s: float
    torque_rate_interval_ms: int
    torque_rate_floor_nm: float
    sensor_offset_counts_factory: float | None = Field(
        default=None,
        description=(
            "What the factory measured: within 5 Nm of it `sensor_offset_counts` needs no token. "
            "Told by the unit; not looked at when it is written."
        ),
        json_schema_extra={"readOnly": True},
    )
    sensor_gain_nm_per_count_factory: float | None = Field(
        default=None,
        description=(
            "What the factory measured: within 15 % of it `sensor_gain_nm_per_count` needs no "
            "token. Told by the unit; not looked at when it is written."
        ),
        json_schema_extra={"readOnly": True},
    )


class UnitLimits(LawModel):
    """What the unit enforces after the law, whatever the table says.

    The last three may be missing in what is written; only the maker changes the market.
    """

    assist_cutoff_kmh: float
    assist_cutoff_band_kmh: float
    motor_torque_nm_max: float
    battery_current_a_max: float
    battery_voltage_v_min: float
    motor_speed_rpm_max: float
    pedal_stop_ms: int
    market: Market | None = Field(default=None, description="Whose law has the last word.")
    assist_cutoff_extra_kmh: float | None = None
    effective_assist_cutoff_kmh: float | None = Field(
        default=None,
        description=(
            "Where assist ends: `assist_cutoff_kmh`, or less where the market allows less. Told by "
            "the unit's own code; not looked at when it is written. Null while the unit has lost "
            "settings, which its faults tell."
        ),
        json_schema_extra={"readOnly": True},
    )


class SurfaceRequest(RequestBody):
    fuzzy_table: FuzzyTable
    speeds_kmh: list[float] = Field(min_length=1, max_length=512)
    torque_rates: list[float] = Field(min_length=1, max_length=512)


class Surface(Answer):
    gain: list[list[float]] = Field(description="`gain[speed][torque rate]`")
    engine: str = Field(description="Which code computed it: the unit's own.")


class PointsRequest(RequestBody):
    fuzzy_table: FuzzyTable
    points: list[tuple[float, float]] = Field(
        min_length=1, max_length=20_000, description="Pairs of speed_kmh and torque_rate."
    )


class PointGains(Answer):
    gain: list[float]
    engine: str


class LintRequest(RequestBody):
    fuzzy_table: FuzzyTable
    assist_modes: AssistModes | None = None
    limits: UnitLimits | None = None
    table: Table = Field(
        default="first",
        description="Which of the unit's tables this is: modes that use the other are not judged.",
    )
    taper_speeds_kmh: tuple[float, float] | None = Field(
        default=None,
        description=(
            "`fixed_taper_start_kmh` and `fixed_taper_end_kmh`; without them fixed modes that "
            "taper between them are not judged."
        ),
    )
    gear_ratio: float | None = Field(
        default=None,
        ge=1.0,
        le=100.0,
        description="The unit's own, motor turns per crank turn; else the registry's default.",
    )
