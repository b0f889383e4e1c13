"""The simulation behind a simulated unit: what may be read and changed, and time that passes."""

from __future__ import annotations

import time
from contextlib import suppress
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from backend.core.api_models import Answer, RequestBody
from backend.core.described import described
from backend.errors import Conflict, NoAnswer
from backend.law.presets import live_scenarios
from backend.units.inspection import Inspection

RiderKind = Literal["off", "constant", "legs"]
DynoConvention = Literal["physical", "thesis"]
MotorModel = Literal["average", "foc"]
POLL_S = 0.01
# A unit that has not lived through a tenth of a second in this long never will.
STUCK_S = 15.0


@described
class Scenario:
    """A ride that a simulated unit can be sent on: `scenario` of its simulation takes the name."""

    name: str
    description: str


@described
class ScenarioList:
    items: tuple[Scenario, ...]
    next: str | None = None


class SimulationRider(Answer):
    kind: RiderKind
    torque_nm: float
    cadence_rpm_max: float


class SimulationRoad(Answer):
    grade_deg: float
    wind_ms: float


class SimulationRotorLink(Answer):
    """Words of the link between spindle and housing, as the unit's receiver counted them."""

    words_good: int
    words_bad: int
    words_lost: int


class SimulationWorkbench(Answer):
    """A bike whose wheel is held, with a mass on a pedal. What hangs in truth is within the limits
    of what is said here."""

    side: Literal["left", "right"]
    mass_kg: float
    crank_angle_deg: float = Field(
        description="0 is the crank level and forward, positive the pedal going down."
    )
    arm_m: float
    mass_limit_share: float
    arm_limit_m: float
    angle_limit_deg: float


class Simulation(BaseModel):
    """What rider, road and clock of a simulated unit do now. A unit may tell more than this."""

    model_config = ConfigDict(from_attributes=True, extra="allow")

    scenario: str | None
    running: bool
    speed_factor: float
    clock: Literal["real", "virtual"]
    advance_left_s: float
    t_s: float
    seed: int
    rider: SimulationRider
    road: SimulationRoad
    load_source: Literal["road", "dyno"]
    dyno_nm: float = Field(description="At the roller, on the bench only.")
    dyno_convention: DynoConvention
    motor_model: MotorModel
    mass_kg: float
    assist_mode: int
    brake: bool
    walk_button: bool
    ambient_degc: float
    grip: float
    faults: dict[str, bool | float | str] = Field(description="What is broken; empty: nothing.")
    workbench: SimulationWorkbench | None = Field(
        default=None, description="Null while the bike is on the road; nobody rides it here."
    )
    rotor_link: SimulationRotorLink
    energy_balance_error_pct: float | None = Field(
        description="By how much the energy books fail to close; null before any work was done."
    )
    energy_consistent: bool
    label: str | None = Field(
        description="`not energy consistent` where a printed equation makes energy, else null."
    )


class SimulationRiderChange(RequestBody):
    kind: RiderKind | None = None
    torque_nm: float | None = None
    cadence_rpm_max: float | None = None


class SimulationRoadChange(RequestBody):
    grade_deg: float | None = None
    wind_ms: float | None = None


class SimulationFaults(RequestBody):
    """Simulated faults; they persist until cleared."""

    torque_sensor: Literal["sound", "stuck", "open_high", "open_low", "drifting"] | None = None
    speed_sensor: Literal["sound", "lost", "stuck"] | None = None
    link_lost: bool | None = None
    motor_hall: bool | None = None
    battery_cut: bool | None = None
    motor_warmer_k: float | None = None
    controller_warmer_k: float | None = None
    pulses_missed: float | None = None
    bit_error_rate: float | None = None
    burst_share: float | None = None
    coupling: float | None = None


class SimulationWorkbenchChange(RequestBody):
    side: Literal["left", "right"] | None = None
    mass_kg: float | None = None
    crank_angle_deg: float | None = None
    arm_m: float | None = None
    mass_limit_share: float | None = None
    arm_limit_m: float | None = None
    angle_limit_deg: float | None = None


class SimulationAdvance(RequestBody):
    """Time that shall pass for a unit with a virtual clock; a day at most."""

    seconds: float = Field(gt=0.0, le=86_400.0)


class SimulationChange(RequestBody):
    """Any subset; what is absent stays. A `scenario` starts from its beginning, null ends it.

    The simulator itself refuses what it cannot simulate, and names it.
    """

    scenario: str | None = Field(default=None, max_length=80)
    running: bool | None = None
    speed_factor: float | None = None
    clock: Literal["real", "virtual"] | None = None
    seed: int | None = None
    rider: SimulationRiderChange | None = None
    road: SimulationRoadChange | None = None
    load_source: Literal["road", "dyno"] | None = None
    dyno_nm: float | None = None
    dyno_convention: DynoConvention | None = Field(
        default=None, description="How its torque reaches the cranks: by energy, or as printed."
    )
    motor_model: MotorModel | None = Field(
        default=None, description="Average, or phase currents under field-oriented control."
    )
    mass_kg: float | None = None
    assist_mode: int | None = None
    brake: bool | None = None
    walk_button: bool | None = None
    ambient_degc: float | None = None
    grip: float | None = Field(default=None, description="Of the rear tyre; 0: it never slips.")
    faults: SimulationFaults | None = None
    workbench: SimulationWorkbenchChange | None = Field(
        default=None,
        description="What is hung on a pedal swings at first; null takes the bike off.",
    )


def scenarios() -> tuple[Scenario, ...]:
    """Every scenario that can be ridden."""
    return tuple(Scenario(name, doc) for name, doc in live_scenarios())


def advance(inspection: Inspection, device_id: str, seconds: float) -> dict[str, Any]:
    """Let `seconds` pass and return what rider, road and clock do then.

    Every row the unit built in that time has arrived by then, but for the two or three that wait
    for their frame to be full. Raises Conflict for a real unit and for a clock that runs by itself,
    NoAnswer when time does not pass.
    """
    state = inspection.simulation(device_id)
    if state.get("clock") != "virtual":
        raise Conflict(
            f"The clock of {device_id} runs by itself; set `clock` of its simulation to "
            "`virtual`, or add the unit as `sim:NAME?clock=virtual`."
        )
    state = inspection.simulate(device_id, {"advance_s": seconds})
    last_left_s, last_s = state["advance_left_s"], time.monotonic()
    while state["advance_left_s"] > 0:
        time.sleep(POLL_S)
        # A unit that computes on a busy machine may answer late; STUCK_S ends the waiting.
        with suppress(NoAnswer):
            state = inspection.simulation(device_id)
        now_s = time.monotonic()
        if state["advance_left_s"] != last_left_s:
            last_left_s, last_s = state["advance_left_s"], now_s
        elif now_s - last_s > STUCK_S:
            raise NoAnswer(
                f"{device_id}: {last_left_s:g} s of {seconds:g} s are still to pass, and none has "
                f"for {STUCK_S:g} s. Look whether its process and its line are alive."
            )
    return state
