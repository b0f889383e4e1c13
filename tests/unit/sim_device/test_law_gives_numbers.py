"""Goal: no configuration that the unit takes, and no reading, makes the law give anything but a
number within every limit; and what is no number in spite of all gives no torque, and stays nowhere.

Method: configurations drawn at the edges of every parameter (least distances, denormals, points
that are a step apart only before rounding) ride through the whole pipeline on readings at their own
edges. The limits are written down again here, from the market's rules and the motor's equations of
thesis 4.8 and 4.9. Then NaN and infinity are put into each value the law remembers, and into
configurations that were never checked.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sim_device.firmware.python._native import ffi, lib

from firmware_protocol._generated import PARAMETER_BY_NAME, Market
from firmware_protocol.parameters import default_config, violations
from firmware_protocol.spelling import words_of
from sim_device.firmware.python.law import (
    OUTPUT_DTYPE,
    STEP_S,
    LawRefused,
    gain_points,
    native_config,
    pack_inputs,
)
from tests import counts
from tests.fakes.accepted_laws import DENORMAL, accepted_config, points_of, readings

SWEEP_CONFIGS = counts.of(4000)
SWEEP_STEPS = 60
EXAMPLES = counts.of(1500)
RAD_PER_S_PER_RPM = math.pi / 30.0
ROUNDING = 1e-4
"""Room for float32: the limits here are computed in double."""

# docs/safety.md and EN 15194, SI 2015/24, US classes, Japan's regulation 1-3, GB 17761: km/h, then
# shaft power at any moment. A continuous rating may be passed by ten times what the mean is below.
CUTOFF_KMH = {"eu_epac": 25.0, "uk": 24.945, "us_class_1": 32.187, "us_class_2": 32.187}
CUTOFF_KMH |= {"us_class_3": 45.062, "japan": 24.0, "china": 25.0}
PEAK_W = {"eu_epac": 2750.0, "uk": 2750.0, "china": 4400.0}
PEAK_W |= {"us_class_1": 750.0, "us_class_2": 750.0, "us_class_3": 750.0}
FAULT = 0x2000

REPORTED: dict[str, Any] = {
    "fuzzy_gain_points": [k * DENORMAL for k in range(5)],
    "fuzzy_rules": [["NS"] * 5] * 5,
    "fuzzy_inference": "mamdani_centroid",
}
"""The table that made the gain 0/0 and the motor give every limit's maximum."""

STATE_FLOATS = [
    name for name, field in ffi.typeof("assist_state").fields if field.type.cname == "float"
]
STATE_ARRAYS = ["torque_history_nm", "push_peak_nm"]
TURN_FLOATS = ["mean_nm", "part_sum_nm", "part_turned"]
PEDALLING = {
    "torque_raw_counts": 3000.0,
    "speed_kmh": 12.0,
    "cadence_rpm": 60.0,
    "motor_speed_rpm": 2000.0,
    "battery_voltage_v": 36.0,
    "mode": 3,
    "brake": 0,
}


def run(
    config: dict[str, Any], rows: npt.NDArray[np.void], state: Any = None, checked: bool = True
) -> tuple[list[int], npt.NDArray[np.void], Any]:
    """Result codes, outputs and what the law remembers after the rows."""
    native = native_config(config) if checked else unchecked(config)
    state = ffi.new("assist_state *") if state is None else state
    outputs = np.empty(len(rows), OUTPUT_DTYPE)
    inputs = ffi.cast("assist_input *", ffi.from_buffer(rows))
    given = ffi.cast("assist_output *", ffi.from_buffer(outputs, require_writable=True))
    codes = [lib.assist_step(native, state, inputs + k, given + k) for k in range(len(rows))]
    return codes, outputs, state


