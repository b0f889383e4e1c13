"""Goal: each fault is found with its numbers, its place and how bad it is; a sound ride has none.

Method: rides of the simulated bike, sound and with its faults at known times, and with its sensors
spoiled afterwards in a known way; a track drawn on a sphere for the wheel.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from backend import law
from backend.core.channels import Values
from backend.rides.diagnosis.finding import DiagnosisCheck, Evidence, Limits
from backend.rides.diagnosis.service import METHOD, diagnose
from tests.fakes.simulated_ride import LOOK_S, simulated_ride

LIMITS = Limits(
    law.LIMITS["temperature"],
    law.law_defaults()["battery_voltage_v_min"],
    wheel_circumference_m=2.2,
)
EARTH_M = 6_371_008.8
LEGS = {"kind": "legs", "torque_nm": 30.0, "cadence_rpm_max": 90.0}
RIDING = {"rider": LEGS, "brake": False, "assist_mode": 3}
STANDING = {"rider": {"kind": "off"}, "brake": True}


@cache
def columns_of(scenario: str) -> dict[str, Values]:
    return simulated_ride(scenario)


def evidence(columns: dict[str, Values], step_s: float = LOOK_S) -> Evidence:
    count = len(next(iter(columns.values())))
    return Evidence(columns, np.arange(count) * step_s, np.full(count, step_s), LIMITS)


def commute(**changes: Values) -> Evidence:
    return evidence({**columns_of("commute"), **changes})


def answer(ride: Evidence, name: str) -> DiagnosisCheck:
    return next(check for check in diagnose(ride) if check.name == name)


@pytest.mark.parametrize("scenario", ["commute", "stop_and_go", "field_ride", "hill_start"])
def test_a_sound_ride_has_no_finding(scenario: str) -> None:
    checks = diagnose(evidence(columns_of(scenario)))

    assert [check.name for check in checks if check.findings] == []
    assert METHOD >= 1


def test_what_a_ride_lacks_is_named_and_not_called_clean() -> None:
    bare = evidence({"speed_kmh": np.full(500, 20.0)})
    nobody_kept = replace(commute(), limits=Limits(LIMITS.temperature))

    lacking = {check.name: check.missing for check in diagnose(bare) if check.state == "impossible"}
    assert lacking["zero_drift"] == ("rider_torque_nm", "cadence_rpm")
    assert set(lacking) == {"zero_drift", "saturation", "brown_out", "derating", "wheel"}
    assert answer(nobody_kept, "brown_out").missing == ("battery_voltage_v_min",)
    never_still = commute(cadence_rpm=np.full(len(columns_of("commute")["speed_kmh"]), 60.0))
    assert answer(never_still, "zero_drift").missing == ("rest",)


def test_a_zero_that_walks_at_rest_is_found_where_it_is_worst() -> None:
    # The scenario's zero walks by 4 Nm a minute over its 75 s of rest, from 76 s on.
    found = answer(evidence(columns_of("sensor_fault")), "zero_drift").findings

    (finding,) = found
    assert (finding.kind, finding.severity) == ("zero_drift", "serious")
    assert finding.numbers["zero_nm_worst"] == pytest.approx(75 / 60 * 4.0, abs=0.5)
    assert 140.0 < finding.from_s < finding.to_s < 172.0
    assert finding.numbers["threshold_nm"] == 3.0


@pytest.mark.parametrize(
    ("zero_nm", "severity"), [(-1.8, "warning"), (-4.0, "serious"), (0.5, None)]
)
def test_a_zero_that_is_off_all_day_is_found(zero_nm: float, severity: str | None) -> None:
    torque = columns_of("commute")["rider_torque_nm"] + zero_nm
    found = answer(commute(rider_torque_nm=torque), "zero_drift").findings

    assert [finding.severity for finding in found] == ([severity] if severity else [])
    for finding in found:
        assert finding.numbers["zero_nm"] == pytest.approx(zero_nm, abs=0.05)


def test_a_foot_on_the_pedal_is_no_drift() -> None:
    columns = columns_of("commute")
    resting = (columns["speed_kmh"] < 0.1) & (columns["cadence_rpm"] < 1.0)
    foot = columns["rider_torque_nm"] + np.where(resting, 12.0, 0.0)

    assert answer(commute(rider_torque_nm=foot), "zero_drift").findings == ()


def test_an_open_bridge_is_a_reading_at_the_end_of_the_converter() -> None:
    # The scenario breaks an arm from 46 s to 56 s.
    (finding,) = answer(evidence(columns_of("sensor_fault")), "saturation").findings

    assert (finding.severity, finding.channel) == ("serious", "rider_torque_raw")
    assert (finding.from_s, finding.to_s) == pytest.approx((46.0, 56.0), abs=0.1)
    assert finding.numbers["seconds"] == pytest.approx(10.0, abs=0.1)


def test_a_clipped_torque_has_flat_tops() -> None:
    columns = {n: v for n, v in columns_of("commute").items() if n != "rider_torque_raw"}
    torque = columns["rider_torque_nm"]
    clipped = columns | {"rider_torque_nm": np.minimum(torque, 40.0)}

    assert answer(evidence(columns), "saturation").state == "clean"
    (finding,) = answer(evidence(clipped), "saturation").findings
    assert finding.numbers["torque_nm"] == 40.0
    once_a_second = {name: values[::50] for name, values in clipped.items()}
    assert answer(evidence(once_a_second, 1.0), "saturation").missing == ("fast_rows",)


@pytest.mark.filterwarnings("error")
def test_a_single_row_is_no_fast_recording() -> None:
    ride = Evidence({"rider_torque_nm": np.array([40.0])}, np.zeros(1), np.zeros(1), Limits(0))

    assert answer(ride, "saturation").missing == ("fast_rows",)


def test_a_lost_rotor_link_is_old_torque() -> None:
    riding = [(6.0, RIDING), (3.0, {"faults": {"link_lost": True}}), (3.0, {"faults": {}})]
    ride = evidence(simulated_ride(riding))

    (finding,) = answer(ride, "drop_outs").findings
    assert (finding.kind, finding.channel) == ("torque_late", "torque_age_ms")
    assert finding.from_s == pytest.approx(6.25, abs=0.1), "a quarter of a second after the last"
    assert finding.to_s > 8.9


def test_a_sensor_that_falls_silent_and_comes_back_is_found() -> None:
    cadence = columns_of("commute")["cadence_rpm"].copy()
    cadence[2000:2100] = np.nan
    cadence[:50] = np.nan  # a sensor that joins later is none
    (finding,) = answer(commute(cadence_rpm=cadence), "drop_outs").findings

    assert (finding.kind, finding.channel, finding.severity) == (
        "sensor_silent",
        "cadence_rpm",
        "note",
    )
    assert (finding.from_s, finding.to_s) == pytest.approx((40.0, 42.0))


def test_rows_lost_on_the_way_are_found_and_a_pause_is_not() -> None:
    columns = {
        name: np.delete(values, slice(2000, 2500)) for name, values in columns_of("commute").items()
    }
    start_s = np.delete(
        np.arange(len(columns_of("commute")["speed_kmh"])) * LOOK_S, slice(2000, 2500)
    )
    ride = replace(evidence(columns), start_s=start_s, gaps=[(40.0, 50.0)])

    (finding,) = answer(ride, "drop_outs").findings
    assert (finding.kind, finding.severity) == ("rows_lost", "warning")
    assert finding.numbers["seconds"] == pytest.approx(10.0)
    assert answer(replace(ride, paused=[(40.0, 50.0)]), "drop_outs").findings == ()
    stood = columns | {"speed_kmh": np.zeros(len(start_s)), "distance_m": np.zeros(len(start_s))}
    assert answer(replace(ride, values=stood), "drop_outs").findings == ()


def test_a_supply_that_breaks_down_is_found_with_its_load() -> None:
    columns = columns_of("commute")
    voltage = columns["battery_voltage_v"].copy()
    voltage[3000:3100] = 28.5  # two seconds below the 30 V that the configuration allows
    (warning,) = answer(commute(battery_voltage_v=voltage), "brown_out").findings
    voltage[3050] = 26.0
    (serious,) = answer(commute(battery_voltage_v=voltage), "brown_out").findings

    assert (warning.severity, serious.severity) == ("warning", "serious")
    assert (warning.from_s, warning.to_s) == pytest.approx((60.0, 62.0))
    assert serious.numbers["voltage_v_min"] == 26.0
    assert serious.numbers["threshold_v"] == 30.0
    assert serious.numbers["current_a"] == pytest.approx(columns["battery_current_a"][3050])


def test_a_hot_motor_is_found_as_the_unit_told_it_and_by_its_temperature() -> None:
    hot = [(5.0, RIDING), (20.0, {"faults": {"motor_warmer_k": 103.0}})]
    columns = simulated_ride(hot)
    # The observer sees the winding; the unit reads its spoiled sensor.
    warmer = np.arange(len(columns["speed_kmh"])) * LOOK_S >= 5.0
    columns["motor_temperature_degc"] = columns["motor_temperature_degc"] + 103.0 * warmer
    told = evidence(columns)
    only_warm = evidence({n: v for n, v in columns.items() if n != "limit_flags"})

    (finding,) = answer(told, "derating").findings
    assert finding.severity == "warning", "most of these 25 s"
    assert finding.numbers["motor_temperature_degc_max"] > 110.0
    (by_heat,) = answer(only_warm, "derating").findings
    assert by_heat.from_s == pytest.approx(5.0, abs=LOOK_S)
    assert finding.from_s == pytest.approx(5.0, abs=0.1)


def test_a_speed_that_no_tyre_can_make_is_found() -> None:
    speed = columns_of("commute")["speed_kmh"].copy()
    speed[2000:2010] = 55.0
    (finding,) = answer(commute(speed_kmh=speed), "implausible_speed").findings

    assert (finding.kind, finding.channel) == ("speed_jump", "speed_kmh")
    assert finding.numbers["acceleration_ms2"] > 9.81
    assert 39.0 < finding.from_s < finding.to_s < 41.0


def test_a_wheel_that_stands_under_turning_cranks_is_found() -> None:
    columns = columns_of("commute")
    pushing = np.flatnonzero((columns["cadence_rpm"] > 40) & (columns["rider_torque_nm"] > 15))
    first = int(pushing[500])
    speed = columns["speed_kmh"].copy()
    speed[first : first + 300] = 0.0
    found = answer(commute(speed_kmh=speed), "implausible_speed").findings

    silent = [finding for finding in found if finding.kind == "speed_silent"]
    assert len(silent) == 1
    assert silent[0].numbers["seconds"] == pytest.approx(6.0, abs=1.5)


def track(wheel_share: float, noise_m: float = 2.0, bend_m: float = 0.0) -> Evidence:
    """20 min at 25 km/h on a sphere, whose wheel tells wheel_share of the way."""
    at_s = np.arange(1200.0)
    way_m = 25.0 / 3.6 * at_s
    heading = way_m / bend_m if bend_m else np.zeros(len(at_s))
    step = np.diff(way_m, prepend=0.0)
    x_m, y_m = np.cumsum(step * np.cos(heading)), np.cumsum(step * np.sin(heading))
    # A receiver's error wanders over a minute.
    random = np.random.default_rng(4)
    wander = np.convolve(
        random.normal(0.0, noise_m, len(at_s) + 59), np.ones(60) / 60**0.5, "valid"
    )
    latitude = 47.0 + np.degrees((y_m + wander) / EARTH_M)
    longitude = 8.0 + np.degrees((x_m + wander) / (EARTH_M * np.cos(np.radians(47.0))))
    columns = {
        "latitude_deg": latitude,
        "longitude_deg": longitude,
        "speed_kmh": np.full(len(at_s), 25.0 * wheel_share),
    }
    return Evidence(columns, at_s, np.ones(len(at_s)), LIMITS)


def test_a_wrong_wheel_is_found_by_the_positions() -> None:
    # 2.2 m are set, the wheel rolls 2.09 m: it tells 5.3 % too much.
    (finding,) = answer(track(2.2 / 2.09), "wheel").findings

    assert finding.numbers["wheel_circumference_m_by_positions"] == pytest.approx(2.09, rel=0.01)
    assert finding.severity == "warning"
    assert answer(track(1.0), "wheel").state == "clean"


def test_bends_make_no_wheel_wrong_and_too_few_straights_tell_nothing() -> None:
    assert answer(track(1.0, bend_m=500.0), "wheel").state == "clean"
    assert answer(track(1.05, bend_m=15.0), "wheel").missing == ("straight_way",)
