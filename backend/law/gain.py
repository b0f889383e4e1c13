"""The gain a table gives, by the unit's own C."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from backend.core.fuzzy_table import FuzzyTable
from backend.errors import FieldError, InvalidRequest
from sim_device.firmware.python import law

ENGINE = law.ENGINE
FAULTS_MAX = 20
POINTS_MAX = 512 * 512
"""Most points one call computes: 3 ms of C, and a bound for the answer's size."""

Floats = npt.NDArray[np.float32]


def surface(table: FuzzyTable, speeds_kmh: npt.ArrayLike, torque_rates: npt.ArrayLike) -> Floats:
    """Gain over a grid, float32 (n, m), rows = speeds.

    speeds_kmh: (n,). torque_rates: (m,). Values outside the table count as its first or last
    point. Raises InvalidRequest for a coordinate that is not finite or more than POINTS_MAX points.
    """
    speeds = _coordinates("speeds_kmh", speeds_kmh)
    rates = _coordinates("torque_rates", torque_rates)
    if speeds.size * rates.size > POINTS_MAX:
        raise InvalidRequest(
            f"{speeds.size} speeds by {rates.size} torque rates are more than {POINTS_MAX} points;"
            " ask for a coarser grid",
            "too_many_points",
        )
    return law.gain_surface(table.to_parameters(), speeds, rates)


def points(
    table: FuzzyTable,
    speeds_kmh: npt.ArrayLike,
    torque_rates: npt.ArrayLike,
    places: tuple[str, str] = ("speeds_kmh[{}]", "torque_rates[{}]"),
) -> Floats:
    """Gain at single points, float32 (k,). speeds_kmh, torque_rates: (k,) each.

    places: what a speed and a rate at fault are called, `{}` for their index. Raises
    InvalidRequest for a coordinate that is not finite or vectors of unequal length.
    """
    speeds = _coordinates("speeds_kmh", speeds_kmh, places[0])
    rates = _coordinates("torque_rates", torque_rates, places[1])
    if speeds.size != rates.size:
        raise InvalidRequest(
            f"{speeds.size} speeds but {rates.size} torque rates; give pairs", "unequal_lengths"
        )
    if speeds.size > POINTS_MAX:
        raise InvalidRequest(f"more than {POINTS_MAX} points; ask in parts", "too_many_points")
    return law.gain_points(table.to_parameters(), speeds, rates)


def _coordinates(name: str, values: npt.ArrayLike, place: str = "") -> Floats:
    try:
        numbers = np.asarray(values, np.float64)
    except (TypeError, ValueError) as wrong:
        raise InvalidRequest(f"{name} must be a list of numbers", "not_a_number") from wrong
    if numbers.ndim != 1:
        raise InvalidRequest(f"{name} must be one list of numbers", "wrong_shape")
    # A double beyond float32 becomes infinite here.
    with np.errstate(over="ignore"):
        narrow = numbers.astype(np.float32)
    faults = [
        _coordinate_fault((place or f"{name}[{{}}]").format(index), float(numbers[index]))
        for index in np.flatnonzero(~np.isfinite(narrow))[:FAULTS_MAX]
    ]
    if faults:
        listed = "; ".join(fault.message for fault in faults[:3])
        raise InvalidRequest(listed, faults[0].code, faults)
    return narrow


def _coordinate_fault(place: str, value: float) -> FieldError:
    """Why a number is no coordinate."""
    if not math.isfinite(value):
        return FieldError(place, "not_finite", f"{place} is not a finite number")
    message = f"{place} is {value:g}; the unit computes with numbers up to 3.4e38"
    return FieldError(place, "out_of_range", message)
