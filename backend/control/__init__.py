"""The only door from the backend to the unit's C law: surface, lint, certificate, replay, twin."""

from backend.control.certificate import certify
from backend.control.finding import Finding, LintReport
from backend.control.gain import ENGINE, points, surface
from backend.control.lint_rules import lint
from backend.control.market import Cutoff, cutoff_of
from backend.control.mode_curves import CADENCE_RPM, HARD_PUSH_NM, ModeCurve, mode_curves
from backend.control.recorded_ride import recorded as recorded_ride
from backend.control.ride_replay import (
    Replay,
    law_readings,
    limit_shares,
    raw_counts_of,
    replay,
)
from backend.control.torque_surface import TorqueSurface, torque_surface
from backend.control.twin import HOLDS_POWER, RoadTwin
from backend.control.why import Why, why, why_steady
from sim_device.firmware.python.law import LIMITS, law_defaults

__all__ = [
    "CADENCE_RPM",
    "ENGINE",
    "HARD_PUSH_NM",
    "HOLDS_POWER",
    "LIMITS",
    "Cutoff",
    "Finding",
    "LintReport",
    "ModeCurve",
    "Replay",
    "RoadTwin",
    "TorqueSurface",
    "Why",
    "certify",
    "cutoff_of",
    "law_defaults",
    "law_readings",
    "limit_shares",
    "lint",
    "mode_curves",
    "points",
    "raw_counts_of",
    "recorded_ride",
    "replay",
    "surface",
    "torque_surface",
    "why",
    "why_steady",
]
