"""Looking at a unit: its live values, its faults, its wear; and the simulation behind one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from backend.core.audit import Action, AuditEntry, Note, no_note
from backend.device.readings import Fault, Snapshot, WearCounters, last_values
from backend.device.states import LinkState
from backend.errors import CapabilityMissing
from backend.units.outcome import telling
from backend.units.service import Devices


class Inspection:
    """What units say of themselves when they are asked. For any thread.

    All of it raises NotFound, and NoAnswer with the reason when the unit is not there. note: adds
    to the audit.
    """

    def __init__(self, devices: Devices, note: Note = no_note) -> None:
        self._devices = devices
        self._note = note

    def snapshot(self, device_id: str) -> Snapshot:
        """The newest value of every channel: of the stream, or asked of the unit."""
        unit = self._devices.unit(device_id)
        block = unit.status().last_block
        return unit.values() if block is None else last_values(block)

    def faults(self, device_id: str) -> Sequence[Fault]:
        """The faults that are active in the unit or were, in words.

        Of a unit that is not there, those that were active when it was.
        """
        unit = self._devices.unit(device_id)
        return unit.faults() if unit.status().state is LinkState.READY else unit.faults_reported()

    def clear_faults(self, device_id: str) -> Sequence[Fault]:
        """Forget the faults that are over; those that are left.

        After a NoAnswer whose outcome is not known they may be forgotten: list them again. Raises
        NameFirst.
        """
        with telling("unchanged"):
            key, unit = self._devices.own(device_id)
            before = sorted(fault.name for fault in unit.faults())
        with telling("unknown"):
            left = unit.clear_faults()
        after = sorted(fault.name for fault in left)
        if after != before:
            action, sides = Action.UNIT_FAULTS_CLEARED, ({"faults": before}, {"faults": after})
            self._note(AuditEntry(action, key, None, *sides, unit_key=key))
        return left

    def wear_counters(self, device_id: str) -> WearCounters:
        """What the unit knows of its own wear. Raises Conflict of one we do not understand."""
        counters = self._devices.writable(device_id).wear_counters()
        if counters is None:
            raise CapabilityMissing(
                "This unit does not count distance, hours and writes.", "upkeep"
            )
        return counters

    def simulation(self, device_id: str) -> dict[str, Any]:
        """Rider, road and clock of a simulated unit. Raises CapabilityMissing for a real one."""
        return self._devices.unit(device_id).simulation()

    def simulate(self, device_id: str, changes: Mapping[str, Any]) -> dict[str, Any]:
        """Change what is named. Raises InvalidRequest in the simulator's words."""
        with telling("unknown"):
            return self._devices.unit(device_id).simulate(changes)
