"""What the simulated bike does with a fuzzy table: energy, evenness, starts, riding at the limit.

Everything is ridden in virtual time by a unit for the EU as it leaves the factory with the table as
its first, and looked at in every control step; the same call gives the same numbers.
"""

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.domain.energy import SECONDS_PER_HOUR
from backend.views.table_use import table_use
from sim_device.preset import load
from sim_device.preset_unit import preset_unit
from sim_device.scenario_file import load as load_scenario

Numbers = npt.NDArray[np.float64]
Ride = dict[str, Numbers]
Changes = Mapping[str, Any]
FACTORY: Changes = MappingProxyType({})

STEP_S = 0.01
SPORT = 3
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

# Slower than this the half turn around a moment lasts longer than a start.
HALF_TURN_S_MAX = 1.5
HALF_TURN_DEG = 180.0

START_SEED, START_KG, START_NM = 1, 100.0, 24.48
START_KMH, START_S_MAX = 15.0, 60.0
CADENCE_RPM_UNLIMITED = 250.0

LIMIT_SEED, LIMIT_FROM_KMH, LIMIT_NM, LIMIT_CADENCE_RPM = 5, 24.0, 16.0, 140.0
LIMIT_SETTLED_S, LIMIT_LOOKED_S = 40.0, 30.0


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


def _seconds(ride: Ride) -> Numbers:
    """How long each look holds (n,): the end of a phase comes between two of them."""
    return np.diff(ride["t_s"], prepend=ride["t_s"][0] - STEP_S)


def assisted(ride: Ride) -> npt.NDArray[np.bool_]:
    """When the fuzzy law asked the motor for torque (n,)."""
    return (ride["motor_demand_nm"] > 0.0) & np.isfinite(ride["fuzzy_gain"])


def wh_per_km(ride: Ride) -> tuple[float, float]:
    """What the battery gave, electronics included, and what the motor's shaft gave."""
    km = ride["distance_m"][-1] / METRES_PER_KM
    battery_w = ride["battery_voltage_v"] * ride["battery_current_a"]
    shaft_w = ride["motor_torque_nm"] * ride["motor_speed_rpm"] * RAD_S_PER_RPM
    seconds = _seconds(ride)
    battery_ws, shaft_ws = float(battery_w @ seconds), float(shaft_w @ seconds)
    return float(battery_ws / SECONDS_PER_HOUR / km), float(shaft_ws / SECONDS_PER_HOUR / km)


def mean_kmh(ride: Ride) -> float:
    """Over the whole way, stops included."""
    return float(3.6 * ride["distance_m"][-1] / (ride["t_s"][-1] - ride["t_s"][0]))


def ripple_pct(ride: Ride) -> float:
    """Rms of the delivered motor torque about its mean over the half turn of the crank around each
    moment, as a share of its mean; where the motor helps throughout that half turn."""
    t_s, seconds = ride["t_s"], _seconds(ride)
    # A hair of a turn for every look: what stands still has no way back from angle to time.
    angle_deg = np.cumsum(ride["cadence_rpm"] * 6.0 * seconds) + 1e-9 * np.arange(len(t_s))
    from_s = np.interp(angle_deg - HALF_TURN_DEG / 2, angle_deg, t_s)
    to_s = np.interp(angle_deg + HALF_TURN_DEG / 2, angle_deg, t_s)
    whole = (angle_deg > HALF_TURN_DEG / 2) & (angle_deg < angle_deg[-1] - HALF_TURN_DEG / 2)

    def over_half_turn(values: Numbers) -> Numbers:
        total = np.cumsum(values * seconds)
        return np.interp(to_s, t_s, total) - np.interp(from_s, t_s, total)

    helped = whole & assisted(ride) & (over_half_turn((~assisted(ride)).astype(float)) < 1e-9)
    helped &= (to_s - from_s < HALF_TURN_S_MAX) & (to_s > from_s)
    torque_nm = ride["motor_torque_nm"]
    mean_nm = over_half_turn(torque_nm)[helped] / (to_s - from_s)[helped]
    rms_nm = np.sqrt(np.mean((torque_nm[helped] - mean_nm) ** 2))
    return float(100.0 * rms_nm / np.mean(torque_nm[helped]))


def column_shares(ride: Ride, table: str) -> Numbers:
    """Share of the assisted time in which the rules of each torque-rate column acted (5,), each
    moment weighted by how much they had to say, as on the page of a ride."""
    values = load(table).values
    when = assisted(ride)
    cells_s = table_use(
        {name: ride[name][when] for name in ("speed_kmh", "torque_rate")},
        _seconds(ride)[when],
        values["fuzzy_speed_points_kmh"],
        values["fuzzy_torque_rate_points"],
    ).seconds
    return cells_s.sum(axis=0) / cells_s.sum()


def mean_gain(ride: Ride) -> float:
    """The gain over the assisted time."""
    when = assisted(ride)
    return float(np.average(ride["fuzzy_gain"][when], weights=_seconds(ride)[when]))


def start_s(table: str, rider: str, changes: Changes = FACTORY) -> float:
    """From rest on the level to 15 km/h: the bike, mass and push of the scenario `start`.

    rider: `constant` is a servo, `legs` push in two strokes a turn. changes: as for `ridden`.
    """
    unit = preset_unit(table, START_SEED, dict(changes), bike={"road.mass_kg": START_KG})
    unit.select_mode(SPORT)
    unit.rider(rider, START_NM, CADENCE_RPM_UNLIMITED)
    for step in range(1, round(START_S_MAX / STEP_S) + 1):
        unit.advance(STEP_S)
        if unit.observe()["speed_kmh"] >= START_KMH:
            return round(step * STEP_S, 2)
    raise AssertionError(f"{table}: {rider} did not reach {START_KMH} km/h in {START_S_MAX} s")


def switched_hz(table: str, hard_cut: bool = False) -> float:
    """How often a second the motor goes on or off under legs that hold 25 km/h.

    hard_cut: on the unit of the thesis's configuration, without a band below the limit.
    """
    made_as, changes = ("thesis", load(table).values) if hard_cut else (table, {})
    unit = preset_unit(made_as, LIMIT_SEED, changes)
    unit.select_mode(SPORT)
    unit.place(LIMIT_FROM_KMH)
    unit.rider("legs", LIMIT_NM, LIMIT_CADENCE_RPM)
    unit.advance(LIMIT_SETTLED_S)
    helps = []
    for _ in range(round(LIMIT_LOOKED_S / STEP_S)):
        unit.advance(STEP_S)
        helps.append(unit.observe()["motor_demand_nm"] > 0.0)
    return float(np.count_nonzero(np.diff(helps))) / LIMIT_LOOKED_S