def unchecked(config: dict[str, Any]) -> Any:
    """A configuration the law refuses, put before it all the same."""
    native = native_config({**config, **{name: default_config()[name] for name in REPORTED}})
    native.table.gain_points = config["fuzzy_gain_points"]
    native.table.rules = [[1] * 5] * 5
    native.table.inference = 0
    return native


def remembered(state: Any) -> list[float]:
    plain = [getattr(state, name) for name in STATE_FLOATS]
    plain += [getattr(state.turn, name) for name in TURN_FLOATS] + list(state.turn.part_nm)
    return plain + [value for name in STATE_ARRAYS for value in getattr(state, name)]


def allowed_nm(config: dict[str, Any], row: np.void, push_nm: float) -> float:
    """The most the motor may give for this reading, as the documents have it."""
    row = {name: float(row[name]) for name in row.dtype.names}
    mode, market = int(row["mode"]), config["market"]
    extra_kmh = config["assist_cutoff_extra_kmh"] if CUTOFF_KMH[market] > 25.001 else 0.0
    stop_kmh = min(config["assist_cutoff_kmh"] + extra_kmh, CUTOFF_KMH[market])
    if (
        row["brake"]
        or row["inhibit"]
        or row["speed_kmh"] >= stop_kmh * (1 + ROUNDING)
        or row["battery_voltage_v"] < config["battery_voltage_v_min"]
        or row["motor_speed_rpm"] >= config["motor_speed_rpm_max"]
    ):
        return 0.0
    limits = [config["motor_torque_nm_max"] * config["mode_torque_pct"][mode] / 100]
    rad_s = max(row["motor_speed_rpm"], 0.0) * RAD_PER_S_PER_RPM
    constant, ohm = config["motor_torque_constant_nm_per_a"], config["motor_resistance_ohm"]
    watt = min(row["battery_voltage_v"], 36.0) * config["battery_current_a_max"]
    back_emf_v = constant * rad_s
    amps = 2 * watt / (back_emf_v + math.sqrt(back_emf_v**2 + 4 * ohm * watt))
    limits.append(constant * amps)
    limits.append(max(0.0, constant * (row["battery_voltage_v"] - back_emf_v) / ohm))
    if rad_s > 0 and market in PEAK_W:
        limits.append(PEAK_W[market] / rad_s)
    if market == "japan":
        ratio = 2.0 if row["speed_kmh"] < 10 else max(0.0, 2 - (row["speed_kmh"] - 10) / 7)
        # Two float32 near two are subtracted: the last digits of the ratio are rounding.
        limits.append((ratio + 1e-6) * max(push_nm, 0.0) / config["gear_ratio"])
    return min(limits)


def judge(config: dict[str, Any], rows: npt.NDArray[np.void]) -> int:
    """Every step of a ride keeps every limit. Returns how many gave torque."""
    codes, outputs, state = run(config, rows)
    driven = 0
    for code, row, output in zip(codes, rows, outputs, strict=True):
        motor_nm = float(output["motor_torque_nm"])
        assert code in (lib.ASSIST_OK, lib.ASSIST_INPUT_REFUSED)
        assert math.isfinite(motor_nm)
        assert motor_nm >= 0.0
        if code == lib.ASSIST_INPUT_REFUSED:
            assert motor_nm == 0.0
            continue
        most_nm = allowed_nm(config, row, float(np.nan_to_num(output["rider_torque_nm"])))
        assert motor_nm <= most_nm * (1 + ROUNDING) + DENORMAL, (config, row, output)
        for name in ("rider_torque_filtered_nm", "torque_rate", "assist_ratio"):
            assert math.isfinite(output[name]), name
        gain = float(output["fuzzy_gain"])
        assert math.isnan(gain) or 0.0 <= gain <= 0.5
        fuzzy = config["mode_laws"][row["mode"]] == "fuzzy"
        assert fuzzy or math.isnan(gain)
        driven += motor_nm > 0
    assert all(map(math.isfinite, remembered(state)))
    return driven


