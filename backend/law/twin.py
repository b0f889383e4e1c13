"""A twin of a recorded ride: the same road, bike and rider, ridden with another table.

Everything belongs to the distance: the road, where the rider stops and how hard he pushes. What the
rider does at another speed nobody recorded; the band of the answer holds it. What the twin errs by
without any change it errs by with one, so every estimate is taken against that. On simulated rides
whose truth is known, work comes within 5 % and time within 1 % in nine of ten
(tests/acceptance/test_the_same_road_again.py); a real road has gusts and a rider has moods.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.errors import InvalidRequest
from backend.law.recorded_ride import FREE_MOTOR_NM, Floats, Recorded
from backend.law.rider_and_bike import RiderAndBike
from backend.law.road_figures import (
    BATTERY,
    DURATION,
    MOTOR_WORK,
    RIPPLE,
    Figures,
    figures_of,
    figures_of_record,
)
from backend.law.road_twin import CHAIN_EFFICIENCY, Assumed, air, road_of
from sim_device.firmware.python.law import LawRefused
from sim_device.firmware.python.twin import Bike, Rider, Totals, Twin

LONGEST_SHARE = 3.0
"""A ride that takes longer than this many times the recorded one is given up."""
DRAWS = 40
MASSES_KG = (72.0, 112.0)
DRAG_AREAS_M2 = (0.35, 0.65)
GEAR_EFFICIENCIES = (0.88, 0.95)
POWER_SHARES = (0.0, 1.2)
HOLD_SHARES = (0.2, 1.0)
CADENCE_SHARES = (0.5, 1.2)
"""Of who shifts: some of what keeps his cadence, or more, as cogs are steps."""
HOLDS_POWER = Rider(power_share=1.0, hold_share=0.0)
HOLDS_POWER_AND_CADENCE = Rider(power_share=1.0, hold_share=0.0, cadence_share=1.0)
GIVEN_WITHIN = 0.03
BAND_PCT = (5.0, 95.0)
FLOORS = {DURATION: 0.0017, MOTOR_WORK: 0.018, BATTERY: 0.02, RIPPLE: 0.08}
FLOOR = 0.018
"""What the method itself errs by, on top of what is not known: shares with which the band held nine
of ten simulated rides of the seeds 701 to 724."""
WORK_LEAST_J = 180.0
"""A twentieth of a Wh: below it a share of the work says nothing."""
SAMPLES_MIN = 100
"""With fewer a fit is a guess."""


UNSPECIFIED = RiderAndBike()


def assumed_of(rider_and_bike: RiderAndBike) -> Assumed:
    """With usual values for what was not given."""
    usual = Assumed()
    return replace(
        usual,
        mass_kg=rider_and_bike.mass_kg or usual.mass_kg,
        drag_area_m2=rider_and_bike.drag_area_m2 or usual.drag_area_m2,
    )


def around(given: float | None, likely: tuple[float, float]) -> tuple[float, float]:
    """Range of a value: near the given one, else anywhere likely."""
    if given is None:
        return likely
    return given * (1.0 - GIVEN_WITHIN), given * (1.0 + GIVEN_WITHIN)


Band = dict[str, tuple[float, float]]
"""From and to of each figure, in which nine of ten truths lay on simulated roads."""


class RoadTwin:
    """A recorded ride that can be ridden again.

    self_replay: what the twin makes of the ride without any change. one_gear: nobody shifted.
    assumed: substitutes for what no ride records. rider: of the estimate, who holds
    his power; where he shifted, his cadence too. recorded: what the record came to.
    reach_m: a radian of the chainring goes so far, in the middle gear.
    """

    def __init__(
        self, ride: Recorded, config: Mapping[str, Any], rider_and_bike: RiderAndBike = UNSPECIFIED
    ) -> None:
        """config: the unit's on that ride. rider_and_bike: of rider and bike. Raises
        InvalidRequest if the ride cannot be laid over its distance."""
        self.ride = ride
        self._road, self._forces = road_of(ride, config)
        self.reach_m = float(np.median(self._road.reach_m))
        self.one_gear = bool(np.ptp(self._road.reach_m) == 0.0)
        self._longest_s = LONGEST_SHARE * ride.duration_s + 60.0
        self._bike = bike_of(ride)
        self._rider_and_bike = rider_and_bike
        self.assumed = assumed_of(rider_and_bike)
        self._twin = self._made(self.assumed)
        self.rider = HOLDS_POWER if self.one_gear else HOLDS_POWER_AND_CADENCE
        self.self_replay, _ = self._twin.ride(config, self.rider)
        self.recorded = figures_of_record(ride)
        unchanged = figures_of(self.self_replay)
        self._record_over_twin = {name: self._ratio(name, unchanged[name]) for name in unchanged}

    def ridden(
        self, config: Mapping[str, Any], rider: Rider, sample_steps: int = 0
    ) -> tuple[Totals, npt.NDArray[np.void]]:
        """The same road with this configuration; samples as in Twin.ride. Raises InvalidRequest
        for what the law refuses."""
        try:
            return self._twin.ride(config, rider, sample_steps)
        except LawRefused as refused:
            raise InvalidRequest(f"replay: {refused}", "replay_refused") from refused

    def corrected(self, totals: Totals) -> Figures:
        """What a ride came to, less what the twin errs by without any change; a figure that was not
        recorded is NaN."""
        figures = figures_of(totals)
        return {name: figures[name] * self._record_over_twin[name] for name in figures}

    def band(
        self,
        config: Mapping[str, Any],
        before_each: Callable[[], None] = lambda: None,
        count: int = DRAWS,
        seed: int = 0,
    ) -> Band:
        """Where nine of ten rides lie, over what a ride does not tell: mass, air, losses of the
        motor's gears, and the rider's answer to another speed, each anywhere in its range.

        before_each: called before each of `count` rides; what it raises ends them."""
        random = np.random.default_rng(seed)
        results = []
        for number in range(count):
            before_each()
            assumed = Assumed(
                mass_kg=random.uniform(*around(self._rider_and_bike.mass_kg, MASSES_KG)),
                drag_area_m2=random.uniform(
                    *around(self._rider_and_bike.drag_area_m2, DRAG_AREAS_M2)
                ),
                gear_efficiency=random.uniform(*GEAR_EFFICIENCIES),
            )
            share = random.uniform(*POWER_SHARES), 0.0
            hold = 0.0, random.uniform(*HOLD_SHARES)
            shifts = 0.0 if self.one_gear else random.uniform(*CADENCE_SHARES)
            rider = Rider(*(share if number % 2 == 0 else hold), shifts)
            totals, _ = self._made(assumed).ride(config, rider)
            results.append(self.corrected(totals))
        limits = {}
        for name in results[0]:
            low, high = np.percentile([figures[name] for figures in results], BAND_PCT)
            floor = FLOORS.get(name, FLOOR)
            limits[name] = float(low * (1.0 - floor)), float(high * (1.0 + floor))
        return limits

    def _ratio(self, name: str, unchanged: float) -> float:
        """Record over twin; 1 where there is too little help to tell, NaN without a record."""
        recorded, least_j = self.recorded, self.self_replay.motor_work_j
        tells = name == DURATION or min(recorded[MOTOR_WORK], least_j) > WORK_LEAST_J
        return recorded[name] / unchanged if tells or math.isnan(recorded[name]) else 1.0

    def _made(self, assumed: Assumed) -> Twin:
        road = replace(self._road, force_n=self._forces.holding_n(assumed))
        bike = replace(
            self._bike,
            mass_kg=assumed.mass_kg,
            air_n_s2_per_m2=air(assumed),
            gear_efficiency=assumed.gear_efficiency,
        )
        return Twin(road, bike, self._longest_s)


def bike_of(ride: Recorded) -> Bike:
    """What moves the bike, and the battery as its voltage and current tell; 36 V without them."""
    assumed = Assumed()
    recorded = Bike(
        mass_kg=assumed.mass_kg,
        air_n_s2_per_m2=air(assumed),
        chain_efficiency=CHAIN_EFFICIENCY,
        gear_efficiency=assumed.gear_efficiency,
        open_v=36.0,
        sag_v_per_j=0.0,
        resistance_ohm=0.0,
        loss_w_per_rad2=0.0,
        power_share=1.0 / 0.8,
        loss_w_per_nm2=0.0,
        idle_w=0.0,
    )
    if ride.voltage_v is None or ride.current_a is None:
        return recorded
    valid = np.isfinite(ride.voltage_v) & np.isfinite(ride.current_a)
    if np.count_nonzero(valid) < SAMPLES_MIN:
        return recorded
    volts, amps = ride.voltage_v[valid], ride.current_a[valid]
    power_w = volts * amps
    taken_j = np.cumsum(power_w) * ride.step_s
    open_v, sag, resistance = fitted(np.column_stack((np.ones(volts.size), -taken_j, -amps)), volts)
    motor_nm, motor_rad_s = ride.motor_nm[valid], ride.motor_rad_s[valid]
    pushing = motor_nm > FREE_MOTOR_NM
    idle_w = float(np.median(power_w[~pushing])) if (~pushing).any() else 0.0
    bike = replace(
        recorded,
        open_v=open_v,
        sag_v_per_j=max(sag, 0.0),
        resistance_ohm=max(resistance, 0.0),
        idle_w=max(idle_w, 0.0),
    )
    if np.count_nonzero(pushing) < SAMPLES_MIN:
        return bike
    torque, speed = motor_nm[pushing], motor_rad_s[pushing]
    terms = np.column_stack((speed**2, torque * speed, torque**2))
    loss, share, copper = fitted(terms, power_w[pushing] - bike.idle_w)
    return replace(bike, loss_w_per_rad2=loss, power_share=share, loss_w_per_nm2=copper)


def fitted(terms: Floats, values: Floats) -> tuple[float, ...]:
    """Least squares: a factor for each column of terms (n, k)."""
    factors, *_ = np.linalg.lstsq(terms, values, rcond=None)
    return tuple(float(factor) for factor in factors)
