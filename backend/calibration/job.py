"""What a job knows besides its captures, as it is kept: plain JSON, read and changed here alone.

unit      serial_number, model, firmware_version, market, battery_min_v
found     the unit's record when the job was opened
free      by parameter, from where to where it needs no token
limits    that it is judged by
setup     None before there is one
fitted_us since when nothing changed after the fit; None before, and after each change
unit_nm   by the number of a capture, what the unit itself told then
changes   of the unit's record that were read back, oldest first
pending   a change that was begun and whose outcome in the unit is still unknown
certificate  of what was written: about, worked, sha256
result    of a closed job
clock_set  at_us, by_us, dated of each time the host's clock was set meanwhile; absent if never
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from backend.calibration.capture import Capture, State
from backend.calibration.files import StoredCapture
from backend.calibration.plain import from_plain
from backend.calibration.setup import Setup
from backend.calibration.types import Step
from backend.errors import Conflict

Body = Mapping[str, Any]

WRITE, RESTORE = "write", "restore"


def new_body(unit: Body, record: Body, free: Body, limits: Body) -> dict[str, Any]:
    """Of a job that is just opened."""
    return {
        "unit": dict(unit),
        "found": dict(record),
        "free": dict(free),
        "limits": dict(limits),
        "setup": None,
        "fitted_us": None,
        "unit_nm": {},
        "changes": [],
        "pending": None,
        "certificate": None,
        "result": None,
    }


def setup_in(body: Body) -> Setup | None:
    """The setup, None before there is one."""
    return None if body["setup"] is None else from_plain(Setup, body["setup"])


def require_setup(body: Body) -> Setup:
    """The setup. Raises Conflict before there is one."""
    setup = setup_in(body)
    if setup is None:
        raise Conflict("The calibration has no setup yet: arm, gravity and masses.", "no_setup")
    return setup


def counting(captures: Sequence[StoredCapture]) -> list[Capture]:
    """Those that are not struck out."""
    return [from_plain(Capture, one.body) for one in captures if one.struck is None]


def is_written(body: Body) -> bool:
    """Whether the unit has what this job made."""
    return bool(body["changes"]) and body["changes"][-1]["kind"] == WRITE


def require_unwritten(body: Body) -> None:
    """Raise Conflict once the unit has what was fitted: another fit is not what it has."""
    if is_written(body) or body["pending"] is not None:
        raise Conflict(
            "The unit has what was fitted. Restore the old calibration first, or close this one "
            "and open another.",
            "already_written",
        )


def require_written(body: Body) -> None:
    """Raise Conflict before the unit has what was fitted."""
    if not is_written(body):
        raise Conflict("Nothing of this calibration is in the unit yet: write it.", "not_written")


def not_fitted() -> Conflict:
    """What is said where a fit is needed and there is none."""
    return Conflict("There is no fit yet: fit first.", "not_fitted")


def changed(**values: Any) -> Callable[[Body], dict[str, Any]]:
    """A change of the named parts."""
    return lambda body: {**body, **values}


def steps(setup: Setup, captures: Sequence[Capture]) -> tuple[Step, ...]:
    """All of them in their order. captures: those that count."""
    done = {key_of(capture.state): capture.number for capture in captures}
    return tuple(
        Step(state, state.load_nm(setup), done.get(key_of(state))) for state in states(setup)
    )


def states(setup: Setup) -> Iterator[State]:
    """Each side's strokes from zero up and back to zero, at the first angle; then the heaviest load
    at every other angle, which tells bending."""
    loads = sorted(setup.loads_kg)
    level, *others = setup.angles_deg
    for side in setup.sides:
        for stroke in range(1, setup.strokes + 1):
            yield State("zero", side, 0.0, None, level, stroke, "loading")
            for mass_kg in loads:
                yield State("load", side, mass_kg, None, level, stroke, "loading")
            for mass_kg in reversed(loads):
                yield State("load", side, mass_kg, None, level, stroke, "unloading")
            yield State("zero", side, 0.0, None, level, stroke, "unloading")
        for angle_deg in others:
            yield State("load", side, loads[-1], None, angle_deg, 1, "loading")


def key_of(state: State) -> tuple[object, ...]:
    """What makes two states the same step: neither the arm nor the temperature."""
    return (
        state.kind,
        state.side,
        state.mass_kg,
        state.crank_angle_deg,
        state.stroke,
        state.direction,
    )
