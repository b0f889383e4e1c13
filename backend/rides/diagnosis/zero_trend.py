"""How the zero of a torque sensor moves over many rides, and when it will have moved too far.

    zero = step[calibration] + per_k * (temperature - typical) + per_month * age + scatter

Weighted least squares with the covariance of every coefficient. Rides scatter by more than each of
them knows: the share that they all lack is the one that brings chi-squared to its median (Paule and
Mandel, J. Res. NBS 87 (1982) 377, median-unbiased as Viechtbauer 2021). A ride that lies apart is
left out and told.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.described import described
from backend.core.statistics import MAD_TO_DEVIATION, NORMAL_90, NORMAL_95, student
from backend.rides.diagnosis.torque import DRIFT_NM, ZERO_NM

WATCH_NM, ACT_NM = ZERO_NM, DRIFT_NM
DAY_US = 86_400_000_000
MONTH_DAYS = 365.25 / 12.0
# With fewer left to judge the scatter by, an interval is wider than any use of it.
FREEDOM_MIN = 3
SPAN_DAYS_MIN = 14.0
"""Within one calibration: over less, the weather of some days looks like age."""
RANGE_K_MIN = 5.0
"""The thermometer tells whole kelvins: over less, its steps look like a coefficient."""
# A forecast over more than five years is meaningless.
HORIZON_DAYS = 1826
OUTLIER_SIGMAS = 5.0
# So that rides that agree to the resolution do not call each other apart.
SIGMA_NM_MIN = 0.02
ABSOLUTE_ROUNDS = 30

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Zeros:
    """Zeros of rides (n,), standard uncertainties, temperatures (NaN for unknown) and days since
    any epoch. stretch: which calibration, counted up; the greatest is in force."""

    zero_nm: Values
    uncertainty_nm: Values
    temperature_degc: Values
    days: Values
    stretch: npt.NDArray[np.intp]

    def only(self, rows: Mask) -> Zeros:
        """Some of them."""
        return Zeros(
            self.zero_nm[rows],
            self.uncertainty_nm[rows],
            self.temperature_degc[rows],
            self.days[rows],
            self.stretch[rows],
        )

    @property
    def has_temperature(self) -> Mask:
        return np.isfinite(self.temperature_degc)


@described
class Share:
    """A coefficient: its value, standard uncertainty, and interval of 95 %."""

    value: float
    uncertainty: float
    low: float
    high: float


@dataclass(frozen=True)
class Trend:
    """per_k: None where temperature is not told apart, for the reason in no_per_k. used: which of
    the rides (n,) it is made of. scatter_nm: of rides, beyond what each knows of itself."""

    per_month: Share
    per_k: Share | None
    no_per_k: str | None
    typical_degc: float | None
    scatter_nm: float
    used: Mask
    stretches: npt.NDArray[np.intp]
    origin_day: float
    coefficients: Values
    covariance: Values
    freedom: int

    def band(self, days: Values, stretch: int) -> tuple[Values, Values]:
        """The zero at the typical temperature on some days (m,), and half its interval of 90 %."""
        rows = np.zeros((len(days), len(self.coefficients)))
        rows[:, np.searchsorted(self.stretches, stretch)] = 1.0
        rows[:, len(self.stretches)] = (days - self.origin_day) / MONTH_DAYS
        variance = np.einsum("ij,jk,ik->i", rows, self.covariance, rows)
        return rows @ self.coefficients, student(NORMAL_90, self.freedom) * np.sqrt(variance)


@dataclass(frozen=True)
class Crossing:
    """When the zero reaches a level of either sign. state: `over` already; `expected` on `day`;
    `not_in_sight` within HORIZON_DAYS. earliest, latest: of 90 %; None for beyond the horizon."""

    level_nm: float
    state: str
    day: float | None = None
    earliest_day: float | None = None
    latest_day: float | None = None


def trend_of(zeros: Zeros, stretch_now: int) -> Trend | str:
    """The trend of rides (n,), else why there is none: `few_rides`, `short_time`, or
    `none_since_calibration`."""
    warm, no_per_k = temperature_counts(zeros)
    used = zeros.has_temperature if warm else np.full(len(zeros.days), True)
    for _ in range(2):
        chosen = zeros.only(used)
        why = what_lacks(chosen, stretch_now, warm)
        if why:
            return why
        design = design_of(chosen, warm)
        outliers = is_outlier(design, chosen)
        if not outliers.any():
            break
        used[np.flatnonzero(used)[outliers]] = False
    chosen = zeros.only(used)
    why = what_lacks(chosen, stretch_now, warm)
    return why or fitted(chosen, warm, no_per_k, used)


def temperature_counts(zeros: Zeros) -> tuple[bool, str | None]:
    """Whether temperature can be separated from age, else why not."""
    with_temperature = zeros.only(zeros.has_temperature)
    if len(with_temperature.days) < 0.5 * len(zeros.days) or not len(with_temperature.days):
        return False, "no_thermometer"
    return (
        (True, None)
        if np.ptp(with_temperature.temperature_degc) >= RANGE_K_MIN
        else (False, "same_weather")
    )


def what_lacks(zeros: Zeros, stretch_now: int, warm: bool) -> str | None:
    """Why these are not enough; None where they are."""
    stretches = np.unique(zeros.stretch)
    if len(zeros.days) - len(stretches) - 1 - warm < FREEDOM_MIN:
        return "few_rides"
    if stretch_now not in stretches:
        return "none_since_calibration"
    spans = [np.ptp(zeros.days[zeros.stretch == stretch]) for stretch in stretches]
    return "short_time" if max(spans) < SPAN_DAYS_MIN else None


def design_of(zeros: Zeros, warm: bool) -> Values:
    """(n, p): a step for each calibration, months, and kelvins from the typical temperature."""
    steps = zeros.stretch[:, None] == np.unique(zeros.stretch)[None, :]
    columns = [steps.astype(float), ((zeros.days - zeros.days.mean()) / MONTH_DAYS)[:, None]]
    if warm:
        columns.append((zeros.temperature_degc - zeros.temperature_degc.mean())[:, None])
    return np.hstack(columns)


def is_outlier(design: Values, zeros: Zeros) -> Mask:
    """Rides (n,) far from where least absolute deviations put them, which a few do not move.

    The scale leaves out as many of the smallest deviations as there are coefficients: those are
    near zero by the fit alone.
    """
    weight = np.ones(len(zeros.days))
    away = np.zeros(len(zeros.days))
    for _ in range(ABSOLUTE_ROUNDS):
        root = np.sqrt(weight)
        coefficients = np.linalg.lstsq(design * root[:, None], zeros.zero_nm * root, rcond=None)[0]
        away = np.abs(zeros.zero_nm - design @ coefficients)
        weight = 1.0 / np.maximum(away, 0.1 * SIGMA_NM_MIN)
    sigma_nm = MAD_TO_DEVIATION * float(np.median(np.sort(away)[design.shape[1] :]))
    return away > OUTLIER_SIGMAS * np.maximum(zeros.uncertainty_nm, max(sigma_nm, SIGMA_NM_MIN))


def fitted(zeros: Zeros, warm: bool, no_per_k: str | None, used: Mask) -> Trend:
    """The trend of rides that were found to be enough."""
    design = design_of(zeros, warm)
    freedom = design.shape[0] - design.shape[1]
    scatter_nm = common_scatter_nm(design, zeros)
    coefficients, covariance, _ = least_squares(design, zeros, scatter_nm)
    quantile = student(NORMAL_95, freedom)
    stretches = np.unique(zeros.stretch)

    def share(index: int) -> Share:
        value, sigma = float(coefficients[index]), float(np.sqrt(covariance[index, index]))
        return Share(value, sigma, value - quantile * sigma, value + quantile * sigma)

    return Trend(
        per_month=share(len(stretches)),
        per_k=share(len(stretches) + 1) if warm else None,
        no_per_k=no_per_k,
        typical_degc=float(zeros.temperature_degc.mean()) if warm else None,
        scatter_nm=scatter_nm,
        used=used,
        stretches=stretches,
        origin_day=float(zeros.days.mean()),
        coefficients=coefficients,
        covariance=covariance,
        freedom=freedom,
    )


def least_squares(design: Values, zeros: Zeros, scatter_nm: float) -> tuple[Any, Any, float]:
    """Coefficients (p,), their covariance (p, p), and chi-squared."""
    weight = 1.0 / (zeros.uncertainty_nm**2 + scatter_nm**2)
    covariance = np.linalg.pinv(design.T @ (design * weight[:, None]))
    coefficients = covariance @ (design.T @ (weight * zeros.zero_nm))
    away = zeros.zero_nm - design @ coefficients
    return coefficients, covariance, float(np.sum(weight * away**2))


def common_scatter_nm(design: Values, zeros: Zeros) -> float:
    """What brings chi-squared to its median, by Wilson and Hilferty; 0 where it is less anyway."""
    freedom = design.shape[0] - design.shape[1]
    median = freedom * (1.0 - 2.0 / (9.0 * freedom)) ** 3
    if least_squares(design, zeros, 0.0)[2] <= median:
        return 0.0
    low, high = 0.0, float(np.ptp(zeros.zero_nm)) + 1.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        if least_squares(design, zeros, middle)[2] > median:
            low = middle
        else:
            high = middle
    return high


def crossing(trend: Trend, level_nm: float, today: float, stretch_now: int) -> Crossing:
    """When the zero reaches a level, from where line and band reach it (Fieller's interval)."""
    days = today + np.arange(HORIZON_DAYS + 1.0)
    line, half = trend.band(days, stretch_now)

    def first(reached: Mask) -> float | None:
        return float(days[np.argmax(reached)]) if reached.any() else None

    day = first(np.abs(line) >= level_nm)
    earliest = first(np.abs(line) + half >= level_nm)
    latest = first(np.abs(line) - half >= level_nm)
    if day == today:
        return Crossing(level_nm, "over", day, earliest, latest)
    return Crossing(level_nm, "not_in_sight" if day is None else "expected", day, earliest, latest)


def level_of(zero_nm: float) -> str:
    """`ok`, `watch` or `act`."""
    if abs(zero_nm) >= ACT_NM:
        return "act"
    return "watch" if abs(zero_nm) >= WATCH_NM else "ok"
