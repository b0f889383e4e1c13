"""A simulated unit of the browser tests that is ridden, or was."""

from __future__ import annotations

from tests.fakes.ride_in_time import legs, recorded_ride, ride_on
from tests.fakes.server import SpindleServer

# Long enough for a bike to come to its speed.
UNDER_WAY_S = 15.0


def record_ride(server: SpindleServer, device: str) -> int:
    """The id of a ride of half a minute, once it is over; the unit's clock is virtual."""
    return int(recorded_ride(server, device)["id"])


def get_under_way(server: SpindleServer, device: str) -> None:
    """A unit comes to its speed at once, and is ridden on in real time."""
    server.simulate(device, clock="virtual")
    ride_on(server, device, UNDER_WAY_S, rider=legs(20.0))
    server.simulate(device, clock="real")
