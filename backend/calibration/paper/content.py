"""What the certificate's paper is made of, and how its numbers and moments are written."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, tzinfo

from backend.calibration.capture import Capture
from backend.calibration.certificate import Evaluated
from backend.calibration.paper.words import WORDS
from backend.paper.sheet import Paper, width_on


@dataclass(frozen=True)
class Struck:
    """A capture that does not count. author: who struck it out, as kept."""

    capture: Capture
    author: str
    reason: str


@dataclass(frozen=True)
class Change:
    """What was done to the unit's record: `write` or `restore`."""

    kind: str
    at_us: int
    generation: int | None


@dataclass(frozen=True)
class ClockSet:
    """The host's clock was set then. dated: dates of before were moved, else they are wrong."""

    at_us: int
    dated: bool


@dataclass(frozen=True)
class Certified:
    """A certificate, worked out again, and what the job around it tells.

    file: the name of its file. unit_sha256: of the document the unit keeps the mark of, None where
    nothing was written. closed_us: None for one that is open.
    """

    evaluated: Evaluated
    file: str
    unit_sha256: str | None
    closed_us: int | None
    change: Change | None
    struck: Sequence[Struck]
    clock_set: Sequence[ClockSet] = ()


@dataclass(frozen=True)
class Manner:
    """How it is printed. zone: of all moments; UTC unless another is chosen."""

    language: str = "en"
    zone: tzinfo = UTC
    paper: Paper = "a4"

    @property
    def width(self) -> float:
        """Between the margins, in points."""
        return width_on(self.paper)

    def say(self, name: str, /, **values: object) -> str:
        """Words of the language, with values put in."""
        return WORDS[self.language][name].format(**values)

    def choice(self, name: str) -> str:
        """A word of a program's as it is written, unless the language has one."""
        return WORDS[self.language].get(name, name)

    def moment(self, at_us: int) -> str:
        """To the second, with the zone's offset."""
        at = datetime.fromtimestamp(at_us // 1_000_000, UTC).astimezone(self.zone)
        text = at.strftime("%Y-%m-%d %H:%M:%S %z")
        return f"{text[:-2]}:{text[-2:]}".replace("+00:00", "UTC")


def number(value: float | None, digits: int, sign: bool = False) -> str:
    """With so many digits behind the point; a dash for what nobody measured."""
    if value is None:
        return "—"
    text = f"{value:{'+' if sign else ''}.{digits}f}"
    return text.replace("-", "−") if float(text) != 0 else f"{0:.{digits}f}"


def significant(value: float | None, digits: int = 6) -> str:
    """With so many digits that count."""
    if value is None:
        return "—"
    before = math.floor(math.log10(abs(value))) + 1 if value else 1
    return number(value, max(0, digits - before))
