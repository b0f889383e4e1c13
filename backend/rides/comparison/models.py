"""Two rides, or two windows of one, side by side."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from backend.core.api_models import Answer
from backend.law.comparison import CellChange
from backend.rides.comparison.figures import FigureValue
from backend.rides.comparison.route_overlap import RouteOverlap
from backend.rides.insight.models import CrankTorque
from backend.tuning.models.law import FuzzyTable
from backend.tuning.types import ParameterChange

NoCrank = Literal["no_angle", "no_torque", "slow_rows", "few_turns"]


class ComparedSide(Answer):
    """A window of a ride; places on an axis count from its start."""

    ride_id: int
    from_s: float
    to_s: float
    rows: int
    motor_torque_meaning: Literal["demanded", "delivered"] | None
    length_s: float
    length_m: float | None = Field(description="Null where nothing tells its way.")


class ComparedFigure(Answer):
    name: str
    unit: str
    a: FigureValue
    b: FigureValue
    difference: float | None = Field(description="B less A; null where one is missing.")


class ComparedChannel(Answer):
    """A channel under the name of what it is: the torque of a ride that tells only what was asked
    of its motor is `motor_torque_demanded_nm`, whatever the file calls it."""

    name: str
    unit: str
    a: bool
    b: bool


class SideSettings(Answer):
    is_known: bool
    why: Literal["imported", "not_told", "not_kept"] | None = Field(
        description="Why the configuration is not known: a file brought the ride, its unit told "
        "none, or nobody kept what it told. Null where it is known."
    )
    unit_key: str | None
    generation: int | None = Field(description="Null where the settings were changed before.")
    changed_at_s: list[float] = Field(
        description="When they changed within the window: the rest of it was ridden by others."
    )


class TableDifference(Answer):
    which: Literal["first", "second"]
    left: FuzzyTable
    right: FuzzyTable
    cells: list[CellChange]


class SettingsDifference(Answer):
    a: SideSettings
    b: SideSettings
    differences: list[ParameterChange] | None = Field(
        description="From A to B by parameter; null unless both are known."
    )
    tables: list[TableDifference] = Field(description="Those of which anything differs.")


class RideComparison(Answer):
    a: ComparedSide
    b: ComparedSide
    figures: list[ComparedFigure]
    motor_torque: Literal["alike", "apart"] = Field(
        description="`apart`: one ride tells what the motor gave, the other what was asked of it."
    )
    channels: list[ComparedChannel]
    route_overlap: RouteOverlap | None
    no_route: Literal["a", "b", "neither", "too_few"] | None = Field(
        description="Who has no positions, or too few of them; null with `route_overlap`."
    )
    settings: SettingsDifference


class BinExtremes(Answer):
    min: list[float | None]
    max: list[float | None]


class SeriesComparison(Answer):
    name: str
    unit: str
    a: BinExtremes | None = Field(description="Null where the ride has no such channel.")
    b: BinExtremes | None
    difference: list[float | None] | None = Field(
        description="Of the means over time of each bin, B less A, where both have one."
    )


class AxisGap(Answer):
    """A stretch without samples; one in which the bike stood has no length on the way."""

    from_x: float
    to_x: float


class ComparedSeries(Answer):
    """Both rides in bins of equal length. A bin has the least and greatest value of the rows that
    begin in it, else of the row that still holds; in a gap null."""

    by: Literal["time", "distance"]
    unit: Literal["s", "m"]
    end_x: float = Field(description="Of the axis: where the longer of both ends.")
    x: list[float] = Field(description="Edges of the bins, one more than there are bins.")
    channels: list[SeriesComparison]
    a_gaps: list[AxisGap]
    b_gaps: list[AxisGap]


class CrankDifference(Answer):
    """B less A, bin by bin; null unless both are known."""

    rider_nm: list[float] | None
    motor_nm: list[float] | None


class ComparedCrank(Answer):
    """Torque over the crank's angle of both; the motor's only as delivered."""

    a: CrankTorque | None
    b: CrankTorque | None
    a_refused: NoCrank | None
    b_refused: NoCrank | None
    difference: CrankDifference
