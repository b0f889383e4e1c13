"""Named states of a simulated bike's torque sensor: sound ones of the thesis, worn, broken ones.

Numbers and their sources are in scenarios/calibration.toml; a broken bridge is a fault.
"""

from dataclasses import dataclass

from sim_device.scenario_file import load

FAULT_OF = {"open_arm": "open_high", "stuck_bridge": "stuck"}


@dataclass(frozen=True)
class SensorState:
    """bike: `sensor.name` -> value. fault: of the sensor, by the name it has in a phase."""

    bike: dict[str, float]
    fault: str = ""

    def by_hand(self) -> dict[str, str]:
        """What is broken, as a phase has it; nothing of a whole bridge."""
        return {"torque_sensor": self.fault} if self.fault else {}


def names() -> tuple[str, ...]:
    """Every state that there is."""
    return (*load("calibration").states, *FAULT_OF)


def state_of(name: str) -> SensorState:
    """The state of this name. Raises KeyError."""
    if name in FAULT_OF:
        return SensorState({}, FAULT_OF[name])
    values = load("calibration").states[name]
    return SensorState({path: number for path, number in values.items() if "sensor." in path})
