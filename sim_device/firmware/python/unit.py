"""The simulated drive unit through cffi: firmware and physics on one virtual clock.

`Unit` owns one C unit and frees it with itself. Time passes only in `advance_us`; nothing here
reads a clock, so the same calls give the same bytes.
"""

import math
from collections.abc import Callable, Iterable
from typing import Any, Final

from firmware_protocol._generated import Market
from sim_device.firmware.python._native import ffi, lib

FLASH_LENGTH: Final[int] = lib.UNIT_FLASH_SIZE
LOG_LENGTH: Final[int] = lib.UNIT_LOG_SIZE
LOG_BLOCK_LENGTH: Final[int] = lib.UNIT_LOG_BLOCK_SIZE
UID_LENGTH: Final[int] = lib.UNIT_UID_LENGTH
UNLOCK_KEY_LENGTH: Final[int] = lib.UNIT_UNLOCK_KEY_LENGTH
ASSIST_OUTPUT_LENGTH: Final[int] = ffi.sizeof("assist_output")
MODE_NOT_SELECTED: Final[int] = lib.UNIT_MODE_NOT_SELECTED

# One read takes what a line of 8 KiB can hold.
_TRANSMIT_CAPACITY = 8192

BoardRequest = Callable[[int, bytes], tuple[int, bytes]]


def _fields(struct_type: str) -> tuple[str, ...]:
    return tuple(name for name, _ in ffi.typeof(struct_type).fields)


_OBSERVED: Final[tuple[str, ...]] = _fields("unit_observation")
_BIKE_PARTS: Final[tuple[str, ...]] = _fields("physics_config")


# An exception in `answer` is printed by cffi; the host is told EBL_STATUS_INTERNAL.
_answers = ffi.def_extern(name="unit_request_python", error=lib.EBL_STATUS_INTERNAL)


@_answers  # type: ignore[untyped-decorator]
def _answer(
    context: Any,
    message_id: int,
    request: Any,
    length: int,
    response: Any,
    capacity: int,
    response_length: Any,
) -> int:
    answer: BoardRequest = ffi.from_handle(context)
    status, body = answer(message_id, bytes(ffi.buffer(request, length)))
    if status == lib.EBL_STATUS_OK and len(body) > capacity:
        # Before HELLO a frame is short: half a JSON object would be worse than none.
        status, body = int(lib.EBL_STATUS_NO_SPACE), b""
    body = body[:capacity]
    ffi.memmove(response, body, len(body))
    response_length[0] = len(body)
    return status


def default_bike() -> dict[str, float]:
    """The pinned bike W1 (thesis_checks 4.7) as `part.name` -> value, e.g. `road.mass_kg`; a list's
    values as `gears.cog_teeth_1`."""
    config = ffi.new("physics_config *")
    lib.physics_default(config)
    return {
        path: float(value)
        for part in _BIKE_PARTS
        for name, field in ffi.typeof(getattr(config, part)).fields
        for path, value in _values(
            f"{part}.{name}", field.type.kind, getattr(getattr(config, part), name)
        )
    }


def _values(path: str, kind: str, value: Any) -> list[tuple[str, float]]:
    """A number under its path; those of a list are numbered from 1."""
    if kind != "array":
        return [(path, value)]
    return [(f"{path}_{number}", each) for number, each in enumerate(value, start=1)]


def kinematics(bike: dict[str, float], speed_kmh: float) -> dict[str, float]:
    """Wheel, crank and motor speed in rpm at `speed_kmh` (thesis eq. 2.7 to 2.9)."""
    config = ffi.new("physics_config *")
    lib.physics_default(config)
    _change(config, bike)
    turning = lib.physics_kinematics_at(config, speed_kmh)
    return {name: getattr(turning, name) for name in _fields("physics_kinematics")}


def _change(config: Any, values: dict[str, float]) -> None:
    """Writes `part.name` values into a physics_config; KeyError names one that does not exist."""
    known = default_bike()
    for path in values:
        if path not in known:
            raise KeyError(f"the bike has no value {path!r}; it has: {', '.join(sorted(known))}")
    for path, value in values.items():
        part, name = path.split(".")
        struct = getattr(config, part)
        if not hasattr(struct, name):
            listed, number = name.rsplit("_", 1)
            getattr(struct, listed)[int(number) - 1] = float(value)
            continue
        whole = isinstance(getattr(struct, name), int)
        setattr(struct, name, int(value) if whole else float(value))


