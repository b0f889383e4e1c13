"""Goal: the estimate of a ride with another table is told with its band and its trust, and refused
with the reason where nobody should believe it.

Method: a simulated ride over a known road, kept in a real store; then the same ride, spoilt. How
near the estimate is to the truth: tests/acceptance/test_the_same_road_again.py.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from backend.core.assist_mode import AssistModes
from backend.core.channels import Values
from backend.errors import InvalidRequest, RequestRefused
from backend.law import law_defaults
from backend.law.rider_and_bike import RiderAndBike
from backend.rides.replay import ride_again
from backend.rides.replay.ride_again import RideAgain
from backend.rides.replay.service import RideReplay
from backend.store import Store
from backend.tuning.preview import Preview
from firmware_protocol._generated import InputFlags
from tests.fakes.kept_rides import config_of, imported_ride
from tests.fakes.known_roads import Outside, Ridden, road

pytestmark = pytest.mark.slow

PERIOD_US = 10_000
SPORT = 3
FIGURES = (
    "wh_per_km",
    "motor_work_wh",
    "battery_wh",
    "km_per_100_wh",
    "rider_work_wh",
    "duration_s",
    "motor_power_w_mean",
    "ripple_nm_per_s",
)


@cache
def sport() -> dict[str, Values]:
    """A ride in sport, as a unit records it."""
    return as_recorded(Ridden(road(601), SPORT))


def as_recorded(ridden: Ridden) -> dict[str, Values]:
    columns = ridden.columns
    columns["input_flags"] = columns.pop("brake") * float(InputFlags.BRAKE)
    columns["motor_torque_demanded_nm"] = columns["motor_torque_nm"]
    del columns["distance_m"]
    return columns


def kept(store: Store, columns: dict[str, Values]) -> int:
    """The id of a ride of these channels, (n,) each."""
    return imported_ride(store, columns, PERIOD_US)


def again(store: Store, columns: dict[str, Values], **question: Any) -> dict[str, Any]:
    """The estimate for a ride of these channels, (n,) each."""
    return RideAgain(store, config_of)(kept(store, columns), **question)


def distance_km(columns: dict[str, Values]) -> float:
    return float(columns["speed_kmh"].sum()) * PERIOD_US / 1e6 / 3600.0


def modes_with_ratio(ratio: float) -> dict[str, Any]:
    modes = AssistModes.from_parameters(law_defaults()).to_json()
    modes["modes"][SPORT] |= {"law": "fixed", "ratio": ratio, "taper": "none"}
    return modes


def test_without_a_change_there_is_no_difference_and_the_record_lies_in_the_band(
    store: Store,
) -> None:
    columns = sport()

    closed = again(store, columns)

    assert abs(closed["trust"]["no_change_error_pct"]) < 1.0
    assert abs(closed["trust"]["no_change_time_error_pct"]) < 3.0
    assert closed["trust"]["one_gear"]
    for name in FIGURES:
        figure = closed[name]
        assert figure["difference"] == pytest.approx(0.0, abs=1e-9)
        assert figure["low"] <= figure["recorded"] <= figure["high"]
    at_limits = {row["limit"]: row for row in closed["limits"]}
    # In sport on flat road the cut-off is always at work somewhere; the ride did not record it.
    assert at_limits["speed_cutoff"]["replayed_s"] > 1.0
    assert at_limits["speed_cutoff"]["recorded_s"] is None
    watts = columns["motor_torque_nm"] * columns["motor_speed_rpm"] * np.pi / 30.0
    assert closed["motor_work_wh"]["recorded"] == pytest.approx(
        watts.sum() * PERIOD_US / 1e6 / 3600.0, rel=1e-3
    )


def test_the_open_loop_tells_of_the_record_what_the_closed_one_tells(store: Store) -> None:
    ride_id = kept(store, sport())
    opened = RideReplay(Preview(), config_of)(store.rides.reader(ride_id))
    closed = RideAgain(store, config_of)(ride_id)

    for name in ("wh_per_km", "motor_work_wh", "motor_power_w_mean", "ripple_nm_per_s"):
        assert opened[name]["recorded"] == pytest.approx(closed[name]["recorded"], rel=2e-3)


@pytest.mark.parametrize("lost_s", [(0.0, 0.3), (10.0, 10.3), (60.0, 60.3)])
def test_rows_that_were_lost_are_no_stop(store: Store, lost_s: tuple[float, float]) -> None:
    first, end = (round(t_s * 1e6 / PERIOD_US) for t_s in lost_s)
    columns = {name: values.copy() for name, values in sport().items()}
    for values in columns.values():
        values[first:end] = np.nan

    trust = again(store, columns)["trust"]

    assert abs(trust["no_change_error_pct"]) < 1.0
    assert abs(trust["no_change_time_error_pct"]) < 3.0


def test_less_help_takes_less_work_and_longer(store: Store) -> None:
    closed = again(store, sport(), assist_modes=modes_with_ratio(0.4))

    for name in ("wh_per_km", "motor_work_wh", "battery_wh", "motor_power_w_mean"):
        assert closed[name]["difference"] < 0.0
        assert closed[name]["low"] <= closed[name]["replayed"] <= closed[name]["high"]
    assert closed["duration_s"]["difference"] > 0.0
    way_km = closed["km_per_100_wh"]
    assert way_km["difference"] > 0.0
    assert way_km["replayed"] == pytest.approx(
        100.0 * distance_km(sport()) / closed["battery_wh"]["replayed"], rel=1e-3
    )


def test_the_three_rides_are_told_over_the_same_places(store: Store) -> None:
    columns = sport()

    curves = again(store, columns, assist_modes=modes_with_ratio(0.4))["curves"]

    km = curves["distance_km"]
    assert len(km) <= 400
    assert min(np.diff(km)) * 1000.0 > 6.0
    recorded, unchanged, replayed = (
        {name: np.array(values, float) for name, values in curves[ride].items()}
        for ride in ("recorded", "unchanged", "replayed")
    )
    # The mean of a stretch over its time is its length.
    length_m = np.nansum(recorded["speed_kmh"] / 3.6 * np.gradient(recorded["t_s"]))
    assert length_m == pytest.approx(distance_km(columns) * 1000.0, rel=0.05)
    apart_kmh = np.abs(unchanged["speed_kmh"] - recorded["speed_kmh"])
    assert np.nanmedian(apart_kmh) < 0.2
    assert np.nanmean(replayed["speed_kmh"] - unchanged["speed_kmh"]) < -0.2
    assert np.nanmean(replayed["motor_torque_nm"] - unchanged["motor_torque_nm"]) < 0.0


def test_time_at_a_limit_is_the_recorded_one_and_what_the_change_adds(store: Store) -> None:
    columns = {**sport(), "limit_flags": np.zeros(len(sport()["speed_kmh"]))}

    unchanged = again(store, columns)["limits"]

    assert unchanged == []


def test_a_battery_that_was_not_measured_has_no_estimate(store: Store) -> None:
    columns = {name: values for name, values in sport().items() if "battery" not in name}

    closed = again(store, columns)

    assert closed["battery_wh"] is None
    assert closed["km_per_100_wh"] is None


def test_what_is_told_of_bike_and_rider_narrows_the_band(store: Store) -> None:
    def width(told: RiderAndBike) -> float:
        answer = again(store, sport(), assist_modes=modes_with_ratio(0.4), rider_and_bike=told)
        figure = answer["duration_s"]
        return float(figure["high"] - figure["low"])

    assert width(RiderAndBike(mass_kg=92.0, drag_area_m2=0.5)) < width(RiderAndBike())


def test_who_shifted_shifts_again_and_that_is_told(store: Store) -> None:
    bike = Outside(cogs=(11, 13, 15, 17, 19, 21, 24, 28, 32, 37, 42))
    columns = as_recorded(Ridden(road(601), SPORT, outside=bike))

    closed = again(store, columns, assist_modes=modes_with_ratio(0.4))

    assert not closed["trust"]["one_gear"]
    work = closed["motor_work_wh"]
    assert work["low"] < work["replayed"] < work["high"]
    assert work["difference"] == pytest.approx(work["replayed"] - work["recorded"])


def test_settings_beside_tables_and_modes_are_ridden_with_as_well(store: Store) -> None:
    wide_band = again(store, sport(), parameters={"assist_cutoff_band_kmh": 4.0})
    slow_filter = again(store, sport(), parameters={"torque_filter_s": 1.0})

    # Sport rides near the cut-off: a wider band takes help there. A slow filter follows no stroke.
    assert wide_band["wh_per_km"]["difference"] < 0.0
    assert slow_filter["ripple_nm_per_s"]["difference"] < 0.0


def test_sensor_and_drivetrain_stay_as_they_were_on_the_ride(store: Store) -> None:
    of_another_bike = {"sensor_gain_nm_per_count": 0.02, "gear_ratio": 20.0}

    closed = again(store, sport(), parameters={**law_defaults(), **of_another_bike})

    for name in FIGURES:
        assert closed[name]["difference"] == pytest.approx(0.0, abs=1e-9)


def test_what_no_unit_takes_is_refused_before_the_road_is_ridden(store: Store) -> None:
    with pytest.raises(InvalidRequest) as refused:
        again(store, sport(), parameters={"torque_filter_s": 99.0})

    assert refused.value.code == "replay_refused"


def test_an_estimate_that_nobody_waits_for_ends_with_the_ride_of_the_moment(store: Store) -> None:
    asked = []

    def check_connected() -> None:
        asked.append(1)
        if len(asked) == 5:
            raise RequestRefused("gone")

    with pytest.raises(RequestRefused, match="gone"):
        again(store, sport(), check_connected=check_connected)

    # Of the forty rides of the band.
    assert len(asked) == 5


def asked_only(columns: dict[str, Values]) -> None:
    del columns["motor_torque_demanded_nm"]


def faulty(columns: dict[str, Values]) -> None:
    faults = np.zeros(len(columns["speed_kmh"]))
    faults[100] = 1.0
    columns["fault_flags"] = faults


def holed(columns: dict[str, Values]) -> None:
    columns["speed_kmh"][2000:3000] = np.nan


def of_another_motor(columns: dict[str, Values]) -> None:
    columns["motor_torque_nm"] *= 1.5


def pushed_by_hand(columns: dict[str, Values]) -> None:
    columns["speed_kmh"][2000:12_000] = 4.0


def never_pedalled(columns: dict[str, Values]) -> None:
    columns["rider_torque_raw"][:] = 0.0


@pytest.mark.parametrize(
    ("spoil", "code"),
    [
        (asked_only, "not_delivered"),
        (faulty, "faults"),
        (holed, "holes"),
        (of_another_motor, "twin_differs"),
        (pushed_by_hand, "too_slow_to_tell"),
        (never_pedalled, "no_pedalling"),
    ],
)
def test_what_cannot_be_trusted_is_refused_with_the_reason(
    store: Store, spoil: Any, code: str
) -> None:
    columns = {name: values.copy() for name, values in sport().items()}
    spoil(columns)

    with pytest.raises(InvalidRequest) as refused:
        again(store, columns)

    assert refused.value.code == code
    assert "cannot be ridden again" in str(refused.value)


def test_a_ride_of_half_a_day_is_refused_before_it_takes_a_thread(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ride_again, "LONGEST_S", len(sport()["speed_kmh"]) * 0.01 - 1.0)

    with pytest.raises(InvalidRequest) as refused:
        again(store, sport())

    assert refused.value.code == "ride_too_long"
