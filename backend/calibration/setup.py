"""Instruments and plan of a calibration: what hangs on which arm, where, and what is planned; and
local gravity: given, or from latitude and height.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import Field

from backend.calibration.plain import Plain, from_plain
from backend.errors import FieldError

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


MassClass = Literal["E2", "F1", "F2", "M1", "M2", "M3"]
Side = Literal["left", "right"]

CLASS_SHARE: dict[MassClass, float] = {
    "E2": 1.6e-6,
    "F1": 5e-6,
    "F2": 1.6e-5,
    "M1": 5e-5,
    "M2": 1.6e-4,
    "M3": 5e-4,
}
"""Largest permissible error as a share of the mass, 100 g and more (OIML R 111-1:2004, table 1)."""

Angle = Annotated[float, Field(gt=-85, lt=85)]
Limit = Annotated[float, Field(ge=0)]

ARM_SAME_M = 0.001
"""Two readings of one crank: they are made in steps of 2.5 mm."""


@dataclass(frozen=True, slots=True)
class Mass(Plain):
    """One weight of the set: of a class of OIML R 111, or weighed to within `limit_kg`."""

    name: Annotated[str, Field(min_length=1, max_length=60)]
    mass_kg: Annotated[float, Field(ge=0.1, le=200)]
    mass_class: MassClass | None = None
    limit_kg: Annotated[float, Field(ge=0, le=10)] | None = None

    @property
    def limit_share(self) -> float:
        """Half the width of what its mass may be, as a share of it."""
        if self.limit_kg is not None:
            return self.limit_kg / self.mass_kg
        return CLASS_SHARE[self.mass_class or "M3"]


@dataclass(frozen=True, slots=True)
class Setup(Plain):
    """Instruments and plan.

    arm_m: from the spindle's axis to the pedal's. arm_again_m: the same, read once more before the
    fit counts: a wrong arm shows in no residual. arm_limit_m, level_limit_deg: half widths of
    what arm and crank angle may be. loads_kg: what is hung on in turn, without the zero. strokes:
    up and down again, of each side. angles_deg: 0 is the crank level and forward, positive the
    pedal going down. resolution_counts: the reading's step. gain_nm_per_count: what the unit was
    made with, which the slope is judged against. thermometer_limit_k: half width, of the sensor's
    own thermometer. *_limit_*_per_k: what a sensor drifts by at most if nobody measured it.
    """

    arm_m: Annotated[float, Field(ge=0.05, le=1.0)]
    arm_limit_m: Annotated[float, Field(ge=0, le=0.05)]
    gravity: Gravity
    masses: Annotated[tuple[Mass, ...], Field(min_length=1, max_length=50)]
    loads_kg: Annotated[
        tuple[Annotated[float, Field(gt=0, le=200)], ...], Field(min_length=1, max_length=50)
    ]
    full_scale_nm: Annotated[float, Field(ge=5, le=1000)]
    gain_nm_per_count: Annotated[float, Field(gt=0, le=10)]
    strokes: Annotated[int, Field(ge=1, le=10)] = 2
    sides: Annotated[tuple[Side, ...], Field(min_length=1, max_length=2)] = ("right", "left")
    angles_deg: Annotated[tuple[Angle, ...], Field(min_length=1, max_length=12)] = (0.0,)
    level_limit_deg: Annotated[float, Field(ge=0, le=10)] = 2.0
    resolution_counts: Annotated[float, Field(ge=0, le=1000)] = 1.0
    thermometer_limit_k: Annotated[float, Field(ge=0, le=10)] = 0.5
    zero_limit_nm_per_k: Limit = 0.02
    span_limit_share_per_k: Limit = 2e-4
    arm_again_m: Annotated[float, Field(ge=0.05, le=1.0)] | None = None

    @property
    def mass_limit_share(self) -> float:
        """Of whatever hangs there: the worst of the set, as if all of it erred alike."""
        return max(mass.limit_share for mass in self.masses)


def setup_of(body: Any) -> Setup:
    """From plain JSON. Raises InvalidRequest naming every field at fault."""
    return from_plain(Setup, body, faults_of)


def faults_of(setup: Setup) -> list[FieldError]:
    """What no single field shows."""
    faults = []
    for index, mass in enumerate(setup.masses):
        if (mass.mass_class is None) == (mass.limit_kg is None):
            field = f"masses[{index}].limit_kg"
            message = f"{field}: give the class or the limit of {mass.name}, one of them"
            faults.append(FieldError(field, "class_or_limit", message))
    for name in ("sides", "loads_kg", "angles_deg"):
        values = getattr(setup, name)
        if len(set(values)) < len(values):
            faults.append(FieldError(name, "named_twice", f"{name}: a value is named twice"))
    again_m = setup.arm_again_m
    if again_m is not None and abs(again_m - setup.arm_m) > ARM_SAME_M:
        message = (
            f"arm_again_m: the crank was read as {1000 * setup.arm_m:g} mm, and now as"
            f" {1000 * again_m:g} mm: measure it, and correct the one that is wrong"
        )
        faults.append(FieldError("arm_again_m", "arm_differs", message))
    heaviest_nm = max(
        torque_nm(kg, setup.gravity.gravity_ms2, setup.arm_m, 0.0) for kg in setup.loads_kg
    )
    if heaviest_nm > 1.5 * setup.full_scale_nm:
        message = (
            f"loads_kg: the heaviest makes {heaviest_nm:.1f} Nm, over 1.5 times the full scale of"
            f" {setup.full_scale_nm:g} Nm"
        )
        faults.append(FieldError("loads_kg", "beyond_full_scale", message))
    return faults


def torque_nm(mass_kg: float, gravity_ms2: float, arm_m: float, crank_angle_deg: float) -> float:
    """Of what hangs on a pedal: m g l cos(angle), thesis eq. 3.22 with the crank's angle."""
    return mass_kg * gravity_ms2 * arm_m * math.cos(math.radians(crank_angle_deg))
