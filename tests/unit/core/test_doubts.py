"""Goal: figures that disagree, and what nobody can do, are doubtful; a ride that agrees is not.

Method: rides along a meridian at a constant speed, whose figures follow from their making; then one
thing at a time is made wrong.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from backend.core.channels import Values
from backend.core.device_metadata import DeviceFigure, DeviceMetadata, DeviceSession, Lap
from backend.core.distance import row_distances
from backend.core.doubts import Doubt, Evidence, doubts_of
from backend.core.intake import Intake
from backend.core.ride import summarise

DEG_M = 111_195.0
SECONDS = 1800


def ridden(kmh: float = 25.2, wheel: float = 1.0, noise_m: float = 0.0) -> dict[str, Values]:
    """Half an hour due north. wheel: what the wheel counts of the way."""
    at_m = np.arange(SECONDS) * kmh / 3.6
    stray = np.random.default_rng(1).normal(0.0, noise_m, (2, SECONDS)) / DEG_M
    return {
        "speed_kmh": np.full(SECONDS, kmh * wheel),
        "latitude_deg": 48.0 + at_m / DEG_M + stray[0],
        "longitude_deg": 11.0 + stray[1],
        "rider_power_w": np.full(SECONDS, 150.0),
    }


def evidence(columns: dict[str, Values], **more: object) -> Evidence:
    start_s: Values = np.arange(SECONDS, dtype=np.float64)
    seconds = np.ones(SECONDS)
    summary = summarise(columns, (start_s * 1e6).astype(np.int64), 1_000_000)
    distances = row_distances(columns, start_s, seconds)
    bare = Evidence(columns, start_s, seconds, distances, summary, None, {}, None, DeviceMetadata())
    return replace(bare, **more)  # type: ignore[arg-type]


def codes(ride: Evidence) -> list[str]:
    return [doubt.code for doubt in doubts_of(ride)]


def only(ride: Evidence) -> Doubt:
    (doubt,) = doubts_of(ride)
    return doubt


@pytest.mark.parametrize("noise_m", [0.0, 5.0])
def test_a_ride_that_agrees_with_itself_is_not_doubtful(noise_m: float) -> None:
    """Also with a receiver that is 5 m off all the time."""
    assert codes(evidence(ridden(noise_m=noise_m))) == []


@pytest.mark.parametrize("wheel", [1 / 3.6, 0.8, 1.25, 1.609344])
def test_a_wheel_in_other_units_shows_beside_the_track(wheel: float) -> None:
    doubt = only(evidence(ridden(kmh=18.0, wheel=wheel)))

    assert (doubt.code, doubt.unit) == ("wheel_and_track", "km")
    assert doubt.against == pytest.approx(9.0, rel=0.01)
    assert doubt.figure == pytest.approx(9.0 * wheel, rel=0.01)


def test_positions_that_nobody_could_ride_are_no_reason_to_believe_the_wheel() -> None:
    """All of them: 18 km/h by the wheel, 540 km/h by positions of another scale."""
    columns = ridden(kmh=18.0)
    columns["latitude_deg"] = 48.0 + 30.0 * (columns["latitude_deg"] - 48.0)

    doubt = only(evidence(columns))

    assert (doubt.code, doubt.figure) == ("wheel_and_track", pytest.approx(9.0, rel=0.01))
    assert doubt.against == pytest.approx(270.0, rel=0.01)


def test_a_receiver_at_rest_that_wanders_is_no_distance() -> None:
    """An hour at a café: the wheel stands, the receiver is 5 m off to all sides."""
    columns = ridden(noise_m=5.0)
    columns["speed_kmh"][600:] = 0.0
    stray = columns["latitude_deg"][600:] - np.linspace(
        columns["latitude_deg"][600], columns["latitude_deg"][-1], SECONDS - 600
    )
    columns["latitude_deg"][600:] = columns["latitude_deg"][600] + 0.2 * stray

    assert codes(evidence(columns)) == []


def session(**figures: float) -> DeviceMetadata:
    told = tuple(DeviceFigure(name, value) for name, value in figures.items())
    return DeviceMetadata(statements=(DeviceSession(0.0, SECONDS - 1.0, told),))


def test_sums_of_the_device_are_laid_beside_ours() -> None:
    km = 25.2 / 2
    right = {"total_distance": 1000 * km, "total_timer_time": 1800.0, "total_work": 270_000.0}
    assert codes(evidence(ridden(), metadata=session(**right))) == []

    for name, code in (
        ("total_distance", "stated_distance"),
        ("total_timer_time", "stated_time"),
        ("total_work", "stated_work"),
    ):
        wrong = right | {name: right[name] * 1.3}
        doubt = only(evidence(ridden(), metadata=session(**wrong)))
        assert doubt.code == code
        assert doubt.against == pytest.approx(1.3 * doubt.figure, rel=0.01)


def test_laps_that_cover_the_ride_state_its_sums_and_half_of_them_do_not() -> None:
    laps = tuple(
        Lap(from_s, from_s + 600.0, None, 600.0, 7000.0) for from_s in (0.0, 600.0, 1200.0)
    )

    doubt = only(evidence(ridden(), metadata=DeviceMetadata(laps=laps)))

    assert (doubt.code, doubt.against) == ("stated_distance", 21.0)
    assert codes(evidence(ridden(), metadata=DeviceMetadata(laps=laps[:1]))) == []


def test_a_session_that_reaches_beyond_the_ride_states_nothing_of_it() -> None:
    whole = (DeviceFigure("total_distance", 80_000.0),)
    metadata = DeviceMetadata(statements=(DeviceSession(-3600.0, 3600.0, whole),))

    assert codes(evidence(ridden(), metadata=metadata)) == []


def test_what_was_left_out_is_doubtful_when_it_is_much() -> None:
    few = Intake(1800, 1790, rows_dropped={"no_time": 10}, values_dropped={"speed_kmh": 5})
    many = Intake(2800, 1800, rows_dropped={"no_time": 1000}, values_dropped={"speed_kmh": 1000})
    strap = Intake(1800, 1800, values_dropped={"heart_rate_bpm": 1800})

    assert codes(evidence(ridden(), intake=few)) == []
    assert codes(evidence(ridden(), intake=strap)) == []
    rows, values = doubts_of(evidence(ridden(), intake=many))
    assert (rows.code, rows.figure, rows.against) == ("rows_left_out", 1000.0, 2800.0)
    assert (values.code, values.channel) == ("values_left_out", "speed_kmh")


def test_a_car_is_not_ridden() -> None:
    assert codes(evidence(ridden(kmh=80.0))) == ["mean_speed"]
    columns = ridden()
    columns["speed_kmh"][900] = 112.0
    assert codes(evidence(columns)) == ["speed"]
    track = {name: values for name, values in ridden(kmh=80.0).items() if name != "speed_kmh"}
    assert codes(evidence(track)) == ["mean_speed"]


def test_no_rider_gives_the_power_of_a_motor() -> None:
    doubt = only(evidence(ridden(), power_w_best={5: 700.0, 60: 690.0, 300: 680.0, 1200: 640.0}))

    assert (doubt.code, doubt.figure, doubt.against, doubt.seconds) == (
        "power",
        640.0,
        500.0,
        1200.0,
    )
    assert codes(evidence(ridden(), power_w_best={5: 1400.0, 1200: 420.0, 300: None})) == []


def test_heights_that_jump_are_no_climb() -> None:
    assert codes(evidence(ridden(), ascent_m=2500.0)) == ["climb_rate"]
    assert codes(evidence(ridden(kmh=5.0), ascent_m=900.0)) == ["climb_share"]
    assert codes(evidence(ridden(), ascent_m=600.0)) == []


def test_a_motor_gives_no_more_than_its_battery() -> None:
    columns = ridden() | {
        "motor_power_w": np.full(SECONDS, 300.0),
        "battery_power_w": np.full(SECONDS, 200.0),
    }

    doubt = only(evidence(columns))

    assert (doubt.code, doubt.figure, doubt.against) == ("motor_work", 150.0, 100.0)
    columns["battery_power_w"] = np.full(SECONDS, 380.0)
    assert codes(evidence(columns)) == []
    # Half of the battery's work was not measured.
    columns["battery_power_w"][::2] = np.nan
    assert codes(evidence(columns)) == []
