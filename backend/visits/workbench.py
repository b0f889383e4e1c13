"""A unit on the workbench: its checks, done now, and the file for who helps from afar."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any, TypeVar

from backend.core.moments import utc
from backend.core.revision import Revision
from backend.device.readings import Fault
from backend.errors import CapabilityMissing, LinkError, NameFirst, NotFound
from backend.store.wall_clock import now_us
from backend.tuning.service import Tuning
from backend.units.inspection import Inspection
from backend.units.service import Devices
from backend.visits.checks import Readings, checks_of
from backend.visits.types import SupportFile, SupportRevision, UnitChecks, VisitReadings

Found = TypeVar("Found")
LEFT_OUT = (
    "names of people, bikes and units",
    "addresses of the server and of the connection",
    "rides and where they went",
    "reasons and notes that somebody wrote",
)
# More than a year of tuning; the newest say what was changed before it failed.
REVISIONS_MAX = 100


class Workbench:
    """Looks at units, and changes nothing. For any thread.

    drift: what a unit's rides show of its zero, as `SensorDriftService`. version: of this Spindle.
    """

    def __init__(
        self,
        devices: Devices,
        inspection: Inspection,
        tuning: Tuning,
        drift: Callable[[str], dict[str, Any]],
        version: str,
    ) -> None:
        self._devices = devices
        self._inspection = inspection
        self._tuning = tuning
        self._drift = drift
        self._version = version

    def check(self, device_id: str) -> UnitChecks:
        """Every check, now. Raises NotFound, NoAnswer, StoreError."""
        return self._checked(device_id, self._parameters(device_id) or {})

    def _checked(self, device_id: str, parameters: Mapping[str, Any]) -> UnitChecks:
        channels = self._inspection.snapshot(device_id).channels
        wear = None
        with suppress(CapabilityMissing):
            wear = self._inspection.wear_counters(device_id)
        drift = self._drift(device_id)
        device = self._devices.get(device_id)
        least_v = parameters.get("battery_voltage_v_min")
        readings = Readings(channels, device.faults_active, wear, device.link, drift, least_v)
        return UnitChecks(utc(now_us()), checks_of(readings), channels, device.faults_active, wear)

    def look(self, device_id: str) -> tuple[VisitReadings, Sequence[Fault]]:
        """What a visit has of a unit, and the faults it has and had. Raises NotFound, Conflict
        for one that nobody knows, LinkError, StoreError."""
        checks = self.check(device_id)
        faults = self._inspection.faults(device_id)
        device = self._devices.get(device_id)
        if device.unit_key is None:
            raise NameFirst("Nobody knows which unit this is: connect it and name it first.")
        identity, config = device.identity, device.config
        readings = VisitReadings(
            at=checks.checked_at,
            unit_key=device.unit_key,
            serial_number=None if identity is None else identity.serial_number,
            model=None if identity is None else identity.model,
            firmware_version=None if identity is None else identity.firmware_version,
            generation=None if config is None else config.generation,
            crc32=None if config is None else config.crc32,
            checks=checks.checks,
            faults_active=checks.faults_active,
        )
        return readings, faults

    def support_file(self, device_id: str) -> SupportFile:
        """What a unit says of itself, also one that is away. Raises NotFound, StoreError."""
        device = self._devices.get(device_id)
        parameters = self._parameters(device_id)
        revisions = unless_away(lambda: self._tuning.revisions(device_id)) or ()
        return SupportFile(
            format="spindle-support",
            version=1,
            spindle_version=self._version,
            made_at=utc(now_us()),
            left_out=LEFT_OUT,
            family=device.family,
            state=device.state,
            reason_code=device.reason_code,
            capabilities=device.capabilities,
            identity=device.identity,
            config=device.config,
            link=device.link,
            faults=tuple(self._inspection.faults(device_id)),
            checks=unless_away(lambda: self._checked(device_id, parameters or {})),
            parameters=parameters,
            revisions=tuple(map(without_words, revisions[:REVISIONS_MAX])),
        )

    def _parameters(self, device_id: str) -> dict[str, Any] | None:
        """What the unit was last known to be set to; None where nobody knows."""
        known = unless_away(lambda: self._tuning.last_known(device_id))
        return None if known is None else {one.name: one.value for one in known.parameters}


def without_words(revision: Revision) -> SupportRevision:
    """A revision without its author and reason."""
    return SupportRevision(
        revision.seq,
        revision.created_at,
        revision.state,
        revision.generation,
        revision.crc32,
        tuple(dict(change) for change in revision.changed),
    )


def unless_away(look: Callable[[], Found]) -> Found | None:
    """What a unit says; None where it does not answer, or never said it."""
    with suppress(LinkError, NotFound):
        return look()
    return None
