"""Remembering what a unit was: its configuration when it connected, and what a ride was made with.

A ride without its configuration cannot be explained or replayed later, so each connected unit is
read once, and a configuration that the log does not know yet is kept as found. The reading is done
on a thread of its own: units are heard on their readers' threads, which must not wait.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from backend.core.revision import RevisionLog
from backend.core.ride import Ride, RideContext
from backend.device.capability import Capability
from backend.device.configuration import ConfigImage
from backend.device.states import CONNECTED, DeviceEvent, LinkState, Named, StateChanged, UnitEvent
from backend.errors import NoAnswer, NotFound, SpindleError
from backend.law import law_defaults
from backend.store import UnitSighting
from backend.units.records import UnitStore
from backend.units.service import Devices

LOG = logging.getLogger(__name__)

FOUND = "found"
CONFIG_EVENTS = ("CONFIG_COMMITTED", "CONFIG_ROLLED_BACK", "CONFIG_DEFAULTED")


class UnitMemory:
    """The configurations of the connected units, and through the log those of earlier ones.

    note_trial_end: called with a unit's id when a trial of it may have ended by itself.
    """

    def __init__(
        self,
        devices: Devices,
        revisions: RevisionLog,
        units: UnitStore,
        note_trial_end: Callable[[str], None],
    ) -> None:
        self._devices = devices
        self._units = units
        self._note_trial_end = note_trial_end
        self._revisions = revisions
        self._lock = threading.Lock()
        self._configs: dict[str, ConfigImage] = {}
        # Units that are to be read, and whether they were just connected.
        self._waiting: dict[str, bool] = {}
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="unit-memory")

    def follow(self, device_id: str, event: DeviceEvent) -> None:
        """Watcher for every unit's events: reads again when the configuration may be another."""
        connected = isinstance(event, StateChanged) and event.state in CONNECTED
        connected = connected or isinstance(event, Named)
        changed = isinstance(event, UnitEvent) and event.name in CONFIG_EVENTS
        if not connected and not changed:
            return
        with self._lock:
            if device_id in self._waiting:
                self._waiting[device_id] |= connected
                return
            self._waiting[device_id] = connected
        try:
            self._reader.submit(self._read, device_id)
        except RuntimeError:
            LOG.debug("%s changed while Spindle was closing.", device_id)

    def ride_context(self, device_id: str) -> RideContext:
        """What is true of a unit's bike now; None while unknown. Never waits."""
        device = self._devices.get(device_id)
        with self._lock:
            config = self._configs.get(device_id)
        identity, stamp = device.identity, device.config
        return RideContext(
            device_id=device_id,
            unit_key=device.unit_key,
            device_serial=identity.serial_number if identity else None,
            device_model=identity.model if identity else None,
            firmware_version=identity.firmware_version if identity else None,
            config_generation=stamp.generation if stamp else None,
            config_crc32=stamp.crc32 if stamp else None,
            gear_ratio=_number(config.parameters, "gear_ratio") if config else None,
            boot_id=identity.boot_id if identity else None,
        )

    def ride_config(self, ride: Ride, t_s: float = 0.0) -> tuple[Mapping[str, Any], str]:
        """The configuration in force t_s after a ride's start and `ride`, or the law's and
        `defaults`."""
        key = ride.context.unit_key
        crc32 = [crc32 for from_s, crc32 in ride.settings_spans() if from_s <= max(t_s, 0.0)][-1]
        if key is not None and crc32 is not None:
            for revision in self._revisions.list(key):
                if revision.crc32 == crc32:
                    return revision.parameters, "ride"
        return law_defaults(), "defaults"

    def close(self) -> None:
        """Give up what waits."""
        self._reader.shutdown(wait=True, cancel_futures=True)

    def _read(self, device_id: str) -> None:
        with self._lock:
            connected = self._waiting.pop(device_id)
        try:
            if connected:
                self._note_unit(device_id)
            unit = self._devices.unit(device_id)
            is_read = Capability.READ_CONFIG in unit.capabilities
            if not is_read or unit.status().state is LinkState.READ_ONLY:
                return
            self._note_trial_end(device_id)
            config = unit.read_config()
            with self._lock:
                self._configs[device_id] = config
            if connected:
                self._store_config(device_id, config)
        except (NotFound, NoAnswer) as error:
            # Gone meanwhile; it is read when it is here again.
            LOG.debug("%s: its configuration was not remembered: %s", device_id, error.message)
        except SpindleError as error:
            LOG.warning("%s: its configuration was not remembered: %s", device_id, error.message)

    def _note_unit(self, device_id: str) -> None:
        """Note that the unit is here: the first time makes its bike."""
        device = self._devices.get(device_id)
        if device.identity is None or device.unit_key is None:
            return
        unit = UnitSighting(
            device.unit_key,
            device.identity.serial_number,
            device.name,
            device.identity.model,
            device.identity.firmware_version,
        )
        self._units.note_unit(unit)

    def _store_config(self, device_id: str, config: ConfigImage) -> None:
        """Note the unit's configuration unless the newest in the log is the same."""
        key = self._devices.unit_key(device_id)
        newest = self._revisions.list(key, 1)
        if not newest or newest[0].crc32 != config.crc32:
            self._revisions.append(
                key,
                config.parameters,
                reason="found when the unit connected",
                generation=config.generation,
                crc32=config.crc32,
                state=FOUND,
                only_if_changed=True,
            )


def _number(parameters: Mapping[str, Any], name: str) -> float | None:
    value = parameters.get(name)
    return float(value) if isinstance(value, int | float) else None
