"""What a setup asks for, step by step, and which capture has done each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from backend.domain.calibration.capture import Capture, State
from backend.domain.calibration.setup import Setup


@dataclass(frozen=True)
class Step:
    """One state to be captured. load_nm: what its mass makes. capture: the number of the newest
    that counts; None while it is to be done."""

    state: State
    load_nm: float
    capture: int | None


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
