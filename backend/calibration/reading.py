"""What a unit's sensor reads now; the steady window that a capture is made of, whether it may be
taken, and why not.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from backend.calibration.coefficients import Coefficients
from backend.calibration.describe import reading_nm
from backend.calibration.job import Body
from backend.calibration.prechecks import Check, Measured, Refusal, prechecks
from backend.calibration.samples import RAW, SENSOR_DEGC, TORQUE, Recent, RecentReadings
from backend.calibration.setup import Setup
from backend.calibration.steady import WINDOW_S, Steadiness, Window, steadiness
from backend.calibration.types import Reading
from backend.calibration.unit_record import coefficients_of
from backend.units.types import Device

STEADY_STEP_S = 0.5
"""The resolution of how long the readings have been steady."""

MISSING_SHARE_MAX = 0.05
"""As many readings may be missing as may be damaged."""

NO_READINGS = Refusal("no_readings", "the unit is not heard, or it sends no raw counts")


@dataclass(frozen=True)
class SteadyWindow:
    """The newest window and what is said of it. raw_counts: (n,), missing ones left out."""

    raw_counts: tuple[int, ...]
    duration_s: float
    steadiness: Steadiness | None
    reasons: tuple[Refusal, ...]
    sensor_degc: float | None
    unit_nm: float | None

    @property
    def steady(self) -> bool:
        """Whether a capture may be taken."""
        return not self.reasons


def newest_window(recent: Recent, setup: Setup) -> SteadyWindow:
    """At the newest window of what was not captured yet."""
    window = recent.last(WINDOW_S)
    raw = tuple(int(value) for value in window.finite(RAW))
    degc = window.finite(SENSOR_DEGC)
    result = steadiness(Window(raw, window.duration_s, degc.tolist()), setup)
    reasons = [*_turning(window), *_missing(window, len(raw))]
    if result is None:
        needed: dict[str, float | str] = {"needed_s": WINDOW_S}
        sentence = f"{window.duration_s:.1f} s so far, {WINDOW_S:g} s are needed"
        reasons.append(Refusal("too_short", sentence, window.duration_s, needed))
    else:
        reasons += result.reasons
    return SteadyWindow(
        raw,
        window.duration_s,
        result,
        tuple(reasons),
        float(degc.mean()) if degc.size else None,
        window.mean(TORQUE),
    )


def steady_s(recent: Recent, setup: Setup) -> float:
    """For how long the readings are such that a capture could be taken, looked at backwards."""
    back_s = 0.0
    while back_s < recent.duration_s and newest_window(recent.before(back_s), setup).steady:
        back_s += STEADY_STEP_S
    return 0.0 if back_s == 0.0 else WINDOW_S + back_s - STEADY_STEP_S


def measured(recent: Recent, idle_nm: float | None, battery_min_v: float | None) -> Measured:
    """What the prechecks judge. idle_nm: the newest readings on the kept calibration."""
    return Measured(
        wheel_kmh=recent.newest("speed_kmh"),
        cadence_rpm=recent.newest("cadence_rpm"),
        motor_rpm=recent.newest("motor_speed_rpm"),
        idle_nm=idle_nm,
        battery_v=recent.newest("battery_voltage_v"),
        battery_min_v=battery_min_v,
        warming_k=recent.warming_k,
    )


def checks_of(now: Measured, faults: Sequence[str]) -> tuple[Check, ...]:
    """The prechecks, and that the unit tells of no fault."""
    names = ", ".join(faults)
    sentence = f"no fault: {names}" if faults else "no fault"
    values: dict[str, float | str] = {"names": names}
    return (*prechecks(now), Check("faults", not faults, sentence, float(len(faults)), 0.0, values))


def _turning(window: Recent) -> list[Refusal]:
    """A crank or wheel that turns in the window moves the load's arm, or is a rider."""
    turned: dict[str, float | str] = {
        name: float(np.abs(window.finite(name)).max(initial=0.0))
        for name in ("speed_kmh", "cadence_rpm")
    }
    if not any(turned.values()):
        return []
    sentence = (
        f"the bike moves: {turned['speed_kmh']:.1f} km/h, crank {turned['cadence_rpm']:.1f} rpm"
    )
    return [Refusal("turning", sentence, values=turned)]


def _missing(window: Recent, readings: int) -> list[Refusal]:
    lost = window.t_us.size - readings
    if lost <= MISSING_SHARE_MAX * window.t_us.size:
        return []
    sentence = f"{lost} of {window.t_us.size} readings did not come from the sensor"
    return [Refusal("readings_missing", sentence, float(lost), {"readings": window.t_us.size})]