def test_the_table_that_became_every_limits_maximum_is_refused_everywhere() -> None:
    assert [found.code for found in violations({**default_config(), **REPORTED})] == [
        "NOT_INCREASING"
    ] * 4

    with pytest.raises(LawRefused, match=r"at least 0\.001 above"):
        native_config({**default_config(), **REPORTED})


def test_put_before_the_law_unchecked_it_gives_no_torque_and_says_so() -> None:
    rows = pack_inputs({name: [value] * 200 for name, value in PEDALLING.items()})

    codes, outputs, state = run({**default_config(), **REPORTED}, rows, checked=False)

    assert set(codes) == {lib.ASSIST_RESULT_LOST}
    assert not outputs["motor_torque_nm"].any()
    assert set(outputs["limit_flags"]) == {FAULT}
    assert remembered(state) == [0.0] * len(remembered(state))


@pytest.mark.parametrize("hurt", [math.nan, math.inf, -math.inf], ids=str)
@pytest.mark.parametrize("name", [*STATE_FLOATS, *STATE_ARRAYS, *TURN_FLOATS, "part_nm"])
def test_what_is_remembered_and_no_number_costs_one_step_and_is_gone(
    name: str, hurt: float
) -> None:
    rows = pack_inputs({name: [value] * 1000 for name, value in PEDALLING.items()})
    _, before, state = run(default_config(), rows)
    if name in TURN_FLOATS:
        setattr(state.turn, name, hurt)
    elif name == "part_nm":
        state.turn.part_nm = [hurt] * len(state.turn.part_nm)
    elif name in STATE_ARRAYS:
        setattr(state, name, [hurt] * len(getattr(state, name)))
    else:
        setattr(state, name, hurt)

    codes, hurt_steps, state = run(default_config(), rows[:64], state)
    codes_after, after, state = run(default_config(), rows, state)

    assert all(math.isfinite(value) for value in hurt_steps["motor_torque_nm"])
    assert hurt_steps["motor_torque_nm"].max() <= before["motor_torque_nm"].max() * (1 + ROUNDING)
    lost = np.array(codes) == lib.ASSIST_RESULT_LOST
    assert lost.sum() <= 1
    assert not hurt_steps["motor_torque_nm"][lost].any()
    assert set(codes_after) == {lib.ASSIST_OK}
    assert all(map(math.isfinite, remembered(state)))
    np.testing.assert_allclose(after[-1]["motor_torque_nm"], before[-1]["motor_torque_nm"], 1e-3)


@pytest.mark.large_count
@pytest.mark.slow
def test_every_accepted_configuration_keeps_every_limit_on_every_reading() -> None:
    random = np.random.default_rng(20261121)

    driven = sum(
        judge(accepted_config(random), readings(random, SWEEP_STEPS)) for _ in range(SWEEP_CONFIGS)
    )

    assert driven > SWEEP_CONFIGS


@pytest.mark.large_count
@pytest.mark.slow
def test_what_the_law_alone_would_take_gives_numbers_too() -> None:
    """The law's own check is wider than the registry: a millionth to a million."""
    random = np.random.default_rng(7)
    steps = 0

    for _ in range(SWEEP_CONFIGS):
        native = native_config(accepted_config(random))
        for name, field in ffi.typeof("assist_config").fields:
            if field.type.cname == "float" and random.random() < 0.2:
                kept = getattr(native, name)
                setattr(native, name, random.choice([0.0, 1e-6, 0.01, 1.0, 1e6]))
                if lib.assist_config_check(native) != lib.ASSIST_OK:
                    setattr(native, name, kept)
        rows, state = readings(random, 20), ffi.new("assist_state *")
        inputs, output = (
            ffi.cast("assist_input *", ffi.from_buffer(rows)),
            ffi.new("assist_output *"),
        )
        for k in range(len(rows)):
            assert lib.assist_step(native, state, inputs + k, output) != lib.ASSIST_RESULT_LOST
            assert 0.0 <= output.motor_torque_nm <= native.motor_torque_nm_max * (1 + ROUNDING)
            steps += output.motor_torque_nm > 0.0

    assert steps > 100


