"""A ride that a simulated unit made under its own table, and that recorded itself."""

from __future__ import annotations

from typing import Any

from tests.fakes.server import SpindleServer, eventually

LEGS: dict[str, Any] = {"kind": "legs", "torque_nm": 20.0, "cadence_rpm_max": 90.0}
FUZZY_MODE = 3


def ride_off(server: SpindleServer, device: str) -> None:
    """Somebody pushes steadily in the mode that the first table rules."""
    server.simulate(device, brake=False, assist_mode=FUZZY_MODE, rider=LEGS)


def record_ride(server: SpindleServer, device: str) -> int:
    """The id of a ride of half a minute of the unit's time, once it is over."""
    ride_off(server, device)
    eventually(
        lambda: server.get("/rides")["items"],
        lambda rides: rides and rides[0]["row_count"] > 3000,
    )
    server.stand_still(device)
    rides = eventually(
        lambda: server.get("/rides")["items"], lambda rides: rides[0]["state"] == "done"
    )
    return int(rides[0]["id"])
