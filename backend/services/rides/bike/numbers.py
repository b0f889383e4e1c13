"""The measurements of a bike's numbers together, as the API has them."""

from __future__ import annotations

from backend.services.rides.bike.cadence import CadenceCheck
from backend.services.rides.bike.climb import ClimbCheck
from backend.services.rides.bike.wheel import ParametersOf, WheelMeasure
from backend.services.rides.replay import ConfigOf
from backend.store import Store


class BikeNumbers:
    """wheel: its circumference. cadence: against the crank's turns. climb: the torque gain by an
    energy balance. Safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf, parameters_of: ParametersOf) -> None:
        self.wheel = WheelMeasure(store, config_of, parameters_of)
        self.cadence = CadenceCheck(store)
        self.climb = ClimbCheck(store)
