"""What somebody can tell of rider and bike that no ride does."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RiderAndBike:
    """mass_kg: rider, bike and load. drag_area_m2: drag coefficient times frontal area. None:
    is unknown."""

    mass_kg: float | None = None
    drag_area_m2: float | None = None
