"""The unit's own assist law for Python: surfaces, points and whole rides, batch first.

Configurations are dictionaries with the names and values of `firmware_protocol.parameters`;
a table needs only the five `fuzzy_*` parameters of its rules and points. Everything is float32, as
in the unit; results are the unit's, to the bit. Each call releases the interpreter's lock.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from firmware_protocol._generated import PARAMETER_BY_NAME, PARAMETERS, LimitFlags
from firmware_protocol.layout import Parameter
from firmware_protocol.parameter_values import BadValue
from firmware_protocol.parameters import default_config, pack_image, pack_parameter, violations
from firmware_protocol.spelling import word_of
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
        ("sensor_temperature_degc", np.float32),
        ("torque_age_ms", np.uint16),
        ("mode", np.uint8),
        ("brake", np.uint8),
        ("walk_button", np.uint8),
        ("inhibit", np.uint8),
    ],
    align=True,
)
LIMITS = {word_of(flag.name): int(flag) for flag in LimitFlags if flag.name}
"""Every limit of the registry and its bit in `limit_flags`."""
INPUT_DEFAULTS = {
    "battery_current_a": np.nan,
    "motor_temperature_degc": np.nan,
    "controller_temperature_degc": np.nan,
    "sensor_temperature_degc": np.nan,
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
        ("motor_torque_demanded_nm", np.float32),
        ("motor_torque_available_nm", np.float32),
        ("limit_flags", np.uint16),
    ],
    align=True,
)
OTHER_SOURCES = "The compiled extension is of other sources than law.py: run `make native`."
assert INPUT_DTYPE.itemsize == ffi.sizeof("assist_input"), OTHER_SOURCES
assert OUTPUT_DTYPE.itemsize == ffi.sizeof("assist_output"), OTHER_SOURCES

TRACE_STEPS = tuple(
    name.removeprefix("ASSIST_TRACE_").lower()
    for name in sorted(
        (name for name in dir(lib) if name.startswith("ASSIST_TRACE_")),
        key=lambda name: int(getattr(lib, name)),
    )[: lib.ASSIST_TRACE_STEPS]
)
"""The steps of the pipeline in their order: the names of assist_trace.h in lower case."""

VIOLATIONS_NAMED = 5
"""Of a configuration that is refused: enough to mend it by."""
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
    return FuzzyGain(table).points(speeds, rates)


class FuzzyGain:
    """One table's gain, for who asks more than once."""

    def __init__(self, table: Config) -> None:
        """table: the `fuzzy_*` parameters. Raises LawRefused for a table the unit refuses."""
        self._native = _native_table(table)

    def points(self, speeds_kmh: Floats, torque_rates: Floats) -> Floats:
        """Gain at single points, float32 (k,); NaN where a coordinate is not finite.

        speeds_kmh, torque_rates: float32 (k,) each, contiguous.
        """
        gains = np.empty(speeds_kmh.size, np.float32)
        lib.fuzzy_gain_run(
            self._native,
            ffi.from_buffer("float[]", speeds_kmh),
            ffi.from_buffer("float[]", torque_rates),
            ffi.from_buffer("float[]", gains, require_writable=True),
            gains.size,
        )
        return gains


@dataclass(frozen=True, slots=True)
class FiredRule:
    """A rule of a table that has a say: its cell, its label's index, and how much, above 0 to 1."""

    row: int
    column: int
    label: int
    weight: float


@dataclass(frozen=True, slots=True)
class Traced:
    """One step of the law and why.

    output: a value for each name of OUTPUT_DTYPE. result: `ok`, `input_refused` or `result_lost`.
    left_nm: torque at the crank that each of TRACE_STEPS left, zeros unless `ok`. walk: walk assist
    asked for it. rules: those behind the gain, none where the mode has none or the table was not
    asked because the torque falls.
    """

    output: dict[str, float]
    result: str
    left_nm: dict[str, float]
    walk: bool
    rules: tuple[FiredRule, ...]


RESULTS = {
    lib.ASSIST_OK: "ok",
    lib.ASSIST_INPUT_REFUSED: "input_refused",
    lib.ASSIST_RESULT_LOST: "result_lost",
}


