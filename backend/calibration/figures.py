"""What a torque sensor's error test says: thesis 3.4, eq. 3.18 to 3.21.

The thesis words repeatability as the range of repeated readings and works it out as the deviation
from their mean; both are told (thesis_checks I-7). Everything is in percent of full scale.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from backend.core.described import described
from backend.errors import FieldError, InvalidRequest

LARGEST_NM = 1e6
"""Far beyond any spindle; keeps squares and sums finite."""

Numbers = npt.NDArray[np.float64]


@described
class TwoDefinitions:
    """By deviation from the mean, and by the range of the readings (thesis_checks I-26)."""

    deviation: float
    range: float


@described
class LineFit:
    """Least-squares line through the mean readings: reading = slope x load + offset."""

    slope: float
    offset_nm: float


@described
class LinearityAgainstLines:
    """Linearity against a line instead of the load; the rest is gain error (thesis_checks I-6)."""

    least_squares: float
    through_zero: float
    end_point: float


@described
class Evaluation:
    """The figures of an error test, in percent of full scale."""

    linearity_pct: float
    """Against the load, as the thesis uses it."""
    hysteresis_pct: float
    repeatability_pct: TwoDefinitions
    total_pct: TwoDefinitions
    fit: LineFit
    linearity_against_line_pct: LinearityAgainstLines
    worst: dict[str, float | str | None]
    """Where each figure has its largest value."""


def evaluate(
    full_scale_nm: float, load_nm: npt.ArrayLike, forward: npt.ArrayLike, reverse: npt.ArrayLike
) -> Evaluation:
    """Figures of an error test. load_nm: (k,). forward, reverse: (r, k) readings in Nm, r >= 2.

    Raises InvalidRequest naming every argument at fault.
    """
    load, up, down = _checked(full_scale_nm, load_nm, forward, reverse)
    up_mean, down_mean = up.mean(axis=0), down.mean(axis=0)
    mean = (up_mean + down_mean) / 2
    percent = 100.0 / full_scale_nm

    linearity_nm = np.abs(mean - load)
    hysteresis_nm = np.abs(up_mean - down_mean)
    deviation_nm = np.stack(
        [np.abs(up - up_mean).max(axis=0), np.abs(down - down_mean).max(axis=0)]
    )
    range_nm = np.stack([np.ptp(up, axis=0), np.ptp(down, axis=0)])

    linearity = float(linearity_nm.max()) * percent
    hysteresis = float(hysteresis_nm.max()) / 2 * percent
    repeatability = TwoDefinitions(
        float(deviation_nm.max()) * percent, float(range_nm.max()) * percent
    )
    slope, offset = np.polyfit(load, mean, 1)
    return Evaluation(
        linearity_pct=linearity,
        hysteresis_pct=hysteresis,
        repeatability_pct=repeatability,
        total_pct=TwoDefinitions(
            float(np.hypot(np.hypot(linearity, hysteresis), repeatability.deviation)),
            float(np.hypot(np.hypot(linearity, hysteresis), repeatability.range)),
        ),
        fit=LineFit(float(slope), float(offset)),
        linearity_against_line_pct=_against_lines(load, mean, float(slope), float(offset), percent),
        worst={
            "linearity_load_nm": float(load[linearity_nm.argmax()]),
            "hysteresis_load_nm": float(load[hysteresis_nm.argmax()]),
            **_worst_cell("repeatability_deviation", load, deviation_nm),
            **_worst_cell("repeatability_range", load, range_nm),
            "reading_error_nm": float(max(np.abs(up - load).max(), np.abs(down - load).max())),
        },
    )


def reading_error_pct(load_nm: npt.ArrayLike, readings: npt.ArrayLike) -> float:
    """Largest error of single readings in percent of their load (thesis 5.3, table 5-1).

    load_nm: (k,), above zero. readings: (k,) or (r, k). Raises InvalidRequest.
    """
    load, values = np.asarray(load_nm, np.float64), np.asarray(readings, np.float64)
    if not (np.isfinite(load).all() and np.isfinite(values).all() and (load > 0).all()):
        raise InvalidRequest("readings and loads must be finite and the loads above zero")
    return float((np.abs(values - load) / load).max() * 100)


def _against_lines(
    load: Numbers, mean: Numbers, slope: float, offset: float, percent: float
) -> LinearityAgainstLines:
    through_zero = float(load @ mean / (load @ load))
    first, last = load.argmin(), load.argmax()
    end_slope = (mean[last] - mean[first]) / (load[last] - load[first])
    end_line = mean[first] + end_slope * (load - load[first])
    return LinearityAgainstLines(
        least_squares=float(np.abs(mean - (slope * load + offset)).max()) * percent,
        through_zero=float(np.abs(mean - through_zero * load).max()) * percent,
        end_point=float(np.abs(mean - end_line).max()) * percent,
    )


def _worst_cell(name: str, load: Numbers, values_nm: Numbers) -> dict[str, float | str | None]:
    direction, index = np.unravel_index(values_nm.argmax(), values_nm.shape)
    return {
        f"{name}_load_nm": float(load[index]),
        f"{name}_direction": ("forward", "reverse")[int(direction)],
    }


def _checked(
    full_scale_nm: float, load_nm: npt.ArrayLike, forward: npt.ArrayLike, reverse: npt.ArrayLike
) -> tuple[Numbers, Numbers, Numbers]:
    faults = []
    if not 1.0 / LARGEST_NM <= full_scale_nm <= LARGEST_NM:
        faults.append(FieldError("full_scale_nm", "out_of_range", "full_scale_nm must be above 0"))
    load = _numbers("load_nm", load_nm, faults)
    if load.ndim != 1 or np.unique(load).size < 2:
        faults.append(FieldError("load_nm", "wrong_shape", "load_nm needs two different loads"))
    strokes = []
    for name, values in (("forward", forward), ("reverse", reverse)):
        readings = _numbers(name, values, faults)
        if readings.ndim != 2 or len(readings) < 2 or readings.shape[1] != load.size:
            message = f"{name} needs two or more strokes of {load.size} readings each"
            faults.append(FieldError(name, "wrong_shape", message))
        strokes.append(readings)
    if faults:
        listed = "; ".join(fault.message for fault in faults)
        raise InvalidRequest(f"calibration readings: {listed}", "invalid_readings", faults)
    return load, strokes[0], strokes[1]


def _numbers(name: str, values: npt.ArrayLike, faults: list[FieldError]) -> Numbers:
    try:
        numbers = np.asarray(values, np.float64)
    except (TypeError, ValueError):
        faults.append(FieldError(name, "wrong_shape", f"{name} must be numbers in rows alike"))
        return np.empty(0)
    if not np.isfinite(numbers).all():
        faults.append(FieldError(name, "not_finite", f"{name} holds a value that is not finite"))
    elif np.abs(numbers).max(initial=0.0) > LARGEST_NM:
        faults.append(FieldError(name, "out_of_range", f"{name} is beyond {LARGEST_NM:g} Nm"))
    return numbers
