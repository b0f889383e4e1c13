"""The sensor's coefficients, as the unit keeps them: counts to newton metres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
import numpy.typing as npt
from pydantic import Field

from backend.calibration.plain import Plain
from backend.core.statistics import Numbers

WARMER_K_MAX = 200.0
"""As in the unit's law: a thermometer that is further from the reference is broken."""


@dataclass(frozen=True, slots=True)
class Coefficients(Plain):
    """None: no correction of that kind. The unit's law applies the same equation in C.

    torque_nm = (raw - offset_counts - offset_counts_per_k dt) gain_nm_per_count
                (1 + gain_share_per_k dt), dt from reference_degc.
    """

    offset_counts: float
    gain_nm_per_count: Annotated[float, Field(gt=0)]
    offset_counts_per_k: float | None = None
    gain_share_per_k: float | None = None
    reference_degc: float | None = None

    def torque_nm(self, counts: npt.ArrayLike, degc: npt.ArrayLike | None = None) -> Numbers:
        """Counts and temperatures (n,) as torques; a temperature that is None, NaN or beyond
        belief corrects nothing. tests/conformance holds it to the law's, which is float32."""
        raw = np.asarray(counts, np.float64)
        warmer_k = np.zeros_like(raw)
        if degc is not None and self.reference_degc is not None:
            warmer_k = np.asarray(degc, np.float64) - self.reference_degc
            warmer_k = np.where(np.abs(warmer_k) <= WARMER_K_MAX, warmer_k, 0.0)
        offset = self.offset_counts + (self.offset_counts_per_k or 0.0) * warmer_k
        scale = self.gain_nm_per_count * (1 + (self.gain_share_per_k or 0.0) * warmer_k)
        return (raw - offset) * scale
