"""The unit's own assist law for Python: surfaces, points and whole rides, batch first.

Configurations are dictionaries with the names and values of `firmware_protocol.parameters`;
a table needs only the five `fuzzy_*` parameters of its rules and points. Everything is float32, as
in the unit; results are the unit's, to the bit. Each call releases the interpreter's lock.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from firmware_protocol._generated import (
    PARAMETERS,
    FallingTorque,
    Inference,
    Label,
    Law,
    Market,
    Taper,
)
from firmware_protocol.parameters import default_config
from sim_device.firmware.python._native import ffi, lib

ENGINE = "sim_device/firmware/control (C99, float32)"
STEP_S = 0.01
"""The unit's control period: registry `control_period_us`."""

Floats = npt.NDArray[np.float32]
Config = Mapping[str, Any]

INPUT_DTYPE = np.dtype(
    [
        ("torque_raw_counts", np.float32),
        ("speed_kmh", np.float32),
        ("cadence_rpm", np.float32),
        ("motor_speed_rpm", np.float32),
        ("battery_voltage_v", np.float32),
        ("battery_current_a", np.float32),
        ("motor_temperature_degc", np.float32),
        ("controller_temperature_degc", np.float32),
        ("torque_age_ms", np.uint16),
        ("mode", np.uint8),
        ("brake", np.uint8),
        ("walk_button", np.uint8),
        ("inhibit", np.uint8),
    ],
    align=True,
)
INPUT_DEFAULTS = {
    "battery_current_a": np.nan,
    "motor_temperature_degc": np.nan,
    "controller_temperature_degc": np.nan,
    "torque_age_ms": 0,
    "walk_button": 0,
    "inhibit": 0,
}
"""What a ride need not tell: not measured, fresh, not pressed, no fault."""

OUTPUT_DTYPE = np.dtype(
    [
        ("rider_torque_nm", np.float32),
        ("rider_torque_filtered_nm", np.float32),
        ("torque_rate", np.float32),
        ("assist_ratio", np.float32),
        ("fuzzy_gain", np.float32),
        ("motor_torque_nm", np.float32),
        ("limit_flags", np.uint16),
    ],
    align=True,
)
assert INPUT_DTYPE.itemsize == ffi.sizeof("assist_input")
assert OUTPUT_DTYPE.itemsize == ffi.sizeof("assist_output")

# Parameters that are one float in assist_config under the same name.
PLAIN_PARAMETERS = (
    "sensor_offset_counts",
    "sensor_gain_nm_per_count",
    "torque_filter_s",
    "torque_rate_floor_nm",
    "fixed_taper_start_kmh",
    "fixed_taper_end_kmh",
    "assist_ramp_up_nm_per_s",
    "assist_ramp_down_nm_per_s",
    "pedal_torque_nm_min",
    "assist_cutoff_kmh",
    "assist_cutoff_band_kmh",
    "motor_torque_nm_max",
    "battery_current_a_max",
    "battery_voltage_v_min",
    "motor_speed_rpm_max",
    "gear_ratio",
    "motor_torque_constant_nm_per_a",
    "motor_resistance_ohm",
    "walk_speed_kmh",
    "assist_cutoff_extra_kmh",
)
FIRST_LATER_ID = 0x0600
"""Parameters from here on may be missing, as in the configuration of an old ride."""


class LawRefused(ValueError):
    """The law does not take this table, configuration or input; the message says what is wrong."""


def gain_surface(table: Config, speeds_kmh: npt.ArrayLike, torque_rates: npt.ArrayLike) -> Floats:
    """Fuzzy gain over a grid, float32 (n, m), rows = speeds.

    table: the `fuzzy_*` parameters. speeds_kmh: (n,). torque_rates: (m,). A non-finite coordinate
    gives NaN. Raises LawRefused for a table the unit refuses.
    """
    speeds = _vector(speeds_kmh, "speeds_kmh")
    rates = _vector(torque_rates, "torque_rates")
    gains = gain_points(table, np.repeat(speeds, rates.size), np.tile(rates, speeds.size))
    return gains.reshape(speeds.size, rates.size)


