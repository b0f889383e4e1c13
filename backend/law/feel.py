"""How a table or a configuration feels, measured on the simulated bike in virtual time.

A fresh unit for each figure, looked at in every control step; the same values give the same figures
to the last digit. It is the bike of the scenario `start`: 100 kg, on the level.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.core.described import described
from backend.errors import Conflict
from sim_device.configure import ConfigureError
from sim_device.firmware.python.law import STEP_S
from sim_device.lockstep import LockstepUnit
from sim_device.preset_unit import MARKET, MARKET_OF, unit_with, without_the_bike

Numbers = npt.NDArray[np.float64]
Ride = Mapping[str, Numbers]

SPORT = 3
LOOKED_AT = ("t_s", "speed_kmh", "cadence_rpm", "motor_demand_nm", "motor_torque_nm", "fuzzy_gain")

# Slower than this the half turn around a moment lasts longer than a start.
HALF_TURN_S_MAX = 1.5
HALF_TURN_DEG = 180.0

START_SEED, START_KG, START_NM = 1, 100.0, 24.48
START_KMH, START_S_MAX = 15.0, 60.0
CADENCE_RPM_UNLIMITED = 250.0
# A rise within this time is felt as one jerk; within a control step it would be the sensor's noise.
RISE_S = 0.1

STEADY_KMH, STEADY_SETTLED_S, STEADY_LOOKED_S = 15.0, 3.0, 10.0

# A push that grows by half at once, at a speed where a table has something to say.
LAG_KMH, LAG_NM, LAG_STEP_NM = 12.0, 12.0, 24.0
LAG_SETTLED_S, LAG_LOOKED_S, LAG_FINAL_S = 4.0, 3.0, 0.5
LAG_SHARE = 1.0 - np.exp(-1.0)
LAG_NM_MIN = 0.02

LIMIT_SEED, LIMIT_FROM_KMH, LIMIT_NM, LIMIT_CADENCE_RPM = 5, 24.0, 16.0, 140.0
LIMIT_SETTLED_S, LIMIT_LOOKED_S = 40.0, 30.0


@described
class Feel:
    """Measured on the simulated bike, 100 kg on the level; null where it never came to that."""

    start_s: float | None
    """From rest to 15 km/h under legs."""
    rise_nm_per_s: float
    """Steepest rise of the motor's torque on the way."""
    ripple_pct: float | None
    """Rms of the motor's torque about its mean over half a turn of the crank, as a share of it,
    under even legs."""
    lag_ms: float | None
    """To 63 % of what a sudden push changes."""
    toggles_hz: float
    """On and off a second under legs that hold 25 km/h."""
    market: str
    """That the simulated unit was made for."""
    seconds: float
    """What measuring took."""


def feel_of(values: Mapping[str, Any]) -> Feel:
    """Measures values over those of the factory. Raises Conflict for what no unit takes.

    values: parameters by registry name, a table's six or a configuration's.
    """
    began = time.perf_counter()
    market = market_for(values)
    mode = fuzzy_mode(values)
    values = without_the_bike(dict(values))

    def made(seed: int) -> LockstepUnit:
        unit = unit_with(values, market, seed, {}, bike={"road.mass_kg": START_KG})
        unit.select_mode(mode)
        return unit

    start = started(made(START_SEED), "legs")
    steady = made(START_SEED)
    steady.place(STEADY_KMH)
    steady.rider("legs", START_NM, CADENCE_RPM_UNLIMITED)
    steady.advance(STEADY_SETTLED_S)
    return Feel(
        start_s=start_s(start),
        rise_nm_per_s=steepest_rise(start),
        ripple_pct=ripple_pct(looked_at(steady, STEADY_LOOKED_S)),
        lag_ms=lag_ms(made(START_SEED)),
        toggles_hz=switched_hz(made(LIMIT_SEED)),
        market=market,
        seconds=time.perf_counter() - began,
    )


def fuzzy_mode(values: Mapping[str, Any]) -> int:
    """The slot to ride in: sport, unless this configuration has its fuzzy law elsewhere."""
    laws = values.get("mode_laws")
    if laws is None or laws[SPORT] == "fuzzy" or "fuzzy" not in laws:
        return SPORT
    return int(list(laws).index("fuzzy"))


def market_for(values: Mapping[str, Any]) -> str:
    """Its own, else the first whose unit takes these values. Raises Conflict where none does."""
    note = ""
    settings = without_the_bike(dict(values))
    for market in dict.fromkeys((str(values.get("market", MARKET)), MARKET, *MARKET_OF.values())):
        try:
            unit_with(settings, market, START_SEED, {})
        except ConfigureError as error:
            note = note or str(error)
        else:
            return market
    raise Conflict(
        f"No simulated unit takes these values, so nothing is measured: {note}", "refused"
    )


