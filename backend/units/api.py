"""Units: find, open, look at, close."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Response, status

from backend.device.readings import Snapshot, WearCounters
from backend.units.addresses import check_url
from backend.units.dashboard import Dashboard, Dashboards
from backend.units.inspection import Inspection
from backend.units.precondition import FOR_ONE_UNIT
from backend.units.service import Devices
from backend.units.simulation import (
    ScenarioList,
    Simulation,
    SimulationAdvance,
    SimulationChange,
    advance,
    scenarios,
)
from backend.units.types import Device, DeviceList, DeviceRequest, FaultList, PortList
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(tags=["devices"], responses=refusals(404, 409, 503, 504))
AllDevices = Annotated[Devices, provided("devices")]
Inspect = Annotated[Inspection, provided("inspection")]
MEANT: Any = {"dependencies": FOR_ONE_UNIT, "responses": refusals(412)}


@router.get("/ports", operation_id="list_ports")
def list_ports(devices: AllDevices) -> PortList:
    """Serial ports of this machine, and the simulated unit."""
    return PortList(tuple(devices.ports()))


@router.get("/devices", operation_id="list_devices")
async def list_devices(devices: AllDevices) -> DeviceList:
    """Every unit that was added and not removed, whatever its state."""
    return DeviceList(tuple(devices.list()))


@router.post(
    "/devices",
    operation_id="add_device",
    status_code=status.HTTP_201_CREATED,
)
def add_device(body: DeviceRequest, devices: AllDevices, response: Response) -> Device:
    """Opens a unit; it connects, and reconnects, in the background.

    The same url again is the same device, and may give its unit a name.
    """
    check_url(body.url)
    device = devices.add(body.url, name=body.name, audited=True)
    response.headers["location"] = f"/api/v1/devices/{device.id}"
    return device


@router.get("/devices/{device_id}", operation_id="get_device")
async def get_device(device_id: str, devices: AllDevices) -> Device:
    """One unit: who it is, how its link is, and why."""
    return devices.get(device_id)


@router.delete(
    "/devices/{device_id}", operation_id="remove_device", status_code=status.HTTP_204_NO_CONTENT
)
def remove_device(device_id: str, devices: AllDevices) -> None:
    """Lets a unit go; a simulated one ends. Its rides and revisions stay."""
    devices.remove(device_id)


@router.get("/devices/{device_id}/snapshot", operation_id="get_snapshot")
def get_snapshot(device_id: str, inspection: Inspect) -> Snapshot:
    """The newest value of every channel, asked of the unit."""
    return inspection.snapshot(device_id)


@router.get("/devices/{device_id}/service", operation_id="get_service")
def get_service(device_id: str, inspection: Inspect) -> WearCounters:
    """How far and how long the unit ran, and how worn the flash of its configuration is."""
    return inspection.wear_counters(device_id)


@router.get("/devices/{device_id}/dashboard", operation_id="get_dashboard")
def get_dashboard(
    device_id: str, devices: AllDevices, dashboards: Annotated[Dashboards, provided("dashboards")]
) -> Dashboard:
    """Speed, acceleration, powers, battery, distance and range, from the rows of the stream."""
    return dashboards.get(devices.get(device_id).id)


@router.get("/devices/{device_id}/faults", operation_id="list_faults")
def list_faults(device_id: str, inspection: Inspect) -> FaultList:
    """The faults that are active in the unit or were, and what the bike did when they came."""
    return FaultList(tuple(inspection.faults(device_id)))


@router.post(
    "/devices/{device_id}/faults/clear",
    operation_id="clear_faults",
    **MEANT,
)
def clear_faults(device_id: str, inspection: Inspect) -> FaultList:
    """Ends latched faults whose cause has been gone for a second, if the bike stands still, and
    forgets those that are over. Lists what is left: whatever still has its cause, and all that is
    active while the bike moves."""
    return FaultList(tuple(inspection.clear_faults(device_id)))


@router.get("/scenarios", operation_id="list_scenarios")
def list_scenarios() -> ScenarioList:
    """The scenarios that a simulated unit can ride."""
    return ScenarioList(scenarios())


@router.get(
    "/devices/{device_id}/simulation", operation_id="get_simulation", response_model=Simulation
)
def get_simulation(device_id: str, inspection: Inspect) -> Any:
    """Rider, road and clock of a simulated unit; 409 for a real one."""
    return inspection.simulation(device_id)


@router.put(
    "/devices/{device_id}/simulation",
    operation_id="put_simulation",
    response_model=Simulation,
    **MEANT,
)
def put_simulation(device_id: str, body: SimulationChange, inspection: Inspect) -> Any:
    """Changes what the body names and leaves the rest."""
    return inspection.simulate(device_id, body.model_dump(exclude_unset=True))


@router.post(
    "/devices/{device_id}/simulation/advance",
    operation_id="advance_simulation",
    response_model=Simulation,
    **MEANT,
)
def advance_simulation(device_id: str, body: SimulationAdvance, inspection: Inspect) -> Any:
    """Lets time pass for a unit with a virtual clock, as fast as it can; 409 for any other."""
    return advance(inspection, device_id, body.seconds)
