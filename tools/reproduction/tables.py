"""Writes docs/tables.md: `python -m tools.reproduction.tables`, half a minute of a core.

Every number on the page is computed now, by the simulated unit with the table under test.
"""

from collections.abc import Callable, Sequence
from pathlib import Path

from backend.core.fuzzy_table import FuzzyTable
from backend.law import lint, presets
from firmware_protocol._generated import PARAMETERS
from firmware_protocol.configuration_file import TABLE
from firmware_protocol.parameters import default_config
from tools.reproduction.table_rides import (
    Ride,
    column_shares,
    mean_gain,
    mean_kmh,
    ridden,
    ripple_pct,
    start_s,
    switched_hz,
    wh_per_km,
)

PAGE = Path(__file__).resolve().parents[2] / "docs" / "tables.md"
# The thesis's first, since the others are compared with it.
TABLES = ("thesis-table", "thesis-rescaled", "even", "strong-start")
ROADS = ("commute", "stop_and_go", "hill_start", "cold_morning", "alpine_climb")
LIMIT_GROUPS = ("limits", "market")
HALF_TURN = {"torque_filter": "half_turn"}

Rides = dict[tuple[str, str], Ride]


def main() -> None:
    came = {name for name in presets.names() if presets.load(name).format == TABLE}
    if came != set(TABLES):
        raise SystemExit(f"TABLES does not name what comes with Spindle: {', '.join(sorted(came))}")
    rides = {(table, road): ridden(table, road) for table in TABLES for road in ROADS}
    page = [
        "# Which table for what",
        "",
        "Four fuzzy tables come with Spindle. `spindle device presets` lists them,",
        "`spindle device diff NAME` shows what one would change in a unit, and",
        "`spindle device restore NAME` puts it there: as the first table, with the points that the",
        "second one shares. `GET /api/v1/library/NAME` is its file.",
        "",
        "Written by `python -m tools.reproduction.tables`: every number is measured by the",
        "simulated bike in virtual time, with a unit for the EU as it leaves the factory (stroke",
        "filter 0.5 s) and the table as its first. A road is one round of the scenario of that",
        "name; all are ridden in the fuzzy mode sport (ratio 1), `alpine_climb` in boost (1.5).",
        "",
        *purpose_section(),
        *start_section(),
        *energy_section(rides),
        *ripple_section(rides),
        *column_section(rides),
        *half_turn_section(),
        *choice_section(),
    ]
    PAGE.write_text("\n".join(page) + "\n", encoding="utf-8")


