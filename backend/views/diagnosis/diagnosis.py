"""All checks of a ride, each with what it needs.

METHOD is in every answer. It is counted up whenever a threshold or a method changes, so that an
answer that somebody kept says by which it was made; a ride keeps none, it is asked anew.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from backend.views.diagnosis.finding import CLEAN, FOUND, IMPOSSIBLE, Check, Evidence, Finding
from backend.views.diagnosis.losses import drop_outs
from backend.views.diagnosis.speed import implausible_speed, wheel
from backend.views.diagnosis.supply import HOT_DEGC, brown_out, derating
from backend.views.diagnosis.torque import saturation, zero_drift

METHOD = 1


@dataclass(frozen=True)
class Question:
    """needs: of each of these at least one channel. config: a limit that has to be known. lacks:
    what is missing where `ask` has no answer although the channels are there."""

    name: str
    ask: Callable[[Evidence], list[Finding] | None]
    needs: tuple[tuple[str, ...], ...] = ()
    config: str | None = None
    lacks: str = ""


QUESTIONS = (
    Question(
        "zero_drift",
        zero_drift,
        (("rider_torque_nm",), ("speed_kmh",), ("cadence_rpm",)),
        lacks="rest",
    ),
    Question(
        "saturation",
        saturation,
        (("rider_torque_raw", "rider_torque_nm"),),
        lacks="fast_rows",
    ),
    Question("drop_outs", drop_outs),
    Question("brown_out", brown_out, (("battery_voltage_v",),), "battery_voltage_v_min"),
    Question("derating", derating, (("limit_flags", *HOT_DEGC),)),
    Question("implausible_speed", implausible_speed, (("speed_kmh",),)),
    Question(
        "wheel",
        wheel,
        (("latitude_deg",), ("longitude_deg",), ("distance_m", "speed_kmh")),
        lacks="straight_way",
    ),
)
NEEDED = (
    *("rider_torque_nm", "rider_torque_raw", "rider_power_w", "speed_kmh", "cadence_rpm"),
    *("heart_rate_bpm", "torque_age_ms", "battery_voltage_v", "battery_current_a", "limit_flags"),
    *("latitude_deg", "longitude_deg", "distance_m", *HOT_DEGC),
)
"""Every channel that any of them looks at."""


def diagnose(ride: Evidence) -> list[Check]:
    """Every question, asked where it can be."""
    return [checked(question, ride) for question in QUESTIONS]


def checked(question: Question, ride: Evidence) -> Check:
    """One question's answer."""
    missing = [names[0] for names in question.needs if not any(map(ride.has, names))]
    if question.config is not None and getattr(ride.limits, question.config) is None:
        missing.append(question.config)
    if missing or not len(ride.start_s):
        return Check(question.name, IMPOSSIBLE, missing=tuple(missing))
    findings = question.ask(ride)
    if findings is None:
        return Check(question.name, IMPOSSIBLE, missing=(question.lacks,))
    return Check(question.name, FOUND if findings else CLEAN, tuple(findings))
