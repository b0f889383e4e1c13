"""A limit proof: what is proven of a configuration on a firmware, with the bound of each proof."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from datetime import datetime
from typing import Any

from backend.core.described import described
from backend.core.moments import utc

NOT_COVERED = (
    "sensor_gain",
    "wheel_circumference",
    "late_readings",
    "motor_control",
    "restart",
    "other_firmware",
)
"""What no proof about the law can hold: see `backend.law.prove_limits`."""


@dataclass(frozen=True, slots=True)
class Claim:
    """One statement about every ride there can be.

    code: names it. message: the statement in words. unit: of the numbers. bound: what was proven;
    None where the thing does not happen at all. allowed: what the market's law asks for, None
    where it asks for nothing. least: the law asks for `allowed` or more, not for less. how:
    `structure`, a step of the pipeline that nothing comes after or that every way goes through;
    `interval`, bounds over every cell of a table; `recursion`, what a filter or ramp can remember.
    values: what the message tells, by name, for a text in another language.
    """

    code: str
    message: str
    unit: str
    bound: float | None
    allowed: float | None
    least: bool
    how: str
    values: Mapping[str, float | str]

    @property
    def margin(self) -> float | None:
        """From the bound to what is allowed; negative where the claim breaks the law."""
        if self.allowed is None:
            return None
        if self.bound is None:
            return self.allowed
        return self.bound - self.allowed if self.least else self.allowed - self.bound

    @property
    def holds(self) -> bool:
        """Whether the law is kept; rounding of the unit's own numbers is no breach."""
        margin = self.margin
        return margin is None or margin >= -ROUNDING * max(1.0, abs(self.allowed or 0.0))


ROUNDING = 5e-7
"""Of a limit, as a share: it is a float32 in the unit and a decimal in the law."""


@described
class Cell:
    """Between two speed points: the assist per rider torque that any mode asks for at most, and
    what the market allows there at least."""

    from_kmh: float
    to_kmh: float
    ratio_most: float
    allowed_ratio: float | None


@dataclass(frozen=True, slots=True)
class LimitProof:
    """Of one configuration, for one firmware, by one version of the method.

    sha256: of all that it says and is about. table_sha256: of both fuzzy tables. market_sha256: of
    the market's numbers in that firmware. unproven: why nothing is said of the unit itself, None
    if something is. created_us: when it was first made.
    """

    sha256: str
    config_sha256: str
    table_sha256: str
    market: str
    market_sha256: str
    firmware_version: str
    method: int
    claims: tuple[Claim, ...]
    cells: tuple[Cell, ...]
    not_covered: tuple[str, ...] = NOT_COVERED
    unproven: str | None = None
    created_us: int | None = None

    @property
    def holds(self) -> bool:
        """Whether every claim keeps the law, and the proof is about this unit's firmware."""
        return self.unproven is None and all(claim.holds for claim in self.claims)

    @property
    def created_at(self) -> datetime | None:
        """`created_us` as a moment in UTC."""
        if self.created_us is None:
            return None
        return utc(self.created_us)

    def body(self) -> dict[str, Any]:
        """As plain JSON, without when it was made and for whom it was asked."""
        told = asdict(self)
        for name in ("sha256", "created_us", "unproven"):
            told.pop(name)
        return told
