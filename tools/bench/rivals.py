"""The rivals' side of the law benchmark: the thesis controller in pyfuzzylite and scikit-fuzzy.

Runs in an environment of its own (pyfuzzylite wants numpy < 2) and prints one JSON object:
seconds per evaluation and the gains it found at the given points, so that both sides are known to
compute the same thing. Usage: python rivals.py points.json
"""

import json
import sys
import time
from pathlib import Path

import fuzzylite as fl
import numpy as np
import skfuzzy as fuzz
from skfuzzy import control

LABELS = ("NB", "NS", "ZO", "PS", "PB")
RESOLUTION = 101


def triangles(points: list[float], low: float, high: float) -> list[tuple[float, float, float]]:
    """Corners of evenly chained triangles; the outer feet mirror the inner ones."""
    left = 2 * points[0] - points[1]
    right = 2 * points[-1] - points[-2]
    feet = [left, *points, right]
    return [(feet[i], feet[i + 1], feet[i + 2]) for i in range(len(points))]


def fuzzylite_engine(table: dict) -> fl.Engine:
    speeds = table["speed_points_kmh"]
    inputs = []
    for name, points in (("speed", speeds), ("rate", table["torque_rate_points"])):
        terms = [
            fl.Triangle(label, *corners)
            for label, corners in zip(LABELS, triangles(points, 0, 0), strict=True)
        ]
        terms[0] = fl.Trapezoid("NB", 2 * points[0] - points[1] - 1, -1e3, points[0], points[1])
        inputs.append(fl.InputVariable(name=name, minimum=0, maximum=points[-1], terms=terms))
    gain = fl.OutputVariable(
        name="gain",
        minimum=0.0,
        maximum=0.5,
        aggregation=fl.Maximum(),
        defuzzifier=fl.Centroid(RESOLUTION),
        terms=[
            fl.Triangle(label, *corners)
            for label, corners in zip(LABELS, triangles(table["gain_points"], 0, 0.5), strict=True)
        ],
    )
    rules = [
        fl.Rule.create(f"if speed is {row} and rate is {column} then gain is {label}")
        for row, labels in zip(LABELS, table["rules"], strict=True)
        for column, label in zip(LABELS, labels, strict=True)
    ]
    block = fl.RuleBlock(conjunction=fl.Minimum(), implication=fl.Minimum(), rules=rules)
    block.activation = fl.General()
    engine = fl.Engine(input_variables=inputs, output_variables=[gain], rule_blocks=[block])
    for rule in rules:
        rule.load(engine)
    return engine


def time_fuzzylite(table: dict, points: list[list[float]]) -> tuple[float, list[float]]:
    engine = fuzzylite_engine(table)
    speed, rate = engine.input_variables
    gains = []
    start = time.perf_counter()
    for speed_kmh, torque_rate in points:
        speed.value = speed_kmh
        rate.value = torque_rate
        engine.process()
        gains.append(float(np.asarray(engine.output_variables[0].value).ravel()[0]))
    return (time.perf_counter() - start) / len(points), gains


def time_scikit_fuzzy(table: dict, points: list[list[float]]) -> tuple[float, list[float]]:
    speeds, rates = table["speed_points_kmh"], table["torque_rate_points"]
    speed = control.Antecedent(np.linspace(0, speeds[-1], RESOLUTION), "speed")
    rate = control.Antecedent(np.linspace(0, rates[-1], RESOLUTION), "rate")
    gain = control.Consequent(np.linspace(0, 0.5, RESOLUTION), "gain")
    for variable, peaks in ((speed, speeds), (rate, rates), (gain, table["gain_points"])):
        for label, corners in zip(LABELS, triangles(peaks, 0, 0), strict=True):
            variable[label] = fuzz.trimf(variable.universe, corners)
    speed["NB"] = fuzz.trapmf(speed.universe, [-1, -1, speeds[0], speeds[1]])
    rules = [
        control.Rule(speed[row] & rate[column], gain[label])
        for row, labels in zip(LABELS, table["rules"], strict=True)
        for column, label in zip(LABELS, labels, strict=True)
    ]
    simulation = control.ControlSystemSimulation(control.ControlSystem(rules), cache=False)
    gains = []
    start = time.perf_counter()
    for speed_kmh, torque_rate in points:
        simulation.input["speed"] = speed_kmh
        simulation.input["rate"] = torque_rate
        simulation.compute()
        gains.append(float(simulation.output["gain"]))
    return (time.perf_counter() - start) / len(points), gains


def main() -> None:
    request = json.loads(Path(sys.argv[1]).read_text())
    table, points = request["table"], request["points"]
    fuzzylite_s, fuzzylite_gains = time_fuzzylite(table, points)
    scikit_s, scikit_gains = time_scikit_fuzzy(table, points[:100])
    print(
        json.dumps(
            {
                "pyfuzzylite": {"seconds": fuzzylite_s, "gains": fuzzylite_gains},
                "scikit_fuzzy": {"seconds": scikit_s, "gains": scikit_gains},
            }
        )
    )


if __name__ == "__main__":
    main()