def gain_points(table: Config, speeds_kmh: npt.ArrayLike, torque_rates: npt.ArrayLike) -> Floats:
    """Fuzzy gain at single points, float32 (k,); NaN where a coordinate is not finite.

    table: the `fuzzy_*` parameters. speeds_kmh, torque_rates: (k,) each. Raises LawRefused for a
    table the unit refuses or vectors of unequal length.
    """
    speeds = _vector(speeds_kmh, "speeds_kmh")
    rates = _vector(torque_rates, "torque_rates")
    if speeds.size != rates.size:
        raise LawRefused(f"{speeds.size} speeds but {rates.size} torque rates; give pairs")
    native = ffi.new("fuzzy_table *")
    _fill_table(native, table)
    gains = np.empty(speeds.size, np.float32)
    lib.fuzzy_gain_run(
        native,
        ffi.from_buffer("float[]", speeds),
        ffi.from_buffer("float[]", rates),
        ffi.from_buffer("float[]", gains, require_writable=True),
        gains.size,
    )
    return gains


class AssistLaw:
    """One instance of the law with its own memory, at rest until the first step."""

    def __init__(self, config: Config, step_s: float = STEP_S) -> None:
        """config: every parameter of the law by its registry name; others are not looked at.

        Raises LawRefused if a parameter is missing or the unit would refuse the configuration.
        """
        self._config = native_config(config, step_s)
        self._state = ffi.new("assist_state *")

    def run(self, inputs: npt.NDArray[np.void]) -> npt.NDArray[np.void]:
        """The next steps in a row. inputs: INPUT_DTYPE (n,), contiguous -> OUTPUT_DTYPE (n,).

        A refused step has zero torque, NaN for the rider's torque and INPUT_REFUSED in its flags.
        """
        if inputs.dtype != INPUT_DTYPE or inputs.ndim != 1 or not inputs.flags.c_contiguous:
            raise LawRefused("inputs must be one contiguous vector of INPUT_DTYPE")
        outputs = np.empty(inputs.size, OUTPUT_DTYPE)
        if inputs.size:
            lib.assist_run(
                self._config,
                self._state,
                ffi.cast("assist_input *", ffi.from_buffer(inputs)),
                ffi.cast("assist_output *", ffi.from_buffer(outputs, require_writable=True)),
                inputs.size,
            )
        return outputs

    def step(self, **readings: float) -> dict[str, float]:
        """One control step. readings: a value for each name of INPUT_DTYPE -> OUTPUT_DTYPE's."""
        row = self.run(pack_inputs({name: [value] for name, value in readings.items()}))[0]
        return {name: row[name].item() for name in OUTPUT_DTYPE.names or ()}


def assist_run(
    config: Config, inputs: Mapping[str, npt.ArrayLike], step_s: float = STEP_S
) -> dict[str, npt.NDArray[Any]]:
    """A whole ride from rest through a fresh law.

    inputs: (n,) or one value for each name of INPUT_DTYPE; those of INPUT_DEFAULTS may be missing.
    Returns (n,) for each name of
    OUTPUT_DTYPE. Raises LawRefused for a bad configuration or unequal lengths.
    """
    outputs = AssistLaw(config, step_s).run(pack_inputs(inputs))
    return {name: outputs[name] for name in OUTPUT_DTYPE.names or ()}


def steady_ratios(config: Config, mode: int, speeds_kmh: npt.ArrayLike) -> Floats:
    """Assist per rider torque a mode asks for at each speed while the torque is steady, (n,).

    config: what the mode is; parameters that are missing have their defaults. Raises LawRefused.
    """
    inputs = {
        "torque_raw_counts": 0.0,
        "speed_kmh": speeds_kmh,
        "cadence_rpm": 60.0,
        "motor_speed_rpm": 0.0,
        "battery_voltage_v": 36.0,
        "mode": mode,
        "brake": 0,
    }
    ratios: Floats = assist_run({**default_config(), **config}, inputs)["assist_ratio"]
    return ratios


def pack_inputs(inputs: Mapping[str, npt.ArrayLike]) -> npt.NDArray[np.void]:
    """Vectors or single values by name -> INPUT_DTYPE (n,). Raises LawRefused."""
    names = INPUT_DTYPE.names or ()
    inputs = {**INPUT_DEFAULTS, **inputs}
    if set(inputs) != set(names):
        wrong = ", ".join(sorted(set(inputs) ^ set(names)))
        raise LawRefused(f"inputs missing or unknown: {wrong}; the law takes {', '.join(names)}")
    columns = {name: _numbers(inputs[name], name) for name in names}
    lengths = {column.size for column in columns.values() if column.ndim == 1}
    if len(lengths) > 1:
        raise LawRefused(f"inputs of unequal lengths: {sorted(lengths)}")
    packed = np.empty(lengths.pop() if lengths else 1, INPUT_DTYPE)
    for name, column in columns.items():
        kind = INPUT_DTYPE[name]
        packed[name] = _whole_or_largest(column, kind) if kind.kind == "u" else column
    return packed


