"""The certificate's tables: fit, figures, budget, verification, captures; and its pictures: what
the new scale leaves of each reading, and the loop.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from reportlab.lib import colors

from backend.calibration.asymmetry import LoadShare
from backend.calibration.capture import State
from backend.calibration.fit import NAMES, Fit
from backend.calibration.paper.content import Certified, Manner, number, significant
from backend.calibration.paper.words import meaning
from backend.calibration.worked import Worked
from backend.paper.plot import Line, Plot, Points, Shape
from backend.paper.sheet import INK, QUIET, SMALL, table, text

UP: tuple[Shape, Any] = ("up", colors.HexColor("#c4470a"))
DOWN: tuple[Shape, Any] = ("down", colors.HexColor("#0868a8"))
HIGH = 150.0
OFFSET_PX = 2.0
LEAST_HALF_NM = 0.05
"""So that noise does not fill a picture."""


def residual_picture(certified: Certified, worked: Worked, manner: Manner) -> Any:
    """Over the load: up the way up, down the way down, the means as a line."""
    fit, curve = worked.fit, worked.curve
    assert fit is not None
    assert curve is not None
    setup = certified.evaluated.content.setup
    allowed = worked.judgement.limits.total_pct * setup.full_scale_nm / 100
    ways = {one.number: one.state.direction for one in certified.evaluated.content.captures}
    down = [one for one in fit.residuals if ways.get(one.capture) == "unloading"]
    up = [one for one in fit.residuals if ways.get(one.capture) != "unloading"]
    half = 1.1 * max(allowed, *(abs(one.residual_nm) for one in fit.residuals))
    most = max(one.load_nm for one in fit.residuals)
    marks = [
        Points([one.load_nm for one in some], [one.residual_nm for one in some], *style)
        for some, style in ((up, (*UP, -OFFSET_PX)), (down, (*DOWN, OFFSET_PX)))
    ]
    mean = Line(curve.load_nm, curve.residual_nm, INK)
    band = (allowed, manner.say("band", nm=number(allowed, 2)))
    size = (manner.width / 2 - 6, HIGH)
    return Plot(size, (most, manner.say("axis")), half, [*marks, mean], band)


def loop_picture(worked: Worked, manner: Manner) -> Any:
    """The mean way up and the mean way down, less the mean of the two."""
    assert worked.curve is not None
    points = [
        (load, loop / 2)
        for load, loop in zip(worked.curve.load_nm, worked.curve.loop_nm, strict=True)
        if loop is not None
    ]
    if len(points) < 2:
        return text(manner.say("no_loop"))
    loads = [load for load, _ in points]
    halves = [half for _, half in points]
    most = 1.2 * max(LEAST_HALF_NM, *(abs(half) for half in halves))
    drawn: list[Line | Points] = []
    for sign, (shape, colour) in ((-1, UP), (1, DOWN)):
        values = [sign * half for half in halves]
        drawn += [Line(loads, values, colour), Points(loads, values, shape, colour)]
    size = (manner.width / 2 - 6, HIGH)
    return Plot(size, (max(loads), manner.say("axis")), most, drawn)


Row = list[Any]


def fit_table(certified: Certified, fit: Fit, manner: Manner) -> Any:
    """Each coefficient as found and as fitted, with its uncertainty and what it means."""
    unit_coefficients = certified.evaluated.content.found
    head = ["coefficient", "as_found", "fitted_value", "expanded", "meaning"]
    rows: list[Row] = [[manner.say(name) for name in head]]
    for name in NAMES:
        value = getattr(fit.coefficients, name)
        sure = significant(fit.expanded(name), 2) if name in fit.names else ""
        rows.append(
            [
                manner.say(name),
                significant(
                    None if unit_coefficients is None else getattr(unit_coefficients, name)
                ),
                manner.say("not_told") if value is None else significant(value),
                sure and f"± {sure}",
                _meaning(manner, name),
            ]
        )
    return table(rows, _shares(manner, 16, 13, 15, 15, 41), (1, 2, 3))


def figures_table(certified: Certified, worked: Worked, manner: Manner) -> Any:
    """Percent of full scale, each beside what is allowed and with its sentence."""
    head = ["figure", "right", "left", "both", "allowed", "meaning"]
    rows: list[Row] = [[manner.say(name) for name in head]]
    for name, code, sides, both, allowed in _figures(certified, worked):
        cells = [number(sides.get(side), 2) if side in sides else "" for side in ("right", "left")]
        limit = "" if allowed is None else f"≤ {allowed:g}"
        rows.append([manner.say(name), *cells, both, limit, _meaning(manner, code)])
    return table(rows, _shares(manner, 25, 8, 8, 14, 8, 37), (1, 2, 3, 4))


def _figures(
    certified: Certified, worked: Worked
) -> Iterator[tuple[str, str, dict[str, float], str, float | None]]:
    """Name, code of its meaning, of each pedal, of both, allowed."""
    limits = worked.judgement.limits
    full = certified.evaluated.content.setup.full_scale_nm
    for name, field, allowed in (
        ("linearity_load", "linearity_load_pct", None),
        ("linearity_line", "linearity_line_pct", limits.linearity_pct),
        ("hysteresis", "hysteresis_pct", limits.hysteresis_pct),
        ("repeatability_deviation", "repeatability_deviation_pct", None),
        ("repeatability_range", "repeatability_range_pct", None),
        ("total", "total_deviation_pct", limits.total_pct),
    ):
        yield name, name, {one.side: getattr(one, field) for one in worked.figures}, "", allowed
    assert worked.fit is not None
    repeated = 200 * worked.fit.repeatability_nm / full
    yield "repeatability", "repeatability", {}, number(repeated, 2), limits.repeatability_pct
    back = worked.zero_return_nm
    back_pct = None if back is None else 100 * abs(back) / full
    yield "zero_return", "zero_return", {}, number(back_pct, 2), limits.zero_return_pct
    asymmetry = worked.asymmetry
    for name, allowed in (
        ("left_right", limits.left_right_pct),
        ("bending_across", limits.bending_pct),
    ):
        yield name, name, {}, _share(getattr(asymmetry, name, None)), allowed
    if worked.budget is not None:
        expanded = 100 * max(worked.budget.expanded_nm) / full
        yield "whole", "expanded", {}, number(expanded, 2), limits.expanded_pct


def budget_table(worked: Worked, manner: Manner) -> Any:
    """Standard uncertainties at no load, half of the full scale and all of it."""
    budget = worked.budget
    assert budget is not None
    last = len(budget.torque_nm) - 1
    places = (0, last // 2, last)
    at = [manner.say("at", nm=f"{budget.torque_nm[place]:g}") for place in places]
    rows: list[Row] = [[manner.say("cause"), *at, manner.say("freedom"), manner.say("meaning")]]
    for one in budget.contributions:
        freedom = "∞" if one.degrees_of_freedom is None else f"{one.degrees_of_freedom:g}"
        cells = [number(one.standard_nm[place], 4) for place in places]
        name = manner.say(f"cause_{one.cause}")
        rows.append([name, *cells, freedom, _meaning(manner, one.cause)])
    free = budget.degrees_of_freedom[last]
    for name, values, digits, freedom, code in (
        ("combined", budget.combined_nm, 4, "∞" if free is None else f"{free:.0f}", "combined"),
        ("coverage", budget.coverage, 2, "", ""),
        ("expanded_row", budget.expanded_nm, 3, "", "expanded"),
    ):
        cells = [number(values[place], digits) for place in places]
        heading = text(manner.say(name), bold=True)
        rows.append([heading, *cells, freedom, _meaning(manner, code) if code else ""])
    return table(rows, _shares(manner, 21, 12, 12, 12, 11, 32), (1, 2, 3, 4))


def verification_table(worked: Worked, manner: Manner) -> Any:
    """Every mass that was hung after the fit."""
    head = ["load", "reads", "off", "explained", "unseen"]
    rows: list[Row] = [[manner.say(name) for name in head]]
    rows += [
        [
            number(one.load_nm, 2),
            number(one.reading_nm, 2),
            number(one.difference_nm, 2, sign=True),
            f"± {number(one.expanded_nm, 2)}",
            manner.say("unseen_yes" if one.unseen else "unseen_no"),
        ]
        for one in worked.verifications
    ]
    return table(rows, _shares(manner, 16, 16, 16, 26, 26), (0, 1, 2, 3))


def captures_table(certified: Certified, worked: Worked, manner: Manner) -> Any:
    """Every capture that counts, with the mean of its raw counts and what the fit leaves."""
    head = ["", "what", "", "stroke", "angle", "kg", "load", "degc", "mean", "spread"]
    head += ["samples", "reads", "residual"]
    rows: list[Row] = [[name and manner.say(name) for name in head]]
    residuals = () if worked.fit is None else worked.fit.residuals
    readings_nm = {one.capture: (one.reading_nm, one.residual_nm) for one in residuals}
    readings_nm |= {
        one.capture: (one.reading_nm, one.difference_nm) for one in worked.verifications
    }
    setup = certified.evaluated.content.setup
    for one in certified.evaluated.content.captures:
        reading, left = readings_nm.get(one.number, (None, None))
        state = one.state
        rows.append(
            [
                str(one.number),
                what(state, manner),
                "" if state.side is None else manner.say(state.side),
                str(state.stroke),
                f"{state.crank_angle_deg:g}",
                f"{state.mass_kg:g}",
                number(state.load_nm(setup), 2),
                number(state.sensor_degc, 1),
                number(one.mean_counts, 2),
                number(one.deviation_counts, 1),
                str(one.count),
                number(reading, 2),
                number(left, 2, sign=True),
            ]
        )
    return table(rows, _shares(manner, 5, 11, 6, 7, 8, 7, 8, 7, 10, 8, 6, 9, 8), (*range(3, 13),))


def what(state: State, manner: Manner) -> str:
    """Of a capture: zero, up or down, a verification."""
    if state.kind != "load":
        return manner.say(state.kind)
    return manner.say(state.direction or "loading")


def _share(share: LoadShare | None) -> str:
    if share is None:
        return "—"
    return f"{number(100 * share.share, 2, sign=True)} ± {number(200 * share.standard, 2)}"


def _meaning(manner: Manner, code: str) -> Any:
    return text(meaning(manner.language, code), SMALL, QUIET)


def _shares(manner: Manner, *parts: float) -> Sequence[float]:
    return [manner.width * part / sum(parts) for part in parts]
