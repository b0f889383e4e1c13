"""What a unit's sensor reads now, and which of its readings no capture has taken yet."""

from __future__ import annotations

import threading

import numpy as np

from backend.domain.calibration.coefficients import Coefficients
from backend.domain.calibration.prechecks import Check
from backend.domain.calibration.setup import Setup
from backend.services.calibration.body import Body
from backend.services.calibration.readings import RAW, SENSOR_DEGC, Recent, RecentReadings
from backend.services.calibration.record import coefficients_of
from backend.services.calibration.telling import reading_nm
from backend.services.calibration.views import ReadingView
from backend.services.calibration.window import NOT_HEARD, checks_of, look, measured, steady_s
from backend.services.units.device_view import DeviceView

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
        device: DeviceView | None,
        body: Body,
        setup: Setup | None,
        fitted: Coefficients | None,
    ) -> ReadingView:
        """As the page shows it several times a second; the unit is not asked."""
        recent = None if device is None else self.untaken(device.id)
        shown = None if device is None else self.recent.of(device.id)
        if device is None or recent is None or shown is None:
            return silent(None if device is None else device.id)
        found = coefficients_of(body["found"])
        checks = self.checks(device, body)
        if setup is None:
            newest = recent.newest(RAW)
            degc = recent.newest(SENSOR_DEGC)
            return told(device.id, shown, checks, found_nm=reading_nm(found, newest, degc))
        seen = look(recent, setup)
        mean = None if seen.found is None else seen.found.mean_counts
        return told(
            device.id,
            shown,
            checks,
            steady=seen.steady,
            steady_s=steady_s(recent, setup),
            reasons=seen.reasons,
            mean_counts=mean,
            deviation_counts=None if seen.found is None else seen.found.deviation_counts,
            spread_counts=None if seen.found is None else seen.found.spread_counts,
            spread_allowed_counts=None if seen.found is None else seen.found.spread_allowed_counts,
            window_s=seen.duration_s,
            found_nm=reading_nm(found, mean, seen.sensor_degc),
            fitted_nm=reading_nm(fitted, mean, seen.sensor_degc),
            unit_nm=seen.unit_nm,
        )

    def checks(self, device: DeviceView, body: Body) -> tuple[Check, ...]:
        """The prechecks of this moment; none of a unit that is not heard."""
        recent = self.recent.of(device.id)
        if recent is None:
            return ()
        newest = recent.last(IDLE_S)
        found = coefficients_of(body["found"])
        idle_nm = reading_nm(found, newest.mean(RAW), newest.mean(SENSOR_DEGC))
        now = measured(recent, idle_nm, body["unit"]["battery_min_v"])
        return checks_of(now, device.faults_active)


def silent(device_id: str | None) -> ReadingView:
    """Of a unit that nobody hears."""
    return ReadingView(
        device_id=device_id,
        steady=False,
        steady_s=0.0,
        reasons=(NOT_HEARD,),
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


def told(device_id: str, recent: Recent, checks: tuple[Check, ...], **known: object) -> ReadingView:
    """The last seconds thinned, with what is known of them."""
    places = np.arange(recent.t_us.size)[:: max(1, -(-recent.t_us.size // SHOWN_MAX))]
    raw = recent.values[RAW][places]
    view = {
        **{name: getattr(silent(device_id), name) for name in ReadingView.__dataclass_fields__},
        "reasons": (),
        "t_s": tuple(((recent.t_us[places] - recent.t_us[-1]) / 1e6).tolist()),
        "raw_counts": tuple(int(value) if np.isfinite(value) else None for value in raw),
        "sensor_degc": recent.newest(SENSOR_DEGC),
        "cadence_rpm": recent.newest("cadence_rpm"),
        "speed_kmh": recent.newest("speed_kmh"),
        "checks": checks,
        **known,
    }
    return ReadingView(**view)
