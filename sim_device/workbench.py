"""A workbench for a simulated bike: its wheel is held, and masses hang on its pedals.

What hangs is said; what hangs in truth is drawn from the unit's seed within the stated limits, and
told nobody. A weight and a crank are the same whenever they come back; how the crank is set to its
angle and how a mass swings is new every time.
"""

from dataclasses import asdict, dataclass, fields
from math import pi, radians
from random import Random
from typing import Any, Final

from sim_device.scenario_phase import ScenarioError, Setting

SIDES: Final = {"left": 0, "right": 1}
SWING_DEG: Final = (2.0, 5.0)
"""Of what a hand lets go. The steepest crank and the widest swing still push forwards."""


@dataclass(frozen=True)
class Workbench:
    """What is said of it. crank_angle_deg: 0 is the crank level and forward, positive the pedal
    going down. The limits are half widths of what mass, arm and angle may be off by; the first is
    that of class M3 (OIML R 111-1:2004, table 1)."""

    side: str = "right"
    mass_kg: float = 0.0
    crank_angle_deg: float = 0.0
    arm_m: float = 0.17
    mass_limit_share: float = 5e-4
    arm_limit_m: float = 3e-4
    angle_limit_deg: float = 0.5

    def as_controls(self) -> dict[str, Any]:
        """As the controls have it."""
        return asdict(self)


_RANGES: Final = {
    "side": Setting("right", choices=tuple(SIDES)),
    "mass_kg": Setting(0.0, min=0.0, max=200.0),
    "crank_angle_deg": Setting(0.0, min=-80.0, max=80.0),
    "arm_m": Setting(0.17, min=0.05, max=1.0),
    "mass_limit_share": Setting(0.0, min=0.0, max=0.1),
    "arm_limit_m": Setting(0.0, min=0.0, max=0.02),
    "angle_limit_deg": Setting(0.0, min=0.0, max=4.0),
}
NAMES: Final = frozenset(field.name for field in fields(Workbench))


def read_workbench_value(where: str, name: str, given: object) -> float | str:
    """One value, checked. Raises ScenarioError with `where` and what is allowed."""
    if name not in _RANGES:
        raise ScenarioError(f"{where} is not known; there are: {', '.join(_RANGES)}", where)
    return _RANGES[name].read(where, given)


def hung(bench: Workbench, seed: int, times: int) -> dict[str, float]:
    """What is in truth, by the names of hung_mass.h, after something was hung `times` times."""

    def off(*about: object) -> float:
        return Random(f"workbench {seed} {about}").uniform(-1.0, 1.0)

    anew = Random(f"workbench {seed} let go {times}")
    off_deg = anew.uniform(-1.0, 1.0) * bench.angle_limit_deg
    return {
        "side": SIDES[bench.side],
        "mass_kg": bench.mass_kg * (1.0 + off("mass", bench.mass_kg) * bench.mass_limit_share),
        "arm_m": bench.arm_m + off("arm", bench.side) * bench.arm_limit_m,
        "crank_angle_rad": radians(bench.crank_angle_deg + off_deg),
        "swing_rad": radians(anew.uniform(*SWING_DEG)),
        "swing_phase_rad": anew.uniform(0.0, 2.0 * pi),
    }
