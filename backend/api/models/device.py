"""Ports, units, their live values, and the simulation behind a simulated unit."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from backend.core.request_body import RequestBody
from backend.device.capability import Capability
from backend.web.models import Answer

DeviceKind = Literal["simulated", "serial", "socket"]
DeviceState = Literal["connecting", "ready", "read_only", "lost", "closed"]
HealthCode = Literal[
    "disk_full",
    "store_read_only",
    "io_error",
    "queue_full",
    "database_unreachable",
    "database_damaged",
    "rows_lost",
    "rows_missing_machine",
    "rows_missing_line",
    "rows_missing_unit",
    "rides_damaged",
]
RiderKind = Literal["off", "constant", "legs"]
DynoConvention = Literal["physical", "thesis"]
MotorModel = Literal["average", "foc"]


class Alive(Answer):
    status: Literal["ok"]


class RecorderHealth(Answer):
    """Rows of rides since the server started."""

    rows_saved: int = Field(description="Committed in the store.")
    rows_lost: int = Field(description="Given up, because the store refused them too long.")
    rows_waiting: int = Field(description="On the way to the store, or waiting for it.")
    rows_missing: int = Field(
        description="Never came while the bike was ridden: gaps of its rides. None of the others."
    )


class DeviceHealth(Answer):
    id: str
    state: DeviceState
    recorder: RecorderHealth


class HealthReason(Answer):
    code: HealthCode
    message: str
    part: str = Field(description="What it is about: a part of the store, or the id of a unit.")


class Health(Answer):
    status: Literal["ok", "degraded"] = Field(
        description="`degraded` while something that is to be kept cannot be written."
    )
    version: str
    reasons: list[HealthReason] = Field(
        description="Why. With status ok too: `rows_lost` and `rows_missing_*` until the unit's "
        "next ride, the latter with where most of them were lost; "
        "`rides_damaged` until the files are restored or the rides deleted."
    )
    devices: list[DeviceHealth]


class Port(Answer):
    """A place where a unit may be: pass `url` to `POST /devices`."""

    url: str
    description: str
    kind: DeviceKind
    manufacturer: str | None
    usb_serial_number: str | None
    in_use: bool | None = Field(description="null where it cannot be told without opening it.")
    hint: str | None = Field(description="What stands in the way and what to do about it.")
    hint_code: str | None = Field(
        description="A word for the hint: `port_permission` or `port_busy`, as a device's "
        "`reason_code`."
    )


class PortList(Answer):
    items: list[Port]
    next: str | None = None


class DeviceRequest(RequestBody):
    url: str = Field(
        min_length=1,
        max_length=400,
        pattern=r"^[^\x00-\x1f\x7f]+$",
        description="`sim`, `sim:NAME?seed=1`, `/dev/ttyUSB0`, `COM3` or `socket://host:port`.",
    )
    name: str | None = Field(
        default=None,
        min_length=1,
        max_length=60,
        pattern=r"^[^\x00-\x20\x7f]([^\x00-\x1f\x7f]*[^\x00-\x20\x7f])?$",
        description="What you call the unit. A unit without a serial number is known by it, and "
        "nothing is written to it before it has one (409 `name_first`): give the same name each "
        "time. Adding the same url again with another name names it anew.",
    )


class Identity(Answer):
    """Who a unit says it is; null for what it does not tell."""

    serial_number: str | None
    model: str
    hardware_revision: int | None
    firmware_version: str | None
    protocol_version: str | None
    schema_hash: str | None
    reset_cause: str | None = Field(
        default=None,
        description="Why the unit started: `power_on`, `brown_out`, `watchdog`, `fault_handler`, "
        "`deadline` or `software`; null where its firmware cannot tell.",
    )


class ConfigStamp(Answer):
    """Which configuration is active. A provisional one is given up at `expires_at`."""

    generation: int
    crc32: int
    state: Literal["committed", "provisional"]
    expires_at: datetime | None
    remaining_s: float | None = Field(description="Until a provisional one is given up.")
    rollback_cause: Literal["asked", "time_out", "restart", "unknown"] | None = Field(
        description="Why the latest trial was given up; null when none was since the unit's start."
    )


class Device(Answer):
    """A connection and the unit at its other end.

    `reason` says in a sentence why the state is what it is.
    """

    id: str = Field(
        description="Of the connection: made of its url, the same after every start. Where a path "
        "takes it, it takes the unit's serial number and `unit_key` too."
    )
    url: str
    name: str | None = Field(description="What its owner calls the unit, as it was added.")
    unit_key: str | None = Field(
        description="Of the unit, whatever it is connected by: `family:serial`, else "
        "`family:name:NAME`, else `family:url:URL`. null until it said who it is. Its rides and "
        "its revisions have the same."
    )
    bike_id: int | None = Field(
        description="The bike the unit is on, made when it was first seen; null for a unit without "
        "a serial number and without a name."
    )
    kind: DeviceKind
    state: DeviceState
    reason: str
    reason_code: str = Field(description="A word for the reason, for programs and translations.")
    identity: Identity | None
    config: ConfigStamp | None
    link: dict[str, int | float | None] = Field(
        description="Counters of the link since it was added."
    )
    faults_active: list[str]
    last_seen_at: datetime | None = Field(
        description="When the unit was last there over this connection, now if it is; null if none "
        "ever was. Kept over a restart, as are `identity` and `unit_key` of a unit that is away."
    )
    family: str = Field(description="The make of the unit: what `?family=` of its url takes.")
    capabilities: list[Capability] = Field(
        description="What this unit can do. A route that needs another answers 409 "
        "`capability_missing` and names it."
    )


class DeviceList(Answer):
    items: list[Device]
    next: str | None = None


class Snapshot(Answer):
    """One row of every channel; a channel without a value is null."""

    t_us: int
    channels: dict[str, float | None]


class Dashboard(Answer):
    """What the rider sees. Rider power and motor power are two things; missing is null."""

    t_us: int | None
    speed_kmh: float | None
    acceleration_ms2: float | None = Field(description="Over the last second.")
    rider_power_w: float | None = Field(description="The rider's own, over the last second.")
    motor_power_w: float | None = Field(
        description="Mechanical, at the motor's shaft; null from a unit that tells only what it "
        "asks of its motor."
    )
    battery_soc_pct: float | None
    battery_voltage_v: float | None
    distance_km: float = Field(description="Since the unit's start or the last charge.")
    missing_s: float = Field(description="Time since then whose rows never came.")
    range_km: float | None = Field(
        description="At the consumption since then; null until half a kilometre and half a percent."
    )


class Fault(Answer):
    """A fault that is active or was. `frozen` is what the bike did when it came last."""

    name: str
    description: str
    active: bool
    count: int | None = Field(description="How often since the unit's start; null if not known.")
    frozen: Snapshot | None
    severity: Literal["warning", "assist_off", "latched"] = Field(
        description="Tells only; no assist while it lasts; no assist until cleared at standstill."
    )
    mechanic_text: str = Field(description="What a mechanic measures and mends.")


class FaultList(Answer):
    items: list[Fault]
    next: str | None = None


class FaultMoment(Answer):
    """What the bike did from 2 s before a fault to 1 s after it, as it was recorded."""

    fault: str
    unit_t_us: int | None = Field(description="When it came last, on the unit's clock.")
    came_at: datetime | None = Field(description="The same as wall time, where samples tell it.")
    source: Literal["ride", "stream"] | None = Field(description="What had the samples.")
    missing: Literal["no_frame", "not_recorded"] | None = Field(
        description="Why there is no sample: nobody knows when the fault came, or nothing was "
        "recorded then; null where there are some."
    )
    ride_id: int | None
    ride_t_s: float | None = Field(description="The fault's place in the ride.")
    motor_torque_meaning: Literal["delivered", "demanded"] | None
    whole: bool = Field(description="False while samples after the fault are still to come.")
    at_s: list[float] = Field(description="Of each sample; the fault came at 0.")
    rider_torque_nm: list[float | None] = Field(description="At the crank; null: no reading.")
    motor_torque_nm: list[float | None] = Field(
        description="At the crank; null: no reading, or no gear ratio is known."
    )


class ConfigSlot(Answer):
    """One of the two places in the unit's flash its configuration is kept."""

    state: Literal["empty", "confirmed", "provisional", "void", "damaged", "unknown"]
    generation: int
    erases: int = Field(description="In the unit's life; this wears it.")
    active: bool


class WearCounters(Answer):
    """What the unit knows of its own wear. What is not saved yet is lost with its supply."""

    distance_m: int
    operating_s: int
    saved_distance_m: int
    saved_operating_s: int
    config_slots: list[ConfigSlot]
    runs_on_default: bool = Field(description="Neither slot is good: the factory's values apply.")


class Scenario(Answer):
    """A ride that a simulated unit can be sent on."""

    name: str
    description: str


class ScenarioList(Answer):
    items: list[Scenario]
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
    """What is to be broken, until it is told to be sound again."""

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
