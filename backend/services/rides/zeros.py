"""Makes the zeros of rides: what the torque sensor read while nobody could push."""

from __future__ import annotations

from backend.core.ride import Ride
from backend.core.ride_zero import RideZero
from backend.services.rides.derived import DueRides, made_or
from backend.services.rides.insight.diagnosis import evidence_of, limits_of
from backend.services.rides.insight.rows import columns_of
from backend.store import Store
from backend.views.diagnosis.torque import TORQUE
from backend.views.diagnosis.zero import NEEDED, zero_of

UNREADABLE = RideZero(reason="unreadable")


class RideZeros(DueRides):
    """The zeros that are due."""

    def __init__(self, store: Store) -> None:
        super().__init__(store, store.zeros.due)

    def make(self, ride: Ride) -> None:
        """A ride's zero, or why it tells none."""
        zero = made_or(UNREADABLE, "zero", ride, lambda: self._zero(ride))
        self._store.zeros.keep(ride, zero)

    def _zero(self, ride: Ride) -> RideZero:
        # Most files of head units: their rows need not be read.
        if TORQUE not in {channel.name for channel in ride.channels}:
            return RideZero(reason="no_torque")
        return zero_of(evidence_of(columns_of(self._store, ride.id, NEEDED), limits_of({})))