SHOWN_MAX = 250
"""Points of ten seconds: as many as a small chart can show."""

IDLE_S = 1.0


class Readings:
    """The last seconds of every unit, and from when on they are nobody's. For any thread."""

    def __init__(self, recent: RecentReadings) -> None:
        self.recent = recent
        self._lock = threading.Lock()
        self._taken_us: dict[str, int] = {}

    def taken(self, device_id: str) -> None:
        """What has come so far is a capture: the next one is made of what comes from now on."""
        recent = self.recent.of(device_id)
        if recent is not None and recent.t_us.size:
            with self._lock:
                self._taken_us[device_id] = int(recent.t_us[-1])

    def untaken(self, device_id: str) -> Recent | None:
        """The last seconds without what a capture has; None where the unit is not heard."""
        recent = self.recent.of(device_id)
        with self._lock:
            taken_us = self._taken_us.get(device_id)
        # A unit that started anew counts from zero again.
        if recent is None or taken_us is None or taken_us > int(recent.t_us[-1]):
            return recent
        return recent.since(taken_us)

    def now(
        self,
        device: Device | None,
        body: Body,
        setup: Setup | None,
        fitted: Coefficients | None,
    ) -> Reading:
        """As the page shows it several times a second; the unit is not asked."""
        recent = None if device is None else self.untaken(device.id)
        shown = None if device is None else self.recent.of(device.id)
        if device is None or recent is None or shown is None:
            return silent(None if device is None else device.id)
        unit_coefficients = coefficients_of(body["found"])
        checks = self.checks(device, body)
        if setup is None:
            newest = recent.newest(RAW)
            degc = recent.newest(SENSOR_DEGC)
            return reading_of(
                device.id, shown, checks, found_nm=reading_nm(unit_coefficients, newest, degc)
            )
        window = newest_window(recent, setup)
        mean = None if window.steadiness is None else window.steadiness.mean_counts
        return reading_of(
            device.id,
            shown,
            checks,
            steady=window.steady,
            steady_s=steady_s(recent, setup),
            reasons=window.reasons,
            mean_counts=mean,
            deviation_counts=None
            if window.steadiness is None
            else window.steadiness.deviation_counts,
            spread_counts=None if window.steadiness is None else window.steadiness.spread_counts,
            spread_allowed_counts=None
            if window.steadiness is None
            else window.steadiness.spread_allowed_counts,
            window_s=window.duration_s,
            found_nm=reading_nm(unit_coefficients, mean, window.sensor_degc),
            fitted_nm=reading_nm(fitted, mean, window.sensor_degc),
            unit_nm=window.unit_nm,
        )

    def checks(self, device: Device, body: Body) -> tuple[Check, ...]:
        """The prechecks of this moment; none of a unit that is not heard."""
        recent = self.recent.of(device.id)
        if recent is None:
            return ()
        newest = recent.last(IDLE_S)
        unit_coefficients = coefficients_of(body["found"])
        idle_nm = reading_nm(unit_coefficients, newest.mean(RAW), newest.mean(SENSOR_DEGC))
        now = measured(recent, idle_nm, body["unit"]["battery_min_v"])
        return checks_of(now, device.faults_active)


def silent(device_id: str | None) -> Reading:
    """Of a unit that nobody hears."""
    return Reading(
        device_id=device_id,
        steady=False,
        steady_s=0.0,
        reasons=(NO_READINGS,),
        t_s=(),
        raw_counts=(),
        mean_counts=None,
        deviation_counts=None,
        spread_counts=None,
        spread_allowed_counts=None,
        window_s=0.0,
        found_nm=None,
        fitted_nm=None,
        unit_nm=None,
        sensor_degc=None,
        cadence_rpm=None,
        speed_kmh=None,
        checks=(),
    )


def reading_of(
    device_id: str, recent: Recent, checks: tuple[Check, ...], **figures: object
) -> Reading:
    """The last seconds thinned, with what is known of them."""
    places = np.arange(recent.t_us.size)[:: max(1, -(-recent.t_us.size // SHOWN_MAX))]
    raw = recent.values[RAW][places]
    view = {
        **{name: getattr(silent(device_id), name) for name in Reading.__dataclass_fields__},
        "reasons": (),
        "t_s": tuple(((recent.t_us[places] - recent.t_us[-1]) / 1e6).tolist()),
        "raw_counts": tuple(int(value) if np.isfinite(value) else None for value in raw),
        "sensor_degc": recent.newest(SENSOR_DEGC),
        "cadence_rpm": recent.newest("cadence_rpm"),
        "speed_kmh": recent.newest("speed_kmh"),
        "checks": checks,
        **figures,
    }
    return Reading(**view)
