"""The judge of trials: what is tried is one whole write, ends in time, and ends for a reason.

It reads the slots' own words in the unit's flash and goes by the unit's clock. Nobody may end a
trial but its author, its time and a restart; nobody but its author makes it last.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from firmware_protocol.layout import Value
from firmware_protocol.parameters import unpack_image
from tests.fakes.config_flash import (
    AT_CONFIRMED,
    AT_PROVISIONAL,
    AT_VOID,
    generation_at,
    image_at,
    is_written,
)
from tests.simulation.violation import Violation

SLOTS_AT = (0, 1024)
MAGIC = b"EBL3"
WORD_BYTES = 4
# The unit looks at its clock every millisecond, the judge every ten.
LATE_S = 0.1
# Until the control step after the end of a trial has been seen.
ECHO_S = 0.05


@dataclass
class Trial:
    """A configuration on trial in the flash. boot: which boot of the unit."""

    number: int
    image: bytes
    values: dict[str, Value]
    began_s: float
    boot: int
    confirm_s: int = 0
    marker: str = ""
    return_asked: bool = False
    ended: str | None = None
    ended_s: float = 0.0


class TrialChecks:
    """One unit's trials. Methods raise Violation with what was seen."""

    def __init__(self) -> None:
        self.trials: list[Trial] = []

    @property
    def current(self) -> Trial | None:
        """What is on trial now."""
        if self.trials and self.trials[-1].ended is None:
            return self.trials[-1]
        return None

    def limits(self, unit_s: float) -> list[Mapping[str, Value]]:
        """What is tried, or was until just now."""
        last = self.trials[-1] if self.trials else None
        recent = last is not None and (last.ended is None or unit_s - last.ended_s < ECHO_S)
        return [last.values] if last is not None and recent else []

    def looked(self, slots: bytes, unit_s: float, boot: int) -> Trial | None:
        """Slots that changed; a trial that began, for its author to be named."""
        found = on_trial(slots)
        current = self.current
        if current is not None and found == (current.number, current.image):
            return None
        if current is not None:
            self._ended(current, slots, unit_s, boot)
        if found is None:
            return None
        trial = Trial(found[0], found[1], unpack_image(found[1]), unit_s, boot)
        self.trials.append(trial)
        return trial

    def _ended(self, trial: Trial, slots: bytes, unit_s: float, boot: int) -> None:
        trial.ended_s = unit_s
        if is_confirmed(slots, trial.image):
            trial.ended = "kept"
        elif boot != trial.boot:
            trial.ended = "restart"
        elif unit_s >= trial.began_s + trial.confirm_s - LATE_S:
            trial.ended = "time_out"
        else:
            trial.ended = "asked"

    def passed(self, unit_s: float, boot: int) -> None:
        """Time went by on a unit that has power."""
        current = self.current
        if current is None:
            return
        if boot != current.boot:
            raise Violation(f"{current.marker} is still on trial after a restart.")
        if unit_s > current.began_s + current.confirm_s + LATE_S:
            raise Violation(
                f"{current.marker} is on trial since {unit_s - current.began_s:.1f} s; after "
                f"{current.confirm_s} s it was to be given up."
            )

    def reasons_in(self, boot: int) -> tuple[str, ...]:
        """What a unit may tell in this boot of the latest trial that it gave up."""
        for trial in reversed(self.trials):
            if trial.ended in ("asked", "time_out") and trial.boot == boot:
                last_moment = abs(trial.ended_s - trial.began_s - trial.confirm_s) < LATE_S
                both = last_moment and trial.return_asked
                return ("asked", "time_out") if both else (trial.ended,)
            if trial.ended == "restart" and trial.boot == boot - 1:
                return ("restart",)
        return ("none",)


def on_trial(slots: bytes) -> tuple[int, bytes] | None:
    """Generation and image of the slot on trial. A word that was begun was meant."""
    for at in SLOTS_AT:
        if slots[at : at + 4] != MAGIC or not says(slots, at + AT_PROVISIONAL):
            continue
        if not says(slots, at + AT_CONFIRMED) and not says(slots, at + AT_VOID):
            return generation_at(slots, at), image_at(slots, at)
    return None


def is_confirmed(slots: bytes, image: bytes) -> bool:
    """Whether a slot that was confirmed holds this image."""
    return any(
        says(slots, at + AT_CONFIRMED)
        and not says(slots, at + AT_VOID)
        and slots[at : at + 4] == MAGIC
        and image_at(slots, at) == image
        for at in SLOTS_AT
    )


def says(slots: bytes, at: int) -> bool:
    """Whether the state word at this address counts."""
    return is_written(slots[at : at + WORD_BYTES])
