"""What the unit told of itself since the handshake: faults, configuration, restarts."""

from __future__ import annotations

from backend.device.configuration import TrialStatus
from backend.device.ebl.faults import fault_names
from backend.device.ebl.session.handshake import Handshake
from backend.device.states import LinkStatistics, UnitEvent
from firmware_protocol._generated import (
    BootEvent,
    ConfigCommittedEvent,
    ConfigDefaultedEvent,
    ConfigProvisionalEvent,
    ConfigRolledBackEvent,
    FaultClearedEvent,
    FaultSetEvent,
    StreamCountsEvent,
)
from firmware_protocol._generated import Event as EventCode
from firmware_protocol.codec import Event


class UnitState:
    """The unit's own word on its configuration and faults, kept fresh by its events.

    trial_ends_s: when the configuration on trial is given up, in the session's time; None while
    none is on trial. rollback_cause: why the latest trial since the unit was switched on was given
    up: none, asked, time_out or restart; None while it was not asked.
    """

    def __init__(self) -> None:
        self.config_generation: int | None = None
        self.config_crc32: int | None = None
        self.fault_flags = 0
        self.boot_id: int | None = None
        self.trial_ends_s: float | None = None
        self.rollback_cause: str | None = None

    @property
    def faults_active(self) -> tuple[str, ...]:
        """Names of the active faults; one of a newer firmware is `fault_n`."""
        return fault_names(self.fault_flags)

    def begin(self, handshake: Handshake, now_s: float) -> None:
        """Start from what the handshake found."""
        trial = handshake.trial
        self.trial_ends_s = now_s + trial.left_s if trial and trial.on_trial else None
        self.rollback_cause = trial.rollback_cause if trial else None
        self.config_generation = handshake.hello.config_generation
        self.config_crc32 = handshake.hello.config_crc32
        self.fault_flags = handshake.fault_flags
        self.boot_id = handshake.identity.boot_id

    def refresh(self, fault_flags: int, trial: TrialStatus, now_s: float) -> None:
        """Start again from what the unit says when asked, because an event did not come."""
        self.fault_flags = fault_flags
        self.rollback_cause = trial.rollback_cause
        ends_s = now_s + trial.left_s if trial.on_trial else None
        self._config(trial.generation, trial.crc32, ends_s)

    def take(
        self, event: Event, statistics: LinkStatistics, now_s: float, late: bool = False
    ) -> UnitEvent | None:
        """Note an event; what is worth telling people comes back.

        late: newer ones came before it, so it says nothing about how things stand.
        """
        message = event.message
        if isinstance(message, StreamCountsEvent):
            statistics.unit_frames_built = message.built
            statistics.unit_frames_dropped = message.dropped_tx
            return None
        if not late:
            self._note(message, now_s)
        name = event.code.name if isinstance(event.code, EventCode) else f"EVENT_{event.code}"
        return UnitEvent(name, event.t_us, event.fields)

    def _note(self, message: object, now_s: float) -> None:
        if isinstance(message, FaultSetEvent | FaultClearedEvent):
            self._fault(message)
        elif isinstance(
            message, ConfigCommittedEvent | ConfigRolledBackEvent | ConfigDefaultedEvent
        ):
            self._config(message.generation, message.crc32, None)
            if isinstance(message, ConfigRolledBackEvent):
                # The event does not say why; what the trial before this one ended of is no answer.
                self.rollback_cause = None
        elif isinstance(message, ConfigProvisionalEvent):
            self._config(message.generation, message.crc32, now_s + message.confirm_s)
        elif isinstance(message, BootEvent):
            self.boot_id = message.boot_id

    def _config(self, generation: int, crc32: int, trial_ends_s: float | None) -> None:
        self.config_generation, self.config_crc32 = generation, crc32
        self.trial_ends_s = trial_ends_s

    def _fault(self, message: FaultSetEvent | FaultClearedEvent) -> None:
        if isinstance(message, FaultSetEvent):
            self.fault_flags |= message.fault_flags
        else:
            self.fault_flags &= ~message.fault_flags
