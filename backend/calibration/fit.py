"""The coefficients from the captures: weighted least squares, and what each is uncertain by.

Counts are the dependent variable, because they scatter; what all loads share (arm, gravity, masses,
level) is kept apart from the scatter, for it does not average out.

    counts = offset + offset_per_k dt + counts_per_nm load / (1 + gain_share_per_k dt)

is `Coefficients` solved for the counts. The weights are one over the variance of a capture: of its
own mean, of the reading's step, and of the repeatability: what captures scatter by beyond what each
one knows of itself, which is what makes the weighted squares of the residuals equal to the degrees
of freedom (Paule and Mandel, 1982).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from backend.calibration.capture import Capture
from backend.calibration.coefficients import Coefficients
from backend.calibration.plain import Plain
from backend.calibration.setup import Setup
from backend.core.statistics import Numbers, coverage_factor, robust_line
from backend.errors import InvalidRequest

HALVINGS = 60


def beyond_own(squares: Callable[[float], float], freedom: int, residual_squares: float) -> float:
    """Variance to add to each capture's own so that the weighted squares of the residuals equal
    the degrees of freedom (Paule and Mandel, 1982); 0 where they are fewer already.

    squares: the weighted squares with so much added; they fall as it grows. residual_squares:
    of the residuals without weights; what is to be added lies below four times their mean.
    """
    if freedom < 1 or squares(0.0) <= freedom:
        return 0.0
    low, high = 0.0, 4 * residual_squares / freedom + 1e-12
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if squares(middle) > freedom else (low, middle)
    return high


NAMES = ("offset_counts", "gain_nm_per_count", "offset_counts_per_k", "gain_share_per_k")
TEMPERATURE_SPAN_K = 10.0
"""Less, and a thermometer of whole degrees decides the coefficient: 0.6 K in 10 K are 6 %."""

ROOT_3 = math.sqrt(3.0)


@dataclass(frozen=True, slots=True)
class Common(Plain):
    """One cause that all loads share. shift: of each coefficient in `Fit.names`, for one standard
    uncertainty of the cause."""

    cause: str
    shift: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Residual(Plain):
    """Of one capture: what the coefficients read there, and how much that is above the load."""

    capture: int
    load_nm: float
    reading_nm: float
    residual_nm: float


@dataclass(frozen=True, slots=True)
class Fit(Plain):
    """covariance: of the coefficients in `names`, from the scatter alone. repeatability_nm:
    standard deviation of one capture beyond its own noise. temperature: `both`, `offset` or
    `none`, with `temperature_span_k` that the captures cover; None without temperatures."""

    coefficients: Coefficients
    names: tuple[str, ...]
    covariance: tuple[tuple[float, ...], ...]
    common: tuple[Common, ...]
    repeatability_nm: float
    degrees_of_freedom: int
    temperature: str
    temperature_span_k: float | None
    residuals: tuple[Residual, ...]

    def standard(self, name: str) -> float:
        """Standard uncertainty of a coefficient, all causes together."""
        place = self.names.index(name)
        shared = sum(common.shift[place] ** 2 for common in self.common)
        return math.sqrt(self.covariance[place][place] + shared)

    def expanded(self, name: str) -> float:
        """For 95.45 %: k is 2 or more, by the degrees of freedom of the scatter's part."""
        place = self.names.index(name)
        standard, scatter = self.standard(name), self.covariance[place][place]
        freedom = self.degrees_of_freedom * standard**4 / scatter**2 if scatter else None
        return coverage_factor(freedom) * standard


class Data(NamedTuple):
    """The captures of a fit as columns (n,). own_variance: of each mean, without repeatability."""

    numbers: tuple[int, ...]
    load_nm: Numbers
    counts: Numbers
    own_variance: Numbers
    angle_rad: Numbers
    side: Numbers  # +1 right, -1 left, 0 neither
    warmer_k: Numbers
    reference_degc: float | None
    span_k: float | None


def data_of(setup: Setup, captures: Sequence[Capture]) -> Data:
    """Columns of what is fitted: zeros and loads, not the verifications."""
    used = [capture for capture in captures if capture.state.kind != "verify"]
    states = [capture.state for capture in used]
    own = [capture.deviation_counts**2 / capture.count for capture in used]
    degc = [state.sensor_degc for state in states if state.sensor_degc is not None]
    has_temperature = bool(used) and len(degc) == len(used)
    reference = round(float(np.mean(degc)), 1) if has_temperature else None
    return Data(
        tuple(capture.number for capture in used),
        np.array([state.load_nm(setup) for state in states]),
        np.array([capture.mean_counts for capture in used]),
        np.array(own) + setup.resolution_counts**2 / 12,
        np.radians([state.crank_angle_deg for state in states]),
        np.array([{"right": 1.0, "left": -1.0, None: 0.0}[state.side] for state in states]),
        np.array(degc) - reference if reference is not None else np.zeros(len(used)),
        reference,
        float(np.ptp(degc)) if has_temperature else None,
    )


