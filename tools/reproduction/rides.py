"""Draws scenarios that are ridden: `python -m tools.reproduction.rides FOLDER [NAME ...]`.

One SVG a scenario and group of values, over time; a point is the mean of what lies between it and
the next, so strokes show as what they give. `--from 60 --seconds 0.2 --step 0.001` looks at
what happens within a fifth of a second, millisecond by millisecond.
"""

import argparse
import math
from pathlib import Path
from typing import Any

from sim_device.lockstep import LockstepUnit
from sim_device.scenario_file import load, names
from tools.reproduction.line_plot import LinePlot, Points

POINTS_MAX = 300
GROUPS: dict[str, tuple[str, tuple[tuple[str, str], ...]]] = {
    "speed": ("km/h", (("speed_kmh", "speed"),)),
    "cadence": ("r/min", (("cadence_rpm", "cadence"), ("cog_teeth", "cog, teeth"))),
    "torque": ("Nm", (("spindle_torque_nm", "pedals"), ("crank_motor_nm", "motor, crank"))),
    "battery": ("V, A", (("battery_voltage_v", "voltage"), ("battery_current_a", "current"))),
}
GEAR_RATIO = 40.34


def ridden(name: str, from_s: float, seconds: float, step_s: float) -> list[dict[str, Any]]:
    """What an observer sees of one round of the scenario, within the window."""
    scenario = load(name)
    unit = LockstepUnit(scenario.seed, scenario=name)
    unit.advance(from_s)
    rows: list[dict[str, Any]] = []
    for seen in unit.ride_once(step_s):
        seen["crank_motor_nm"] = seen["motor_torque_nm"] * GEAR_RATIO
        rows.append(seen)
        if seen["t_s"] >= from_s + seconds:
            break
    return rows


def nice_step(span: float) -> float:
    """A step of 1, 2 or 5 times a power of ten that makes four to ten lines of a span."""
    power = 10.0 ** math.floor(math.log10(span / 4))
    return max(step for step in (power, 2 * power, 5 * power) if step <= span / 4)


def means(rows: list[dict[str, Any]], key: str) -> Points:
    """At most POINTS_MAX points: seconds since the first row, and the mean of a run of rows."""
    begun_s, length = rows[0]["t_s"], -(-len(rows) // POINTS_MAX)
    runs = [rows[at : at + length] for at in range(0, len(rows), length)]
    return [(run[0]["t_s"] - begun_s, sum(row[key] for row in run) / len(run)) for run in runs]


def drawn(name: str, group: str, rows: list[dict[str, Any]]) -> LinePlot:
    unit, curves = GROUPS[group]
    points = [(label, means(rows, key)) for key, label in curves]
    x_max = max(rows[-1]["t_s"] - rows[0]["t_s"], 1e-3)
    values = [y for _, curve in points for _, y in curve]
    y_step = nice_step(max(max(values), 1.0))
    y_min = y_step * math.floor(min(*values, 0.0) / y_step)
    y_max = y_step * math.ceil(max(*values, y_step) / y_step)
    return LinePlot(
        f"{name}: {group}", "s", unit, x_max, y_min, y_max, nice_step(x_max), y_step, points
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--groups", nargs="+", choices=GROUPS, default=list(GROUPS))
    parser.add_argument("--from", dest="from_s", type=float, default=0.0)
    parser.add_argument("--seconds", type=float, default=36_000.0)
    parser.add_argument("--step", type=float, default=0.1)
    asked = parser.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    for name in asked.names or [each for each in names() if load(each).live]:
        rows = ridden(name, asked.from_s, asked.seconds, asked.step)
        for group in asked.groups:
            picture = asked.folder / f"{name}-{group}.svg"
            picture.write_text(drawn(name, group, rows).svg(), encoding="utf-8")


if __name__ == "__main__":
    main()
