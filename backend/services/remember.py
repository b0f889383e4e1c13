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

from backend.control import law_defaults
from backend.device.configuration import ConfigImage
from backend.device.states import DeviceEvent, LinkState, StateChanged, UnitEvent
from backend.domain.ride import Ride, RideContext
from backend.errors import NoAnswer, NotFound, SpindleError
from backend.services.connect import Devices
from backend.store import RevisionLog

LOG = logging.getLogger(__name__)

FOUND = "found"
CONFIG_EVENTS = ("CONFIG_COMMITTED", "CONFIG_ROLLED_BACK", "CONFIG_DEFAULTED")


class UnitMemory:
    """The configurations of the connected units, and through the log those of earlier ones.

    note_trial_end: called with a unit's id when a trial of it may have ended by itself.
    """

    def __init__(
        self, devices: Devices, revisions: RevisionLog, note_trial_end: Callable[[str], None]
    ) -> None:
        self._devices = devices
        self._note_trial_end = note_trial_end
        self._revisions = revisions
        self._lock = threading.Lock()
        self._configs: dict[str, ConfigImage] = {}
        self._waiting: set[str] = set()
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="unit-memory")

    def follow(self, device_id: str, event: DeviceEvent) -> None:
        """Watcher for every unit's events: reads again when the configuration may be another."""
        connected = isinstance(event, StateChanged) and event.state is LinkState.READY
        changed = isinstance(event, UnitEvent) and event.name in CONFIG_EVENTS
        if not connected and not changed:
            return
        with self._lock:
            if device_id in self._waiting:
                return
            self._waiting.add(device_id)
        try:
            self._reader.submit(self._read, device_id, connected)
        except RuntimeError:
            LOG.debug("%s changed while Spindle was closing.", device_id)

    def ride_context(self, device_id: str) -> RideContext:
        """What is true of a unit's bike now; None where nobody knows yet. Never waits."""
        device = self._devices.get(device_id)
        with self._lock:
            config = self._configs.get(device_id)
        identity, stamp = device.identity, device.config
        return RideContext(
            device_id=device_id,
            device_serial=identity.serial_number if identity else None,
            device_model=identity.model if identity else None,
            firmware_version=identity.firmware_version if identity else None,
            config_generation=stamp.generation if stamp else None,
            config_crc32=stamp.crc32 if stamp else None,
            gear_ratio=_number(config.parameters, "gear_ratio") if config else None,
            boot_id=identity.boot_id if identity else None,
        )

    def ride_config(self, ride: Ride) -> tuple[Mapping[str, Any], str]:
        """The configuration a ride was made with and `ride`, or the law's and `defaults`."""
        serial, crc32 = ride.context.device_serial, ride.context.config_crc32
        if serial is not None and crc32 is not None:
            for revision in self._revisions.list(serial):
                if revision.crc32 == crc32:
                    return revision.parameters, "ride"
        return law_defaults(), "defaults"

    def close(self) -> None:
        """Give up what waits."""
        self._reader.shutdown(wait=True, cancel_futures=True)

    def _read(self, device_id: str, connected: bool) -> None:
        with self._lock:
            self._waiting.discard(device_id)
        try:
            self._note_trial_end(device_id)
            config = self._devices.unit(device_id).read_config()
            with self._lock:
                self._configs[device_id] = config
            if connected:
                self._keep(device_id, config)
        except (NotFound, NoAnswer) as error:
            # Gone meanwhile; it is read when it is here again.
            LOG.debug("%s: its configuration was not remembered: %s", device_id, error.message)
        except SpindleError as error:
            LOG.warning("%s: its configuration was not remembered: %s", device_id, error.message)

    def _keep(self, device_id: str, config: ConfigImage) -> None:
        """Note the unit, and its configuration unless the newest in the log is the same."""
        identity = self._devices.get(device_id).identity
        if identity is None:
            return
        serial = identity.serial_number
        self._revisions.device_seen(serial, identity.model, identity.firmware_version)
        newest = self._revisions.list(serial, 1)
        if not newest or newest[0].crc32 != config.crc32:
            self._revisions.append(
                serial,
                config.parameters,
                reason="found when the unit connected",
                generation=config.generation,
                crc32=config.crc32,
                state=FOUND,
            )


def _number(parameters: Mapping[str, Any], name: str) -> float | None:
    value = parameters.get(name)
    return float(value) if isinstance(value, int | float) else None