class Unit:
    """One simulated unit on its bike.

    Args:
        uid: the 12 bytes that make up its serial number.
        boot_id: what HELLO reports; another one tells the host that the unit was restarted.
        seed: of the sensor's noise.
        bike: `part.name` -> value, over `default_bike()`.
        speed_kmh: the bike starts rolling at this speed.
        flash: `FLASH_LENGTH` bytes of an earlier life, or None for an erased flash.
        log: the whole flash for ride logs, or None for an erased one of `LOG_LENGTH` bytes; another
            length, in whole blocks, makes a smaller flash.
        unlock_key: the maker's public key to provision, or None for what the flash has.
        market: for which a unit with an erased flash leaves the factory; None: it was never there.
        line_baud: the serial line's rate at boot, or 0 for one that takes no time.
        request: answers SIM_GET and SIM_SET: (message id, request) -> (status, response).
        bike_alone: the firmware runs on another board; `sensors` and `drive` stand for its wires.

    Raises:
        KeyError: a value of `bike` does not exist.
        ValueError: `uid`, `flash`, `log` or `unlock_key` has a wrong length.
        MemoryError: the unit could not be allocated, or its flash has another unlock key.
    """

    def __init__(
        self,
        *,
        uid: bytes,
        boot_id: int,
        seed: int = 0,
        bike: dict[str, float] | None = None,
        speed_kmh: float = 0.0,
        flash: bytes | None = None,
        log: bytes | None = None,
        unlock_key: bytes | None = None,
        market: Market | None = Market.EU_EPAC,
        line_baud: int = 0,
        request: BoardRequest | None = None,
        bike_alone: bool = False,
    ) -> None:
        if len(uid) != UID_LENGTH:
            raise ValueError(f"uid has {len(uid)} bytes, not {UID_LENGTH}")
        if flash is not None and len(flash) != FLASH_LENGTH:
            raise ValueError(f"the flash image has {len(flash)} bytes, not {FLASH_LENGTH}")
        if log is not None and (not log or len(log) % LOG_BLOCK_LENGTH or len(log) > LOG_LENGTH):
            raise ValueError(f"the log's image has {len(log)} bytes, not whole blocks")
        if unlock_key is not None and len(unlock_key) != UNLOCK_KEY_LENGTH:
            raise ValueError(f"the key has {len(unlock_key)} bytes, not {UNLOCK_KEY_LENGTH}")
        setup = ffi.new("unit_setup *")
        lib.physics_default(ffi.addressof(setup, "physics"))
        _change(setup.physics, bike or {})
        setup.speed_kmh = speed_kmh
        setup.seed = seed
        setup.uid = uid
        setup.boot_id = boot_id
        setup.market_number = market or Market.EU_EPAC
        setup.not_provisioned = int(market is None)
        setup.line_baud = line_baud
        setup.bike_alone = int(bike_alone)
        setup.flash = ffi.NULL if flash is None else ffi.from_buffer("uint8_t[]", flash)
        setup.log_size = 0 if log is None else len(log)
        setup.log = ffi.NULL if log is None else ffi.from_buffer("uint8_t[]", log)
        setup.unlock_key = (
            ffi.NULL if unlock_key is None else ffi.from_buffer("uint8_t[]", unlock_key)
        )
        self._request = None if request is None else ffi.new_handle(request)
        if self._request is not None:
            setup.request = lib.unit_request_python
            setup.request_context = self._request
        created = lib.unit_create(setup)
        if created == ffi.NULL:
            raise MemoryError("no memory for a simulated unit, or another key is in its flash")
        self._unit = ffi.gc(created, lib.unit_destroy)
        self._observation = ffi.new("unit_observation *")
        self._transmitted = bytearray(_TRANSMIT_CAPACITY)
        self._transmit_buffer = ffi.from_buffer("uint8_t[]", self._transmitted)

    def advance_us(self, duration_us: int, distance_m: float | None = None) -> int:
        """Lets `duration_us` of the unit's time pass, less if the bike comes to `distance_m` on its
        counter before; how much did, to the millisecond."""
        if distance_m is None:
            lib.unit_advance_us(self._unit, duration_us)
            return duration_us
        return int(lib.unit_advance_to_m(self._unit, duration_us, distance_m))

    def poll(self) -> None:
        """Let the unit answer what it has received while its clock stands."""
        lib.unit_poll(self._unit)

    def receive(self, data: bytes) -> int:
        """Bytes from the host; returns how many the line took."""
        return int(lib.unit_receive(self._unit, data, len(data)))

    def transmit(self, bytes_max: int = _TRANSMIT_CAPACITY) -> bytes:
        """Takes what the unit wants to send to the host, at most `bytes_max`."""
        capacity = min(bytes_max, _TRANSMIT_CAPACITY)
        length = lib.unit_transmit(self._unit, self._transmit_buffer, capacity)
        return bytes(self._transmitted[:length])

    def host_baud(self, baud: int) -> None:
        """The far end of a line with a rate sends and listens at this one from now on."""
        lib.unit_host_baud(self._unit, baud)

    @property
    def line_baud(self) -> int:
        """The unit's own rate now, 0 where its line has none."""
        return int(lib.unit_line_baud(self._unit))

    def observe(self, names: Iterable[str] = _OBSERVED) -> dict[str, Any]:
        """Speeds, torques, energies and the law's last decision, by name; missing is NaN."""
        lib.unit_observe(self._unit, self._observation)
        return {name: getattr(self._observation, name) for name in names}

    def sensors(self) -> bytes:
        """What the sensors see now: the bytes of a hal_inputs, the same on every board."""
        inputs = ffi.new("hal_inputs *")
        lib.unit_inputs(self._unit, inputs)
        return bytes(ffi.buffer(inputs))

    def drive(self, output: bytes, mode: int) -> None:
        """What the firmware elsewhere decided: the bytes of an assist_output. Raises ValueError."""
        if len(output) != ASSIST_OUTPUT_LENGTH:
            raise ValueError(f"an assist_output of {len(output)} bytes: build the board again")
        lib.unit_drive(self._unit, ffi.cast("assist_output *", ffi.from_buffer(output)), mode)

    @property
    def speed_kmh(self) -> float:
        return float(self.observe()["speed_kmh"])

    def set_rider(self, kind: int, torque_nm: float, cadence_rpm_max: float) -> None:
        """`kind`: RIDER_OFF, RIDER_CONSTANT or RIDER_LEGS of rider.h."""
        rider = lib.unit_stimulus(self._unit).rider
        rider.kind = kind
        rider.torque_nm = torque_nm
        rider.cadence_rpm_max = cadence_rpm_max

    def set_road(self, *, grade_deg: float, wind_ms: float, dyno_nm: float, brake: bool) -> None:
        """Wind counts against the direction of travel; `dyno_nm` acts only with the dyno load."""
        road = lib.unit_stimulus(self._unit).road
        road.grade_deg = grade_deg
        road.wind_ms = wind_ms
        road.dyno_nm = dyno_nm
        road.brake = int(brake)

    def hang_mass(self, hung: dict[str, float] | None) -> None:
        """Puts the bike on a workbench and hangs a mass there: `name` -> value of hung_mass in
        hung_mass.h. None takes it off."""
        lib.unit_hang_mass(self._unit, ffi.NULL if hung is None else ffi.new("hung_mass *", hung))

    def set_faults(self, faults: dict[str, float]) -> None:
        """`name` -> value of physics_faults in physics.h; what is not named is sound."""
        lib.unit_stimulus(self._unit).faults = faults

    def hold_walk_button(self, held: bool) -> None:
        """Holds or releases the button for walk assist."""
        lib.unit_hold_walk_button(self._unit, int(held))

    def change_bike(self, values: dict[str, float]) -> None:
        """Changes `part.name` values of the bike and starts its energy ledger afresh."""
        self.change_surroundings(values)
        lib.unit_begin_ledger(self._unit)

    def change_surroundings(self, values: dict[str, float]) -> None:
        """Changes `part.name` values that hold no energy; the ledger goes on."""
        _change(lib.unit_bike(self._unit), values)

    def place(self, speed_kmh: float, seed: int) -> None:
        """Puts the bike on the road at this speed; ledger, distance and noise start afresh."""
        lib.unit_place(self._unit, speed_kmh, seed)

    def renew(self) -> None:
        """A fresh battery, rider and sensor, as the bike has them now; it rolls on."""
        lib.unit_renew(self._unit)

    def seed_noise(self, seed: int) -> None:
        """Starts the sensor's noise afresh."""
        lib.unit_seed_noise(self._unit, seed)

    def select_mode(self, mode: int) -> None:
        """Selects a mode slot; MODE_NOT_SELECTED leaves the choice to the configuration."""
        lib.unit_select_mode(self._unit, mode)

    def hang(self, steps: bool = True, polls: bool = True) -> None:
        """Control steps, polls or both come no more, until the watchdog starts the unit anew."""
        lib.unit_hang(self._unit, lib.UNIT_HANG_STEPS * steps + lib.UNIT_HANG_POLLS * polls)

    def cut_power_after(self, flash_bytes: int) -> None:
        """Brown-out after so many more bytes erased or programmed; 0 takes the battery out now."""
        lib.unit_flash_cut_after(self._unit, flash_bytes)

    def cut_power_in_log_after(self, log_bytes: int) -> None:
        """The same for the flash for ride logs."""
        lib.unit_log_cut_after(self._unit, log_bytes)

    @property
    def powered(self) -> bool:
        """Whether the supply still holds."""
        return bool(lib.unit_is_powered(self._unit))

    def flash(self) -> bytes:
        """The flash as it is now, to be given to the unit's next life."""
        return bytes(ffi.buffer(lib.unit_flash(self._unit), FLASH_LENGTH))

    def log(self) -> bytes:
        """The flash for ride logs as it is now."""
        return bytes(ffi.buffer(lib.unit_log(self._unit), lib.unit_log_size(self._unit)))

    def log_changed(self) -> tuple[int, bytes]:
        """Address and bytes of what changed in the flash for ride logs since the last call."""
        address = ffi.new("size_t *")
        length = lib.unit_log_changed(self._unit, address)
        return address[0], bytes(ffi.buffer(lib.unit_log(self._unit) + address[0], length))

    @property
    def log_changes(self) -> int:
        """How often the flash for ride logs was written; the same number means the same bytes."""
        return int(lib.unit_log_changes(self._unit))


def finite_or_none(value: float) -> float | None:
    """Missing in JSON is null, in C it is NaN."""
    return value if math.isfinite(value) else None
