"""A unit's configuration as services see it, whatever the make: values, rows, what is on trial."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from backend.core.described import described
from backend.core.parameter_value import ParameterValue
from backend.errors import FieldError

Value: TypeAlias = ParameterValue
ParameterValues: TypeAlias = Mapping[str, Value]

NO_TRIAL = (
    "No change is on trial in this unit: it was kept, given up or its time ran out. Read the "
    "configuration again to see what is active."
)


@dataclass(frozen=True)
class ConfigImage:
    """A unit's whole configuration as it was at one generation; parameters by name.

    A unit that does not count its configurations has generation 0; crc32 tells them apart.
    """

    generation: int
    crc32: int
    parameters: dict[str, Value]


@dataclass(frozen=True)
class TrialStatus:
    """Where the active configuration stands.

    left_s: until it is given up, 0 when it is not on trial. rollback_cause: why the latest trial
    since the unit was switched on was given up: none, asked, time_out or restart.
    """

    on_trial: bool
    generation: int
    crc32: int
    left_s: float
    rollback_cause: str
    rolled_back_generation: int


@dataclass(frozen=True)
class ValuesOnTrial:
    """Values on trial in a unit's memory alone: those that differ from the configuration, by name.

    left_s: until the unit ends it, 0 where nothing is on trial.
    """

    parameters: dict[str, Value]
    left_s: float


@dataclass(frozen=True)
class ParameterRow:
    """What a parameter is. min, max: the unit's own bounds. access: who may change it.

    choices: of an enumeration, None for numbers and texts. length: bytes that a text may have, None
    for numbers. may_be_none: whether the unit takes it without a value. of_the_unit: measured or
    set for this one unit and its bike, as its sensor's calibration and its wheel.
    """

    id: int
    name: str
    group: str
    type: str
    shape: tuple[int, ...]
    unit: str
    min: float | None
    max: float | None
    default: Value
    access: Literal["rider", "dealer", "factory"]
    choices: tuple[str, ...] | None
    length: int | None
    description: str
    may_be_none: bool = False
    of_the_unit: bool = False


@described
class Free:
    """Without the maker's token a value may be set from here to there."""

    min: float
    max: float
    around: str
    """The parameter that holds what the factory measured."""


class ParameterTable(ABC):
    """The parameters of one kind of unit, and the checks of a whole configuration of it.

    rows: in the order they are shown. factory: the maker's names.
    """

    rows: Sequence[ParameterRow]
    factory: frozenset[str] = frozenset()

    def free_of(self, name: str, config: ParameterValues) -> Free | None:
        """The band of a parameter in this configuration; None for one without."""
        return None

    @abstractmethod
    def faults_of(self, config: ParameterValues) -> list[FieldError]:
        """Everything that is wrong with a whole configuration, each element named."""

    @abstractmethod
    def rounded(self, config: ParameterValues) -> dict[str, Value]:
        """A checked configuration as the unit will hold it."""

    @abstractmethod
    def crc32_of(self, config: ParameterValues) -> int:
        """The checksum a unit gives for this whole configuration."""

    def group(self, name: str) -> tuple[str, ...]:
        """Names of the parameters of one group, in the order of the rows."""
        return tuple(row.name for row in self.rows if row.group == name)

    def unknown_names(self, changes: ParameterValues) -> list[FieldError]:
        """A fault for each name that is no parameter."""
        names = {row.name for row in self.rows}
        return [
            FieldError(name, "unknown_parameter", f"{name} is not a parameter of this unit.")
            for name in changes
            if name not in names
        ]
