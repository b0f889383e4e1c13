"""What a certificate says of a torque, for whoever compares something with it."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime


@dataclass(frozen=True)
class Certified:
    """calibration_id: of the job that has it. sha256: of the certificate that the unit keeps.
    written_at: when the unit got it. expanded_share: of torque_nm, k = 2."""

    calibration_id: int
    sha256: str
    written_at: datetime
    torque_nm: float
    expanded_share: float
