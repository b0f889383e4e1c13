"""Local gravity: given, or from latitude and height."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field

from backend.domain.calibration.plain import Plain

# WGS 84 (NIMA TR 8350.2, table 3.4 and equation 4-1): gravity at the equator, Somigliana's k, and
# the square of the first eccentricity; semi-axes and angular terms for the height.
EQUATOR_MS2 = 9.7803253359
SOMIGLIANA = 0.00193185265241
ECCENTRICITY_SQUARED = 0.00669437999013
SEMI_MAJOR_M = 6378137.0
FLATTENING = 1 / 298.257223563
ROTATION_SHARE = 0.00344978650684

ANOMALY_MS2 = 5e-4
"""Standard uncertainty of real gravity about the normal one: free-air anomalies on inhabited land
stay mostly within 50 mGal of zero."""

HEIGHT_MS2_PER_M = 3.086e-6

ANYWHERE_MS2, ANYWHERE_LIMIT_MS2 = 9.806, 0.026
"""Of nobody knows where: 9.780 at the equator to 9.832 at the poles."""


@dataclass(frozen=True, slots=True)
class Gravity(Plain):
    """What a kilogram weighs here.

    standard_ms2: standard uncertainty. source: `given`, or `place` with latitude and height.
    """

    gravity_ms2: Annotated[float, Field(ge=9.76, le=9.84)]
    standard_ms2: Annotated[float, Field(ge=0.0, le=0.05)]
    source: Literal["given", "place"]
    latitude_deg: Annotated[float, Field(ge=-90, le=90)] | None = None
    height_m: Annotated[float, Field(ge=-500, le=9000)] | None = None


def normal_gravity_ms2(latitude_deg: float, height_m: float = 0.0) -> float:
    """Normal gravity of WGS 84 by Somigliana's formula, with the free-air correction of second
    order (NIMA TR 8350.2, equations 4-1 and 4-3)."""
    sine_squared = math.sin(math.radians(latitude_deg)) ** 2
    at_sea_ms2 = EQUATOR_MS2 * (1 + SOMIGLIANA * sine_squared)
    at_sea_ms2 /= math.sqrt(1 - ECCENTRICITY_SQUARED * sine_squared)
    slope = 1 + FLATTENING + ROTATION_SHARE - 2 * FLATTENING * sine_squared
    share = height_m / SEMI_MAJOR_M
    return at_sea_ms2 * (1 - 2 * slope * share + 3 * share * share)


def gravity_at(latitude_deg: float, height_m: float, height_standard_m: float = 50.0) -> Gravity:
    """Gravity of a place, with what anomaly and height leave open."""
    return Gravity(
        normal_gravity_ms2(latitude_deg, height_m),
        math.hypot(ANOMALY_MS2, HEIGHT_MS2_PER_M * height_standard_m),
        "place",
        latitude_deg,
        height_m,
    )
