"""Values on trial while the bike runs: in the unit's memory alone, for some seconds, then gone."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from datetime import UTC, datetime

from backend.core.audit import Action, AuditEntry, Note, differing, no_note
from backend.device.capability import Capability
from backend.device.configuration import Value, ValuesOnTrial
from backend.errors import FieldError, InvalidRequest, LimitViolation, NoAnswer
from backend.tuning.types import TrialValues
from backend.units.outcome import find_outcome, telling
from backend.units.service import Devices

TTL_S_MAX = 255


class TrialTuning:
    """Values on top of a unit's configuration. For any thread. now_s: Unix time. note: adds to the
    audit."""

    def __init__(
        self, devices: Devices, now_s: Callable[[], float] = time.time, note: Note = no_note
    ) -> None:
        self._devices = devices
        self._note = note
        self._now_s = now_s

    def read(self, device_id: str) -> TrialValues:
        """What is on trial, read from the unit. Raises NotFound, Conflict, NoAnswer."""
        return self._view(self._devices.writable(device_id).trial_values())

    def set(self, device_id: str, changes: Mapping[str, Value], ttl_s: int) -> TrialValues:
        """Put values on trial for `ttl_s` seconds, on top of those that are already.

        Raises InvalidRequest, LimitViolation with every fault named, AccessDenied for what the
        maker protects, NotFound, Conflict, NameFirst, NoAnswer.
        """
        key, unit = self._devices.own(device_id)
        unit.require(Capability.LIVE_SET)
        if not 1 <= ttl_s <= TTL_S_MAX:
            message = f"ttl_s is from 1 to {TTL_S_MAX} seconds."
            raise InvalidRequest(message, fields=[FieldError("ttl_s", "out_of_range", message)])
        unknown = unit.parameters.unknown_names(changes)
        if unknown:
            raise InvalidRequest(" ".join(fault.message for fault in unknown), fields=unknown)
        with telling("unchanged"):
            in_force = unit.values_in_force()
        intended = {**in_force, **changes}
        faults = unit.parameters.faults_of(intended)
        if faults:
            raise LimitViolation(" ".join(fault.message for fault in faults), fields=faults)
        rounded = unit.parameters.rounded(intended)
        values = {name: rounded[name] for name in changes}
        before = {name: in_force[name] for name in changes}
        try:
            with telling("unknown"):
                state = unit.set_trial_values(values, ttl_s)
        except NoAnswer as error:
            if error.outcome != "unknown":
                raise
            state = find_outcome(
                self._devices,
                device_id,
                key,
                lambda unit: unit.outcome_of_trial_values(before, values),
                error,
            )
        old, new = differing(before, values)
        if new:
            entry = AuditEntry(Action.UNIT_VALUES_TRIED, key, None, old, new, unit_key=key)
            self._note(entry)
        return self._view(state)

    def end(self, device_id: str) -> TrialValues:
        """End what is on trial: the law runs on the configuration again. Raises as `set`."""
        key, unit = self._devices.own(device_id)
        try:
            with telling("unknown"):
                state = unit.end_trial_values()
        except NoAnswer as error:
            if error.outcome != "unknown":
                raise
            state = find_outcome(
                self._devices,
                device_id,
                key,
                lambda unit: unit.outcome_of_trial_values_end(),
                error,
            )
        self._note(AuditEntry(Action.UNIT_VALUES_ENDED, key, unit_key=key))
        return self._view(state)

    def _view(self, state: ValuesOnTrial) -> TrialValues:
        if state.left_s == 0.0:
            return TrialValues({}, None, None)
        expires_at = datetime.fromtimestamp(self._now_s() + state.left_s, UTC)
        return TrialValues(state.parameters, state.left_s, expires_at)