def _numbers(values: npt.ArrayLike, name: str) -> npt.NDArray[Any]:
    numbers = np.asarray(values)
    if numbers.dtype.kind not in "fiub" or numbers.ndim > 1:
        raise LawRefused(f"{name}: a vector of numbers is needed, not {numbers.dtype}")
    return numbers


def _whole_or_largest(numbers: npt.NDArray[Any], kind: np.dtype[Any]) -> npt.NDArray[Any]:
    """What is missing or does not fit becomes the largest: a mode the law refuses, a brake that is
    pulled, a reading that is too old."""
    largest = np.iinfo(kind).max
    with np.errstate(invalid="ignore"):
        fits = (numbers >= 0) & (numbers <= largest)
    return np.where(fits, numbers, largest).astype(kind)


def _vector(values: npt.ArrayLike, name: str) -> Floats:
    return np.ascontiguousarray(np.atleast_1d(_numbers(values, name)), np.float32)


def _fill_table(native: Any, table: Config) -> None:
    try:
        native.inference = Inference[table["fuzzy_inference"]]
        native.speed_points_kmh = table["fuzzy_speed_points_kmh"]
        native.torque_rate_points = table["fuzzy_torque_rate_points"]
        native.gain_points = table["fuzzy_gain_points"]
        native.rules = [[Label[label] for label in row] for row in table["fuzzy_rules"]]
    except KeyError as missing:
        raise LawRefused(f"fuzzy table: {missing} is missing or not a choice") from missing
    except (TypeError, IndexError) as wrong:
        raise LawRefused(f"fuzzy table: {wrong}") from wrong
    if lib.fuzzy_table_check(ffi.addressof(native[0])) != lib.FUZZY_OK:
        raise LawRefused(
            "fuzzy table: points must be finite and increasing, speeds by 0.1 km/h, torque rates "
            "and gains by 0.001 at least, gains between 0 and 0.5"
        )


def _second_table(config: Config) -> Config:
    """The second table as the first one's parameters: it shares the points of speed and rate."""
    return {
        **config,
        "fuzzy_inference": config["second_inference"],
        "fuzzy_gain_points": config["second_gain_points"],
        "fuzzy_rules": config["second_rules"],
    }


def _fill_modes(native: Any, config: Config) -> None:
    native.mode_laws = [Law[name] for name in config["mode_laws"]]
    native.mode_ratios = config["mode_ratios"]
    native.mode_tapers = [Taper[name] for name in config["mode_tapers"]]
    native.mode_tables = config["mode_tables"]
    native.mode_ramp_up_nm_per_s = config["mode_ramp_up_nm_per_s"]
    native.mode_ramp_down_nm_per_s = config["mode_ramp_down_nm_per_s"]
    native.mode_torque_share = [pct / 100 for pct in config["mode_torque_pct"]]


def law_defaults() -> dict[str, Any]:
    """The configuration the firmware brings, by registry name."""
    return dict(default_config())


def native_config(config: Config, step_s: float = STEP_S) -> Any:
    """The assist_config of a configuration, as AssistLaw takes it. Raises LawRefused."""
    defaults = default_config()
    later = {row.name: defaults[row.name] for row in PARAMETERS if row.id >= FIRST_LATER_ID}
    config = {**later, **config}
    native = ffi.new("assist_config *")
    native.step_s = step_s
    _fill_table(ffi.addressof(native, "table"), config)
    _fill_table(ffi.addressof(native, "second_table"), _second_table(config))
    try:
        for name in PLAIN_PARAMETERS:
            setattr(native, name, config[name])
        native.torque_rate_interval_s = config["torque_rate_interval_ms"] / 1000
        native.pedal_stop_s = config["pedal_stop_ms"] / 1000
        _fill_modes(native, config)
        native.market = Market[config["market"]]
        native.fuzzy_falling_torque = FallingTorque[config["fuzzy_falling_torque"]]
    except KeyError as missing:
        raise LawRefused(f"configuration: {missing} is missing or not a choice") from missing
    except (TypeError, IndexError) as wrong:
        raise LawRefused(f"configuration: {wrong}") from wrong
    if lib.assist_config_check(native) != lib.ASSIST_OK:
        raise LawRefused("configuration: a value is not finite or physically impossible")
    return native