def fit(setup: Setup, captures: Sequence[Capture]) -> Fit:
    """Of all captures but the verifications. Raises InvalidRequest where they do not suffice."""
    data = data_of(setup, captures)
    temperature = _temperature(data)
    number = {"none": 2, "offset": 3, "both": 4}[temperature]
    line = robust_line(data.load_nm, data.counts) if data.load_nm.size else None
    if line is None or data.load_nm.size <= number:
        message = f"a fit needs more than {number} captures, at two loads or more"
        raise InvalidRequest(message, "too_few_captures")
    start = np.array([line[1], line[0], 0.0, 0.0])[:number]
    solution = _solved(start, data)
    jacobian, weights = _jacobian(solution.values, data), 1 / (data.own_variance + solution.extra)
    inverse = np.linalg.inv(jacobian.T @ (jacobian * weights[:, None]))
    # From counts per newton metre to newton metres per count.
    counts_per_nm = float(solution.values[1])
    turn = np.ones(number)
    turn[1] = -1 / counts_per_nm**2
    covariance = inverse * np.outer(turn, turn)
    gain = inverse @ (jacobian * weights[:, None]).T * turn[:, None]
    coefficients = Coefficients(
        float(solution.values[0]),
        1 / counts_per_nm,
        float(solution.values[2]) if number > 2 else None,
        float(solution.values[3]) if number > 3 else None,
        data.reference_degc,
    )
    return Fit(
        coefficients=coefficients,
        names=NAMES[:number],
        covariance=tuple(tuple(float(value) for value in row) for row in covariance),
        common=tuple(
            Common(cause, tuple(float(value) for value in gain @ (shift * counts_per_nm)))
            for cause, shift in common_shifts_nm(setup, data, number)
        ),
        repeatability_nm=math.sqrt(solution.extra) / counts_per_nm,
        degrees_of_freedom=data.counts.size - number,
        temperature=temperature,
        temperature_span_k=data.span_k,
        residuals=_residuals(coefficients, data),
    )


def common_shifts_nm(setup: Setup, data: Data, number: int) -> list[tuple[str, Numbers]]:
    """What each common cause does to the loads (n,) by one standard uncertainty, in Nm.

    Limits are half widths of a rectangle (GUM 4.3.7). Level: a dial that is off by up to `a`
    lowers a level arm's load by a square; the root of its mean square is a^2 / (2 root 5). Step:
    all captures may be rounded the same way.
    """
    level_rad = math.radians(setup.level_limit_deg)
    load, slope = data.load_nm, np.tan(data.angle_rad)
    step_nm = setup.resolution_counts * setup.gain_nm_per_count
    shifts = [
        ("masses", load * setup.mass_limit_share / ROOT_3),
        ("arm", load * setup.arm_limit_m / setup.arm_m / ROOT_3),
        ("gravity", load * setup.gravity.standard_ms2 / setup.gravity.gravity_ms2),
        ("level", load * slope * level_rad / ROOT_3),
        ("level_squared", load * level_rad**2 / (2 * math.sqrt(5.0))),
        ("step", np.full_like(load, step_nm / 2 / ROOT_3)),
    ]
    if number < 3:
        shifts.append(("temperature_zero", data.warmer_k * setup.zero_limit_nm_per_k / ROOT_3))
    if number < 4:
        span = setup.span_limit_share_per_k / ROOT_3
        shifts.append(("temperature_span", load * data.warmer_k * span))
    return shifts


class _Solution(NamedTuple):
    values: Numbers
    extra: float  # variance of the repeatability, counts squared


def _solved(start: Numbers, data: Data) -> _Solution:
    """Gauss and Newton inside, the repeatability outside."""
    values = _newton(start, data, 1 / (data.own_variance + data.own_variance.mean()))

    def squares(extra: float) -> float:
        weights = 1 / (data.own_variance + extra)
        left = data.counts - _model(_newton(values, data, weights), data)
        return float(left @ (weights * left))

    left = data.counts - _model(values, data)
    extra = beyond_own(squares, data.counts.size - values.size, float(left @ left))
    return _Solution(_newton(values, data, 1 / (data.own_variance + extra)), extra)


def _newton(values: Numbers, data: Data, weights: Numbers) -> Numbers:
    """Three steps: without temperature the first is exact, with it the gain's share is small."""
    root = np.sqrt(weights)
    for _ in range(1 if values.size < 4 else 4):
        left = data.counts - _model(values, data)
        step, *_ = np.linalg.lstsq(_jacobian(values, data) * root[:, None], left * root, rcond=None)
        values = values + step
    return values


def _model(values: Numbers, data: Data) -> Numbers:
    offset, counts_per_nm, per_k, share = np.pad(values, (0, 4 - values.size))
    signal = counts_per_nm * data.load_nm / (1 + share * data.warmer_k)
    modelled: Numbers = offset + per_k * data.warmer_k + signal
    return modelled


def _jacobian(values: Numbers, data: Data) -> Numbers:
    counts_per_nm, share = values[1], values[3] if values.size > 3 else 0.0
    warmth = 1 + share * data.warmer_k
    columns = [
        np.ones_like(data.load_nm),
        data.load_nm / warmth,
        data.warmer_k,
        -counts_per_nm * data.load_nm * data.warmer_k / warmth**2,
    ]
    return np.stack(columns[: values.size], axis=1)


def _temperature(data: Data) -> str:
    """Which temperature coefficients the captures can tell."""
    if data.span_k is None:
        return "none"
    loaded = data.warmer_k[data.load_nm > 0.25 * data.load_nm.max()]
    if np.ptp(data.warmer_k) < TEMPERATURE_SPAN_K:
        return "none"
    return "both" if loaded.size and np.ptp(loaded) >= TEMPERATURE_SPAN_K else "offset"


def _residuals(coefficients: Coefficients, data: Data) -> tuple[Residual, ...]:
    reference = data.reference_degc
    degc = None if reference is None else data.warmer_k + reference
    reading = coefficients.torque_nm(data.counts, degc)
    return tuple(
        Residual(number, float(load), float(read), float(read - load))
        for number, load, read in zip(data.numbers, data.load_nm, reading, strict=True)
    )
