"""The checks of a unit, done now."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from datetime import datetime
from typing import Any

from backend.core.described import described
from backend.core.moments import utc
from backend.device.readings import WearCounters
from backend.errors import CapabilityMissing, NotFound
from backend.store.wall_clock import now_us
from backend.tuning.service import Tuning
from backend.units.inspection import Inspection
from backend.units.service import Devices
from backend.visits.checks import Readings, UnitCheck, checks_of


@described
class UnitChecks:
    """What was found, and the readings it was found by."""

    unit_key: str | None
    checked_at: datetime
    checks: tuple[UnitCheck, ...]
    channels: dict[str, float | None]
    faults_active: tuple[str, ...]
    wear: WearCounters | None
    """Null for a unit of another make, which does not count."""


class CheckUnit:
    """Checks units; it only reads. For any thread.

    drift: what a unit's rides show of its zero, as `SensorDriftService`.
    """

    def __init__(
        self,
        devices: Devices,
        inspection: Inspection,
        tuning: Tuning,
        drift: Callable[[str], dict[str, Any]],
    ) -> None:
        self._devices = devices
        self._inspection = inspection
        self._tuning = tuning
        self._drift = drift

    def __call__(self, device_id: str) -> UnitChecks:
        """Every check, now. Raises NotFound, NoAnswer, StoreError."""
        channels = self._inspection.snapshot(device_id).channels
        wear = None
        with suppress(CapabilityMissing):
            wear = self._inspection.wear_counters(device_id)
        drift = self._drift(device_id)
        device = self._devices.get(device_id)
        least_v = self._battery_v_min(device_id)
        readings = Readings(channels, device.faults_active, wear, device.link, drift, least_v)
        return UnitChecks(
            device.unit_key,
            utc(now_us()),
            checks_of(readings),
            channels,
            device.faults_active,
            wear,
        )

    def _battery_v_min(self, device_id: str) -> float | None:
        try:
            parameters = self._tuning.last_known(device_id).parameters
        except NotFound:
            return None
        values = {one.name: one.value for one in parameters}
        least = values.get("battery_voltage_v_min")
        return float(least) if isinstance(least, int | float) else None
