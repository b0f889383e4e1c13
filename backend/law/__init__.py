"""The only door from the backend to the unit's C law: surface, lint, limit proof, replay, twin."""

from backend.law.finding import Finding, LintReport
from backend.law.gain import ENGINE, points, surface
from backend.law.lint_rules import lint
from backend.law.market import Cutoff, cutoff_of
from backend.law.mode_curves import CADENCE_RPM, HARD_PUSH_NM, ModeCurve, mode_curves
from backend.law.prove_limits import prove_limits
from backend.law.recorded_ride import STANDING_MS
from backend.law.recorded_ride import recorded as recorded_ride
from backend.law.ride_replay import (
    Replay,
    joined,
    law_readings,
    limit_shares,
    raw_counts_of,
    replay,
)
from backend.law.road_figures import (
    curves_of,
    curves_of_record,
    limits_of_record,
    places_km,
    power_w_mean,
    ripple_nm_per_s,
)
from backend.law.torque_surface import TorqueSurface, torque_surface
from backend.law.twin import WORK_LEAST_J, Band, RoadTwin
from backend.law.why import Why, why, why_steady
from sim_device.firmware.python.law import LIMITS, OF_THE_BIKE, law_defaults
from sim_device.firmware.python.twin import Totals

__all__ = [
    "CADENCE_RPM",
    "ENGINE",
    "HARD_PUSH_NM",
    "LIMITS",
    "OF_THE_BIKE",
    "STANDING_MS",
    "WORK_LEAST_J",
    "Band",
    "Cutoff",
    "Finding",
    "LintReport",
    "ModeCurve",
    "Replay",
    "RoadTwin",
    "TorqueSurface",
    "Totals",
    "Why",
    "curves_of",
    "curves_of_record",
    "cutoff_of",
    "joined",
    "law_defaults",
    "law_readings",
    "limit_shares",
    "limits_of_record",
    "lint",
    "mode_curves",
    "places_km",
    "points",
    "power_w_mean",
    "prove_limits",
    "raw_counts_of",
    "recorded_ride",
    "replay",
    "ripple_nm_per_s",
    "surface",
    "torque_surface",
    "why",
    "why_steady",
]
