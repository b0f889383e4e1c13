"""A unit that speaks EBL, as services see it: every question is an operation of its session."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from itertools import count
from typing import Any, TypeVar, cast

from backend.core.channels import ChannelSpec
from backend.core.unit_key import EBL
from backend.device.capability import Capability
from backend.device.configuration import (
    ConfigImage,
    ParameterTable,
    ParameterValues,
    TrialStatus,
    Value,
    ValuesOnTrial,
)
from backend.device.driver import Driver, LinkOpener, Listener
from backend.device.ebl.faults import described
from backend.device.ebl.operations import config_outcome, config_trial, ride_logs, trial_values
from backend.device.ebl.operations.config_transaction import read_bank, read_config, write_config
from backend.device.ebl.operations.parameters import TABLE
from backend.device.ebl.operations.readings import (
    CHANNEL_SPECS,
    clear_faults,
    fault_frames,
    read_values,
    read_wear_counters,
    settings_are_lost,
)
from backend.device.ebl.operations.simulation import simulation_get, simulation_set
from backend.device.ebl.operations.unlock import Token, token_from
from backend.device.ebl.session.log_receiver import LogReceiver
from backend.device.ebl.session.operation import Operation
from backend.device.ebl.session.schema import Schemas
from backend.device.ebl.session.session import Session
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.ebl.session.trial_status import trial_status
from backend.device.readings import Fault, LogSegments, RideLog, RideLogs, Snapshot, WearCounters
from backend.device.states import LinkState
from backend.device.unit import Unit
from backend.errors import CapabilityMissing, DeviceRefused, SpindleError

Result = TypeVar("Result")

ANSWER_S = 10.0
# A write is some ten round trips; on a poor line each may take four attempts.
WRITE_S = 30.0
# The unit's own check of a log of 4 MB takes seconds.
LOG_CHECK_S = 60.0
LOG_SESSIONS = 15

# Where the unit's settings mean something else than we know, only what it sends is understood.
READ_ONLY = frozenset({Capability.STREAM, Capability.RIDER_TORQUE, Capability.UNIQUE_ID})
EVERY = frozenset(Capability) - {Capability.RESTART_TO_APPLY, Capability.SIMULATION}


class EblUnit(Unit):
    """One unit and its thread.

    streaming: whether rows of every channel are to come by themselves. Others as in Driver, and
    schemas as in Session.
    """

    family = EBL

    def __init__(
        self,
        opener: LinkOpener,
        listener: Listener,
        streaming: bool = True,
        reopen_when_silent: bool = True,
        schemas: Schemas | None = None,
    ) -> None:
        plan = StreamPlan() if streaming else None
        self._session = Session(time.monotonic(), plan, schemas)
        self._log_sessions = count()
        super().__init__(Driver(opener, listener, self._session, reopen_when_silent))

    @property
    def capabilities(self) -> frozenset[Capability]:
        status = self.status()
        if status.state is LinkState.READ_ONLY:
            return READ_ONLY
        simulated = status.identity is not None and status.identity.simulated
        return EVERY | {Capability.SIMULATION} if simulated else EVERY

    @property
    def parameters(self) -> ParameterTable:
        return TABLE

    @property
    def channels(self) -> tuple[ChannelSpec, ...]:
        return CHANNEL_SPECS

    def values(self) -> Snapshot:
        return self._run(read_values())

    # ------------------------------------------------------------------ configuration

    def read_config(self) -> ConfigImage:
        return self._run(read_config(self._mtu))

    def read_bank(self, bank: str) -> ConfigImage:
        return self._run(read_bank(bank, self._mtu))

    def permit(self, token: str) -> Token:
        return token_from(token)

    def write_config(
        self, base: ConfigImage, changes: ParameterValues, confirm_s: int = 0, permit: object = None
    ) -> ConfigImage:
        token = cast("Token | None", permit)
        return self._run(write_config(base, changes, self._mtu, confirm_s, token), WRITE_S)

    def outcome_of_write(self, base: ConfigImage, intended: ParameterValues) -> ConfigImage:
        return self._run(config_outcome.outcome_of_write(base, intended, self._mtu))

    def settings_are_lost(self) -> bool:
        return self._run(settings_are_lost())

    def trial(self) -> TrialStatus:
        return self._run(trial_status())

    def confirm_config(self, intended: ParameterValues) -> ConfigImage:
        return self._run(config_trial.confirm_config(intended, self._mtu), WRITE_S)

    def outcome_of_confirm(self, tried: ConfigImage) -> ConfigImage:
        return self._run(config_outcome.outcome_of_confirm(tried))

    def rollback_config(self) -> ConfigImage:
        return self._run(config_trial.rollback_config(self._mtu), WRITE_S)

    def outcome_of_rollback(self, tried: ConfigImage) -> ConfigImage:
        return self._run(config_outcome.outcome_of_rollback(tried, self._mtu))

    # ------------------------------------------------------------------ values on trial

    def trial_values(self) -> ValuesOnTrial:
        return self._run(trial_values.read_trial_values(self._mtu))

    def values_in_force(self) -> dict[str, Value]:
        return self._run(trial_values.values_in_force(self._mtu))

    def set_trial_values(self, changes: ParameterValues, ttl_s: int) -> ValuesOnTrial:
        return self._run(trial_values.set_trial_values(changes, ttl_s, self._mtu))

    def outcome_of_trial_values(
        self, before: ParameterValues, values: ParameterValues
    ) -> ValuesOnTrial:
        return self._run(trial_values.outcome_of_trial_values(before, values, self._mtu))

    def end_trial_values(self) -> ValuesOnTrial:
        self._run(trial_values.end_trial_values())
        return self.trial_values()

    def outcome_of_trial_values_end(self) -> ValuesOnTrial:
        return self._run(trial_values.outcome_of_trial_values_end(self._mtu))

    # ------------------------------------------------------------------ faults and wear

    def faults(self) -> Sequence[Fault]:
        return self._run(fault_frames())

    def faults_reported(self) -> Sequence[Fault]:
        return [described(name) for name in self.status().faults_active]

    def clear_faults(self) -> Sequence[Fault]:
        return self._run(clear_faults())

    def wear_counters(self) -> WearCounters | None:
        return self._run(read_wear_counters())

    # ------------------------------------------------------------------ ride logs

    def logs(self) -> RideLogs:
        try:
            return self._run(ride_logs.list_logs())
        except DeviceRefused as error:
            if error.status in ("UNSUPPORTED", "UNKNOWN_MSG"):
                self._lacks(Capability.LOGS)
            raise

    def log_crc(self, log: RideLog, length: int) -> int:
        return self._run(ride_logs.log_crc(log, length), LOG_CHECK_S)

    @contextmanager
    def fetch_log(self, log: RideLog, have: int) -> Iterator[LogSegments]:
        receiver = LogReceiver(next(self._log_sessions) % LOG_SESSIONS + 1, time.monotonic())
        self.driver.between_turns(lambda: self._session.receive_log(receiver))
        try:
            self._run(ride_logs.receive_log(log, receiver, have))
            yield receiver
        finally:
            self.driver.between_turns(lambda: self._session.receive_log(None))
            with suppress(SpindleError):
                self._run(ride_logs.close_log(receiver.session))

    def confirm_log(self, log: RideLog, crc32: int) -> None:
        self._run(ride_logs.confirm_log(log, crc32), LOG_CHECK_S)

    def erase_log(self, log: RideLog) -> int | None:
        return self._run(ride_logs.erase_log(log), LOG_CHECK_S)

    def outcome_of_erase(self, log: RideLog) -> None:
        self._run(ride_logs.outcome_of_erase(log))

    # ------------------------------------------------------------------ simulation

    def simulation(self) -> dict[str, Any]:
        return self._simulated(simulation_get())

    def simulate(self, changes: Mapping[str, Any]) -> dict[str, Any]:
        return self._simulated(simulation_set(changes))

    def _simulated(self, operation: Operation[dict[str, Any]]) -> dict[str, Any]:
        identity = self.status().identity
        try:
            if identity is None or identity.simulated:
                return self._run(operation)
        except DeviceRefused as error:
            if error.status != "UNKNOWN_MSG":
                raise
        raise CapabilityMissing(
            "This is a real unit; only a simulated one has a simulation.",
            Capability.SIMULATION.value,
        )

    # ------------------------------------------------------------------ inside

    @property
    def _mtu(self) -> int:
        """The largest frame that both sides take."""
        return self.driver.between_turns(lambda: self._session.mtu)

    def _run(self, operation: Operation[Result], timeout_s: float = ANSWER_S) -> Result:
        return self.run(operation, timeout_s)
