"""All checks of a ride's samples, each with what it needs; and the zero of its torque sensor.

METHOD is in every answer. It is counted up whenever a threshold or a method changes, so that an
answer that somebody kept says by which it was made; a ride keeps none, it is asked anew.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from backend import law
from backend.core.ride import Ride
from backend.core.ride_zero import RideZero
from backend.rides.diagnosis.finding import (
    CLEAN,
    FOUND,
    IMPOSSIBLE,
    SEVERITIES,
    CheckName,
    DiagnosisCheck,
    DiagnosisFinding,
    Evidence,
    Limits,
)
from backend.rides.diagnosis.speed import implausible_speed, wheel
from backend.rides.diagnosis.supply import HOT_DEGC, brown_out, derating, drop_outs
from backend.rides.diagnosis.torque import TORQUE, saturation, zero_drift
from backend.rides.diagnosis.zero import ZERO_CHANNELS, zero_of
from backend.rides.logbook.cards import DueRides, made_or
from backend.rides.rows import RideColumns, columns_of
from backend.rides.settings_in_force import ConfigOf, all_through
from backend.store import Store

METHOD = 1


@dataclass(frozen=True)
class Question:
    """needs: of each of these at least one channel. config: a limit that has to be known. lacks:
    what is missing where `check` has no answer although the channels are there."""

    name: CheckName
    check: Callable[[Evidence], list[DiagnosisFinding] | None]
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


def diagnose(ride: Evidence) -> list[DiagnosisCheck]:
    """Every question, asked where it can be."""
    return [checked(question, ride) for question in QUESTIONS]


def checked(question: Question, ride: Evidence) -> DiagnosisCheck:
    """One question's answer."""
    missing = [names[0] for names in question.needs if not any(map(ride.has, names))]
    if question.config is not None and getattr(ride.limits, question.config) is None:
        missing.append(question.config)
    if missing or not len(ride.start_s):
        return DiagnosisCheck(question.name, IMPOSSIBLE, missing=tuple(missing))
    findings = question.check(ride)
    if findings is None:
        return DiagnosisCheck(question.name, IMPOSSIBLE, missing=(question.lacks,))
    return DiagnosisCheck(question.name, FOUND if findings else CLEAN, tuple(findings))


class Diagnosis:
    """Looks at one ride. Holds nothing of it; safe from any thread."""

    def __init__(self, store: Store, config_of: ConfigOf) -> None:
        self._store = store
        self._config_of = config_of

    def __call__(self, ride_id: int) -> dict[str, Any]:
        """The answer as in the API. Raises NotFound, ObjectDamaged."""
        rows = columns_of(self._store, ride_id, NEEDED)
        config, _ = all_through(self._config_of, rows.ride)
        evidence = evidence_of(rows, limits_of(config))
        checks = [asdict(check) for check in diagnose(evidence)]
        findings = [finding for check in checks for finding in check["findings"]]
        worst = max((SEVERITIES.index(one["severity"]) for one in findings), default=None)
        return {
            "ride_id": ride_id,
            "method": METHOD,
            "worst": None if worst is None else SEVERITIES[worst],
            "checks": checks,
        }


def evidence_of(rows: RideColumns, limits: Limits) -> Evidence:
    """A ride's rows as the diagnosis looks at them."""
    return Evidence(
        rows.values,
        rows.start_s,
        rows.seconds,
        limits,
        gaps=[(gap.from_s, gap.to_s) for gap in rows.ride.gaps],
        paused=paused(rows.ride),
        derived=frozenset(channel.name for channel in rows.ride.derived),
    )


def limits_of(config: Mapping[str, Any]) -> Limits:
    """What a configuration says; nothing of one that nobody kept."""
    return Limits(
        temperature=law.LIMITS["temperature"],
        battery_voltage_v_min=config.get("battery_voltage_v_min"),
        wheel_circumference_m=config.get("wheel_circumference_m"),
    )


def paused(ride: Ride) -> list[tuple[float, float]]:
    """Where the device says that its timer stood."""
    return [(pause.from_s, pause.to_s) for pause in ride.metadata.pauses]


UNREADABLE = RideZero(reason="unreadable")


class RideZeros(DueRides):
    """The zeros that are due."""

    def __init__(self, store: Store) -> None:
        super().__init__(store, store.zeros.due)

    def make(self, ride: Ride) -> None:
        """A ride's zero, or why it tells none."""
        zero = made_or(UNREADABLE, "zero", ride, lambda: self._zero(ride))
        self._store.zeros.save(ride, zero)

    def _zero(self, ride: Ride) -> RideZero:
        # Most files of head units: their rows need not be read.
        if TORQUE not in {channel.name for channel in ride.channels}:
            return RideZero(reason="no_torque")
        return zero_of(evidence_of(columns_of(self._store, ride.id, ZERO_CHANNELS), limits_of({})))
