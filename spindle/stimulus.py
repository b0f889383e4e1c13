"""What can be done to a simulated unit, as types: names, kinds and choices for editor and checker.

The same for a server's unit (spindle.client.Unit.simulate) and for one on the bench
(spindle.testing.DriveUnit.simulate). Ranges are the simulator's; it refuses what lies outside and
names it. `docs/scenarios.md` says what each one does.
"""

from __future__ import annotations

from typing import Literal, TypedDict


class Rider(TypedDict, total=False):
    """`constant` is a servo, `legs` two strokes a turn; negative torque pedals backwards."""

    kind: Literal["off", "constant", "legs"]
    torque_nm: float
    cadence_rpm_max: float


class Road(TypedDict, total=False):
    """Wind counts against the direction of travel. On the bench the grade is the lift's."""

    grade_deg: float
    wind_ms: float


class Faults(TypedDict, total=False):
    """What is broken until it is told to be sound again; `{}` changes nothing."""

    torque_sensor: Literal["sound", "stuck", "open_high", "open_low", "drifting"]
    speed_sensor: Literal["sound", "lost", "stuck"]
    link_lost: bool
    motor_hall: bool
    battery_cut: bool
    motor_warmer_k: float
    controller_warmer_k: float
    pulses_missed: float
    bit_error_rate: float
    burst_share: float
    coupling: float


class Workbench(TypedDict, total=False):
    """A mass on a pedal of a bike whose wheel is held. Angle 0 is the crank level and forward,
    positive the pedal going down; the limits are half widths of what may be otherwise in truth."""

    side: Literal["left", "right"]
    mass_kg: float
    crank_angle_deg: float
    arm_m: float
    mass_limit_share: float
    arm_limit_m: float
    angle_limit_deg: float


class Stimulus(TypedDict, total=False):
    """Any subset; what is absent stays. A scenario starts from its beginning, None ends it; None
    takes the bike off the workbench."""

    scenario: str | None
    running: bool
    speed_factor: float
    clock: Literal["real", "virtual"]
    seed: int
    rider: Rider
    road: Road
    load_source: Literal["road", "dyno"]
    dyno_nm: float
    dyno_convention: Literal["physical", "thesis"]
    motor_model: Literal["average", "foc"]
    mass_kg: float
    assist_mode: int
    brake: bool
    walk_button: bool
    ambient_degc: float
    grip: float
    faults: Faults
    workbench: Workbench | None
