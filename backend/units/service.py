"""Units: add one by its url, look at it, listen to it, let it go. Several at once.

A device is a connection: its id comes from its url and is the same after every start. The unit at
its other end has a key (core.unit_key), which goes with it to another cable. A device is found by
its id, its url, its unit's key and its unit's serial number.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, MutableMapping, Sequence
from dataclasses import asdict
from datetime import UTC, datetime
from pathlib import Path

from backend.core.audit import Action, AuditEntry, Note, no_note
from backend.core.channels import ChannelSpec
from backend.core.unit_key import identifies_unit, serial_of, unit_key
from backend.device.capability import Capability
from backend.device.driver import LinkOpener, Listener, other_unit
from backend.device.families import DEFAULT_FAMILY, FAMILIES, Families
from backend.device.ports import DeviceKind, Opener, Port, family_of, kind_of, list_ports
from backend.device.states import CONNECTED, DeviceEvent, Identity, LinkState, Named, code_of
from backend.device.unit import Unit
from backend.errors import Conflict, InvalidRequest, NameFirst, NoAnswer, NotFound
from backend.units.addresses import canonical, id_of
from backend.units.types import ConfigStamp, Device, Sighting

# For those who follow every device: its id and what happened.
Watcher = Callable[[str, DeviceEvent], None]

# How long `add` waits for the unit to say who it is: a simulated one starts in a second or two.
IDENTITY_WAIT_S = 6.0
# A workshop has one to four; more is a script gone wrong, and each costs a thread.
DEVICES_MAX = 32


class _Device:
    """One added unit: its thread, its id once it is announced, who listens."""

    def __init__(
        self,
        url: str,
        kind: DeviceKind,
        name: str | None,
        watchers: Callable[[], tuple[Watcher, ...]],
    ) -> None:
        self.url = url
        self.kind = kind
        self.name = name
        # None until it is known that no other device has the same unit: nobody hears of it before.
        self.id: str | None = None
        self.unit: Unit
        self._watchers = watchers
        self._lock = threading.Lock()
        self._listeners: tuple[Listener, ...] = ()

    @property
    def is_here(self) -> bool:
        """Whether its unit answers now."""
        return self.unit.status().state in CONNECTED

    @property
    def serial_number(self) -> str | None:
        """The unit's serial number once it has said it."""
        identity = self.unit.status().identity
        return identity.serial_number if identity else None

    @property
    def unit_key(self) -> str | None:
        """The unit's key once it has said who it is, if only that it cannot say."""
        return self.unit_key_of(self.unit.status().identity)

    def unit_key_of(self, identity: Identity | None) -> str | None:
        if identity is None:
            return None
        return unit_key(self.unit.family, identity.serial_number, self.name, self.url)

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
    there are. bike_of: the bike that the unit with a key is on, told at once. last_seen: the unit
    that was last there over the connection with a url, told at once. note: adds to the audit.
    """

    def __init__(
        self,
        flash_folder: Path | None = None,
        streaming: bool = True,
        opener: Callable[[str], LinkOpener] | None = None,
        schemas: MutableMapping[str, bytes] | None = None,
        families: Families = FAMILIES,
        bike_of: Callable[[str], int | None] = lambda key: None,
        last_seen: Callable[[str], Sighting | None] = lambda url: None,
        note: Note = no_note,
    ) -> None:
        self._note = note
        self._streaming = streaming
        self._schemas = {} if schemas is None else schemas
        self._families = families
        self._bike_of = bike_of
        self._last_seen = last_seen
        self._opener = opener or (lambda url: Opener(url, flash_folder))
        self._lock = threading.Lock()
        self._devices: dict[str, _Device] = {}  # by url
        self._watchers: tuple[Watcher, ...] = ()

    # ------------------------------------------------------------------ which there are

    def add(
        self,
        url: str,
        wait_s: float = IDENTITY_WAIT_S,
        name: str | None = None,
        audited: bool = False,
    ) -> Device:
        """Open a unit; it connects, and reconnects, in the background.

        Waits up to `wait_s` for the unit to say who it is. name: its owner's for the unit. The same
        url twice is the same device, and another name for it counts from then on. A lost connection
        to the same unit gives way: a unit that is plugged in again has another port. audited:
        somebody asked for it, and not the settings. Raises InvalidRequest for a bad url, Conflict
        when the unit is here by another way already.
        """
        url = canonical(url)
        kind = kind_of(url)
        with self._lock:
            device = self._devices.get(url)
            is_new = device is None
            if device is None:
                device = self._open(url, kind, name)
        device.unit.driver.probed.wait(wait_s)
        twin = self._announce(device)
        if twin is not None and not twin.is_here:
            self._close(twin)
            twin = self._announce(device)
        if twin is not None:
            self._close(device)
            raise Conflict(
                f"The unit behind {url} is {device.unit_key}, which is connected as "
                f"{twin.id} over {twin.url} already. Remove that one first."
            )
        if is_new and audited:
            self._note(of_unit(Action.UNIT_CONNECTED, device, None))
        if name is not None and name != device.name:
            before = device.name
            self._name(device, name)
            if audited:
                self._note(of_unit(Action.UNIT_NAMED, device, {"name": before}))
        return self._view(device)

    def remove(self, device_id: str) -> None:
        """Let a unit go and give its port back; a simulated one ends. Raises NotFound."""
        device = self._find(device_id)
        key = device.unit_key
        self._close(device)
        facts = {"url": device.url}
        self._note(AuditEntry(Action.UNIT_REMOVED, key, device.name, facts, unit_key=key))

    def list(self) -> Sequence[Device]:
        """Every device in the order of its adding."""
        with self._lock:
            devices = [device for device in self._devices.values() if device.id is not None]
        return [self._view(device) for device in devices]

    def get(self, device_id: str) -> Device:
        """One device by any of its names. Raises NotFound."""
        return self._view(self._find(device_id))

    def ports(self) -> Sequence[Port]:
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

    def unit_key(self, device_id: str) -> str:
        """Which unit it is. Raises NotFound, NoAnswer before it has said so."""
        device = self._find(device_id)
        key = device.unit_key
        if key is None:
            raise NoAnswer(device.unit.status().reason, "not_connected")
        return key

    def last_known_key(self, device_id: str) -> str:
        """As `unit_key`, for whoever only reads what is kept: of a unit that has not yet said who
        it is, the one that was last seen over its connection. Raises NotFound, NoAnswer."""
        key = self.get(device_id).unit_key
        return key if key is not None else self.unit_key(device_id)

    def unit_at(self, device_id: str) -> str | None:
        """As `unit_key`; None where there is no such device or it has not said so."""
        try:
            return self._find(device_id).unit_key
        except NotFound:
            return None

    def pinned(self, device_id: str) -> tuple[str, Unit]:
        """The key of the unit that is there, and that unit and no other.

        What is asked of it raises OtherUnit once another unit is on the connection. Raises
        NotFound, Conflict, NoAnswer.
        """
        unit = self.writable(device_id)
        key = self.unit_key(device_id)
        return key, unit.only(serial_of(key))

    def own(self, device_id: str, meant: str | None = None) -> tuple[str, Unit]:
        """As `pinned`, for whoever is about to write to the unit.

        meant: the key of the unit the change is for, None for the one that is there. Raises
        OtherUnit, and NameFirst for a unit without a serial number and without a name.
        """
        key, unit = self.pinned(device_id)
        if not identifies_unit(key):
            raise NameFirst(
                "This unit has no serial number, so nobody can tell it from the next one on this "
                "connection. Give it a name first: connect it again with the name you call it by."
            )
        if meant is not None and key != meant:
            raise other_unit(self.get(device_id).url, meant, key)
        return key, unit

    def check_meant(self, device_id: str, meant: str) -> None:
        """Raise OtherUnit where a connection leads to another unit than the one with this key."""
        key = self.unit_at(device_id)
        if key is not None and key != meant:
            raise other_unit(self.get(device_id).url, meant, key)

    def wait_connected(self, device_id: str, timeout_s: float) -> bool:
        """Wait until the unit can be asked; False when it cannot after `timeout_s`."""
        return self._find(device_id).unit.driver.connected.wait(timeout_s)

    # ------------------------------------------------------------------ inside

    def _open(self, url: str, kind: DeviceKind, name: str | None) -> _Device:
        """Make a device and start its thread; the caller holds the lock."""
        if len(self._devices) >= DEVICES_MAX:
            raise InvalidRequest(f"There are {DEVICES_MAX} devices already; remove one first.")
        family = family_of(url, DEFAULT_FAMILY)
        if family not in self._families:
            raise InvalidRequest(
                f"There is no family {family!r} of units; there is {', '.join(self._families)}."
            )
        device = _Device(url, kind, name, lambda: self._watchers)
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
        if device.id is None and device.unit_key is not None:
            self._announce(device)
        device.emit(event)

    def _announce(self, device: _Device) -> _Device | None:
        """Let a device be heard of from now on; returns another device that is the same unit."""
        key = device.unit_key
        with self._lock:
            twin = self._other_with(device, key)
            if twin is None:
                device.id = id_of(device.url)
        return twin

    def _other_with(self, device: _Device, key: str | None) -> _Device | None:
        """Another device that is the unit with this key; the caller holds the lock."""
        others = (other for other in self._devices.values() if other is not device)
        return next((other for other in others if key is not None and other.unit_key == key), None)

    def _name(self, device: _Device, name: str) -> None:
        """Give a device's unit its owner's name. Raises Conflict where another unit has it."""
        identity = device.unit.status().identity
        with self._lock:
            before, device.name = device.name, name
            twin = self._other_with(device, device.unit_key_of(identity))
            if twin is not None:
                device.name = before
                raise Conflict(f"{name} is connected as {twin.id} over {twin.url} already.")
        device.emit(Named(name))

    def _close(self, device: _Device) -> None:
        with self._lock:
            is_listed = self._devices.get(device.url) is device
        if is_listed:
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
            also = (device.url, device.unit_key, device.serial_number)
            if device.id is not None and device_id in also:
                return device
        raise NotFound(f"There is no device {device_id}. `GET /devices` lists those there are.")

    def _view(self, device: _Device) -> Device:
        status = device.unit.status()
        identity = status.identity
        key = device.unit_key_of(identity)
        sighting = self._last_seen(device.url)
        if identity is None and sighting is not None:
            identity = Identity(
                sighting.serial_number, sighting.model or "", sighting.firmware_version
            )
            key = sighting.unit_key
        last_seen_at = sighting.seen_at if sighting else None
        if device.is_here:
            last_seen_at = datetime.now(UTC)
        return Device(
            id=device.id or id_of(device.url),
            url=device.url,
            kind="simulated" if identity and identity.simulated else device.kind,
            state=status.state.value,
            reason=status.reason,
            reason_code=code_of(status.reason),
            identity=identity,
            config=ConfigStamp.of(status),
            link=asdict(status.statistics),
            faults_active=status.faults_active,
            family=device.unit.family,
            capabilities=tuple(sorted(device.unit.capabilities)),
            name=device.name or (sighting.name if sighting else None),
            unit_key=key,
            bike_id=self._bike_of(key) if key is not None else None,
            last_seen_at=last_seen_at,
        )


def of_unit(action: Action, device: _Device, before: dict[str, str | None] | None) -> AuditEntry:
    """Something that was done to a connection, for the audit."""
    key = device.unit_key
    after = {"url": device.url} | ({} if device.name is None else {"name": device.name})
    return AuditEntry(action, key, device.name, before, after, unit_key=key)


def _bound(watcher: Watcher, device_id: str) -> Listener:
    return lambda event: watcher(device_id, event)
