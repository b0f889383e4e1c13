"""The only door from the backend to the unit's C law: surface, points, lint, replay."""

from backend.control.gain import ENGINE, points, surface
from backend.control.lint_rules import Finding, LintReport, lint
from backend.control.ride_replay import Replay, raw_counts_of, replay

__all__ = [
    "ENGINE",
    "Finding",
    "LintReport",
    "Replay",
    "lint",
    "points",
    "raw_counts_of",
    "replay",
    "surface",
]
