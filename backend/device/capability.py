"""What units differ in."""

from __future__ import annotations

from enum import StrEnum


class Capability(StrEnum):
    """What units differ in; the API and the pages use these words.

    unit_trial: the unit itself returns from a change that is not kept. live_set: values can be on
    trial in its memory alone. unlock: its maker may permit what its market forbids. unit_limits: it
    enforces limits by itself. unique_id: it has a serial number. restart_to_apply: what is written
    holds from the next start on.
    """

    READ_CONFIG = "read_config"
    WRITE_CONFIG = "write_config"
    UNIT_TRIAL = "unit_trial"
    STREAM = "stream"
    RIDER_TORQUE = "rider_torque"
    CALIBRATE = "calibrate"
    LIVE_SET = "live_set"
    LOGS = "logs"
    UNLOCK = "unlock"
    UNIT_LIMITS = "unit_limits"
    UNIQUE_ID = "unique_id"
    RESTART_TO_APPLY = "restart_to_apply"
    FUZZY_TABLE = "fuzzy_table"
    ASSIST_MODES = "assist_modes"
    LIMITS = "limits"
    SIMULATION = "simulation"
