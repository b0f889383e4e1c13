"""The steady window: what a capture is made of, whether it may be taken, and why not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from backend.domain.calibration.prechecks import Check, Measured, prechecks
from backend.domain.calibration.refusal import Refusal
from backend.domain.calibration.setup import Setup
from backend.domain.calibration.steady import WINDOW_S, Steadiness, Window, steadiness
from backend.services.calibration.readings import RAW, SENSOR_DEGC, TORQUE, Recent

LOOK_S = 0.5
"""How finely it is told since when the readings are steady."""

MISSING_SHARE_MAX = 0.05
"""As many readings may be missing as may be damaged."""

NOT_HEARD = Refusal("no_readings", "the unit is not heard, or it sends no raw counts")


@dataclass(frozen=True)
class Look:
    """The newest window and what is said of it. raw_counts: (n,), missing ones left out."""

    raw_counts: tuple[int, ...]
    duration_s: float
    found: Steadiness | None
    reasons: tuple[Refusal, ...]
    sensor_degc: float | None
    unit_nm: float | None

    @property
    def steady(self) -> bool:
        """Whether a capture may be taken."""
        return not self.reasons


def look(recent: Recent, setup: Setup) -> Look:
    """At the newest window of what was not captured yet."""
    window = recent.last(WINDOW_S)
    raw = tuple(int(value) for value in window.known(RAW))
    degc = window.known(SENSOR_DEGC)
    found = steadiness(Window(raw, window.duration_s, degc.tolist()), setup)
    reasons = [*_turning(window), *_missing(window, len(raw))]
    if found is None:
        needed: dict[str, float | str] = {"needed_s": WINDOW_S}
        sentence = f"{window.duration_s:.1f} s so far, {WINDOW_S:g} s are needed"
        reasons.append(Refusal("too_short", sentence, window.duration_s, needed))
    else:
        reasons += found.reasons
    return Look(
        raw,
        window.duration_s,
        found,
        tuple(reasons),
        float(degc.mean()) if degc.size else None,
        window.mean(TORQUE),
    )


def steady_s(recent: Recent, setup: Setup) -> float:
    """For how long the readings are such that a capture could be taken, looked at backwards."""
    back_s = 0.0
    while back_s < recent.duration_s and look(recent.before(back_s), setup).steady:
        back_s += LOOK_S
    return 0.0 if back_s == 0.0 else WINDOW_S + back_s - LOOK_S


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
    told = f"no fault: {names}" if faults else "no fault"
    values: dict[str, float | str] = {"names": names}
    return (*prechecks(now), Check("faults", not faults, told, float(len(faults)), 0.0, values))


def _turning(window: Recent) -> list[Refusal]:
    """A crank or wheel that turns in the window moves the load's arm, or is a rider."""
    turned: dict[str, float | str] = {
        name: float(np.abs(window.known(name)).max(initial=0.0))
        for name in ("speed_kmh", "cadence_rpm")
    }
    if not any(turned.values()):
        return []
    sentence = (
        f"the bike moves: {turned['speed_kmh']:.1f} km/h, crank {turned['cadence_rpm']:.1f} rpm"
    )
    return [Refusal("turning", sentence, values=turned)]


def _missing(window: Recent, known: int) -> list[Refusal]:
    lost = window.t_us.size - known
    if lost <= MISSING_SHARE_MAX * window.t_us.size:
        return []
    sentence = f"{lost} of {window.t_us.size} readings did not come from the sensor"
    return [Refusal("readings_missing", sentence, float(lost), {"readings": window.t_us.size})]
