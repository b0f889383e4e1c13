"""Units: find, open, look at, close."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Path, Response, status

from backend.api.meant import FOR_ONE_UNIT
from backend.api.models.device import (
    Dashboard,
    Device,
    DeviceList,
    DeviceRequest,
    FaultList,
    FaultMoment,
    PortList,
    ScenarioList,
    Simulation,
    SimulationAdvance,
    SimulationChange,
    Snapshot,
    WearCounters,
)
from backend.api.models.ride import RideMark
from backend.api.services import Provided
from backend.services.units.asked_url import check_asked
from backend.services.units.simulate import advance, scenarios
from backend.web.problem import DAMAGED, refusals

router = APIRouter(tags=["devices"], responses=refusals(404, 409, 503, 504))
MEANT: Any = {"dependencies": FOR_ONE_UNIT, "responses": refusals(412)}


@router.get("/ports", operation_id="list_ports", response_model=PortList)
def list_ports(services: Provided) -> dict[str, Any]:
    """Serial ports of this machine, and the simulated unit."""
    return {"items": services.devices.ports()}


@router.get("/devices", operation_id="list_devices", response_model=DeviceList)
async def list_devices(services: Provided) -> dict[str, Any]:
    """Every unit that was added and not removed, whatever its state."""
    return {"items": services.devices.list()}


@router.post(
    "/devices",
    operation_id="add_device",
    response_model=Device,
    status_code=status.HTTP_201_CREATED,
)
def add_device(body: DeviceRequest, services: Provided, response: Response) -> Any:
    """Opens a unit; it connects, and reconnects, in the background.

    The same url again is the same device, and may give its unit a name.
    """
    check_asked(body.url)
    device = services.devices.add(body.url, name=body.name)
    response.headers["location"] = f"/api/v1/devices/{device.id}"
    return device


@router.get("/devices/{device_id}", operation_id="get_device", response_model=Device)
async def get_device(device_id: str, services: Provided) -> Any:
    """One unit: who it is, how its link is, and why."""
    return services.devices.get(device_id)


@router.delete(
    "/devices/{device_id}", operation_id="remove_device", status_code=status.HTTP_204_NO_CONTENT
)
def remove_device(device_id: str, services: Provided) -> None:
    """Lets a unit go; a simulated one ends. Its rides and revisions stay."""
    services.devices.remove(device_id)


@router.get("/devices/{device_id}/snapshot", operation_id="get_snapshot", response_model=Snapshot)
def get_snapshot(device_id: str, services: Provided) -> Any:
    """The newest value of every channel, asked of the unit."""
    return services.inspection.snapshot(device_id)


@router.get("/devices/{device_id}/service", operation_id="get_service", response_model=WearCounters)
def get_service(device_id: str, services: Provided) -> Any:
    """How far and how long the unit ran, and how worn the flash of its configuration is."""
    return services.inspection.wear_counters(device_id)


@router.get(
    "/devices/{device_id}/dashboard", operation_id="get_dashboard", response_model=Dashboard
)
def get_dashboard(device_id: str, services: Provided) -> Any:
    """Speed, acceleration, powers, battery, distance and range, from the rows of the stream."""
    return services.dashboards.get(services.devices.get(device_id).id)


@router.get("/devices/{device_id}/faults", operation_id="list_faults", response_model=FaultList)
def list_faults(device_id: str, services: Provided) -> Any:
    """The faults that are active in the unit or were, and what the bike did when they came."""
    return {"items": services.inspection.faults(device_id)}


@router.get(
    "/devices/{device_id}/faults/{fault_name}/moment",
    operation_id="moment_of_fault",
    response_model=FaultMoment,
    responses=DAMAGED,
)
def moment_of_fault(
    device_id: str, fault_name: Annotated[str, Path(max_length=80)], services: Provided
) -> Any:
    """The rider's and the motor's torque around a fault, from the ride it came on, else from the
    last minutes of the stream."""
    return services.fault_moments(device_id, fault_name)


@router.post(
    "/devices/{device_id}/faults/clear",
    operation_id="clear_faults",
    response_model=FaultList,
    **MEANT,
)
def clear_faults(device_id: str, services: Provided) -> Any:
    """Ends latched faults whose cause has been gone for a second, if the bike stands still, and
    forgets those that are over. Lists what is left: whatever still has its cause, and all that is
    active while the bike moves."""
    return {"items": services.inspection.clear_faults(device_id)}


@router.post(
    "/devices/{device_id}/marks",
    operation_id="mark_moment",
    response_model=RideMark,
    **MEANT,
    status_code=status.HTTP_201_CREATED,
)
def mark_moment(device_id: str, services: Provided) -> Any:
    """Marks the newest moment of the ride that is being recorded; it is among the ride's events."""
    return services.mark(device_id)


@router.get("/scenarios", operation_id="list_scenarios", response_model=ScenarioList)
def list_scenarios() -> dict[str, Any]:
    """The scenarios that a simulated unit can ride."""
    return {"items": scenarios()}


@router.get(
    "/devices/{device_id}/simulation", operation_id="get_simulation", response_model=Simulation
)
def get_simulation(device_id: str, services: Provided) -> Any:
    """Rider, road and clock of a simulated unit; 409 for a real one."""
    return services.inspection.simulation(device_id)


@router.put(
    "/devices/{device_id}/simulation",
    operation_id="put_simulation",
    response_model=Simulation,
    **MEANT,
)
def put_simulation(device_id: str, body: SimulationChange, services: Provided) -> Any:
    """Changes what the body names and leaves the rest."""
    return services.inspection.simulate(device_id, body.model_dump(exclude_unset=True))


@router.post(
    "/devices/{device_id}/simulation/advance",
    operation_id="advance_simulation",
    response_model=Simulation,
    **MEANT,
)
def advance_simulation(device_id: str, body: SimulationAdvance, services: Provided) -> Any:
    """Lets time pass for a unit with a virtual clock, as fast as it can; 409 for any other."""
    return advance(services.inspection, device_id, body.seconds)
