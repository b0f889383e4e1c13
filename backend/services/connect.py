"""Units: add one by its url, look at it, listen to it, let it go. Several at once.

A device keeps the id it got when it was added: the unit's serial number if it answered by then,
else one made of its url. Either way it is found by both: a name once written down stays good.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, MutableMapping, Sequence
from dataclasses import asdict
from pathlib import Path

from backend.device.driver import LinkOpener, Listener
from backend.device.families import DEFAULT_FAMILY, FAMILIES, Families
from backend.device.ports import Opener, PortInfo, family_of, kind_of, list_ports
from backend.device.states import DeviceEvent, LinkState
from backend.device.unit import Unit
from backend.domain.capability import Capability
from backend.domain.channels import ChannelSpec
from backend.errors import Conflict, InvalidRequest, NoAnswer, NotFound
from backend.services.device_ids import canonical, id_of
from backend.services.device_view import ConfigStamp, DeviceView

# For those who follow every device: its id and what happened.
Watcher = Callable[[str, DeviceEvent], None]

# How long `add` waits for the unit to say who it is: a simulated one starts in a second or two.
IDENTITY_WAIT_S = 6.0
# A workshop has one to four; more is a script gone wrong, and each costs a thread.
DEVICES_MAX = 32


class _Device:
    """One added unit: its thread, its id once it is settled, who listens."""

    def __init__(self, url: str, kind: str, watchers: Callable[[], tuple[Watcher, ...]]) -> None:
        self.url = url
        self.kind = kind
        self.id: str | None = None
        self.unit: Unit
        self._watchers = watchers
        self._lock = threading.Lock()
        self._listeners: tuple[Listener, ...] = ()

    @property
    def serial_number(self) -> str | None:
        """The unit's serial number once it has said it."""
        identity = self.unit.status().identity
        return identity.serial_number if identity else None

    def listen(self, listener: Listener) -> Callable[[], None]:
        """Add a listener; the result removes it."""
        with self._lock:
            self._listeners = (*self._listeners, listener)

        def leave() -> None:
            with self._lock:
                self._listeners = tuple(one for one in self._listeners if one is not listener)

        return leave

    def emit(self, event: DeviceEvent) -> None:
        """Pass an event on; one listener's fault is not the next one's. On the driver's thread."""
        errors: list[Exception] = []
        listeners = self._listeners
        if self.id is not None:
            device_id = self.id
            listeners += tuple(_bound(watcher, device_id) for watcher in self._watchers())
        for listener in listeners:
            try:
                listener(event)
            except Exception as error:
                errors.append(error)
        if errors:
            raise ExceptionGroup(f"{len(errors)} listeners of {self.url} failed", errors)


