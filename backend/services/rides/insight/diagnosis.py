"""What a ride shows of its bike's health."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from backend import law
from backend.core.ride import Ride
from backend.services.rides.insight.rows import RideColumns, columns_of
from backend.services.rides.settings_in_force import ConfigOf, all_through
from backend.store import Store
from backend.views.diagnosis.diagnosis import METHOD, NEEDED, diagnose
from backend.views.diagnosis.finding import SEVERITIES, Evidence, Limits


class Diagnosis:
    """Looks at one ride. Holds nothing of it; safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, ride_id: int) -> dict[str, Any]:
        """The answer as the API tells it. Raises NotFound, ObjectDamaged."""
        rows = columns_of(self._store, ride_id, NEEDED)
        config, _ = all_through(self._config_of, rows.ride)
        evidence = evidence_of(rows, limits_of(config))
        checks = [asdict(check) for check in diagnose(evidence)]
        found = [finding for check in checks for finding in check["findings"]]
        worst = max((SEVERITIES.index(one["severity"]) for one in found), default=None)
        return {
            "ride_id": ride_id,
            "method": METHOD,
            "worst": None if worst is None else SEVERITIES[worst],
            "checks": checks,
        }


def evidence_of(rows: RideColumns, limits: Limits) -> Evidence:
    """A ride's rows as the diagnosis looks at them."""
    return Evidence(
        rows.values,
        rows.start_s,
        rows.seconds,
        limits,
        gaps=[(gap.from_s, gap.to_s) for gap in rows.ride.gaps],
        paused=paused(rows.ride),
        derived=frozenset(channel.name for channel in rows.ride.derived),
    )


def limits_of(config: Mapping[str, Any]) -> Limits:
    """What a configuration says; nothing of one that nobody kept."""
    return Limits(
        temperature=law.LIMITS["temperature"],
        battery_voltage_v_min=config.get("battery_voltage_v_min"),
        wheel_circumference_m=config.get("wheel_circumference_m"),
    )


def paused(ride: Ride) -> list[tuple[float, float]]:
    """Where the device says that its timer stood."""
    return [(pause.from_s, pause.to_s) for pause in ride.noted.pauses]
