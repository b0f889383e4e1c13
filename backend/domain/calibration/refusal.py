"""Why something is not taken: a code for programs and pages, a sentence, the figure."""

from __future__ import annotations

from dataclasses import dataclass, field

from backend.domain.calibration.plain import Plain


@dataclass(frozen=True, slots=True)
class Refusal(Plain):
    """figure: the number that decides, in the unit the code implies; None where it is no number.

    values: what the sentence tells besides, by name, for a text in another language. captures:
    the numbers of those at fault.
    """

    code: str
    sentence: str
    figure: float | None = None
    values: dict[str, float | str] = field(default_factory=dict)
    captures: tuple[int, ...] = ()