class Devices:
    """Every unit that was added and not removed, whatever its state. For any thread.

    flash_folder: where simulated units keep their configuration between runs, None for nowhere.
    streaming: whether rows of every channel are to come by themselves. opener: how a url becomes a
    link. schemas: where descriptions of units with another firmware are kept. families: the makes
    there are.
    """

    def __init__(
        self,
        flash_folder: Path | None = None,
        streaming: bool = True,
        opener: Callable[[str], LinkOpener] | None = None,
        schemas: MutableMapping[str, bytes] | None = None,
        families: Families = FAMILIES,
    ) -> None:
        self._streaming = streaming
        self._schemas = {} if schemas is None else schemas
        self._families = families
        self._opener = opener or (lambda url: Opener(url, flash_folder))
        self._lock = threading.Lock()
        self._devices: dict[str, _Device] = {}  # by url
        self._watchers: tuple[Watcher, ...] = ()

    # ------------------------------------------------------------------ which there are

    def add(self, url: str, wait_s: float = IDENTITY_WAIT_S) -> DeviceView:
        """Open a unit; it connects, and reconnects, in the background.

        Waits up to `wait_s` for the unit to say who it is. The same url twice is the same device.
        Raises InvalidRequest for a bad url, Conflict when the unit is here by another way already.
        """
        url = canonical(url)
        kind = kind_of(url)
        with self._lock:
            device = self._devices.get(url)
            if device is None:
                device = self._open(url, kind)
        device.unit.driver.probed.wait(wait_s)
        twin = self._settle(device)
        if twin is not None:
            self._close(device)
            raise Conflict(
                f"The unit behind {url} is {device.serial_number}, which is connected as "
                f"{twin.id} over {twin.url} already. Remove that one first."
            )
        return _view(device)

    def remove(self, device_id: str) -> None:
        """Let a unit go and give its port back; a simulated one ends. Raises NotFound."""
        self._close(self._find(device_id))

    def list(self) -> Sequence[DeviceView]:
        """Every device in the order of its adding."""
        with self._lock:
            devices = [device for device in self._devices.values() if device.id is not None]
        return [_view(device) for device in devices]

    def get(self, device_id: str) -> DeviceView:
        """One device by its id, its serial number or its url's id. Raises NotFound."""
        return _view(self._find(device_id))

    def ports(self) -> Sequence[PortInfo]:
        """Ports of this machine that may have a unit, and the simulated unit."""
        return list_ports()

    def close(self) -> None:
        """Let every unit go."""
        with self._lock:
            devices = list(self._devices.values())
        for device in devices:
            # Each takes its time to end a simulated unit or to save the end of a ride.
            device.unit.driver.stop()
        for device in devices:
            self._close(device)

    # ------------------------------------------------------------------ what they tell

    def subscribe(self, device_id: str, listener: Listener) -> Callable[[], None]:
        """Hear what happens to a device, on its own thread; the result ends it. Raises NotFound.

        A listener must not wait: it holds up the unit.
        """
        return self._find(device_id).listen(listener)

    def watch(self, watcher: Watcher) -> Callable[[], None]:
        """Hear what happens to every device, present and to come; the result ends it."""
        with self._lock:
            self._watchers = (*self._watchers, watcher)

        def leave() -> None:
            with self._lock:
                self._watchers = tuple(one for one in self._watchers if one is not watcher)

        return leave

    # ------------------------------------------------------------------ what is asked of them

    def unit(self, device_id: str) -> Unit:
        """What a device may be asked. Raises NotFound."""
        return self._find(device_id).unit

    def writable(self, device_id: str) -> Unit:
        """As `unit`, of one whose settings we understand. Raises Conflict with the reason."""
        unit = self.unit(device_id)
        status = unit.status()
        if status.state is LinkState.READ_ONLY:
            raise Conflict(status.reason, "read_only")
        return unit

    def channels(self, device_id: str) -> tuple[ChannelSpec, ...]:
        """Every channel a device streams. Raises NotFound, CapabilityMissing."""
        unit = self.unit(device_id)
        unit.require(Capability.STREAM)
        return unit.channels

    def serial_number(self, device_id: str) -> str:
        """Who the unit says it is. Raises NotFound, NoAnswer before it has."""
        status = self.unit(device_id).status()
        if status.identity is None:
            raise NoAnswer(status.reason, "not_connected")
        return status.identity.serial_number

    def wait_connected(self, device_id: str, timeout_s: float) -> bool:
        """Wait until the unit can be asked; False when it cannot after `timeout_s`."""
        return self._find(device_id).unit.driver.connected.wait(timeout_s)

    # ------------------------------------------------------------------ inside

    def _open(self, url: str, kind: str) -> _Device:
        """Make a device and start its thread; the caller holds the lock."""
        if len(self._devices) >= DEVICES_MAX:
            raise InvalidRequest(f"There are {DEVICES_MAX} devices already; remove one first.")
        family = family_of(url, DEFAULT_FAMILY)
        if family not in self._families:
            raise InvalidRequest(
                f"There is no family {family!r} of units; there is {', '.join(self._families)}."
            )
        device = _Device(url, kind, lambda: self._watchers)
        device.unit = self._families[family](
            self._opener(url),
            lambda event: self._emit(device, event),
            self._streaming,
            reopen_when_silent=kind != "simulated",
            schemas=self._schemas,
        )
        self._devices[url] = device
        device.unit.driver.start()
        return device

    def _emit(self, device: _Device, event: DeviceEvent) -> None:
        if device.id is None and device.serial_number is not None:
            self._settle(device)
        device.emit(event)

    def _settle(self, device: _Device) -> _Device | None:
        """Give a device its id for good; returns another device that is the same unit."""
        serial_number = device.serial_number
        with self._lock:
            others = [other for other in self._devices.values() if other is not device]
            twins = [other for other in others if serial_number in (other.id, other.serial_number)]
            if serial_number is not None and twins:
                return twins[0]
            if device.id is None:
                device.id = serial_number or id_of(device.url)
        return None

    def _close(self, device: _Device) -> None:
        with self._lock:
            known = self._devices.get(device.url) is device
        if known:
            device.unit.driver.close()
            with self._lock:
                self._devices.pop(device.url, None)

    def _find(self, device_id: str) -> _Device:
        with self._lock:
            devices = list(self._devices.values())
        for device in devices:
            if device.id == device_id:
                return device
        for device in devices:
            if device.id is not None and device_id in (device.serial_number, id_of(device.url)):
                return device
        raise NotFound(f"There is no device {device_id}. `GET /devices` lists those there are.")


def _bound(watcher: Watcher, device_id: str) -> Listener:
    return lambda event: watcher(device_id, event)


def _view(device: _Device) -> DeviceView:
    status = device.unit.status()
    identity = status.identity
    return DeviceView(
        id=device.id or id_of(device.url),
        url=device.url,
        kind="simulated" if identity and identity.simulated else device.kind,
        state=status.state.value,
        reason=status.reason,
        identity=identity,
        config=ConfigStamp.of(status),
        link=asdict(status.statistics),
        faults_active=status.faults_active,
        family=device.unit.family,
        capabilities=tuple(sorted(device.unit.capabilities)),
    )
