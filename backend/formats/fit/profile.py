"""What the numbers of FIT's public profile mean: which messages are read, and a record's fields.

After Garmin's profile 21.218. What is not here is kept under its number.
"""

from __future__ import annotations

from dataclasses import dataclass

SPORTS: dict[int, str] = {
    0: "generic",
    1: "running",
    2: "cycling",
    3: "transition",
    5: "swimming",
    11: "walking",
    17: "hiking",
    21: "e_biking",
}


@dataclass(frozen=True)
class ProfileField:
    """value = raw / scale - offset, in `unit`."""

    name: str
    unit: str = ""
    scale: float = 1.0
    offset: float = 0.0


# Three bytes: 12 bits of speed (1/100 m/s) and 12 bits of distance (1/16 m) that go round.
COMPRESSED_SPEED_DISTANCE = "compressed_speed_distance"

RECORD_FIELDS: dict[int, ProfileField] = {
    0: ProfileField("position_lat", "deg", 2**31 / 180.0),
    1: ProfileField("position_long", "deg", 2**31 / 180.0),
    2: ProfileField("altitude", "m", 5, 500),
    3: ProfileField("heart_rate", "bpm"),
    4: ProfileField("cadence", "rpm"),
    5: ProfileField("distance", "m", 100),
    6: ProfileField("speed", "m/s", 1000),
    7: ProfileField("power", "W"),
    8: ProfileField(COMPRESSED_SPEED_DISTANCE),
    9: ProfileField("grade", "%", 100),
    10: ProfileField("resistance"),
    11: ProfileField("time_from_course", "s", 1000),
    12: ProfileField("cycle_length", "m", 100),
    13: ProfileField("temperature", "degC"),
    18: ProfileField("cycles"),
    19: ProfileField("total_cycles"),
    28: ProfileField("compressed_accumulated_power", "W"),
    29: ProfileField("accumulated_power", "W"),
    30: ProfileField("left_right_balance"),
    31: ProfileField("gps_accuracy", "m"),
    32: ProfileField("vertical_speed", "m/s", 1000),
    33: ProfileField("calories", "kcal"),
    39: ProfileField("vertical_oscillation", "mm", 10),
    40: ProfileField("stance_time_percent", "%", 100),
    41: ProfileField("stance_time", "ms", 10),
    42: ProfileField("activity_type"),
    43: ProfileField("left_torque_effectiveness", "%", 2),
    44: ProfileField("right_torque_effectiveness", "%", 2),
    45: ProfileField("left_pedal_smoothness", "%", 2),
    46: ProfileField("right_pedal_smoothness", "%", 2),
    47: ProfileField("combined_pedal_smoothness", "%", 2),
    48: ProfileField("time128", "s", 128),
    49: ProfileField("stroke_type"),
    50: ProfileField("zone"),
    51: ProfileField("ball_speed", "m/s", 100),
    52: ProfileField("cadence256", "rpm", 256),
    53: ProfileField("fractional_cadence", "rpm", 128),
    54: ProfileField("total_hemoglobin_conc", "g/dL", 100),
    55: ProfileField("total_hemoglobin_conc_min", "g/dL", 100),
    56: ProfileField("total_hemoglobin_conc_max", "g/dL", 100),
    57: ProfileField("saturated_hemoglobin_percent", "%", 10),
    58: ProfileField("saturated_hemoglobin_percent_min", "%", 10),
    59: ProfileField("saturated_hemoglobin_percent_max", "%", 10),
    62: ProfileField("device_index"),
    67: ProfileField("left_pco", "mm"),
    68: ProfileField("right_pco", "mm"),
    69: ProfileField("left_power_phase", "deg", 256 / 360),
    70: ProfileField("left_power_phase_peak", "deg", 256 / 360),
    71: ProfileField("right_power_phase", "deg", 256 / 360),
    72: ProfileField("right_power_phase_peak", "deg", 256 / 360),
    73: ProfileField("enhanced_speed", "m/s", 1000),
    78: ProfileField("enhanced_altitude", "m", 5, 500),
    81: ProfileField("battery_soc", "%", 2),
    82: ProfileField("motor_power", "W"),
    83: ProfileField("vertical_ratio", "%", 100),
    84: ProfileField("stance_time_balance", "%", 100),
    85: ProfileField("step_length", "mm", 10),
    87: ProfileField("cycle_length16", "m", 100),
    91: ProfileField("absolute_pressure", "Pa"),
    92: ProfileField("depth", "m", 1000),
    99: ProfileField("respiration_rate", "1/min"),
    108: ProfileField("enhanced_respiration_rate", "1/min", 100),
    114: ProfileField("grit"),
    115: ProfileField("flow"),
    116: ProfileField("current_stress", "", 100),
    117: ProfileField("ebike_travel_range", "km"),
    118: ProfileField("ebike_battery_level", "%"),
    119: ProfileField("ebike_assist_mode"),
    120: ProfileField("ebike_assist_level_percent", "%"),
    127: ProfileField("ascent_rate", "m/s", 1000),
    139: ProfileField("core_temperature", "degC", 100),
}
PROFILE_NAMES = frozenset(field.name for field in RECORD_FIELDS.values())
