"""A tiny unit as services see it: what it cannot do it leaves to the base class to refuse."""

from __future__ import annotations

import json
import time
import zlib
from collections.abc import Mapping

from backend.core.channels import ChannelSpec
from backend.device.capability import Capability
from backend.device.configuration import (
    ConfigImage,
    ParameterRow,
    ParameterTable,
    ParameterValues,
    Value,
)
from backend.device.conversation import Operation
from backend.device.driver import Driver, LinkOpener, Listener
from backend.device.readings import Snapshot, named_values
from backend.device.unit import Unit
from backend.errors import ConfigConflict, DeviceRefused, FieldError, NoAnswer, PeerProtocolError
from tests.fakes.tiny.conversation import CHANNELS, TinyConversation, read_values
from tests.fakes.tiny.motor import SETTINGS

ANSWER_S = 5.0
SENSORS = ("cadence", "torque")


def _row(number: int, name: str, unit: str, low: int, high: int) -> ParameterRow:
    return ParameterRow(
        id=number,
        name=name,
        group="basic",
        type="u8",
        shape=(),
        unit=unit,
        min=low,
        max=high,
        default=SETTINGS[number],
        access="dealer",
        choices=None,
        length=None,
        description=f"Setting {number}.",
    )


ROWS = (
    _row(1, "speed_limit_kmh", "km/h", 5, 45),
    _row(2, "battery_current_max_a", "A", 1, 30),
    _row(3, "wheel_diameter_in", "in", 16, 30),
    _row(4, "assist_levels", "", 3, 9),
    _row(5, "start_current_pct", "%", 1, 100),
    _row(6, "pedal_stop_ms", "ms", 50, 2000),
    _row(7, "battery_low_v", "V", 20, 60),
    ParameterRow(
        8, "pedal_sensor", "basic", "enum", (), "", None, None, SENSORS[1], "dealer", SENSORS, None,
        "Setting 8.",
    ),
)  # fmt: skip
NUMBERS = {row.name: row.id for row in ROWS}


def _faults_of(config: ParameterValues) -> list[FieldError]:
    faults = []
    for row in ROWS:
        value = config[row.name]
        if row.choices is not None:
            if value not in row.choices:
                message = f"{row.name} is {value!r}; it is one of {', '.join(row.choices)}."
                faults.append(FieldError(row.name, "unknown_choice", message))
        elif not isinstance(value, int | float) or not _within(value, row):
            message = f"{row.name} is {value!r}; it is from {row.min} to {row.max} {row.unit}."
            faults.append(FieldError(row.name, "out_of_range", message))
    return faults


def _within(value: float, row: ParameterRow) -> bool:
    return row.min is not None and row.max is not None and row.min <= value <= row.max


def _count_of(row: ParameterRow, value: Value) -> int:
    if row.choices is not None:
        return row.choices.index(str(value))
    assert isinstance(value, int | float)
    return round(value)


def _value_of(row: ParameterRow, count: int) -> Value:
    return count if row.choices is None else row.choices[count]


class TinyParameters(ParameterTable):
    """What it has."""

    rows = ROWS

    def faults_of(self, config: ParameterValues) -> list[FieldError]:
        return _faults_of(config)

    def rounded(self, config: ParameterValues) -> dict[str, Value]:
        return {row.name: _value_of(row, _count_of(row, config[row.name])) for row in ROWS}

    def crc32_of(self, config: ParameterValues) -> int:
        return zlib.crc32(json.dumps([_count_of(row, config[row.name]) for row in ROWS]).encode())


TABLE = TinyParameters()


class TinyUnit(Unit):
    """One tiny unit and its thread."""

    family = "tiny"

    def __init__(
        self,
        opener: LinkOpener,
        listener: Listener,
        streaming: bool = True,
        reopen_when_silent: bool = True,
        schemas: object = None,
    ) -> None:
        conversation = TinyConversation(time.monotonic(), streaming)
        super().__init__(Driver(opener, listener, conversation, reopen_when_silent))

    @property
    def capabilities(self) -> frozenset[Capability]:
        return frozenset(
            {
                Capability.READ_CONFIG,
                Capability.WRITE_CONFIG,
                Capability.STREAM,
                Capability.RESTART_TO_APPLY,
            }
        )

    @property
    def parameters(self) -> ParameterTable:
        return TABLE

    @property
    def channels(self) -> tuple[ChannelSpec, ...]:
        return CHANNELS

    def values(self) -> Snapshot:
        counts = self.run(read_values(), ANSWER_S)
        # It has no clock: the moment is ours.
        return Snapshot(time.monotonic_ns() // 1000, named_values(CHANNELS, counts))

    def read_config(self) -> ConfigImage:
        return self.run(read_config(), ANSWER_S)

    def write_config(
        self, base: ConfigImage, changes: ParameterValues, confirm_s: int = 0, permit: object = None
    ) -> ConfigImage:
        return self.run(write_config(base, changes), ANSWER_S)

    def outcome_of_write(self, base: ConfigImage, intended: ParameterValues) -> ConfigImage:
        found = self.read_config()
        if found.crc32 == base.crc32:
            raise NoAnswer("The unit was not reached; nothing changed.", outcome="unchanged")
        compare(intended, found)
        return found


def read_config() -> Operation[ConfigImage]:
    """Every setting, one by one."""
    parameters: dict[str, Value] = {}
    for row in ROWS:
        parameters[row.name] = _value_of(row, int((yield f"G {row.id}")))
    return ConfigImage(0, TABLE.crc32_of(parameters), parameters)


def write_config(base: ConfigImage, changes: ParameterValues) -> Operation[ConfigImage]:
    """Every setting that changes, then all of them read back. Raises as Unit.write_config."""
    if (yield from read_config()).crc32 != base.crc32:
        raise ConfigConflict("Somebody else changed the settings; read them again.")
    intended = {**base.parameters, **changes}
    for row in ROWS:
        if row.name in changes:
            told = yield f"S {row.id} {_count_of(row, changes[row.name])}"
            if told != "OK":
                raise DeviceRefused(f"The unit refuses {row.name}.", told)
    found = yield from read_config()
    compare(intended, found)
    return found


def compare(intended: Mapping[str, Value], found: ConfigImage) -> None:
    """Raise PeerProtocolError naming what reads back different."""
    faults = [
        FieldError(name, "reads_back_different", f"{name} is {found.parameters[name]} in the unit.")
        for name, value in intended.items()
        if found.parameters[name] != value
    ]
    if faults:
        raise PeerProtocolError("The unit did not keep what was written.", fields=faults)
