"""What services may ask of any unit, whatever its make; each family in a room of its own answers.

What a family cannot do it leaves out: the methods here refuse with CapabilityMissing, which names
what is missing. `capabilities` says it beforehand.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from copy import copy
from typing import Any, ClassVar, NoReturn, Self, TypeVar

from backend.core.channels import ChannelSpec
from backend.device.capability import Capability
from backend.device.configuration import (
    ConfigImage,
    ParameterTable,
    ParameterValues,
    TrialStatus,
    Value,
    ValuesOnTrial,
)
from backend.device.conversation import Operation
from backend.device.driver import Driver
from backend.device.readings import Fault, LogSegments, RideLog, RideLogs, Snapshot, WearCounters
from backend.device.states import DeviceStatus
from backend.errors import CapabilityMissing

Result = TypeVar("Result")

MEANING = {
    Capability.READ_CONFIG: "let its configuration be read",
    Capability.WRITE_CONFIG: "let its configuration be written",
    Capability.UNIT_TRIAL: "try a change and return from it by itself",
    Capability.STREAM: "send live values",
    Capability.RIDER_TORQUE: "measure the rider's torque",
    Capability.CALIBRATE: "have its sensor calibrated from here",
    Capability.LIVE_SET: "try values while it runs",
    Capability.LOGS: "keep ride logs",
    Capability.UNLOCK: "take the maker's word for what its market forbids",
    Capability.UNIT_LIMITS: "enforce limits by itself",
    Capability.UNIQUE_ID: "say who it is",
    Capability.RESTART_TO_APPLY: "apply changes at its next start",
    Capability.FUZZY_TABLE: "assist by a rule table",
    Capability.ASSIST_MODES: "have its assist modes edited",
    Capability.LIMITS: "have its limits edited",
    Capability.SIMULATION: "be simulated",
}


class Unit(ABC):
    """One unit behind one url. For any thread; every question may wait for the unit.

    What is asked raises NoAnswer when the unit is silent and DeviceRefused when it refuses.
    """

    family: ClassVar[str]

    def __init__(self, driver: Driver) -> None:
        self.driver = driver
        self.meant: str | None = None

    def only(self, serial_number: str | None) -> Self:
        """The same, for questions to the unit with this serial number and to no other.

        They raise OtherUnit once another one is on the line. None: whichever is there.
        """
        same = copy(self)
        same.meant = serial_number
        return same

    def run(self, operation: Operation[Result], timeout_s: float) -> Result:
        """Run an operation, as of Driver.run, on the unit that is meant."""
        return self.driver.run(operation, timeout_s, self.meant)

    # ------------------------------------------------------------------ what it is

    @property
    @abstractmethod
    def capabilities(self) -> frozenset[Capability]:
        """What this unit can do, as far as it is known now."""

    @property
    @abstractmethod
    def parameters(self) -> ParameterTable:
        """Its parameters and their checks."""

    @property
    @abstractmethod
    def channels(self) -> tuple[ChannelSpec, ...]:
        """Every channel it can send."""

    def status(self) -> DeviceStatus:
        """Everything that is known of its link and of itself."""
        return self.driver.status()

    def require(self, *needed: Capability) -> None:
        """Raise CapabilityMissing naming the first that the unit does not have."""
        available = self.capabilities
        for capability in needed:
            if capability not in available:
                self._lacks(capability)

    @abstractmethod
    def values(self) -> Snapshot:
        """One row of every channel, asked now."""

    # ------------------------------------------------------------------ configuration

    def read_config(self) -> ConfigImage:
        """The active configuration, whole. PeerProtocolError when it contradicts itself."""
        self._lacks(Capability.READ_CONFIG)

    def read_bank(self, bank: str) -> ConfigImage:
        """The `previous` or the `default` configuration. Raises NotFound where there is none."""
        self._lacks(Capability.READ_CONFIG)

    def permit(self, token: str) -> object:
        """The maker's answer as a person brings it, for `write_config`. Raises InvalidRequest."""
        self._lacks(Capability.UNLOCK)

    def write_config(
        self, base: ConfigImage, changes: ParameterValues, confirm_s: int = 0, permit: object = None
    ) -> ConfigImage:
        """Change what is named on top of `base`, all or nothing, and read everything back.

        confirm_s: 0 for good, else on trial for so many seconds. Raises ConfigConflict,
        LimitViolation, AccessDenied, TokenNeeded, NotStandingStill with the unit unchanged;
        NoAnswer with its outcome; PeerProtocolError naming what reads back different.
        """
        self._lacks(Capability.WRITE_CONFIG)

    def outcome_of_write(self, base: ConfigImage, intended: ParameterValues) -> ConfigImage:
        """What became of a write nobody answered: the configuration if it is what was meant.

        Raises NoAnswer with the outcome `unchanged`, ConfigConflict, PeerProtocolError; NoAnswer
        without an outcome when the unit is silent again.
        """
        self._lacks(Capability.WRITE_CONFIG)

    def settings_are_lost(self) -> bool:
        """Whether defaults stand where settings were: to write what it shows is a change then."""
        return False

    # ------------------------------------------------------------------ a change on trial

    def trial(self) -> TrialStatus:
        """Where the active configuration stands."""
        self._lacks(Capability.UNIT_TRIAL)

    def confirm_config(self, intended: ParameterValues) -> ConfigImage:
        """Keep what is on trial once it was read back and compared. Raises Conflict."""
        self._lacks(Capability.UNIT_TRIAL)

    def outcome_of_confirm(self, tried: ConfigImage) -> ConfigImage:
        """As `outcome_of_write`, of a confirmation."""
        self._lacks(Capability.UNIT_TRIAL)

    def rollback_config(self) -> ConfigImage:
        """Give up what is on trial; what is active then. Raises Conflict."""
        self._lacks(Capability.UNIT_TRIAL)

    def outcome_of_rollback(self, tried: ConfigImage) -> ConfigImage:
        """As `outcome_of_write`, of a return."""
        self._lacks(Capability.UNIT_TRIAL)

    # ------------------------------------------------------------------ values on trial

    def trial_values(self) -> ValuesOnTrial:
        """What is on trial in the unit's memory alone."""
        self._lacks(Capability.LIVE_SET)

    def values_in_force(self) -> dict[str, Value]:
        """Every parameter as the law uses it now."""
        self._lacks(Capability.LIVE_SET)

    def set_trial_values(self, changes: ParameterValues, ttl_s: int) -> ValuesOnTrial:
        """Put values on trial for `ttl_s` seconds. Raises LimitViolation, AccessDenied."""
        self._lacks(Capability.LIVE_SET)

    def outcome_of_trial_values(
        self, before: ParameterValues, values: ParameterValues
    ) -> ValuesOnTrial:
        """As `outcome_of_write`, of values on trial."""
        self._lacks(Capability.LIVE_SET)

    def end_trial_values(self) -> ValuesOnTrial:
        """End what is on trial; what is on trial then."""
        self._lacks(Capability.LIVE_SET)

    def outcome_of_trial_values_end(self) -> ValuesOnTrial:
        """As `outcome_of_write`, of the end of what is on trial."""
        self._lacks(Capability.LIVE_SET)

    # ------------------------------------------------------------------ faults and wear

    def faults(self) -> Sequence[Fault]:
        """Every fault that is active or was."""
        return self.faults_reported()

    def faults_reported(self) -> Sequence[Fault]:
        """Those that were active when the unit was last heard, without asking."""
        return [Fault(name, name) for name in self.status().faults_active]

    def clear_faults(self) -> Sequence[Fault]:
        """Forget the faults that are over; those that are left."""
        return self.faults()

    def wear_counters(self) -> WearCounters | None:
        """What the unit knows of its own wear; None for one that counts nothing."""
        return None

    # ------------------------------------------------------------------ ride logs

    def logs(self) -> RideLogs:
        """What is in its directory."""
        self._lacks(Capability.LOGS)

    def log_crc(self, log: RideLog, length: int) -> int:
        """The unit's CRC-32 over the first `length` bytes of a log."""
        self._lacks(Capability.LOGS)

    def fetch_log(self, log: RideLog, have: int) -> AbstractContextManager[LogSegments]:
        """Have the unit send a log from byte `have` on, until the context is left."""
        self._lacks(Capability.LOGS)

    def confirm_log(self, log: RideLog, crc32: int) -> None:
        """Tell the unit that a log is safe here: it may free it."""
        self._lacks(Capability.LOGS)

    def erase_log(self, log: RideLog) -> int | None:
        """Have the unit free a confirmed log; blocks of flash erased for logs in its life."""
        self._lacks(Capability.LOGS)

    def outcome_of_erase(self, log: RideLog) -> None:
        """Raises NoAnswer with the outcome `unchanged` when the log is still there."""
        self._lacks(Capability.LOGS)

    # ------------------------------------------------------------------ simulation

    def simulation(self) -> dict[str, Any]:
        """What rider, road and clock of a simulated unit do now."""
        self._lacks(Capability.SIMULATION)

    def simulate(self, changes: Mapping[str, Any]) -> dict[str, Any]:
        """Change what is named. Raises InvalidRequest in the simulator's words."""
        self._lacks(Capability.SIMULATION)

    def _lacks(self, capability: Capability) -> NoReturn:
        raise CapabilityMissing(
            f"This unit cannot {MEANING[capability]} (capability `{capability}`).",
            capability.value,
        )
