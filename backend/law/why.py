"""Why a control step gave what it gave: the pipeline's steps in the unit's order, by its own C."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.core.described import described
from backend.core.energy import RADIANS_PER_S_PER_RPM
from backend.core.fuzzy_table import LABELS, Label
from backend.errors import InvalidRequest
from backend.law.ride_replay import law_readings
from sim_device.firmware.python import law

WALK_ASSIST = "walk_assist"
CURRENT_CONTROL = "current_control"
INPUT_REFUSED = "input_refused"
SHAPED_BY = {"fuzzy": "gain", "fixed": "taper", "off": "mode_off"}

# Step of the trace -> its name, and the limit it is when it takes something. What a mode's law does
# at `shaped` depends on the law; the ramps and the battery have two limits each.
STEP_OF: Mapping[str, tuple[str, str | None]] = {
    "rider": ("rider_torque", None),
    "ratio": ("mode_ratio", None),
    "shaped": ("", None),
    "threshold": ("pedal_threshold", None),
    "fresh": ("stale_torque", "fault"),
    "band": ("cutoff_band", "speed_cutoff"),
    "ramps": ("ramps", None),
    "pedal_stop": ("pedal_stop", "pedal_stop"),
    "brake": ("brake", "brake"),
    "speed": ("speed_cutoff", "speed_cutoff"),
    "voltage": ("battery_voltage", "battery_voltage"),
    "inhibit": ("fault", "fault"),
    "motor": ("motor_torque", "motor_torque"),
    "heat": ("temperature", "temperature"),
    "battery": ("battery_current", "battery_current"),
    "back_emf": ("back_emf", "motor_speed"),
    "market": ("market", "market"),
}
OF_THE_LAW = ("rider", "ratio", "shaped", "threshold", "fresh")


@described
class FiredRule:
    """Its cell, `[row][column]` of the table's rules, and how much it had to say."""

    row: int
    column: int
    label: Label
    weight: float
    """Above 0, to 1: the lesser of the two memberships under `mamdani_centroid`, their product
    under `weighted_average`."""


@described
class WhyStep:
    """What one step of the pipeline added to the torque at the crank, or took from it."""

    name: str
    torque_nm: float
    power_w: float | None
    """At the crank's speed; null where it is not known."""
    limit: str | None
    """The limit it is, where it took or gave something."""


@dataclass(frozen=True, slots=True)
class Why:
    """One control step explained; None is missing. Torques are at the crank.

    The torques of the steps add up to `commanded_nm`; with the last, `current_control`, to
    `delivered_nm`. available_nm: what motor, heat, battery and back-EMF allow. law: the mode's, or
    `walk`. result: `ok`, or `input_refused`, or `result_lost`, where the only step is that.
    """

    result: str
    law: str
    rules: tuple[FiredRule, ...]
    gain: float | None
    assist_ratio: float | None
    torque_rate: float | None
    rider_torque_nm: float | None
    crank_rad_per_s: float | None
    steps: tuple[WhyStep, ...]
    commanded_nm: float
    available_nm: float | None
    delivered_nm: float | None
    limit_flags: tuple[str, ...]


def why(
    config: Mapping[str, Any],
    readings: Mapping[str, npt.ArrayLike],
    *,
    step_s: float = law.STEP_S,
    delivered_nm: float | None = None,
) -> Why:
    """The last of these steps, after all before it from rest. n > 0 steps.

    config: the unit's parameters by registry name. readings: the law's inputs as of
    `law.replay`, (n,) each or one value. delivered_nm: what the motor gave at its shaft in the
    last, where that was measured. Raises InvalidRequest for what the law refuses.
    """
    try:
        one, rows = _prepared(config, readings, step_s)
        one.run(rows[:-1])
        return _why_of(config, one.trace(rows[-1:]), rows[-1], delivered_nm)
    except (law.LawRefused, KeyError, TypeError, ValueError) as refused:
        raise InvalidRequest(f"why: {refused}", "why_refused") from refused


