"""What the simulated bike does with a fuzzy table: energy, evenness, starts, riding at the limit.

Everything is ridden in virtual time by a unit for the EU as it leaves the factory with the table as
its first, and looked at in every control step; the same call gives the same numbers.
"""

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from backend.core.energy import SECONDS_PER_HOUR
from backend.law import feel
from backend.law.feel import SPORT, STEP_S, Numbers, assisted, seconds_of
from backend.rides.insight.table_use import table_use
from sim_device.preset import load
from sim_device.preset_unit import preset_unit
from sim_device.scenario_file import load as load_scenario

Ride = dict[str, Numbers]
Changes = Mapping[str, Any]
FACTORY: Changes = MappingProxyType({})

RAD_S_PER_RPM = np.pi / 30.0
METRES_PER_KM = 1000.0
LOOKED_AT = (
    "t_s",
    "distance_m",
    "speed_kmh",
    "cadence_rpm",
    "battery_voltage_v",
    "battery_current_a",
    "motor_demand_nm",
    "motor_torque_nm",
    "motor_speed_rpm",
    "torque_rate",
    "fuzzy_gain",
)


def ridden(table: str, scenario: str, changes: Changes = FACTORY) -> Ride:
    """One round of the scenario with this table preset: what is seen, (n,) each.

    changes: parameters that differ from those of the factory.
    """
    road = load_scenario(scenario)
    unit = preset_unit(table, road.seed, dict(changes), name=scenario)
    unit.simulation_set({"scenario": scenario})
    return _columns(unit.ride_once(STEP_S))


def _columns(rows: Iterable[dict[str, Any]]) -> Ride:
    seen = np.array([[row[name] for name in LOOKED_AT] for row in rows])
    return dict(zip(LOOKED_AT, seen.T, strict=True))


def wh_per_km(ride: Ride) -> tuple[float, float]:
    """What the battery gave, electronics included, and what the motor's shaft gave."""
    km = ride["distance_m"][-1] / METRES_PER_KM
    battery_w = ride["battery_voltage_v"] * ride["battery_current_a"]
    shaft_w = ride["motor_torque_nm"] * ride["motor_speed_rpm"] * RAD_S_PER_RPM
    seconds = seconds_of(ride)
    battery_ws, shaft_ws = float(battery_w @ seconds), float(shaft_w @ seconds)
    return float(battery_ws / SECONDS_PER_HOUR / km), float(shaft_ws / SECONDS_PER_HOUR / km)


def mean_kmh(ride: Ride) -> float:
    """Over the whole way, stops included."""
    return float(3.6 * ride["distance_m"][-1] / (ride["t_s"][-1] - ride["t_s"][0]))


def ripple_pct(ride: Ride) -> float:
    """As of `feel`, for a ride on which the motor helped."""
    found_pct = feel.ripple_pct(ride)
    assert found_pct is not None
    return found_pct


def column_shares(ride: Ride, table: str) -> Numbers:
    """Share of the assisted time in which the rules of each torque-rate column acted (5,), each
    moment weighted by how much they had to say, as on the page of a ride."""
    values = load(table).values
    when = assisted(ride)
    cells_s = table_use(
        {name: ride[name][when] for name in ("speed_kmh", "torque_rate")},
        seconds_of(ride)[when],
        values["fuzzy_speed_points_kmh"],
        values["fuzzy_torque_rate_points"],
    ).seconds
    return cells_s.sum(axis=0) / cells_s.sum()


def mean_gain(ride: Ride) -> float:
    """The gain over the assisted time."""
    when = assisted(ride)
    return float(np.average(ride["fuzzy_gain"][when], weights=seconds_of(ride)[when]))


def start_s(table: str, rider: str, changes: Changes = FACTORY) -> float:
    """From rest on the level to 15 km/h: the bike, mass and push of the scenario `start`.

    rider: `constant` is a servo, `legs` push in two strokes a turn. changes: as for `ridden`.
    """
    unit = preset_unit(table, feel.START_SEED, dict(changes), bike={"road.mass_kg": feel.START_KG})
    unit.select_mode(SPORT)
    taken_s = feel.start_s(feel.started(unit, rider))
    assert taken_s is not None, f"{table}: {rider} did not reach {feel.START_KMH} km/h in time"
    return taken_s


def switched_hz(table: str, hard_cut: bool = False) -> float:
    """How often a second the motor goes on or off under legs that hold 25 km/h.

    hard_cut: on the unit of the thesis's configuration, without a band below the limit.
    """
    made_as, changes = ("thesis", load(table).values) if hard_cut else (table, {})
    unit = preset_unit(made_as, feel.LIMIT_SEED, changes)
    unit.select_mode(SPORT)
    return feel.switched_hz(unit)