@pytest.mark.large_count
@settings(max_examples=EXAMPLES, deadline=None)
@given(st.integers(0, 2**32 - 1))
@pytest.mark.slow
def test_no_configuration_and_ride_that_hypothesis_finds_breaks_a_limit(seed: int) -> None:
    random = np.random.default_rng(seed)

    judge(accepted_config(random), readings(random, 8))


@pytest.mark.large_count
@settings(max_examples=EXAMPLES, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.floats(width=32, allow_nan=False, allow_infinity=False),
    st.floats(width=32, allow_nan=False, allow_infinity=False),
    st.sampled_from(["mamdani_centroid", "weighted_average"]),
)
@pytest.mark.slow
def test_every_accepted_table_has_a_gain_within_its_points_everywhere(
    seed: int, speed_kmh: float, rate: float, inference: str
) -> None:
    random = np.random.default_rng(seed)
    rows = [PARAMETER_BY_NAME[f"fuzzy_{name}"] for name in ("speed_points_kmh",)]
    rows += [PARAMETER_BY_NAME["fuzzy_torque_rate_points"], PARAMETER_BY_NAME["fuzzy_gain_points"]]
    table = {row.name: points_of(row, random) for row in rows}
    labels = random.choice(["NB", "NS", "ZO", "PS", "PB"], (5, 5)).tolist()
    table |= {"fuzzy_inference": inference, "fuzzy_rules": labels}
    if violations({**default_config(), **table}):
        return
    edges = np.array([*table["fuzzy_speed_points_kmh"], speed_kmh, 0.0, DENORMAL], np.float32)
    rates = np.array([*table["fuzzy_torque_rate_points"], rate, 0.0, DENORMAL], np.float32)

    gains = gain_points(table, np.repeat(edges, len(rates)), np.tile(rates, len(edges)))

    assert np.isfinite(gains).all()
    assert gains.min() >= 0.0
    assert gains.max() <= 0.5


@pytest.mark.parametrize("name", ["fuzzy_speed_points_kmh", "fuzzy_torque_rate_points"])
@pytest.mark.slow
def test_registry_and_law_agree_on_every_distance_around_the_least(name: str) -> None:
    row = PARAMETER_BY_NAME[name]
    random = np.random.default_rng(5)
    verdicts = set()

    for _ in range(300):
        start = np.float32(random.uniform(0.0, row.max or 0.0) * 0.8)
        points = [start, start + np.float32(row.least_step * 0.99)]
        for _ in range(random.integers(0, 4)):
            points[1] = np.nextafter(points[1], np.float32([0, 50][random.integers(2)]))
        points += [points[1] + np.float32(k * row.least_step * 1.1) for k in (1, 2, 3)]
        config = {**default_config(), name: [float(point) for point in points]}
        taken = not violations(config)
        verdicts.add(taken)
        try:
            native_config(config)
            assert taken
        except LawRefused:
            assert not taken

    assert verdicts == {True, False}


def test_steps_that_were_not_run_let_the_ramps_begin_at_nothing() -> None:
    rows = pack_inputs({name: [value] * 1000 for name, value in PEDALLING.items()})
    _, before, state = run(default_config(), rows)

    lib.assist_interrupted(state)
    _, after, _ = run(default_config(), rows[:1], state)

    rise_nm = default_config()["assist_ramp_up_nm_per_s"] * STEP_S / 40.34  # type: ignore[operator]
    assert before[-1]["motor_torque_nm"] > 0.5
    assert 0 < after[0]["motor_torque_nm"] <= rise_nm * (1 + ROUNDING)


def test_every_market_of_the_registry_is_judged() -> None:
    assert set(CUTOFF_KMH) == set(words_of(Market))
