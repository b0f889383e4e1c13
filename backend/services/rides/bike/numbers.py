"""The measurements of a bike's numbers together, as the API has them."""

from __future__ import annotations

from backend.services.rides.bike.cadence import CadenceCheck
from backend.services.rides.bike.climb import CertifiedOf, ClimbCheck
from backend.services.rides.bike.pulses import PulseCount
from backend.services.rides.bike.wheel import ParametersOf, WheelMeasure
from backend.services.rides.settings_in_force import ConfigOf
from backend.store import Store


class BikeNumbers:
    """wheel: its circumference. pulses: in a turn of it. cadence: against the crank's turns. climb:
    the torque gain by an energy balance. Safe from any thread."""

    def __init__(
        self,
        store: Store,
        config_of: ConfigOf,
        parameters_of: ParametersOf,
        certified_of: CertifiedOf,
    ) -> None:
        self.wheel = WheelMeasure(store, config_of, parameters_of)
        self.pulses = PulseCount(store, config_of)
        self.cadence = CadenceCheck(store)
        self.climb = ClimbCheck(store, certified_of)