def started(unit: LockstepUnit, rider: str) -> Ride:
    """What is seen from rest on until 15 km/h, or for a minute. rider: `legs` or `constant`."""
    unit.rider(rider, START_NM, CADENCE_RPM_UNLIMITED)
    rows = []
    for _ in range(round(START_S_MAX / STEP_S)):
        unit.advance(STEP_S)
        rows.append(unit.observe())
        if rows[-1]["speed_kmh"] >= START_KMH:
            break
    return columns(rows)


def start_s(start: Ride) -> float | None:
    """How long a start of `started` took; None for one that did not reach its speed."""
    reached = start["speed_kmh"][-1] >= START_KMH
    return round(len(start["t_s"]) * STEP_S, 2) if reached else None


def looked_at(unit: LockstepUnit, seconds: float) -> Ride:
    """What is seen in every control step."""
    rows = []
    for _ in range(round(seconds / STEP_S)):
        unit.advance(STEP_S)
        rows.append(unit.observe())
    return columns(rows)


def columns(rows: list[dict[str, Any]]) -> Ride:
    """Looks as columns (n,), by name."""
    return {name: np.array([row[name] for row in rows], np.float64) for name in LOOKED_AT}


def steepest_rise(ride: Ride) -> float:
    """The fastest that the motor's torque grew by within `RISE_S`, in Nm/s at its shaft."""
    step = round(RISE_S / STEP_S)
    torque_nm = ride["motor_torque_nm"]
    if len(torque_nm) <= step:
        return 0.0
    return float(np.max(torque_nm[step:] - torque_nm[:-step]) / RISE_S)


def lag_ms(unit: LockstepUnit) -> float | None:
    """After a push that grows at once: until the motor made 63 % of the way; None if it hardly
    went any."""
    unit.place(LAG_KMH)
    unit.rider("constant", LAG_NM, CADENCE_RPM_UNLIMITED)
    unit.advance(LAG_SETTLED_S)
    before_nm = unit.observe()["motor_torque_nm"]
    unit.rider("constant", LAG_STEP_NM, CADENCE_RPM_UNLIMITED)
    torque_nm = looked_at(unit, LAG_LOOKED_S)["motor_torque_nm"]
    rise_nm = float(np.mean(torque_nm[-round(LAG_FINAL_S / STEP_S) :])) - before_nm
    if rise_nm < LAG_NM_MIN:
        return None
    reached = torque_nm >= before_nm + LAG_SHARE * rise_nm
    return round(1000.0 * STEP_S * (int(np.argmax(reached)) + 1), 1) if reached.any() else None


def switched_hz(unit: LockstepUnit) -> float:
    """How often a second the motor goes on or off under legs that hold 25 km/h."""
    unit.place(LIMIT_FROM_KMH)
    unit.rider("legs", LIMIT_NM, LIMIT_CADENCE_RPM)
    unit.advance(LIMIT_SETTLED_S)
    helps = looked_at(unit, LIMIT_LOOKED_S)["motor_demand_nm"] > 0.0
    return float(np.count_nonzero(np.diff(helps))) / LIMIT_LOOKED_S


def assisted(ride: Ride) -> npt.NDArray[np.bool_]:
    """When the fuzzy law asked the motor for torque (n,)."""
    return (ride["motor_demand_nm"] > 0.0) & np.isfinite(ride["fuzzy_gain"])


def seconds_of(ride: Ride) -> Numbers:
    """How long each look holds (n,): the end of a phase comes between two of them."""
    return np.diff(ride["t_s"], prepend=ride["t_s"][0] - STEP_S)


def ripple_pct(ride: Ride) -> float | None:
    """Rms of the delivered motor torque about its mean over the half turn of the crank around each
    moment, as a share of its mean; where the motor helps throughout that half turn, None if it
    nowhere does."""
    t_s, seconds = ride["t_s"], seconds_of(ride)
    # A hair of a turn for every look: what stands still has no way back from angle to time.
    angle_deg = np.cumsum(ride["cadence_rpm"] * 6.0 * seconds) + 1e-9 * np.arange(len(t_s))
    from_s = np.interp(angle_deg - HALF_TURN_DEG / 2, angle_deg, t_s)
    to_s = np.interp(angle_deg + HALF_TURN_DEG / 2, angle_deg, t_s)
    full_turns = (angle_deg > HALF_TURN_DEG / 2) & (angle_deg < angle_deg[-1] - HALF_TURN_DEG / 2)

    def over_half_turn(values: Numbers) -> Numbers:
        total = np.cumsum(values * seconds)
        return np.interp(to_s, t_s, total) - np.interp(from_s, t_s, total)

    helped = full_turns & assisted(ride) & (over_half_turn((~assisted(ride)).astype(float)) < 1e-9)
    helped &= (to_s - from_s < HALF_TURN_S_MAX) & (to_s > from_s)
    torque_nm = ride["motor_torque_nm"]
    if not helped.any() or not np.mean(torque_nm[helped]) > 0.0:
        return None
    mean_nm = over_half_turn(torque_nm)[helped] / (to_s - from_s)[helped]
    rms_nm = np.sqrt(np.mean((torque_nm[helped] - mean_nm) ** 2))
    return float(100.0 * rms_nm / np.mean(torque_nm[helped]))
