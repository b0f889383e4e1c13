"""One phase of a ride: what rider, road, air and faults do; names as in TOML and the controls."""

from dataclasses import dataclass, fields
from typing import Any

Value = float | int | str

RIDER_KINDS = {"off": 0, "constant": 1, "legs": 2}
TORQUE_SENSOR_FAULTS = {"sound": 0, "stuck": 1, "open_high": 2, "open_low": 3, "drifting": 4}
SPEED_SENSOR_FAULTS = {"sound": 0, "lost": 1, "stuck": 2}

# What a person, a road and a part can do; beyond it a typing error is likelier than a wish.
TORQUE_NM_MAX = 300.0
CADENCE_RPM_MAX = 250.0
GRADE_DEG_MAX = 30.0
WIND_MS_MAX = 40.0
DYNO_NM_MAX = 200.0
PHASE_S_MAX = 36_000.0
# A phase in metres ends without them when the bike has been slower than one is pushed, from a
# standing start: nobody waits for one that stands.
STALL_KMH = 2.0
STALL_S = 30.0
PHASE_M_MAX = (PHASE_S_MAX - STALL_S) * STALL_KMH / 3.6
WARMER_K_MAX = 300.0


class ScenarioError(ValueError):
    """A scenario, a setting or a control value that does not exist or is out of its range.

    field: where in the question the fault is (`rider.torque_nm`), empty where it is in no field.
    """

    def __init__(self, message: str, field: str = "") -> None:
        super().__init__(message)
        self.field = field


@dataclass(frozen=True)
class Setting:
    """One value a measured scenario can be run with."""

    default: Value
    doc: str = ""
    min: float | None = None
    max: float | None = None
    choices: tuple[Value, ...] = ()

    def read(self, where: str, given: object) -> Value:
        """`given`, a text from the command line included, as a value of this setting.

        Raises ScenarioError, naming `where`, what was given and what is allowed.
        """
        value = self._typed(where, given)
        if self.choices and value not in self.choices:
            allowed = ", ".join(str(choice) for choice in self.choices)
            raise ScenarioError(f"{where} is {given!r}; it can be: {allowed}", where)
        if isinstance(value, str):
            return value
        below = self.min is not None and not value >= self.min
        above = self.max is not None and not value <= self.max
        if below or above:
            message = f"{where} is {given}; it lies from {self.min} to {self.max}"
            raise ScenarioError(message, where)
        return value

    def _typed(self, where: str, given: object) -> Value:
        wanted = type(self.default)
        try:
            if isinstance(given, str):
                return wanted(given)
            if wanted is float and isinstance(given, int | float) and not isinstance(given, bool):
                return float(given)
            if wanted is int and isinstance(given, int) and not isinstance(given, bool):
                return given
        except ValueError:
            pass
        kind = {int: "a whole number", float: "a number", str: "a text"}[wanted]
        raise ScenarioError(f"{where} is {given!r}, not {kind}", where)


@dataclass(frozen=True)
class Phase:
    """What rider, road and faults do for `seconds`, or over `metres`. None: as the bike has it."""

    seconds: float | None = None
    metres: float | None = None
    rider: str = "off"
    torque_nm: float = 0.0
    cadence_rpm_max: float = 100.0
    grade_deg: float = 0.0
    wind_ms: float = 0.0
    dyno_nm: float | None = None
    brake: bool = False
    walk_button: bool = False
    assist_mode: int | None = None
    ambient_degc: float | None = None
    grip: float | None = None
    bit_error_rate: float | None = None
    burst_share: float | None = None
    coupling: float | None = None
    torque_sensor: str = "sound"
    speed_sensor: str = "sound"
    link_lost: bool = False
    motor_hall: bool = False
    battery_cut: bool = False
    motor_warmer_k: float = 0.0
    controller_warmer_k: float = 0.0
    pulses_missed: float = 0.0

    @property
    def seconds_max(self) -> float:
        """After which it ends, whatever the bike has done."""
        if self.metres is None:
            return self.seconds or 0.0
        return STALL_S + self.metres * 3.6 / STALL_KMH

    @property
    def faults(self) -> dict[str, Value]:
        """What is broken, by the names of the controls; empty on a sound bike."""
        given = {name: getattr(self, name) for name in FAULTS}
        return {name: value for name, value in given.items() if value != _SOUND[name]}


FAULTS = (
    "torque_sensor",
    "speed_sensor",
    "link_lost",
    "motor_hall",
    "battery_cut",
    "motor_warmer_k",
    "controller_warmer_k",
    "pulses_missed",
    "bit_error_rate",
    "burst_share",
    "coupling",
)
_SOUND = {field.name: field.default for field in fields(Phase)}

_FLAGS = ("brake", "walk_button", "link_lost", "motor_hall", "battery_cut")
_RANGES = {
    "seconds": Setting(1.0, min=0.01, max=PHASE_S_MAX),
    "metres": Setting(1.0, min=0.1, max=PHASE_M_MAX),
    "rider": Setting("off", choices=tuple(RIDER_KINDS)),
    "torque_nm": Setting(0.0, min=-TORQUE_NM_MAX, max=TORQUE_NM_MAX),
    "cadence_rpm_max": Setting(100.0, min=0.0, max=CADENCE_RPM_MAX),
    "grade_deg": Setting(0.0, min=-GRADE_DEG_MAX, max=GRADE_DEG_MAX),
    "wind_ms": Setting(0.0, min=-WIND_MS_MAX, max=WIND_MS_MAX),
    "dyno_nm": Setting(0.0, min=0.0, max=DYNO_NM_MAX),
    "assist_mode": Setting(0, min=0, max=4),
    "ambient_degc": Setting(20.0, min=-40.0, max=60.0),
    "grip": Setting(0.0, min=0.0, max=2.0),
    "bit_error_rate": Setting(0.0, min=0.0, max=0.5),
    "burst_share": Setting(0.0, min=0.0, max=1.0),
    "coupling": Setting(1.0, min=0.0, max=1.0),
    "torque_sensor": Setting("sound", choices=tuple(TORQUE_SENSOR_FAULTS)),
    "speed_sensor": Setting("sound", choices=tuple(SPEED_SENSOR_FAULTS)),
    "motor_warmer_k": Setting(0.0, min=-WARMER_K_MAX, max=WARMER_K_MAX),
    "pulses_missed": Setting(0.0, min=0.0, max=1.0),
    "controller_warmer_k": Setting(0.0, min=-WARMER_K_MAX, max=WARMER_K_MAX),
}


def read_phase_value(where: str, name: str, given: object) -> Any:
    """One value of a phase, checked; used for live controls too. Raises ScenarioError."""
    if name in _FLAGS:
        if not isinstance(given, bool):
            raise ScenarioError(f"{where} is {given!r}, not true or false", where)
        return given
    if name not in _RANGES:
        known = ", ".join([*_RANGES, *_FLAGS])
        raise ScenarioError(f"{where} is not known; there are: {known}", where)
    return _RANGES[name].read(where, given)
