"""What a FIT file's sessions state of the whole ride: totals, means, extremes, battery used.

The device counted them by rules of its own; ours are counted from the rows.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from backend.core.channels import Values
from backend.core.device_metadata import FIGURES_MAX, STATEMENTS_MAX, DeviceFigure, DeviceSession
from backend.formats.fit.fields import Bytes, Described, table_of
from backend.formats.fit.layout import Part
from backend.formats.fit.profile import ProfileField
from backend.formats.fit_numbers import EPOCH_S, SESSION

# Whose numbers are no figures: what a session is, when, and where.
ASIDE: dict[int, ProfileField] = {
    0: ProfileField("event"),
    1: ProfileField("event_type"),
    2: ProfileField("start_time"),
    3: ProfileField("start_position_lat"),
    4: ProfileField("start_position_long"),
    5: ProfileField("sport"),
    6: ProfileField("sub_sport"),
    25: ProfileField("first_lap_index"),
    26: ProfileField("num_laps"),
    27: ProfileField("event_group"),
    28: ProfileField("trigger"),
    29: ProfileField("nec_lat"),
    30: ProfileField("nec_long"),
    31: ProfileField("swc_lat"),
    32: ProfileField("swc_long"),
    38: ProfileField("end_position_lat"),
    39: ProfileField("end_position_long"),
    111: ProfileField("sport_index"),
    254: ProfileField("message_index"),
}
# What has two numbers has a wider field of the same meaning: the first with a value counts.
FIGURES: dict[int, ProfileField] = {
    7: ProfileField("total_elapsed_time", "s", 1000),
    8: ProfileField("total_timer_time", "s", 1000),
    9: ProfileField("total_distance", "m", 100),
    10: ProfileField("total_cycles"),
    11: ProfileField("total_calories", "kcal"),
    13: ProfileField("total_fat_calories", "kcal"),
    14: ProfileField("avg_speed", "m/s", 1000),
    15: ProfileField("max_speed", "m/s", 1000),
    16: ProfileField("avg_heart_rate", "bpm"),
    17: ProfileField("max_heart_rate", "bpm"),
    18: ProfileField("avg_cadence", "rpm"),
    19: ProfileField("max_cadence", "rpm"),
    20: ProfileField("avg_power", "W"),
    21: ProfileField("max_power", "W"),
    22: ProfileField("total_ascent", "m"),
    23: ProfileField("total_descent", "m"),
    24: ProfileField("total_training_effect", "", 10),
    34: ProfileField("normalized_power", "W"),
    35: ProfileField("training_stress_score", "", 10),
    36: ProfileField("intensity_factor", "", 1000),
    45: ProfileField("threshold_power", "W"),
    48: ProfileField("total_work", "J"),
    49: ProfileField("avg_altitude", "m", 5, 500),
    50: ProfileField("max_altitude", "m", 5, 500),
    51: ProfileField("gps_accuracy", "m"),
    52: ProfileField("avg_grade", "%", 100),
    53: ProfileField("avg_pos_grade", "%", 100),
    54: ProfileField("avg_neg_grade", "%", 100),
    55: ProfileField("max_pos_grade", "%", 100),
    56: ProfileField("max_neg_grade", "%", 100),
    57: ProfileField("avg_temperature", "degC"),
    58: ProfileField("max_temperature", "degC"),
    59: ProfileField("total_moving_time", "s", 1000),
    60: ProfileField("avg_pos_vertical_speed", "m/s", 1000),
    61: ProfileField("avg_neg_vertical_speed", "m/s", 1000),
    62: ProfileField("max_pos_vertical_speed", "m/s", 1000),
    63: ProfileField("max_neg_vertical_speed", "m/s", 1000),
    64: ProfileField("min_heart_rate", "bpm"),
    71: ProfileField("min_altitude", "m", 5, 500),
    92: ProfileField("avg_fractional_cadence", "rpm", 128),
    93: ProfileField("max_fractional_cadence", "rpm", 128),
    101: ProfileField("avg_left_torque_effectiveness", "%", 2),
    102: ProfileField("avg_right_torque_effectiveness", "%", 2),
    103: ProfileField("avg_left_pedal_smoothness", "%", 2),
    104: ProfileField("avg_right_pedal_smoothness", "%", 2),
    105: ProfileField("avg_combined_pedal_smoothness", "%", 2),
    112: ProfileField("time_standing", "s", 1000),
    113: ProfileField("stand_count"),
    114: ProfileField("avg_left_pco", "mm"),
    115: ProfileField("avg_right_pco", "mm"),
    124: ProfileField("avg_speed", "m/s", 1000),
    125: ProfileField("max_speed", "m/s", 1000),
    126: ProfileField("avg_altitude", "m", 5, 500),
    127: ProfileField("min_altitude", "m", 5, 500),
    128: ProfileField("max_altitude", "m", 5, 500),
    129: ProfileField("avg_lev_motor_power", "W"),
    130: ProfileField("max_lev_motor_power", "W"),
    131: ProfileField("lev_battery_consumption", "%", 2),
    137: ProfileField("total_anaerobic_training_effect", "", 10),
    139: ProfileField("avg_vam", "m/s", 1000),
    150: ProfileField("min_temperature", "degC"),
    168: ProfileField("training_load_peak", "", 65536),
    169: ProfileField("avg_respiration_rate", "1/min", 100),
    170: ProfileField("max_respiration_rate", "1/min", 100),
    180: ProfileField("min_respiration_rate", "1/min", 100),
}
SESSION_FIELDS = ASIDE | FIGURES
LEFT_OUT = frozenset(field.name for field in ASIDE.values())


def statements_of(
    cells: Bytes, part: Part, described: Mapping[tuple[int, int], Described], records_s: Values
) -> tuple[tuple[DeviceSession, ...], dict[str, int]]:
    """What each session states, with Unix times, and which of its fields are no single number.

    records_s: FIT times (n,) of the records, which a session without times is of.
    """
    sessions = table_of(cells, part.of(SESSION), SESSION_FIELDS, described)
    valid_s = records_s[np.isfinite(records_s)]
    ends_s, starts_s = sessions.time_s, sessions.values("start_time")
    elapsed_s = sessions.values("total_elapsed_time")
    starts_s = np.where(np.isnan(starts_s), ends_s - elapsed_s, starts_s)
    ends_s = np.where(np.isnan(elapsed_s), ends_s, starts_s + elapsed_s)
    statements = []
    for row in range(min(len(sessions), STATEMENTS_MAX)):
        figures = [
            DeviceFigure(name, round(float(column.values[row]), 6), column.unit)
            for name, column in sessions.columns.items()
            if name not in LEFT_OUT and np.isfinite(column.values[row])
        ]
        from_s, to_s = float(starts_s[row]), float(ends_s[row])
        if not to_s > from_s and len(valid_s):
            from_s, to_s = float(valid_s.min()), float(valid_s.max())
        if figures and to_s > from_s:
            within = tuple(figures[:FIGURES_MAX])
            statements.append(DeviceSession(EPOCH_S + from_s, EPOCH_S + to_s, within))
    unread = {f"session_{name}": count for name, count in sessions.unread.items()}
    return tuple(statements), unread
