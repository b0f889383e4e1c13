"""What the routes may call, handed to them by main. The API builds none of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, cast

from fastapi import Depends
from starlette.requests import HTTPConnection

if TYPE_CHECKING:
    from backend.services.collect import Collect
    from backend.services.connect import Devices
    from backend.services.dashboard import Dashboards
    from backend.services.health import Health
    from backend.services.inspection import Inspection
    from backend.services.preview import Preview
    from backend.services.review import Rides
    from backend.services.try_live import LiveTuning
    from backend.services.tune import Tuning
    from backend.services.upload import Uploads
    from backend.services.watch import Watch


@dataclass(frozen=True)
class Services:
    """The use cases behind the API; each is safe to call from any thread."""

    health: Health
    devices: Devices
    inspection: Inspection
    watch: Watch
    dashboards: Dashboards
    tuning: Tuning
    live: LiveTuning
    preview: Preview
    rides: Rides
    uploads: Uploads
    collect: Collect


def services_of(connection: HTTPConnection) -> Services:
    """The container that main put on the application."""
    return cast(Services, connection.app.state.services)


Provided = Annotated[Services, Depends(services_of)]
