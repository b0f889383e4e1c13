"""The bike's physics alone: no firmware, the motor's torque is set by hand.

The motor's demand may be a function of the speed, asked every control step like the unit's law.
"""

from collections.abc import Callable
from typing import Any

from sim_device.firmware.python._native import ffi, lib

STEP_S = 0.001
STEPS_PER_CONTROL = 10
NO_CADENCE_LIMIT_RPM = 1000.0

RIDER_OFF, RIDER_CONSTANT, RIDER_LEGS = 0, 1, 2


class Bike:
    """One bike; `config`, `state` and `command` are the C structs of physics.h."""

    def __init__(self, speed_kmh: float = 0.0, seed: int = 1) -> None:
        self.config: Any = ffi.new("physics_config *")
        self.state: Any = ffi.new("physics_state *")
        self.command: Any = ffi.new("physics_command *")
        lib.physics_default(self.config)
        self.place(speed_kmh, seed)

    def place(self, speed_kmh: float, seed: int = 1) -> None:
        lib.physics_reset(self.config, self.state, speed_kmh, seed)

    def rider(self, torque_nm: float, kind: int = RIDER_CONSTANT) -> None:
        self.command.rider.kind = kind
        self.command.rider.torque_nm = torque_nm
        self.command.rider.cadence_rpm_max = NO_CADENCE_LIMIT_RPM

    def advance(
        self, seconds: float, motor_nm: Callable[[float], float] | float | None = None
    ) -> None:
        for step in range(round(seconds / STEP_S)):
            if step % STEPS_PER_CONTROL == 0 and motor_nm is not None:
                demand = motor_nm(self.speed_kmh) if callable(motor_nm) else motor_nm
                self.command.motor_torque_nm = demand
            lib.physics_step(self.config, self.state, self.command, STEP_S)

    @property
    def speed_kmh(self) -> float:
        return float(self.state.speed_ms) * 3.6

    @property
    def balance_error_pct(self) -> float:
        return float(lib.physics_energy_balance_error_pct(self.config, self.state))
