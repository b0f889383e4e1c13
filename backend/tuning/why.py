"""Why the motor gives what it gives: the law's own steps, for a state that somebody asks about.

A steady state is held from rest and then explained; the answer says that it is one. How a moment of
a ride is explained is in `services.rides.why_ride`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any

import numpy as np
import numpy.typing as npt

from backend import law
from backend.core.fuzzy_table import PARAMETERS_OF, stored_json
from backend.device.capability import Capability
from backend.device.unit import Unit
from backend.law import Why, law_defaults
from backend.tuning.preview import changed_config

Config = Mapping[str, Any]
Json = Mapping[str, Any]


class WhySteady:
    """Explains states that nobody rode. Holds nothing; safe from any thread.

    unit_of: the unit behind a device, whose configuration may be read.
    """

    def __init__(self, unit_of: Callable[[str], Unit]) -> None:
        self._unit_of = unit_of

    def __call__(self, state: Json, changes: Json, device_id: str | None = None) -> dict[str, Any]:
        """The answer as in the API.

        state: speed_kmh, torque_rate, rider_torque_nm, cadence_rpm, hold_s; mode, or None for the
        one at start; and other inputs of the law by their names, None where not known. changes: as
        of `changed_config`. device_id: whose configuration is the base; without it the law's
        defaults. Raises InvalidRequest, NotFound, NoAnswer, CapabilityMissing.
        """
        base, source = law_defaults(), "given"
        if device_id is not None:
            unit = self._unit_of(device_id)
            unit.require(Capability.READ_CONFIG, Capability.FUZZY_TABLE)
            base, source = unit.read_config().parameters, "unit"
        config = {**law_defaults(), **changed_config(base, **changes)}
        readings_given = {name: value for name, value in state.items() if value is not None}
        torque_rate, hold_s = readings_given.pop("torque_rate"), readings_given.pop("hold_s")
        readings_given.setdefault("mode", config["assist_mode_at_start"])
        result = law.why_steady(config, readings_given, torque_rate, hold_s)
        moment = {"kind": "steady", "ride_id": None, "t_s": None, "hold_s": hold_s}
        return why_json(result, config, readings_given, moment, source)


def why_json(
    why: Why,
    config: Config,
    readings: Mapping[str, npt.ArrayLike],
    moment: Json,
    config_source: str,
    recorded: Json | None = None,
) -> dict[str, Any]:
    """A control step as in the API: why, with which settings and on which readings.

    readings: the law's inputs, (n,) each or one value, of which the last is the step's.
    """
    last = {name: number(np.atleast_1d(values)[-1]) for name, values in readings.items()}
    mode = int(last.pop("mode") or 0)
    which = tuple(PARAMETERS_OF)[int(config["mode_tables"][mode])]
    return {
        **asdict(why),
        "moment": moment,
        "config_source": config_source,
        "engine": law.ENGINE,
        "mode": mode,
        "mode_name": config["mode_names"][mode],
        "table": stored_json(config, which) if why.law == "fuzzy" else None,
        "speed_kmh": last.get("speed_kmh"),
        "cadence_rpm": last.get("cadence_rpm"),
        "readings": last,
        "settings": settings(config, mode),
        "recorded": recorded,
        "differs": [],
    }


def settings(config: Config, mode: int) -> dict[str, float]:
    """What the steps after the law go by, in a mode; the registry's names where they are its."""
    cutoff = law.cutoff_of(config)
    share = float(config["mode_torque_pct"][mode]) / 100.0
    up = min(config["assist_ramp_up_nm_per_s"], config["mode_ramp_up_nm_per_s"][mode])
    down = min(config["assist_ramp_down_nm_per_s"], config["mode_ramp_down_nm_per_s"][mode])
    return {
        "gear_ratio": config["gear_ratio"],
        "mode_ratio": config["mode_ratios"][mode],
        "pedal_torque_nm_min": config["pedal_torque_nm_min"],
        "cutoff_kmh": cutoff.holds_kmh if cutoff else config["assist_cutoff_kmh"],
        "ramp_up_nm_per_s": up,
        "ramp_down_nm_per_s": down,
        "motor_torque_nm_max": config["motor_torque_nm_max"] * share,
        "battery_current_a_max": config["battery_current_a_max"],
        "battery_voltage_v_min": config["battery_voltage_v_min"],
        "motor_speed_rpm_max": config["motor_speed_rpm_max"],
    }


def number(value: Any) -> float | None:
    """A reading for JSON: None where there is none."""
    plain = float(value)
    return plain if np.isfinite(plain) else None