class AssistLaw:
    """One instance of the law with its own memory, at rest until the first step."""

    def __init__(self, config: Config, step_s: float = STEP_S, in_range: bool = True) -> None:
        """config: every parameter of the law by its registry name; the unit's others may be there.

        Raises LawRefused if one of the law is missing, or in the unit's words for whatever the unit
        would refuse. Names that the registry does not have are not looked at. in_range: False to
        see what the law alone makes of a configuration that the unit's check does not let through.
        """
        self._config = native_config(config, step_s, in_range)
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

    def trace(self, inputs: npt.NDArray[np.void]) -> Traced:
        """The next step and why. inputs: INPUT_DTYPE (1,), contiguous."""
        output = np.empty(1, OUTPUT_DTYPE)
        trace = ffi.new("assist_trace *")
        result = lib.assist_step_traced(
            self._config,
            self._state,
            ffi.cast("assist_input *", ffi.from_buffer(inputs)),
            ffi.cast("assist_output *", ffi.from_buffer(output, require_writable=True)),
            trace,
        )
        told = {name: output[0][name].item() for name in OUTPUT_DTYPE.names or ()}
        return Traced(
            output=told,
            result=RESULTS[result],
            left_nm=dict(zip(TRACE_STEPS, trace.torque_nm, strict=True)),
            walk=bool(trace.walk),
            rules=self._rules(inputs[0], told) if result == lib.ASSIST_OK else (),
        )

    def hold(self, inputs: npt.NDArray[np.void], torque_rate: float, steps: int) -> None:
        """Steps in which nothing changes but that the torque keeps rising at a rate.

        No torque can do that for long; it is a question about a point of the table. inputs:
        INPUT_DTYPE (1,), contiguous. torque_rate: above -1. Below 0 the torque falls.
        """
        given = ffi.cast("assist_input *", ffi.from_buffer(inputs))
        output = ffi.new("assist_output *")
        lib.assist_hold(self._config, self._state, given, torque_rate, steps, output)

    def settle(
        self, inputs: npt.NDArray[np.void], torque_rates: Floats, steps: int
    ) -> npt.NDArray[np.void]:
        """What is given for long at points beside each other, OUTPUT_DTYPE (n,).

        inputs: INPUT_DTYPE (n,), contiguous. torque_rates: float32 (n,), contiguous, above -1; as
        of `hold`. steps: for each point; see hold.h.
        """
        outputs = np.empty(inputs.size, OUTPUT_DTYPE)
        lib.assist_settle(
            self._config,
            self._state,
            ffi.cast("assist_input *", ffi.from_buffer(inputs)),
            ffi.from_buffer("float[]", torque_rates),
            steps,
            ffi.cast("assist_output *", ffi.from_buffer(outputs, require_writable=True)),
            inputs.size,
        )
        return outputs

    def _rules(self, row: np.void, output: Mapping[str, float]) -> tuple[FiredRule, ...]:
        """The rules that made this gain, by the table of the row's mode."""
        second = self._config.mode_tables[row["mode"]]
        table = ffi.addressof(self._config, "second_table" if second else "table")
        point = (float(row["speed_kmh"]), output["torque_rate"])
        gain = ffi.new("float *")
        lib.fuzzy_gain(table, *point, gain)
        if gain[0] != output["fuzzy_gain"]:
            return ()
        fired = ffi.new("fuzzy_rule[]", lib.FUZZY_RULES_FIRED_MAX)
        count = lib.fuzzy_rules_fired(table, *point, fired)
        return tuple(
            FiredRule(one.row, one.column, one.label, one.weight) for one in fired[0:count]
        )


def assist_run(
    config: Config,
    inputs: Mapping[str, npt.ArrayLike],
    step_s: float = STEP_S,
    in_range: bool = True,
) -> dict[str, npt.NDArray[Any]]:
    """A whole ride from rest through a fresh law.

    inputs: (n,) or one value for each name of INPUT_DTYPE; those of INPUT_DEFAULTS may be missing.
    Returns (n,) for each name of
    OUTPUT_DTYPE. in_range: as for AssistLaw. Raises LawRefused for a bad configuration or unequal
    lengths.
    """
    outputs = AssistLaw(config, step_s, in_range).run(pack_inputs(inputs))
    return {name: outputs[name] for name in OUTPUT_DTYPE.names or ()}


def rider_torque_nm(
    config: Config, torque_raw_counts: npt.ArrayLike, sensor_temperature_degc: npt.ArrayLike
) -> Floats:
    """What the unit makes of readings of its torque sensor, float32 (n,); NaN stays NaN.

    config: the parameters of the sensor; what is missing of them is as by default.
    torque_raw_counts: (n,). sensor_temperature_degc: (n,) or one; NaN is not corrected for.
    """
    native = native_config({**default_config(), **config})
    counts = _vector(torque_raw_counts, "torque_raw_counts")
    degc = _vector(np.broadcast_to(sensor_temperature_degc, counts.shape), "temperature")
    torques = np.empty(counts.size, np.float32)
    lib.assist_rider_torque_run(
        native,
        ffi.from_buffer("float[]", counts),
        ffi.from_buffer("float[]", degc),
        ffi.from_buffer("float[]", torques, require_writable=True),
        torques.size,
    )
    return torques


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
        packed[name] = _integer_or_largest(column, kind) if kind.kind == "u" else column
    return packed


def _numbers(values: npt.ArrayLike, name: str) -> npt.NDArray[Any]:
    numbers = np.asarray(values)
    if numbers.dtype.kind not in "fiub" or numbers.ndim > 1:
        raise LawRefused(f"{name}: a vector of numbers is needed, not {numbers.dtype}")
    return numbers


def _integer_or_largest(numbers: npt.NDArray[Any], kind: np.dtype[Any]) -> npt.NDArray[Any]:
    """What is missing or does not fit becomes the largest: a mode the law refuses, a brake that is
    pulled, a reading that is too old."""
    largest = np.iinfo(kind).max
    with np.errstate(invalid="ignore"):
        fits = (numbers >= 0) & (numbers <= largest)
    return np.where(fits, numbers, largest).astype(kind)


