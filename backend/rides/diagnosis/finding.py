"""What a diagnosis is made of, and what it looks at."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, Literal

import numpy as np
import numpy.typing as npt

from backend.core.channels import Values
from backend.core.described import described

Mask = npt.NDArray[np.bool_]
Span = tuple[float, float]

Severity = Literal["note", "warning", "serious"]
State = Literal["clean", "found", "impossible"]
FindingKind = Literal[
    "zero_drift",
    "saturation",
    "rows_lost",
    "sensor_silent",
    "torque_late",
    "brown_out",
    "derating",
    "speed_jump",
    "speed_silent",
    "wheel",
]
CheckName = Literal[
    "zero_drift",
    "saturation",
    "drop_outs",
    "brown_out",
    "derating",
    "implausible_speed",
    "wheel",
]
NOTE: Final = "note"
WARNING: Final = "warning"
SERIOUS: Final = "serious"
SEVERITIES: tuple[Severity, ...] = (NOTE, WARNING, SERIOUS)
CLEAN: Final = "clean"
FOUND: Final = "found"
IMPOSSIBLE: Final = "impossible"


@described
class DiagnosisFinding:
    """Something that is not as it should be, with its evidence."""

    kind: FindingKind
    """Which check found it, with what it found."""
    severity: Severity
    from_s: float
    """Where to look first."""
    to_s: float
    """With `from_s`: where to look first."""
    numbers: Mapping[str, float]
    """By name with its unit, the threshold with it."""
    channel: str | None = None
    """What it is about, if it is one."""


@described
class DiagnosisCheck:
    """One question; `impossible` where the ride lacks what it needs, named in `missing`: channels,
    values of the configuration, or a rest, fast rows, a straight way."""

    name: CheckName
    state: State
    findings: tuple[DiagnosisFinding, ...] = ()
    missing: tuple[str, ...] = ()


@dataclass(frozen=True)
class Limits:
    """What the ride's configuration and law say; None where nobody kept it.

    temperature: the bit of `limit_flags` for it.
    """

    temperature: int
    battery_voltage_v_min: float | None = None
    wheel_circumference_m: float | None = None


@dataclass(frozen=True)
class Evidence:
    """The rows of a ride: values by channel (n,), missing as NaN; when each begins and how long it
    holds (n,). gaps: between rows. paused: where the device says that its timer stood."""

    values: Mapping[str, Values]
    start_s: Values
    seconds: Values
    limits: Limits
    gaps: Sequence[Span] = ()
    paused: Sequence[Span] = ()
    derived: frozenset[str] = field(default_factory=frozenset)

    def has(self, *names: str) -> bool:
        """Whether each channel has a sample."""
        return not self.missing(names)

    def missing(self, names: Sequence[str]) -> tuple[str, ...]:
        """Those of the channels without a sample."""
        return tuple(n for n in names if n not in self.values or np.isnan(self.values[n]).all())

    def spans(self, mask: Mask) -> Iterator[slice]:
        """Runs of rows (n,) that are true, none across a gap."""
        breaks = np.diff(self.start_s) > self.seconds[:-1] + 1e-6
        starts = mask & ~np.append(False, mask[:-1] & ~breaks)
        stops = mask & ~np.append(mask[1:] & ~breaks, False)
        for first, last in zip(np.flatnonzero(starts), np.flatnonzero(stops), strict=True):
            yield slice(int(first), int(last) + 1)

    def time(self, rows: slice) -> Span:
        """From the first row's beginning to the last one's end."""
        return float(self.start_s[rows.start]), float(self.end_s[rows.stop - 1])

    @property
    def end_s(self) -> Values:
        """When each row ends (n,)."""
        return self.start_s + self.seconds
