"""The measurements of a bike's numbers: among them the cadence that a unit tells against the turns
of its crank, and the speed sensor's pulses in a turn of a wheel that is turned by hand.

A unit tells no pulses: it tells the speed that they come to with the circumference and the pulses
a turn that it keeps. Its way over turns that somebody counted tells both apart.
"""

from __future__ import annotations

import numpy as np

from backend.calibration.bike.climb_check import CertifiedOf, ClimbCheck
from backend.calibration.bike.types import Cadence, PulseComparison
from backend.calibration.bike.wheel import cadence_error_rpm, pulses_per_turn, summed
from backend.calibration.bike.wheel_measure import (
    CIRCUMFERENCE_PARAMETER,
    SPEED,
    ParametersOf,
    WheelMeasure,
    refusal,
    rows_of,
)
from backend.core.energy import KMH_PER_MS
from backend.rides.rows import Window
from backend.rides.settings_in_force import ConfigOf, all_through
from backend.store import Store

CADENCE, ANGLE = "cadence_rpm", "crank_angle_deg"
TURNS_MIN = 20.0
"""Fewer, and where the crank stood at either end decides."""
SPACING_S_MAX = 0.15
"""Half a turn at 200 rpm: over longer ones the crank's turns are ambiguous."""


class CadenceCheck:
    """Counts the turns of a window. Safe from any thread."""

    def __init__(self, store: Store) -> None:
        self._store = store

    def __call__(self, window: Window) -> Cadence:
        """Raises NotFound, ObjectDamaged, and InvalidRequest where the ride cannot tell."""
        rows = rows_of(self._store, window, "ride_id", [CADENCE, ANGLE])
        if np.diff(rows.time_s).max() > SPACING_S_MAX:
            message = f"rows more than {SPACING_S_MAX:g} s apart do not tell the crank's turns"
            raise refusal("ride_id", "too_slow", message)
        angle_deg = np.unwrap(rows[ANGLE], period=360.0)
        turns = abs(float(angle_deg[-1] - angle_deg[0])) / 360.0
        if turns < TURNS_MIN:
            message = f"the crank made {turns:.1f} turns there; {TURNS_MIN:g} are needed"
            raise refusal("ride_id", "too_few_turns", message)
        duration_s = float(rows.time_s[-1] - rows.time_s[0])
        reported_rpm = float(np.trapezoid(rows[CADENCE], rows.time_s)) / duration_s
        error, expanded = cadence_error_rpm(reported_rpm, turns, duration_s)
        agrees = abs(error) <= expanded
        return Cadence(reported_rpm, turns, duration_s, error, expanded, agrees)


PULSES_PARAMETER = "wheel_pulses_per_turn"


class PulseCount:
    """Counts the pulses of a window. Safe from any thread. config_of: a ride's."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, window: Window, turns: float) -> PulseComparison:
        """turns: of the wheel by hand, counted. Raises NotFound, ObjectDamaged, and InvalidRequest
        where the ride cannot tell."""
        rows = rows_of(self._store, window, "ride_id", [SPEED])
        config, source = all_through(self._config_of, rows.ride)
        circumference_m, stored_pulses = (
            config.get(CIRCUMFERENCE_PARAMETER),
            config.get(PULSES_PARAMETER),
        )
        if source != "ride" or circumference_m is None or stored_pulses is None:
            message = f"ride {window.ride_id} does not tell what its unit counted with"
            raise refusal("ride_id", "missing", message)
        distance_m = float(summed(rows[SPEED] / KMH_PER_MS, rows.time_s)[-1])
        counted_turns = distance_m / float(circumference_m)
        pulses = pulses_per_turn(int(stored_pulses), counted_turns, turns)
        return PulseComparison(rows.ride.context.unit_key, counted_turns, turns, pulses)


class BikeNumbers:
    """wheel: its circumference. pulses: in a turn of it. cadence: against the crank's turns. climb:
    the torque gain by an energy balance. Safe from any thread."""

    def __init__(
        self,
        store: Store,
        config_of: ConfigOf,
        parameters_of: ParametersOf,
        certified_of: CertifiedOf,
    ) -> None:
        self.wheel = WheelMeasure(store, config_of, parameters_of)
        self.pulses = PulseCount(store, config_of)
        self.cadence = CadenceCheck(store)
        self.climb = ClimbCheck(store, certified_of)
