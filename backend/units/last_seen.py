"""When each connection's unit was last there, over a restart of the server too.

Noted as soon as a unit is there and once a second from then on; written when it goes, every half
minute while it is there, and at the end: what a crash loses is that half minute.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Sequence
from typing import Protocol

from backend.device.states import CONNECTED, DeviceEvent, Named, StateChanged
from backend.errors import SpindleError
from backend.units.types import Device, Sighting

LOG = logging.getLogger(__name__)
WRITE_EVERY_S = 30.0
US_PER_S = 1e6


class SightingStore(Protocol):
    """Where sightings are kept; units.records has one."""

    def sighted(self, sighting: Sighting) -> None:
        """Note one. Raises StoreError."""
        ...

    def sightings(self) -> Sequence[Sighting]:
        """The last one of every unit, oldest first."""
        ...


class LastSeen:
    """Sightings by the url of the connection. For any thread; only `update` and `close` write."""

    def __init__(self, store: SightingStore) -> None:
        self._store = store
        self._lock = threading.Lock()
        self._sightings = {sighting.url: sighting for sighting in store.sightings()}
        self._written_us = {url: one.seen_us for url, one in self._sightings.items()}

    def at(self, url: str) -> Sighting | None:
        """The last sighting over a connection; None where no unit was. Never waits."""
        with self._lock:
            return self._sightings.get(url)

    def update(self, devices: Sequence[Device], now_us: int) -> None:
        """Note who is there now. Raises StoreError."""
        due = [self._sighting_of(device, now_us) for device in devices]
        self._write([sighting for sighting in due if sighting is not None])

    def follower(self, view_of: Callable[[str], Device]) -> Callable[[str, DeviceEvent], None]:
        """A watcher of devices that notes a unit which comes and goes between two looks."""

        def follow(device_id: str, event: DeviceEvent) -> None:
            if isinstance(event, StateChanged | Named):
                self._sighting_of(view_of(device_id), time.time_ns() // 1000)

        return follow

    def close(self) -> None:
        """Write what is not written yet; a store that refuses it is logged."""
        with self._lock:
            sightings = list(self._sightings.values())
        try:
            self._write([one for one in sightings if self._written_us.get(one.url) != one.seen_us])
        except SpindleError as error:
            LOG.warning("When the units were last seen is not kept: %s", error.message)

    def _sighting_of(self, device: Device, now_us: int) -> Sighting | None:
        """What of a device is to be written."""
        with self._lock:
            last = self._sightings.get(device.url)
            is_connected = device.state in [state.value for state in CONNECTED]
            if is_connected and device.identity is not None and device.unit_key is not None:
                last = Sighting(
                    device.url,
                    device.unit_key,
                    now_us,
                    device.identity.serial_number,
                    device.name,
                    device.identity.model,
                    device.identity.firmware_version,
                )
                self._sightings[device.url] = last
            if last is None:
                return None
            age_s = (last.seen_us - self._written_us.get(device.url, 0)) / US_PER_S
            return last if age_s > (WRITE_EVERY_S if is_connected else 0.0) else None

    def _write(self, sightings: Sequence[Sighting]) -> None:
        for sighting in sightings:
            self._store.sighted(sighting)
            self._written_us[sighting.url] = sighting.seen_us
