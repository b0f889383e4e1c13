"""What routes may call, handed to them by main; each requests one with `web.services.provided`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from backend.audit.service import Audit
    from backend.bikes.service import Bikes
    from backend.calibration.bike.service import BikeNumbers
    from backend.calibration.service import Calibrations
    from backend.imports.mapping import TableMapping
    from backend.imports.service import Uploads
    from backend.imports.unit_logs import Collect
    from backend.people.service import PeopleService
    from backend.rides.comparison.since_change import RidesSinceChange
    from backend.rides.diagnosis.sensor_drift import SensorDriftService
    from backend.rides.insight.ledger import EnergyLedger
    from backend.rides.insight.table_use import UseOfTable
    from backend.rides.logbook.home import RiderHomeService
    from backend.rides.questions import Insight
    from backend.rides.recording.fault_moment import FaultMoments
    from backend.rides.recording.marks import MarkMoment
    from backend.rides.replay.propose import Proposals
    from backend.rides.replay.ride_again import RideAgain
    from backend.rides.replay.why_ride import WhyRide
    from backend.rides.service import Rides
    from backend.server.addresses import ServerAddresses
    from backend.server.backup import StoreService
    from backend.server.health import HealthCheck
    from backend.tuning.library.compare import Compare
    from backend.tuning.library.service import Library
    from backend.tuning.limit_proof import ProveLimits
    from backend.tuning.preview import Preview
    from backend.tuning.service import Tuning
    from backend.tuning.trial_values import TrialTuning
    from backend.tuning.why import WhySteady
    from backend.units.dashboard import Dashboards
    from backend.units.inspection import Inspection
    from backend.units.service import Devices
    from backend.units.watch import Watch
    from backend.visits.service import Visits
    from backend.visits.workbench import Workbench


@dataclass(frozen=True)
class Services:
    """The use cases behind the API; each is safe to call from any thread."""

    health: HealthCheck
    store: StoreService
    addresses: ServerAddresses
    devices: Devices
    inspection: Inspection
    workbench: Workbench
    fault_moments: FaultMoments
    watch: Watch
    dashboards: Dashboards
    mark: MarkMoment
    tuning: Tuning
    calibrations: Calibrations
    bike_numbers: BikeNumbers
    trial_values: TrialTuning
    preview: Preview
    library: Library
    compare: Compare
    prove_limits: ProveLimits
    rides: Rides
    home: RiderHomeService
    ride_again: RideAgain
    proposals: Proposals
    use_of_table: UseOfTable
    since_change: RidesSinceChange
    sensor_drift: SensorDriftService
    why_steady: WhySteady
    why_ride: WhyRide
    ledger: EnergyLedger
    insight: Insight
    uploads: Uploads
    tables: TableMapping
    sample_ride: Callable[[int | None], int]
    collect: Collect
    bikes: Bikes
    visits: Visits
    audit: Audit
    # None where nobody is asked to sign in.
    people: PeopleService | None
