"""The dashboard of every unit, kept from the rows its stream brings; a unit that starts anew starts
its account anew."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field

from backend.device.states import DeviceEvent
from backend.device.stream import StreamBlock
from backend.domain.dashboard import CHANNELS, Column, Dashboard, DashboardAccount
from backend.errors import NotFound


@dataclass
class _Kept:
    """One unit's account and the number of rows its subscription has brought."""

    account: DashboardAccount = field(default_factory=DashboardAccount)
    epoch: int | None = None


class Dashboards:
    """Follows all units; `follow` is their watcher."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._kept: dict[str, _Kept] = {}

    def follow(self, device_id: str, event: DeviceEvent) -> None:
        """Take what a unit sent; anything but rows is not for us."""
        if not isinstance(event, StreamBlock):
            return
        columns = _columns(event)
        with self._lock:
            kept = self._kept.setdefault(device_id, _Kept())
            if kept.account.t_us is not None and event.t0_us < kept.account.t_us:
                kept = self._kept[device_id] = _Kept()
            lost_rows = event.lost_rows_before if kept.epoch == event.epoch else 0
            kept.epoch = event.epoch
            kept.account.take(event.t0_us, event.period_us, columns, lost_rows)

    def get(self, device_id: str) -> Dashboard:
        """The values of a unit as of its last row. Raises NotFound before the first."""
        with self._lock:
            if device_id not in self._kept:
                raise NotFound(f"{device_id} has sent no row yet, or there is no such unit.")
            return self._kept[device_id].account.now()


def _columns(block: StreamBlock) -> dict[str, Column]:
    return {
        spec.name: spec.to_values(block.values[:, number])
        for number, spec in enumerate(block.channels)
        if spec.name in CHANNELS
    }
