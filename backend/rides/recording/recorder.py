"""The recorder of all units: one for each, told of by their connections and by the clock."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence

from backend.core.ride import RideContext, RideSummary
from backend.device.host_clock import wall_offset_us
from backend.device.states import DeviceEvent
from backend.device.stream import LostBy
from backend.rides.recording.finishing import Finishing
from backend.rides.recording.ride_tail import RecorderHealth
from backend.rides.recording.unit_recorder import (
    ContextOf,
    RecordingStatus,
    RecordSettings,
    UnitRecorder,
)
from backend.store import RideStore


class Recorder:
    """Records every unit that is followed.

    unfinished: rides of a server that died; they are finished as soon as the store lets us.
    offset_us: Unix time minus a clock that nobody sets.
    """

    def __init__(
        self,
        rides: RideStore,
        context_of: ContextOf = lambda device_id: RideContext(device_id=device_id),
        settings: RecordSettings | None = None,
        unfinished: Sequence[int] = (),
        offset_us: Callable[[], int] = wall_offset_us,
    ) -> None:
        self._rides = rides
        self._context_of = context_of
        self._settings = settings or RecordSettings()
        self._offset_us = offset_us
        self._units: dict[str, UnitRecorder] = {}
        self._lock = threading.Lock()
        self._finisher = Finishing(rides, unfinished)

    def listener(self, device_id: str) -> Callable[[DeviceEvent], None]:
        """What to subscribe to a unit's events; the same for the same unit."""
        with self._lock:
            if device_id not in self._units:
                self._units[device_id] = UnitRecorder(
                    device_id,
                    self._rides,
                    self._settings,
                    self._context_of,
                    self._finisher.finish,
                    self._offset_us,
                )
            return self._units[device_id].take

    def watch(self, device_id: str, event: DeviceEvent) -> None:
        """Watcher of every device: records whichever moves."""
        self.listener(device_id)(event)

    def status(self, device_id: str) -> RecordingStatus | None:
        """The ride a unit is recording now, None when it records none."""
        unit = self._units.get(device_id)
        return unit.status if unit else None

    def newest(self, device_id: str) -> tuple[int, float] | None:
        """The newest moment of a unit's ride, `UnitRecorder.newest`."""
        unit = self._units.get(device_id)
        return unit.newest if unit else None

    def running(self, ride_id: int) -> RideSummary | None:
        """What a ride that is being recorded comes to so far; None for any other."""
        unit = next((one for one in self._all() if one.records(ride_id)), None)
        return unit.running(ride_id) if unit else None

    def counts(self, device_id: str) -> RecorderHealth:
        """What became of a unit's rows; never waits."""
        unit = self._units.get(device_id)
        return unit.counts if unit else RecorderHealth()

    def rows_lost_lately(self) -> Sequence[tuple[str, int]]:
        """Units whose latest ride lost rows to the store, and how many; never waits."""
        units = list(self._units.items())
        return [(name, unit.lost_lately) for name, unit in units if unit.lost_lately]

    def rows_missing_lately(self) -> Sequence[tuple[str, LostBy, int]]:
        """Units whose latest ride lacks rows that never came, where most of them were lost, and how
        many there are in all; never waits."""
        missing = [(name, unit.missing.most) for name, unit in list(self._units.items())]
        return [(name, *most) for name, most in missing if most]

    def tick(self, now_us: int) -> None:
        """End rides of silent units, and try again what the store refused; now_us: Unix time."""
        for unit in self._all():
            unit.end_if_lost(now_us)
            unit.retry()
        self._rides.beat(now_us)
        self._finisher.tick(now_us)

    def close(self) -> None:
        """End and finish every ride; what cannot be finished now is finished at the next start."""
        for future in [unit.close() for unit in self._all()]:
            if future is not None:
                future.exception()

    def _all(self) -> Sequence[UnitRecorder]:
        with self._lock:
            return list(self._units.values())
