"""Goal: a check passes, fails, or says why it could not be done; what the unit itself calls faulty
has failed, whatever it reads.

Method: readings as units give them; the bounds are those at which the unit counts a fault itself
(TORQUE_DRIFT at 3 Nm, TORQUE_LINK after 250 ms, no assist above 110 degC in the motor).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from backend.device.readings import ConfigSlot, WearCounters
from backend.visits.checks import Readings, UnitCheck, checks_of

AT_REST = {
    "rider_torque_nm": 0.4,
    "speed_kmh": 0.0,
    "motor_speed_rpm": 0.0,
    "torque_age_ms": 12.0,
    "battery_voltage_v": 36.9,
    "motor_temperature_degc": 31.0,
    "controller_temperature_degc": 35.0,
}
SLOTS = (ConfigSlot("confirmed", 5, 7, True), ConfigSlot("void", 4, 6, False))
WEAR = WearCounters(1_204_000, 400_000, 1_204_000, 400_000, SLOTS, False)
LINK = {"balance_built": 900, "balance_received": 900, "balance_lost": 0, "balance_dropped": 0}
DRIFT: dict[str, Any] = {
    "act_nm": 3.0,
    "level": "ok",
    "latest": {"ride_id": 7, "started_at": "2026-11-22T14:58:00Z", "zero_nm": 0.42},
    "rides": [{"zero_nm": 0.42}, {"zero_nm": None}, {"zero_nm": 0.3}],
    "trend": None,
}
SOUND = Readings(AT_REST, (), WEAR, LINK, DRIFT, 31.0)


def check(name: str, **other: Any) -> UnitCheck:
    """One check of the sound unit with other readings."""
    if "channels" in other:
        other["channels"] = AT_REST | other["channels"]
    return next(one for one in checks_of(replace(SOUND, **other)) if one.name == name)


def test_a_sound_unit_passes_every_check() -> None:
    assert [one.passed for one in checks_of(SOUND)] == [True] * 8


@pytest.mark.parametrize(
    ("name", "channel", "passes", "fails"),
    [
        ("zero", "rider_torque_nm", -3.0, -3.1),
        ("rotor", "torque_age_ms", 250.0, 251.0),
        ("battery", "battery_voltage_v", 31.0, 30.9),
        ("motor", "motor_temperature_degc", 110.0, 110.5),
        ("controller", "controller_temperature_degc", 85.0, 85.5),
    ],
)
def test_a_reading_passes_up_to_its_bound(
    name: str, channel: str, passes: float, fails: float
) -> None:
    assert check(name, channels={channel: passes}).passed is True
    assert check(name, channels={channel: fails}).passed is False


def test_what_is_missing_now_and_what_is_never_sent_are_told_apart() -> None:
    without = {key: value for key, value in AT_REST.items() if key != "rider_torque_nm"}

    missing = check("zero", channels={"rider_torque_nm": None})
    never = checks_of(replace(SOUND, channels=without))[0]

    assert (missing.passed, missing.not_done) == (None, "no_reading")
    assert (never.passed, never.not_done) == (None, "not_sent")


def test_the_zero_is_not_known_while_the_bike_moves() -> None:
    for moving in ({"speed_kmh": 12.0}, {"motor_speed_rpm": 400.0}):
        riding = check("zero", channels={"rider_torque_nm": 25.0, **moving})
        assert (riding.passed, riding.not_done) == (None, "moving")


@pytest.mark.parametrize("fault", ["torque_sensor", "torque_stuck", "torque_link"])
def test_a_sensor_that_the_unit_calls_faulty_has_failed(fault: str) -> None:
    for reading in (None, 0.0):
        found = check("zero", channels={"rider_torque_nm": reading}, faults_active=(fault,))
        assert (found.passed, found.fault, found.value) == (False, fault, reading)
    moving = check("zero", channels={"speed_kmh": 12.0}, faults_active=(fault,))
    assert moving.passed is False


def test_the_rides_show_how_the_zero_holds() -> None:
    assert check("drift").evidence == {
        "ride_id": 7,
        "started_at": "2026-11-22T14:58:00Z",
        "rides": 2,
        "per_month_nm": None,
        "level": "ok",
    }
    trend = {"per_month_nm": {"value": 0.2}}
    moved = check("drift", drift=DRIFT | {"level": "watch", "trend": trend})
    assert (moved.passed, (moved.evidence or {})["per_month_nm"]) == (True, 0.2)
    assert check("drift", drift=DRIFT | {"level": "act"}).passed is False
    none = check("drift", drift=DRIFT | {"level": None, "latest": None})
    assert (none.passed, none.not_done) == (None, "no_ride_shows_it")


def test_a_damaged_place_in_the_flash_and_lost_frames_fail() -> None:
    damaged = replace(WEAR, config_slots=(SLOTS[0], replace(SLOTS[1], state="damaged")))
    assert check("flash", wear=damaged).passed is False
    assert check("flash", wear=replace(WEAR, runs_on_default=True)).passed is False
    assert (check("flash").evidence or {})["erases"] == 13
    lost = check("line", link=LINK | {"balance_lost": 2, "balance_dropped": 1})
    assert (lost.passed, lost.evidence) == (False, {"built": 900, "lost": 3})


def test_a_unit_that_counts_nothing_has_these_checks_undone() -> None:
    """Of another make: no flash of ours, no account of the stream, no known least voltage."""
    other = replace(SOUND, wear=None, link={}, drift=None, battery_v_min=None)
    undone = {one.name: one.not_done for one in checks_of(other) if one.passed is None}
    assert undone == {
        "drift": "not_known",
        "battery": "not_known",
        "flash": "not_sent",
        "line": "not_sent",
    }
