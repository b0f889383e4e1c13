"""What can be checked of a unit without touching it: what was found, what is allowed, and whether
it passed. One that could not be done is neither passed nor failed, and says why."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from backend.core._generated import RESTING_KMH, RESTING_MOTOR_RPM
from backend.core.described import described
from backend.device.readings import WearCounters

# From here on the unit itself counts a fault or lowers the assist.
ZERO_NM_MAX = 3.0
ROTOR_MS_MAX = 250.0
MOTOR_DEGC_MAX = 110.0
CONTROLLER_DEGC_MAX = 85.0
TORQUE_FAULTS = ("torque_sensor", "torque_stuck", "torque_drift", "foot_at_start", "torque_link")
BATTERY_FAULTS = ("battery_low", "battery_cut", "under_voltage")

CheckName = Literal["zero", "drift", "rotor", "battery", "motor", "controller", "flash", "line"]
NotDone = Literal["no_reading", "not_sent", "moving", "no_ride_shows_it", "not_known"]


@described
class UnitCheck:
    """One check. Numbers are in `unit`; what is null is not known or does not apply."""

    name: CheckName
    passed: bool | None
    """Null: not done; `not_done` says why."""
    value: float | None = None
    unit: str | None = None
    limit: float | None = None
    """It passes up to here; a battery's voltage from here on."""
    not_done: NotDone | None = None
    fault: str | None = None
    """What the unit itself calls faulty: then it has failed, whatever it reads."""
    evidence: dict[str, Any] | None = None
    """What else was seen: of `drift` the ride, how many show the zero, the trend a month and the
    level; of `flash` its erases and places; of `line` frames built and lost."""


@dataclass(frozen=True)
class Readings:
    """What a unit says of itself now, and what its rides show. None is what it does not say.

    channels: one row; what is not in it the unit never sends. link: counters of the connection.
    drift: as `SensorDrift`. battery_v_min: least voltage by its configuration.
    """

    channels: Mapping[str, float | None]
    faults_active: tuple[str, ...]
    wear: WearCounters | None
    link: Mapping[str, int | float | None]
    drift: Mapping[str, Any] | None
    battery_v_min: float | None


def checks_of(readings: Readings) -> tuple[UnitCheck, ...]:
    """Every check, in the order of the sheet."""
    return (
        zero(readings),
        drift(readings.drift),
        up_to(readings, "rotor", "torque_age_ms", "ms", ROTOR_MS_MAX, ("torque_link",)),
        battery(readings),
        up_to(readings, "motor", "motor_temperature_degc", "degC", MOTOR_DEGC_MAX),
        up_to(readings, "controller", "controller_temperature_degc", "degC", CONTROLLER_DEGC_MAX),
        flash(readings.wear),
        line(readings.link),
    )


def up_to(
    readings: Readings,
    name: CheckName,
    channel: str,
    unit: str,
    limit: float,
    faults: tuple[str, ...] = (),
) -> UnitCheck:
    """A reading that passes up to a limit, on either side of zero."""
    value = readings.channels.get(channel)
    fault = next((one for one in faults if one in readings.faults_active), None)
    if fault is not None:
        return UnitCheck(name, False, value, unit, limit, fault=fault)
    if value is None:
        return UnitCheck(name, None, None, unit, limit, missing(readings, channel))
    return UnitCheck(name, abs(value) <= limit, value, unit, limit)


def missing(readings: Readings, channel: str) -> NotDone:
    """Why a channel has no value: the unit has none now, or never sends it."""
    return "no_reading" if channel in readings.channels else "not_sent"


def zero(readings: Readings) -> UnitCheck:
    """Torque without a foot on the pedals; on the move nobody knows that."""
    check = up_to(readings, "zero", "rider_torque_nm", "Nm", ZERO_NM_MAX, TORQUE_FAULTS)
    speeds = (("speed_kmh", RESTING_KMH), ("motor_speed_rpm", RESTING_MOTOR_RPM))
    moves = any(abs(readings.channels.get(name) or 0.0) >= least for name, least in speeds)
    if moves and check.fault is None:
        return UnitCheck("zero", None, check.value, "Nm", ZERO_NM_MAX, "moving")
    return check


def drift(found: Mapping[str, Any] | None) -> UnitCheck:
    """What the rides show of the zero, while coasting."""
    if found is None:
        return UnitCheck("drift", None, not_done="not_known")
    limit, latest, level = found["act_nm"], found["latest"], found["level"]
    if latest is None or level is None:
        return UnitCheck("drift", None, None, "Nm", limit, "no_ride_shows_it")
    trend = found["trend"]
    evidence = {
        "ride_id": latest["ride_id"],
        "started_at": latest["started_at"],
        "rides": sum(ride["zero_nm"] is not None for ride in found["rides"]),
        "per_month_nm": None if trend is None else trend["per_month_nm"]["value"],
        "level": level,
    }
    return UnitCheck("drift", level != "act", latest["zero_nm"], "Nm", limit, evidence=evidence)


def battery(readings: Readings) -> UnitCheck:
    """The battery's voltage against the least that its configuration allows."""
    limit, value = readings.battery_v_min, readings.channels.get("battery_voltage_v")
    fault = next((one for one in BATTERY_FAULTS if one in readings.faults_active), None)
    if fault is not None:
        return UnitCheck("battery", False, value, "V", limit, fault=fault)
    if value is None:
        return UnitCheck("battery", None, None, "V", limit, missing(readings, "battery_voltage_v"))
    if limit is None:
        return UnitCheck("battery", None, value, "V", None, "not_known")
    return UnitCheck("battery", value >= limit, value, "V", limit)


def flash(wear: WearCounters | None) -> UnitCheck:
    """The two places in which the unit keeps its configuration."""
    if wear is None:
        return UnitCheck("flash", None, not_done="not_sent")
    damaged = any(slot.state == "damaged" for slot in wear.config_slots)
    evidence = {
        "erases": sum(slot.erases for slot in wear.config_slots),
        "damaged": damaged,
        "runs_on_default": wear.runs_on_default,
    }
    return UnitCheck("flash", not damaged and not wear.runs_on_default, evidence=evidence)


def line(link: Mapping[str, int | float | None]) -> UnitCheck:
    """Frames of the live stream: built = received + lost on the link + dropped by the unit."""
    built = link.get("balance_built") or 0
    if not built:
        return UnitCheck("line", None, not_done="not_sent")
    lost = (link.get("balance_lost") or 0) + (link.get("balance_dropped") or 0)
    return UnitCheck("line", lost == 0, evidence={"built": built, "lost": lost})
