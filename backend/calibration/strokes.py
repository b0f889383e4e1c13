"""The error test's figures (thesis eq. 3.18 to 3.21) from captures, side by side; and a correction
by straight pieces through what the line leaves: for the certificate only, because the unit's law
knows a line.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from backend.calibration.capture import Capture, Direction
from backend.calibration.coefficients import Coefficients
from backend.calibration.figures import Evaluation, evaluate
from backend.calibration.fit import Fit
from backend.calibration.plain import Plain
from backend.calibration.setup import Setup, Side
from backend.core.statistics import Numbers


@dataclass(frozen=True, slots=True)
class SideFigures(Plain):
    """Of one pedal at the crank's first planned angle, percent of full scale.

    linearity_load, linearity_line: against the loads and against their least-squares line.
    slope: of that line. total_*: root of the squares with repeatability by deviation and by range.
    """

    side: Side
    strokes: int
    linearity_load_pct: float
    linearity_line_pct: float
    hysteresis_pct: float
    repeatability_deviation_pct: float
    repeatability_range_pct: float
    total_deviation_pct: float
    total_range_pct: float
    slope: float


@dataclass(frozen=True, slots=True)
class Curve(Plain):
    """Means of strokes and sides at each load (k,), in Nm: the residuals' shape and loop."""

    load_nm: tuple[float, ...]
    residual_nm: tuple[float, ...]
    loop_nm: tuple[float | None, ...]  # unloading less loading; None with one direction only
    captures: tuple[int, ...]


def side_figures(
    setup: Setup, captures: Sequence[Capture], coefficients: Coefficients
) -> tuple[SideFigures, ...]:
    """Of every side with two complete strokes or more; others are left out."""
    results = []
    for side in setup.sides:
        grid = _grid(setup, captures, side, coefficients)
        if grid is None:
            continue
        load, forward, reverse = grid
        figures = evaluate(setup.full_scale_nm, load, forward, reverse)
        results.append(_summary(side, len(forward), figures))
    return tuple(results)


def _summary(side: Side, strokes: int, figures: Evaluation) -> SideFigures:
    return SideFigures(
        side,
        strokes,
        figures.linearity_pct,
        figures.linearity_against_line_pct.least_squares,
        figures.hysteresis_pct,
        figures.repeatability_pct.deviation,
        figures.repeatability_pct.range,
        figures.total_pct.deviation,
        figures.total_pct.range,
        figures.fit.slope,
    )


def curve(setup: Setup, captures: Sequence[Capture], coefficients: Coefficients) -> Curve:
    """What the coefficients leave at each load, crank at its first planned angle: another one shows
    bending and how well the angle was met. Of all loads where none hung there."""
    fitted = [capture for capture in captures if capture.state.kind != "verify"]
    level_deg = setup.angles_deg[0]
    used = [one for one in fitted if one.state.crank_angle_deg == level_deg] or fitted
    load = np.round([capture.state.load_nm(setup) for capture in used], 6)
    left = readings_nm(used, coefficients) - load
    up = np.array([capture.state.direction != "unloading" for capture in used])
    places = np.unique(load)
    loops: list[float | None] = []
    for place in places:
        here = load == place
        both = (here & up).any() and (here & ~up).any()
        loops.append(float(left[here & ~up].mean() - left[here & up].mean()) if both else None)
    return Curve(
        tuple(float(place) for place in places),
        tuple(float(left[load == place].mean()) for place in places),
        tuple(loops),
        tuple(int((load == place).sum()) for place in places),
    )


def zero_return_nm(captures: Sequence[Capture], coefficients: Coefficients) -> float | None:
    """Largest change of the zero over a stroke: last zero less first; None with fewer than two
    zeros in every stroke."""
    strokes: dict[tuple[object, int], list[Capture]] = {}
    for capture in sorted(captures, key=lambda capture: capture.number):
        if capture.state.kind == "zero":
            strokes.setdefault((capture.state.side, capture.state.stroke), []).append(capture)
    changes = [
        float(np.diff(readings_nm([zeros[0], zeros[-1]], coefficients))[0])
        for zeros in strokes.values()
        if len(zeros) > 1
    ]
    return max(changes, key=abs, default=None)


def readings_nm(
    captures: Sequence[Capture], coefficients: Coefficients
) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """What the coefficients make of the captures (n,), at the temperature of each."""
    degc = [
        np.nan if capture.state.sensor_degc is None else capture.state.sensor_degc
        for capture in captures
    ]
    torque = coefficients.torque_nm([capture.mean_counts for capture in captures], degc)
    return torque.reshape(len(captures))


def _grid(
    setup: Setup, captures: Sequence[Capture], side: Side, coefficients: Coefficients
) -> tuple[np.ndarray, list[list[float]], list[list[float]]] | None:
    """Loads (k,) and readings (r, k) up and down; the last capture of a place counts."""
    cells: dict[tuple[int, Direction, float], float] = {}
    used = [capture for capture in captures if _belongs(capture, setup, side)]
    used.sort(key=lambda capture: capture.number)
    for capture, reading in zip(used, readings_nm(used, coefficients), strict=True):
        state = capture.state
        key = (state.stroke, state.direction or "loading", state.mass_kg)
        cells[key] = float(reading)
    masses = sorted({mass for _, _, mass in cells})
    rows = {
        direction: [
            [cells[(stroke, direction, mass)] for mass in masses]
            for stroke in sorted({stroke for stroke, _, _ in cells})
            if all((stroke, direction, mass) in cells for mass in masses)
        ]
        for direction in ("loading", "unloading")
    }
    enough = len(masses) > 1 and min(len(rows["loading"]), len(rows["unloading"])) >= 2
    if not enough:
        return None
    by_mass = {capture.state.mass_kg: capture.state.load_nm(setup) for capture in used}
    return np.array([by_mass[mass] for mass in masses]), rows["loading"], rows["unloading"]


def _belongs(capture: Capture, setup: Setup, side: Side) -> bool:
    state = capture.state
    if state.kind == "load":
        return state.side == side and state.crank_angle_deg == setup.angles_deg[0]
    return state.kind == "zero" and state.direction is not None and state.side == side


KNOTS_MIN = 4
"""Fewer loads, and a line through them leaves nothing to correct."""


@dataclass(frozen=True, slots=True)
class Piecewise(Plain):
    """To be added to a reading: correction_nm at reading_nm (k,), ascending; standard_nm of each.

    significant: the largest correction is beyond twice its own standard uncertainty.
    """

    reading_nm: tuple[float, ...]
    correction_nm: tuple[float, ...]
    standard_nm: tuple[float, ...]
    significant: bool

    def corrected_nm(self, reading_nm: npt.ArrayLike) -> Numbers:
        """Readings (n,); beyond the outermost knots the last correction holds."""
        reading = np.asarray(reading_nm, np.float64)
        added: Numbers = reading + np.interp(reading, self.reading_nm, self.correction_nm)
        return added


def piecewise(curve: Curve, fit: Fit) -> Piecewise | None:
    """Through the means at each load; None with fewer than four loads."""
    if len(curve.load_nm) < KNOTS_MIN:
        return None
    left = np.array(curve.residual_nm)
    standard = fit.repeatability_nm / np.sqrt(curve.captures)
    worst = int(np.abs(left).argmax())
    return Piecewise(
        tuple(float(value) for value in np.array(curve.load_nm) + left),
        tuple(float(value) for value in -left),
        tuple(float(value) for value in standard),
        bool(math.fabs(left[worst]) > 2 * standard[worst]),
    )
