"""What rides tell, in one place for those who ask."""

from __future__ import annotations

from backend.rides.comparison.service import RideComparison
from backend.rides.diagnosis.service import Diagnosis
from backend.rides.insight.service import RideEffort, RideEnergy, RidePedalling
from backend.rides.report.service import RideReport
from backend.rides.settings_in_force import ConfigOf
from backend.store import Store


class Insight:
    """The questions that can be asked of a ride; each is safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self.energy = RideEnergy(store, config_of)
        self.effort = RideEffort(store)
        self.diagnosis = Diagnosis(store, config_of)
        self.comparison = RideComparison(store, config_of)
        self.pedalling = RidePedalling(store, config_of)
        self.report = RideReport(store, self.energy, self.effort, self.pedalling, self.diagnosis)
