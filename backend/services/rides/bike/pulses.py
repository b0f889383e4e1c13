"""The speed sensor's pulses in a turn of its wheel, from a ride of a wheel turned by hand.

A unit tells no pulses: it tells the speed that they come to with the circumference and the pulses
a turn that it keeps. Its way over turns that somebody counted tells both apart.
"""

from __future__ import annotations

from dataclasses import dataclass

from backend.domain.calibration.bike.arrays import summed
from backend.domain.calibration.bike.wheel import Pulses, pulses_per_turn
from backend.domain.energy import KMH_PER_MS
from backend.services.rides.bike.wheel import KEPT, SPEED
from backend.services.rides.bike.window import refusal, rows_of
from backend.services.rides.insight.rows import Window
from backend.services.rides.settings_in_force import ConfigOf, all_through
from backend.store import Store

KEPT_PULSES = "wheel_pulses_per_turn"


@dataclass(frozen=True)
class PulsesCounted:
    """told_turns: of the wheel, by the unit. unit_key: whose they are."""

    unit_key: str | None
    told_turns: float
    turns: float
    pulses: Pulses


class PulseCount:
    """Counts the pulses of a window. Safe from any thread. config_of: a ride's."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, window: Window, turns: float) -> PulsesCounted:
        """turns: of the wheel by hand, counted. Raises NotFound, ObjectDamaged, and InvalidRequest
        where the ride cannot tell."""
        rows = rows_of(self._store, window, "ride_id", [SPEED])
        config, source = all_through(self._config_of, rows.ride)
        circumference_m, kept = config.get(KEPT), config.get(KEPT_PULSES)
        if source != "ride" or circumference_m is None or kept is None:
            message = f"ride {window.ride_id} does not tell what its unit counted with"
            raise refusal("ride_id", "missing", message)
        way_m = float(summed(rows[SPEED] / KMH_PER_MS, rows.time_s)[-1])
        told_turns = way_m / float(circumference_m)
        found = pulses_per_turn(int(kept), told_turns, turns)
        return PulsesCounted(rows.ride.context.unit_key, told_turns, turns, found)
