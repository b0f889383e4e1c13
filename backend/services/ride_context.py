"""What was true of a bike while it made a ride: which unit, which firmware, which configuration.

A ride must know its configuration to be understood and replayed later. It is read from the unit
when the unit becomes ready and whenever it reports a change, on a thread of its own because the
unit's thread may not wait for its own answer, and kept as a revision of that unit.
"""

from __future__ import annotations

import logging
import threading
from collections import OrderedDict
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Protocol

from backend.device.states import DeviceEvent, LinkState, StateChanged, UnitEvent
from backend.domain.ride import Ride, RideContext
from backend.errors import SpindleError
from backend.services.device_view import DeviceView
from backend.store import RevisionLog

LOG = logging.getLogger(__name__)

# Configurations remembered by their checksum; each is some 3 KB.
CONFIGS_KEPT = 64
CHANGES = ("CONFIG_COMMITTED", "CONFIG_ROLLED_BACK", "CONFIG_DEFAULTED")

Config = Mapping[str, Any]


class ConfigRead(Protocol):
    """A configuration as it was read from a unit."""

    @property
    def generation(self) -> int: ...
    @property
    def crc32(self) -> int: ...
    @property
    def parameters(self) -> Mapping[str, Any]: ...


class RideContexts:
    """Knows each unit's configuration without asking it at the wrong moment.

    view_of: a device by its id. read_config: asks the unit, may wait and raise SpindleError.
    defaults: the configuration a new unit has.
    """

    def __init__(
        self,
        view_of: Callable[[str], DeviceView],
        read_config: Callable[[str], ConfigRead],
        revisions: RevisionLog,
        defaults: Config,
    ) -> None:
        self._view_of = view_of
        self._read_config = read_config
        self._revisions = revisions
        self._defaults = defaults
        self._configs: OrderedDict[tuple[str, int], Config] = OrderedDict()
        self._lock = threading.Lock()
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="ride-context")

    def watch(self, device_id: str, event: DeviceEvent) -> None:
        """Watcher of every device: reads the configuration when it may have changed."""
        ready = isinstance(event, StateChanged) and event.state in (
            LinkState.READY,
            LinkState.READ_ONLY,
        )
        if ready or (isinstance(event, UnitEvent) and event.name in CHANGES):
            try:
                self._reader.submit(self.refresh, device_id)
            except RuntimeError:
                LOG.debug("Unit %s changed while the server closes.", device_id)

    def refresh(self, device_id: str) -> None:
        """Read a unit's configuration, remember it, and keep it as a revision if it is new."""
        try:
            read = self._read_config(device_id)
            view = self._view_of(device_id)
            serial = view.identity.serial_number if view.identity else device_id
            self._remember(serial, read.crc32, read.parameters)
            newest = self._revisions.list(serial, 1)
            if not newest or newest[0].crc32 != read.crc32:
                self._revisions.append(
                    serial,
                    read.parameters,
                    reason="found on the unit",
                    generation=read.generation,
                    crc32=read.crc32,
                    state="found",
                )
        except SpindleError as error:
            LOG.info("The configuration of %s is not known: %s", device_id, error.message)

    def context_of(self, device_id: str) -> RideContext:
        """What is known now, without waiting for the unit."""
        try:
            view = self._view_of(device_id)
        except SpindleError:
            return RideContext(device_id=device_id)
        identity, stamp = view.identity, view.config
        serial = identity.serial_number if identity else None
        config = self._known(serial, stamp.crc32) if serial and stamp else None
        gear_ratio = config.get("gear_ratio") if config else None
        return RideContext(
            device_id=device_id,
            device_serial=serial,
            device_model=identity.model if identity else None,
            firmware_version=identity.firmware_version if identity else None,
            config_generation=stamp.generation if stamp else None,
            config_crc32=stamp.crc32 if stamp else None,
            gear_ratio=float(gear_ratio) if gear_ratio else None,
        )

    def config_of(self, ride: Ride) -> tuple[Config, str]:
        """A ride's configuration, and `ride`, or `defaults` when nobody kept it."""
        serial, crc32 = ride.context.device_serial, ride.context.config_crc32
        if serial is not None and crc32 is not None:
            for revision in self._revisions.list(serial):
                if revision.crc32 == crc32:
                    return revision.parameters, "ride"
        return self._defaults, "defaults"

    def close(self) -> None:
        """Stop asking."""
        self._reader.shutdown(wait=True, cancel_futures=True)

    def _remember(self, serial: str, crc32: int, parameters: Config) -> None:
        with self._lock:
            self._configs[(serial, crc32)] = parameters
            while len(self._configs) > CONFIGS_KEPT:
                self._configs.popitem(last=False)

    def _known(self, serial: str, crc32: int) -> Config | None:
        with self._lock:
            return self._configs.get((serial, crc32))