def why_steady(
    config: Mapping[str, Any],
    readings: Mapping[str, float],
    torque_rate: float,
    hold_s: float,
    step_s: float = law.STEP_S,
) -> Why:
    """A state that was held for so long from rest, its torque rising all the while at a rate.

    readings: as of `why`, one value each. torque_rate: above -1; what the table is asked. Nothing
    was measured, so nothing is delivered. Raises InvalidRequest for what the law refuses.
    """
    try:
        one, rows = _prepared(config, readings, step_s)
        # A walk button counts from its press on.
        released = rows[-1:].copy()
        released["walk_button"] = 0
        one.run(released)
        one.hold(rows[-1:], torque_rate, round(hold_s / step_s))
        return _why_of(config, one.trace(rows[-1:]), rows[-1], None)
    except (law.LawRefused, KeyError, TypeError, ValueError) as refused:
        raise InvalidRequest(f"why: {refused}", "why_refused") from refused


def _prepared(
    config: Mapping[str, Any], readings: Mapping[str, npt.ArrayLike], step_s: float
) -> tuple[law.AssistLaw, npt.NDArray[np.void]]:
    rows = law.pack_inputs(law_readings(config, readings))
    return law.AssistLaw(config, step_s), np.ascontiguousarray(rows)


def _why_of(
    config: Mapping[str, Any], traced: law.Traced, row: np.void, delivered_nm: float | None
) -> Why:
    output = traced.output
    gear = float(config["gear_ratio"])
    crank_rpm = float(row["motor_speed_rpm"]) / gear if traced.walk else float(row["cadence_rpm"])
    rad_per_s = _finite_or_none(max(crank_rpm, 0.0) * RADIANS_PER_S_PER_RPM)
    law_name = "walk" if traced.walk else _mode_law(config, int(row["mode"]))
    flags = tuple(name for name, bit in law.LIMITS.items() if int(output["limit_flags"]) & bit)
    changes = _changes(traced, law_name, flags)
    commanded_nm = sum(change for _, change, _ in changes)
    delivered_crank_nm = None if delivered_nm is None else delivered_nm * gear
    if delivered_crank_nm is not None:
        changes.append((CURRENT_CONTROL, delivered_crank_nm - commanded_nm, None))
    ok = traced.result == "ok"
    return Why(
        result=traced.result,
        law=law_name,
        rules=tuple(
            FiredRule(rule.row, rule.column, LABELS[rule.label], rule.weight)
            for rule in traced.rules
        ),
        gain=_finite_or_none(output["fuzzy_gain"]) if ok else None,
        assist_ratio=output["assist_ratio"] if ok and not traced.walk else None,
        torque_rate=output["torque_rate"] if ok else None,
        rider_torque_nm=output["rider_torque_filtered_nm"] if ok else None,
        crank_rad_per_s=rad_per_s,
        steps=tuple(
            WhyStep(name, change, None if rad_per_s is None else change * rad_per_s, limit)
            for name, change, limit in changes
        ),
        commanded_nm=commanded_nm,
        available_nm=_finite_or_none(output["motor_torque_available_nm"] * gear),
        delivered_nm=delivered_crank_nm,
        limit_flags=flags,
    )


def _changes(
    traced: law.Traced, law_name: str, flags: tuple[str, ...]
) -> list[tuple[str, float, str | None]]:
    """Each step's name, what it added or took at the crank, and which limit it is."""
    if traced.result != "ok":
        return [(traced.result, 0.0, INPUT_REFUSED if INPUT_REFUSED in flags else "fault")]
    changes: list[tuple[str, float, str | None]] = []
    before_nm = 0.0
    for step, left_nm in traced.left_nm.items():
        name, limit = STEP_OF[step]
        if traced.walk and step in OF_THE_LAW:
            # All five are what walk assist asks for; it is reported once.
            if step == OF_THE_LAW[-1]:
                changes.append((WALK_ASSIST, left_nm, None))
                before_nm = left_nm
            continue
        if step == "shaped":
            name = SHAPED_BY[law_name]
            limit = None if name == "gain" else name
        change_nm = left_nm - before_nm
        if step == "ramps":
            limit = "ramp_up" if change_nm < 0.0 else "ramp_down"
        if step == "battery" and "battery_voltage" in flags:
            limit = "battery_voltage"
        changes.append((name, change_nm, limit if change_nm != 0.0 else None))
        before_nm = left_nm
    return changes


def _mode_law(config: Mapping[str, Any], mode: int) -> str:
    """The law of a slot. A slot nobody has is off."""
    laws = config["mode_laws"]
    return str(laws[mode]) if mode < len(laws) else "off"


def _finite_or_none(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None
