"""Trying values while the bike runs: in the unit's memory alone, for some seconds, then gone."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime

from backend.device.ebl.operations.live_set import (
    TTL_S_MAX,
    LiveState,
    end_live,
    read_live,
    set_live,
    settle_live,
    settle_live_end,
    values_in_force,
)
from backend.device.ebl.operations.parameters import Value, faults_of, rounded, unknown_names
from backend.errors import FieldError, InvalidRequest, LimitViolation, NoAnswer
from backend.services.connect import Devices
from backend.services.outcome import telling
from backend.services.settle import settled


@dataclass(frozen=True)
class LiveView:
    """What is tried and until when; nothing and None where nothing is.

    parameters: those that differ from the configuration, with the value in force.
    """

    parameters: dict[str, Value]
    remaining_s: float | None
    expires_at: datetime | None


class LiveTuning:
    """Values on top of a unit's configuration. For any thread. now_s: Unix time."""

    def __init__(self, devices: Devices, now_s: Callable[[], float] = time.time) -> None:
        self._devices = devices
        self._now_s = now_s

    def read(self, device_id: str) -> LiveView:
        """What is tried, asked of the unit. Raises NotFound, Conflict, NoAnswer."""
        status = self._devices.writable(device_id)
        return self._view(self._devices.run(device_id, read_live(status.mtu)))

    def set(self, device_id: str, changes: Mapping[str, Value], ttl_s: int) -> LiveView:
        """Try values for `ttl_s` seconds, on top of what is tried already.

        Raises InvalidRequest, LimitViolation with every fault named, AccessDenied for what the
        maker protects, NotFound, Conflict, NoAnswer.
        """
        status = self._devices.writable(device_id)
        if not 1 <= ttl_s <= TTL_S_MAX:
            message = f"ttl_s is from 1 to {TTL_S_MAX} seconds."
            raise InvalidRequest(message, fields=[FieldError("ttl_s", "out_of_range", message)])
        unknown = unknown_names(changes)
        if unknown:
            raise InvalidRequest(" ".join(fault.message for fault in unknown), fields=unknown)
        with telling("unchanged"):
            in_force = self._devices.run(device_id, values_in_force(status.mtu))
        intended = {**in_force, **changes}
        faults = faults_of(intended)
        if faults:
            raise LimitViolation(" ".join(fault.message for fault in faults), fields=faults)
        whole = rounded(intended)
        values = {name: whole[name] for name in changes}
        try:
            with telling("unknown"):
                state = self._devices.run(device_id, set_live(values, ttl_s, status.mtu))
        except NoAnswer as error:
            if error.outcome != "unknown":
                raise
            before = {name: in_force[name] for name in changes}
            state = settled(
                self._devices, device_id, lambda mtu: settle_live(before, values, mtu), error
            )
        return self._view(state)

    def end(self, device_id: str) -> LiveView:
        """End what is tried: the law runs on the configuration again."""
        status = self._devices.writable(device_id)
        try:
            with telling("unknown"):
                self._devices.run(device_id, end_live())
                state = self._devices.run(device_id, read_live(status.mtu))
        except NoAnswer as error:
            if error.outcome != "unknown":
                raise
            state = settled(self._devices, device_id, settle_live_end, error)
        return self._view(state)

    def _view(self, state: LiveState) -> LiveView:
        if state.left_s == 0.0:
            return LiveView({}, None, None)
        expires_at = datetime.fromtimestamp(self._now_s() + state.left_s, UTC)
        return LiveView(state.parameters, state.left_s, expires_at)
