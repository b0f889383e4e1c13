"""A ride of a simulated unit with a virtual clock, through the whole server: as long as is said,
and over in a moment."""

from __future__ import annotations

from typing import Any

from tests.fakes.server import SpindleServer, eventually

FUZZY_MODE = 3
# A ride ends itself once the bike has stood for half a minute.
REST_S = 40.0


def legs(torque_nm: float = 25.0, cadence_rpm_max: float = 90.0) -> dict[str, Any]:
    """A rider who pushes with every stroke."""
    return {"kind": "legs", "torque_nm": torque_nm, "cadence_rpm_max": cadence_rpm_max}


def ride_on(server: SpindleServer, device: str, seconds: float, **more: Any) -> None:
    """Rides for so long in the mode that the first table rules. more: of the simulation."""
    usual = {"brake": False, "assist_mode": FUZZY_MODE, "rider": legs()}
    server.simulate(device, **usual | more)
    server.advance(device, seconds)


def end_ride(server: SpindleServer, device: str) -> dict[str, Any]:
    """Brakes and rests until the ride ends itself; the ride, once it is done."""
    server.simulate(device, rider={"kind": "off"}, brake=True)
    server.advance(device, REST_S)
    rides = eventually(lambda: rides_of(server, device), all_done)
    return rides[0]


def rides_of(server: SpindleServer, device: str) -> list[dict[str, Any]]:
    """The rides of a connection, newest first."""
    rides = server.get("/rides")["items"]
    return [ride for ride in rides if ride["device"]["device_id"] == device]


def all_done(rides: list[dict[str, Any]]) -> bool:
    """Whether there are rides, and none is still recorded."""
    return bool(rides) and all(ride["state"] == "done" for ride in rides)


def recorded_ride(server: SpindleServer, device: str, seconds: float = 32.0) -> dict[str, Any]:
    """A ride of so long and the rest that ends it."""
    ride_on(server, device, seconds)
    return end_ride(server, device)
