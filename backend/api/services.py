"""What the routes may call, handed to them by main. The API builds none of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, cast

from fastapi import Depends
from starlette.requests import HTTPConnection

if TYPE_CHECKING:
    from backend.calibration.bike.service import BikeNumbers
    from backend.calibration.service import Calibrations
    from backend.imports.mapping import TableMapping
    from backend.imports.service import Uploads
    from backend.imports.unit_logs import Collect
    from backend.people.service import PeopleService
    from backend.server.backup import StoreService
    from backend.server.health import HealthCheck
    from backend.services.rides.fault_moment import FaultMoments
    from backend.services.rides.home import RiderHome
    from backend.services.rides.insight.questions import Insight
    from backend.services.rides.ledger import EnergyLedger
    from backend.services.rides.mark import MarkMoment
    from backend.services.rides.propose import Proposals
    from backend.services.rides.review import Rides
    from backend.services.rides.ride_again import RideAgain
    from backend.services.rides.sensor_drift import SensorDrift
    from backend.services.rides.since_change import SinceChange
    from backend.services.rides.use_of_table import UseOfTable
    from backend.services.rides.why_ride import WhyRide
    from backend.tuning.library.compare import Compare
    from backend.tuning.library.service import Library
    from backend.tuning.limit_proof import Certify
    from backend.tuning.live_set import LiveTuning
    from backend.tuning.preview import Preview
    from backend.tuning.service import Tuning
    from backend.tuning.why import WhySteady
    from backend.units.dashboard import Dashboards
    from backend.units.inspection import Inspection
    from backend.units.service import Devices
    from backend.units.watch import Watch


@dataclass(frozen=True)
class Services:
    """The use cases behind the API; each is safe to call from any thread."""

    health: HealthCheck
    store: StoreService
    devices: Devices
    inspection: Inspection
    fault_moments: FaultMoments
    watch: Watch
    dashboards: Dashboards
    mark: MarkMoment
    tuning: Tuning
    calibrations: Calibrations
    bike_numbers: BikeNumbers
    live: LiveTuning
    preview: Preview
    library: Library
    compare: Compare
    certify: Certify
    rides: Rides
    home: RiderHome
    ride_again: RideAgain
    proposals: Proposals
    use_of_table: UseOfTable
    since_change: SinceChange
    sensor_drift: SensorDrift
    why_steady: WhySteady
    why_ride: WhyRide
    ledger: EnergyLedger
    insight: Insight
    uploads: Uploads
    tables: TableMapping
    sample_ride: Callable[[], int]
    collect: Collect
    # None where nobody is asked to sign in.
    people: PeopleService | None


def services_of(connection: HTTPConnection) -> Services:
    """The container that main put on the application."""
    return cast(Services, connection.app.state.services)


Provided = Annotated[Services, Depends(services_of)]