def _vector(values: npt.ArrayLike, name: str) -> Floats:
    return np.ascontiguousarray(np.atleast_1d(_numbers(values, name)), np.float32)


DEFAULT_IMAGE = pack_image(default_config())
TABLE_PARAMETERS = tuple(
    row
    for row in PARAMETERS
    if row.name
    in (
        "fuzzy_inference",
        "fuzzy_speed_points_kmh",
        "fuzzy_torque_rate_points",
        "fuzzy_gain_points",
        "fuzzy_rules",
    )
)


def _law_of(image: bytes) -> Any:
    """The assist_config of an image, by the unit's own mapping."""
    config = ffi.new("ebl_config *")
    lib.ebl_config_unpack(config, image)
    native = ffi.new("assist_config *")
    lib.config_law_from(config, native)
    return native


def _is_read_by_the_law(row: Parameter, law_of_default: bytes) -> bool:
    """Whether another value of this parameter makes another assist_config."""
    changed = bytearray(DEFAULT_IMAGE)
    for at in range(row.image_offset, row.image_offset + row.size):
        changed[at] ^= 1
    return _bytes_of(_law_of(bytes(changed))) != law_of_default


def _bytes_of(native: Any) -> bytes:
    return bytes(ffi.buffer(native))


def _law_parameters() -> tuple[Parameter, ...]:
    law_of_default = _bytes_of(_law_of(DEFAULT_IMAGE))
    return tuple(row for row in PARAMETERS if _is_read_by_the_law(row, law_of_default))


LAW_PARAMETERS = _law_parameters()
"""The parameters that the unit maps to the law's configuration."""


def _image_of(config: Config, rows: Iterable[Parameter], what: str) -> bytes:
    """The image of these parameters, with the defaults of all others. Raises LawRefused."""
    image = bytearray(DEFAULT_IMAGE)
    for row in rows:
        if row.name not in config:
            raise LawRefused(f"{what}: {row.name} is missing")
        try:
            packed = pack_parameter(row, config[row.name])
        except BadValue as wrong:
            raise LawRefused(f"{what}: {wrong}") from wrong
        image[row.image_offset : row.image_offset + row.size] = packed
    return bytes(image)


def _refuse_violations(given: Config, what: str) -> None:
    """Raises LawRefused in the unit's words for what it would refuse."""
    found = violations(given, complete=False)
    if found:
        raise LawRefused(f"{what}: {' '.join(one.message for one in found[:VIOLATIONS_NAMED])}")


def _native_table(table: Config) -> Any:
    """The first table of a configuration, checked. Raises LawRefused."""
    given = {row.name: table[row.name] for row in TABLE_PARAMETERS if row.name in table}
    _refuse_violations(given, "fuzzy table")
    law = _law_of(_image_of(table, TABLE_PARAMETERS, "fuzzy table"))
    native = ffi.new("fuzzy_table *", law.table)
    if lib.fuzzy_table_check(native) != lib.FUZZY_OK:
        raise LawRefused("fuzzy table: the unit's own check refuses it")
    return native


def law_defaults() -> dict[str, Any]:
    """The configuration the firmware brings, by registry name."""
    return dict(default_config())


OF_THE_BIKE = frozenset(row.name for row in PARAMETERS if row.record in ("CALIBRATION", "FACTORY"))
"""What says how sensor, wheel and drivetrain are made: it is measured, not chosen."""


def parameter_range(name: str) -> tuple[float, float]:
    """The least and the most of a number that the unit takes. Raises KeyError for no number."""
    row = PARAMETER_BY_NAME[name]
    if row.min is None or row.max is None:
        raise KeyError(name)
    return float(row.min), float(row.max)


def law_image(config: Config, tables_only: bool = False) -> bytes:
    """The bytes of what the law reads of a configuration, and the defaults of all else.

    Two configurations that the law cannot tell apart have the same. tables_only: of both fuzzy
    tables alone. Raises LawRefused.
    """
    rows = [
        row
        for row in LAW_PARAMETERS
        if row.name in config and (not tables_only or row.name.startswith(("fuzzy_", "second_")))
    ]
    return _image_of(config, rows, "configuration")


def native_config(config: Config, step_s: float = STEP_S, in_range: bool = True) -> Any:
    """The assist_config of a configuration, as AssistLaw takes it. Raises LawRefused."""
    if in_range:
        known = {name: value for name, value in config.items() if name in PARAMETER_BY_NAME}
        _refuse_violations(known, "configuration")
    given = [row for row in LAW_PARAMETERS if row.name in config or row.id < FIRST_LATER_ID]
    native = _law_of(_image_of(config, given, "configuration"))
    native.step_s = step_s
    if lib.assist_config_check(native) != lib.ASSIST_OK:
        raise LawRefused("configuration: a value is not finite or physically impossible")
    return native
