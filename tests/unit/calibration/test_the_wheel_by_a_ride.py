"""Goal: the wheel's circumference from a ride is that of the road it went, and rides that cannot
tell, of wheel or climb, are refused by the name of what they lack.

Method: rides made row by row in a real store, along a meridian at 45 degrees, where a degree of WGS
84 is 111.132 km (NIMA TR 8350.2). The head unit's clock differs by 2 s.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

import numpy as np
import pytest

from backend.calibration.bike.climb_check import ClimbCheck, Question, Slope, rise_by_heights
from backend.calibration.bike.coast_down import ClimbInputs
from backend.calibration.bike.service import CadenceCheck, PulseCount
from backend.calibration.bike.types import Cadence, CertificateOfTorque
from backend.calibration.bike.wheel_measure import TrackQuestion, WheelMeasure
from backend.core.channels import ChannelSpec, Values
from backend.core.ride import Ride
from backend.errors import InvalidRequest
from backend.law import law_defaults
from backend.rides.rows import Window
from backend.store import Store
from tests.fakes.kept_rides import imported_ride

SPECS = {
    "speed_kmh": ChannelSpec("speed_kmh", "km/h", 0.01),
    "cadence_rpm": ChannelSpec("cadence_rpm", "rpm", 0.1),
    "rider_torque_nm": ChannelSpec("rider_torque_nm", "Nm", 0.01),
    "motor_torque_demanded_nm": ChannelSpec("motor_torque_demanded_nm", "Nm", 0.0001),
    "crank_angle_deg": ChannelSpec("crank_angle_deg", "deg", 0.1),
    "altitude_m": ChannelSpec("altitude_m", "m", 0.1),
    "latitude_deg": ChannelSpec("latitude_deg", "deg", 1e-7, wide=True),
    "longitude_deg": ChannelSpec("longitude_deg", "deg", 1e-7, wide=True),
}
BEGAN_US = 1_700_000_000_000_000
DAY_S = 86_400.0
KEPT_M = float(law_defaults()["wheel_circumference_m"])
LARGER = 1.02
DEGREE_M = 111_132.0
AT_S = np.arange(620.0)
RIDING_MS = np.where((AT_S >= 10) & (AT_S <= 610), 6.0, 0.0)
KNOWN = ClimbInputs(mass_kg=100.0, mass_limit_kg=0.5, gravity_ms2=9.807, rise_limit_m=0.5)


def kept(
    store: Store, columns: Mapping[str, Values], later_s: float = 0.0, row_s: float = 1.0
) -> int:
    """A ride of a row every row_s. later_s: than BEGAN_US, by its device's clock; another one is
    another ride."""
    began_us = BEGAN_US + round(later_s * 1e6)
    return imported_ride(store, columns, round(row_s * 1e6), began_us, SPECS)


def told_kmh() -> Values:
    """Of a wheel larger than its device believes."""
    return RIDING_MS / LARGER * 3.6


def track(later_s: float = 0.0) -> dict[str, Values]:
    way_m = np.concatenate([[0.0], np.cumsum((RIDING_MS[1:] + RIDING_MS[:-1]) / 2)])
    way_m = np.interp(AT_S + later_s, AT_S, way_m)
    return {
        "latitude_deg": 45.0 + way_m / DEGREE_M,
        "longitude_deg": np.full(len(way_m), 8.0),
    }


def measure(store: Store, source: str = "ride") -> WheelMeasure:
    def config_of(ride: Ride, t_s: float = 0.0) -> tuple[dict[str, Any], str]:
        return law_defaults(), source

    return WheelMeasure(store, config_of, lambda device_id: [])


def codes(refused: pytest.ExceptionInfo[InvalidRequest]) -> list[tuple[str, str]]:
    return [(fault.field, fault.code) for fault in refused.value.fields]


def test_a_larger_wheel_is_found_by_the_positions_of_its_own_ride(store: Store) -> None:
    ride = kept(store, {"speed_kmh": told_kmh(), **track()})

    told = measure(store).tracked(TrackQuestion(Window(ride)), None)

    assert told.distance_m == pytest.approx(6.0 * 601, rel=1e-4)
    assert told.measured.circumference_m == pytest.approx(LARGER * KEPT_M, rel=3e-4)
    assert told.noise_m == pytest.approx(0.0, abs=0.05)
    # Half a percent of positions that wander, one turn of 1700: rectangles, k = 2.
    share = math.hypot(0.005, 1 / told.turns) / math.sqrt(3)
    assert told.measured.expanded_m == pytest.approx(2 * share * LARGER * KEPT_M, rel=0.02)
    assert told.unit_comparison is None


def test_the_positions_may_be_of_another_device_with_a_clock_of_its_own(store: Store) -> None:
    wheel = kept(store, {"speed_kmh": told_kmh()})
    other = kept(store, track(later_s=5.0), later_s=3.0)

    told = measure(store).tracked(TrackQuestion(Window(wheel), other), None)

    assert told.measured.circumference_m == pytest.approx(LARGER * KEPT_M, rel=3e-3)
    with pytest.raises(InvalidRequest) as refused:
        measure(store).tracked(TrackQuestion(Window(wheel, 100.0, 500.0), other), None)
    assert codes(refused) == [("ride_id", "not_standing")]
    later = kept(store, track(), later_s=300.0)
    with pytest.raises(InvalidRequest) as refused:
        measure(store).tracked(TrackQuestion(Window(wheel), later), None)
    assert codes(refused) == [("track_ride_id", "not_covered")]


def test_what_a_ride_lacks_for_its_wheel_is_named(store: Store) -> None:
    bare = kept(store, {"speed_kmh": told_kmh()})
    whole = kept(store, {"speed_kmh": told_kmh(), **track()}, 1 * DAY_S)
    holed = track()
    holed["latitude_deg"][300:320] = np.nan
    torn = kept(store, {"speed_kmh": told_kmh(), **holed}, 2 * DAY_S)

    for question, source, expected in (
        (TrackQuestion(Window(bare)), "ride", ("ride_id", "missing_channel")),
        (TrackQuestion(Window(torn)), "ride", ("ride_id", "missing_rows")),
        (TrackQuestion(Window(whole)), "defaults", ("device_circumference_m", "missing")),
    ):
        with pytest.raises(InvalidRequest) as refused:
            measure(store, source).tracked(question, None)
        assert codes(refused) == [expected]
    stated = TrackQuestion(Window(whole), stored_m=KEPT_M)
    found = measure(store, "defaults").tracked(stated, None).measured
    assert found.circumference_m == pytest.approx(LARGER * KEPT_M, rel=1e-3)


def test_positions_too_rough_to_tell_are_refused_with_the_figure(store: Store) -> None:
    rough = track()
    noise = np.random.default_rng(7).normal(0.0, 12.0, len(AT_S))
    rough["latitude_deg"] = rough["latitude_deg"] + noise / DEGREE_M
    ride = kept(store, {"speed_kmh": told_kmh(), **rough})

    with pytest.raises(InvalidRequest, match=r"positions are \d+\.\d m off .* to \d+\.\d % only"):
        measure(store).tracked(TrackQuestion(Window(ride)), None)


def nobody(ride: Ride, torque_nm: float) -> CertificateOfTorque | None:
    """No calibration was ever kept."""
    return None


def test_pulses_of_a_wheel_turned_by_hand_are_told_beside_the_unit_s(store: Store) -> None:
    """25 turns in 50 s of a wheel with half the magnets that the unit believes in."""
    told_ms = 12.5 * KEPT_M / 50
    ride = kept(store, {"speed_kmh": np.full(51, 3.6 * told_ms)})
    has = law_defaults() | {"wheel_pulses_per_turn": 36}

    told = PulseCount(store, lambda ride, t_s=0: (has, "ride"))(Window(ride), 25)

    assert told.reported_turns == pytest.approx(12.5, abs=0.05)  # 0.01 km/h
    assert (told.pulses.stored, told.pulses.nearest_integer, told.pulses.agrees) == (36, 18, False)
    with pytest.raises(InvalidRequest) as refused:
        PulseCount(store, lambda ride, t_s=0: (has, "defaults"))(Window(ride), 25)
    assert codes(refused) == [("ride_id", "missing")]


def test_the_certificate_in_the_unit_tells_how_sure_the_calibration_is(store: Store) -> None:
    question = climb_of(store, 0.0)
    asked: list[float] = []

    def certified(ride: Ride, torque_nm: float) -> CertificateOfTorque:
        asked.append(torque_nm)
        return CertificateOfTorque(7, "ab" * 32, datetime(2026, 11, 1, tzinfo=UTC), torque_nm, 0.02)

    unsaid = dataclasses.replace(question, calibrated_expanded_share=None)
    said = ClimbCheck(store, certified)(question)
    told = ClimbCheck(store, certified)(unsaid)
    unknown = ClimbCheck(store, nobody)(unsaid)

    assert asked == [pytest.approx(30.0)]
    assert [one.calibrated.source for one in (said, told, unknown)] == [
        "given",
        "certificate",
        "unknown",
    ]
    assert told.calibrated.certificate is not None
    assert told.calibrated.certificate.calibration_id == 7
    ratio, expanded = told.balance.gain_ratio, told.balance.expanded
    both = math.hypot(expanded, 0.02 * ratio)
    assert told.balance.en == pytest.approx(abs(ratio - 1) / both)
    assert unknown.balance.en == pytest.approx(abs(ratio - 1) / expanded)


def climb_of(store: Store, demanded_nm: float | None, day: int = 1) -> Question:
    """A coast-down from 9 m/s by 10 N and a climb of 24 m, in rides of a head unit."""
    coast = kept(store, {"speed_kmh": 3.6 * np.linspace(9.0, 3.0, 60)})
    flat = np.full(121, 1.0)
    columns = {"speed_kmh": 3.6 * 4.0 * flat, "rider_torque_nm": 30.0 * flat}
    columns |= {"cadence_rpm": 70.0 * flat, "altitude_m": 400.0 + np.arange(121) / 5}
    if demanded_nm is not None:
        columns["motor_torque_demanded_nm"] = demanded_nm * flat
    slopes = [Slope(Window(coast), 0.0)]
    return Question(Slope(Window(kept(store, columns, day * DAY_S))), slopes, KNOWN, True, 0.0)


def test_a_motor_that_nobody_measured_takes_the_rider_s_word(store: Store) -> None:
    question = climb_of(store, 0.0)

    told = ClimbCheck(store, nobody)(question)

    assert told.rise_m == pytest.approx(24.0, abs=0.05)
    # 100 kg x 9.807 x 24 m and 480 m of the coast-down's 10.4 N, by 0.97 of 30 Nm at 70 rpm.
    legs_j = 30.0 * 70 * math.pi / 30 * 120
    assert told.balance.crank_energy_j == pytest.approx(legs_j, rel=1e-9)
    ratio = told.balance.needed_energy_j / (0.97 * legs_j)
    assert told.balance.gain_ratio == pytest.approx(ratio, rel=1e-9)
    assert told.balance.needed_energy_j == pytest.approx(100 * 9.807 * 24 + 480 * 10.4, rel=0.01)
    for day, demanded_nm, motor_off, expected in (
        (2, 0.0, False, "motor_unknown"),
        (3, None, False, "motor_unknown"),
        (4, 0.5, True, "motor_helped"),
    ):
        question = climb_of(store, demanded_nm, day)
        with pytest.raises(InvalidRequest) as refused:
            ClimbCheck(store, nobody)(
                Question(question.climb, question.coast_downs, KNOWN, motor_off, 0.0)
            )
        assert codes(refused) == [("motor_off", expected)]


def test_a_climb_without_heights_or_torque_is_refused_by_name(store: Store) -> None:
    coast = kept(store, {"speed_kmh": 3.6 * np.linspace(9.0, 3.0, 60)})
    question = Question(Slope(Window(coast), 20.0), [Slope(Window(coast))], KNOWN, True, 0.0)

    with pytest.raises(InvalidRequest, match="altitude_m") as refused:
        ClimbCheck(store, nobody)(question)
    assert codes(refused) == [("coast_downs[0]", "missing_channel")]
    level = [Slope(Window(coast), 0.0)]
    with pytest.raises(InvalidRequest, match="rider_torque_nm, cadence_rpm") as refused:
        ClimbCheck(store, nobody)(Question(question.climb, level, KNOWN, True, 0.0))
    assert codes(refused) == [("climb", "missing_channel")]


def test_a_cadence_that_tells_less_than_the_crank_turns_is_told(store: Store) -> None:
    at_s = np.arange(0.0, 60.0, 0.05)
    angle_deg = (80.0 * 6.0 * at_s) % 360.0

    def checked(reported_rpm: float, day: int) -> Cadence:
        columns = {"cadence_rpm": np.full(len(at_s), reported_rpm), "crank_angle_deg": angle_deg}
        return CadenceCheck(store)(Window(kept(store, columns, day * DAY_S, row_s=0.05)))

    true, less = checked(80.0, 1), checked(78.0, 2)

    assert true.turns == pytest.approx(80.0 * at_s[-1] / 60.0, abs=1e-3)
    assert (true.agrees, less.agrees) == (True, False)
    assert less.error_rpm == pytest.approx(-2.0, abs=0.01)
    slow = kept(store, {"cadence_rpm": AT_S, "crank_angle_deg": AT_S % 360.0}, 3 * DAY_S)
    with pytest.raises(InvalidRequest) as refused:
        CadenceCheck(store)(Window(slow))
    assert codes(refused) == [("ride_id", "too_slow")]
    with pytest.raises(InvalidRequest) as refused:
        CadenceCheck(store)(Window(2, 0.0, 5.0))
    assert codes(refused) == [("ride_id", "too_few_turns")]


def test_heights_at_the_ends_of_a_slope_are_not_taken_late() -> None:
    time_s = np.arange(0.0, 100.0, 0.5)
    noise = np.random.default_rng(4).normal(0.0, 0.1, len(time_s))

    rise_m = rise_by_heights(time_s, 300.0 + 0.2 * time_s + noise)

    # Of a line through 11 heights the end is known to 0.56 of the noise: both 0.08 m.
    assert rise_m == pytest.approx(0.2 * time_s[-1], abs=3 * 0.08)