def grid(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """A table of the page, an empty line after it."""
    lines = [head, ["---"] * len(head), *rows]
    return [*(f"| {' | '.join(line)} |" for line in lines), ""]


def by_road(rides: Rides, cell: Callable[[Ride, str], str]) -> list[str]:
    """A row for each road, a column for each table. cell: of a ride and its table."""
    rows = [[road, *(cell(rides[table, road], table) for table in TABLES)] for road in ROADS]
    return grid(["road", *(f"`{table}`" for table in TABLES)], rows)


def warnings_of(table: str) -> str:
    """The codes of what the linter warns of, under the limits of a unit for the EU."""
    factory = default_config()
    limits = {row.name: factory[row.name] for row in PARAMETERS if row.group in LIMIT_GROUPS}
    report = lint(FuzzyTable.from_parameters(presets.load(table).values), limits=limits)
    return ", ".join(f"`{finding.code}`" for finding in report.warnings) or "nothing"


def purpose_section() -> list[str]:
    rows = [[f"`{name}`", presets.load(name).comment, warnings_of(name)] for name in TABLES]
    return grid(["table", "what it is good for", "the linter warns of"], rows)


def start_section() -> list[str]:
    rows = [
        [
            f"`{table}`",
            f"{start_s(table, 'constant'):.1f} s",
            f"{start_s(table, 'legs'):.1f} s",
            f"{switched_hz(table):.1f}",
            f"{switched_hz(table, hard_cut=True):.1f}",
        ]
        for table in TABLES
    ]
    head = ["table", "15 km/h, servo", "15 km/h, legs", "on and off a second at 25 km/h"]
    return [
        "## Away, and at the limit",
        "",
        "From rest on the level, 100 kg, 24.48 Nm at the crank, as in the scenario `start`: a",
        "servo's even torque, and legs with two strokes a turn. At the limit: legs that hold 25",
        "km/h with the motor, half a minute. No table decides that: the factory's band of 1.5",
        "km/h does, and under the thesis's configuration, which cuts hard, every table is",
        "switched.",
        "",
        *grid([*head, "the same, hard cut"], rows),
    ]


def energy_section(rides: Rides) -> list[str]:
    def cell(ride: Ride, _: str) -> str:
        battery, shaft = wh_per_km(ride)
        return f"{battery:.2f} / {shaft:.2f}, {mean_kmh(ride):.1f}"

    return [
        "## Energy",
        "",
        "Wh/km from the battery, electronics included / from the motor's shaft; mean km/h, stops",
        "included. The rider pushes the same whatever the table: what a table saves, it saves by",
        "helping less, and the bike is a little slower. Where the motor's 2 Nm decide (the",
        "climbs), the table hardly does.",
        "",
        *by_road(rides, cell),
    ]


def ripple_section(rides: Rides) -> list[str]:
    return [
        "## Evenness",
        "",
        "Ripple: rms of the delivered motor torque about its mean over the half turn of the crank",
        "around each moment, as a share of the mean torque, while the motor helps. Most of it is",
        "the stroke that the filter lets through; a gain that follows the torque rate adds to it.",
        "A motor at its 2 Nm is even whatever the law asks: on the pass `even` asks for less, is",
        "there less often, and ripples more.",
        "",
        *by_road(rides, lambda ride, _: f"{ripple_pct(ride):.1f} %"),
    ]


def column_section(rides: Rides) -> list[str]:
    def cell(ride: Ride, table: str) -> str:
        shares = " ".join(f"{100 * share:.0f}" for share in column_shares(ride, table))
        return f"{shares}; {mean_gain(ride):.2f}"

    return [
        "## Which columns act",
        "",
        "Percent of the assisted time in which the rules of each torque-rate column acted, NB to",
        "PB, each moment weighted by how much they had to say; then the mean gain. Half of the",
        "time the filtered torque falls and counts as the first column. While it rises, the",
        "stroke of steady legs gives rates up to 0.16: a table whose points lie above leaves its",
        "columns to starts, and one whose points lie below is led through them twice a turn.",
        "",
        *by_road(rides, cell),
    ]


def half_turn_section() -> list[str]:
    rows = []
    for table in TABLES:
        ride = ridden(table, "commute", HALF_TURN)
        shares = " ".join(f"{100 * share:.0f}" for share in column_shares(ride, table))
        battery, _ = wh_per_km(ride)
        away_s = start_s(table, "legs", HALF_TURN)
        cell = [f"{battery:.2f} Wh/km", f"{ripple_pct(ride):.1f} %", shares, f"{away_s:.1f} s"]
        rows.append([f"`{table}`", *cell])
    return [
        "## With the mean over half a turn",
        "",
        "The commute and the start again with `torque_filter` at `half_turn`, which leaves none of",
        "the stroke ([filters](torque-filter.md)): then the torque rate is zero but for real",
        "changes of the push, every table is more even, and little depends on the columns.",
        "",
        *grid(["table", "battery", "ripple", "columns, %", "15 km/h, legs"], rows),
    ]


def choice_section() -> list[str]:
    return [
        "## What is seen",
        "",
        "- The torque rate tells the stroke, not the rider's mind, for all but the first half",
        "  second of a start. So rescaling the thesis's columns makes them act and costs",
        "  evenness, and gains little away.",
        "- Speed rows do what the torque rate was meant for. `strong-start` uses them alone: it",
        "  is the quickest away, more even than the thesis's table, and takes no more energy on",
        "  the commute.",
        "- `even` gives next to nothing to steady pedalling: choose the help by the mode's ratio.",
        "- The linter's `gain_at_steady_torque` asks for no gain while the rider pushes evenly. A",
        "  table that helps at low speed and obeys it can only do so on the rise of every stroke.",
    ]


if __name__ == "__main__":
    main()
