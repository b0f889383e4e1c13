"""The zero of the torque sensor on one ride, from its coasting.

While the wheel turns and the crank stands, the freewheel passes nothing on: whatever a foot does,
no torque goes forward through the spindle. At a standstill a foot can hold a few newton metres
against chain and brake, as still as a zero; so that is no zero of a ride.
"""

from __future__ import annotations

import math

import numpy as np

from backend.core._generated import MOVING_KMH
from backend.core.channels import Values
from backend.core.ride_zero import RideZero
from backend.core.statistics import MEDIAN_TO_MEAN, robust_deviation
from backend.rides.diagnosis.finding import Evidence
from backend.rides.diagnosis.torque import (
    CADENCE,
    RAW,
    REST_RPM,
    SPEED,
    STILL_NM,
    STILL_S,
    TORQUE,
    ZERO_NM,
    Segment,
    unloaded_segments,
)

TEMPERATURE = "sensor_temperature_degc"
ZERO_CHANNELS = (TORQUE, CADENCE, SPEED, RAW, TEMPERATURE)
# A median of more than this scatter cannot tell whether it is beyond the level that is watched.
SCATTER_NM_MAX = 0.5 * ZERO_NM
# With fewer pieces their own scatter says little: then as if each were anywhere in STILL_NM.
SEGMENTS_FEW = 5
# Of the scale, thesis_checks I-21.
RESOLUTION_NM = 0.01


def zero_of(ride: Evidence) -> RideZero:
    """The median over stretches of coasting, each STILL_S long, with its standard uncertainty."""
    for channel, reason in ((TORQUE, "no_torque"), (CADENCE, "no_cadence"), (SPEED, "no_speed")):
        if channel in ride.derived or not ride.has(channel):
            return RideZero(reason=reason)
    coasting = ride.values[SPEED] > MOVING_KMH
    coasting &= np.abs(ride.values[CADENCE]) < REST_RPM
    segments = unloaded_segments(ride, coasting)
    free = [segment for segment in segments if segment.shows_zero]
    if not free:
        return RideZero(reason=why_none(segments))
    zeros = np.array([segment.torque_nm for segment in free])
    scatter_nm = robust_deviation(zeros)
    if scatter_nm > SCATTER_NM_MAX:
        return RideZero(pieces=len(free), reason="disagree")
    return RideZero(
        zero_nm=float(np.median(zeros)),
        uncertainty_nm=uncertainty_nm(scatter_nm, len(free)),
        zero_counts=meanwhile(ride, RAW, free),
        temperature_degc=meanwhile(ride, TEMPERATURE, free),
        pieces=len(free),
    )


def why_none(segments: list[Segment]) -> str:
    """Why no piece tells the zero."""
    if not segments:
        return "no_coasting"
    return "foot" if any(segment.is_still for segment in segments) else "not_still"


def uncertainty_nm(scatter_nm: float, segments: int) -> float:
    """Standard uncertainty of a median: GUM 4.2.3, 4.3.7 for few pieces and for the resolution."""
    if segments < SEGMENTS_FEW:
        scatter_nm = max(scatter_nm, STILL_NM / math.sqrt(12.0))
    of_median = MEDIAN_TO_MEAN * scatter_nm / math.sqrt(segments)
    return math.hypot(of_median, RESOLUTION_NM / math.sqrt(12.0))


def meanwhile(ride: Evidence, channel: str, segments: list[Segment]) -> float | None:
    """The median of another channel's means over the same pieces; None where it has none."""
    values: Values | None = ride.values.get(channel)
    if values is None:
        return None
    means = []
    for segment in segments:
        ends = np.searchsorted(ride.start_s, (segment.begin_s, segment.begin_s + STILL_S))
        samples = values[slice(*ends)]
        samples = samples[np.isfinite(samples)]
        if len(samples):
            means.append(float(np.mean(samples)))
    return float(np.median(means)) if means else None
