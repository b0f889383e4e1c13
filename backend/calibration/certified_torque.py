"""How well a unit's torque was known on a ride, by the certificate of its calibration then."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from backend.calibration.bike.types import CertificateOfTorque
from backend.calibration.budget import Budget
from backend.calibration.job import is_written
from backend.calibration.plain import from_plain
from backend.calibration.records import CalibrationStore
from backend.calibration.unit_record import PARAMETER_OF
from backend.core.moments import utc
from backend.core.ride import Ride

GAIN = PARAMETER_OF["gain_nm_per_count"]
FLOAT32_SHARE = 1e-6

ConfigOf = Callable[[Ride], tuple[Mapping[str, Any], str]]


class CertifiedTorque:
    """Reads only. For any thread. config_of: what a unit was configured as on the whole ride."""

    def __init__(self, store: CalibrationStore, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, ride: Ride, torque_nm: float) -> CertificateOfTorque | None:
        """The newest calibration that was in the unit before the ride began; None without one, or
        where the ride's own configuration has another gain."""
        if ride.context.unit_key is None or not torque_nm > 0:
            return None
        config, source = self._config_of(ride)
        for job in self._store.list(ride.context.unit_key):
            if not is_written(job.body) or job.body["certificate"] is None:
                continue
            written = job.body["changes"][-1]
            if written["at_us"] > ride.started_us:
                continue
            gain = float(written["record"][GAIN])
            # None where the gain was changed on the ride.
            gain_in_force = config.get(GAIN) if source == "ride" else gain
            if gain_in_force is None or not math.isclose(
                gain, float(gain_in_force), rel_tol=FLOAT32_SHARE
            ):
                return None
            certificate = job.body["certificate"]
            budget = from_plain(Budget, certificate["worked"]["budget"])
            share = budget.expanded_at(torque_nm) / torque_nm
            return CertificateOfTorque(
                job.id, certificate["sha256"], utc(written["at_us"]), torque_nm, share
            )
        return None
