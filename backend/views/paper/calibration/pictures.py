"""The certificate's pictures: what the new scale leaves of each reading, and the loop."""

from __future__ import annotations

from typing import Any

from reportlab.lib import colors

from backend.domain.calibration.worked import Worked
from backend.views.paper.calibration.told import Certified, Manner, number
from backend.views.paper.plot import Line, Plot, Points, Shape
from backend.views.paper.sheet import INK, text

UP: tuple[Shape, Any] = ("up", colors.HexColor("#c4470a"))
DOWN: tuple[Shape, Any] = ("down", colors.HexColor("#0868a8"))
HIGH = 150.0
BESIDE = 2.0
LEAST_HALF_NM = 0.05
"""So that noise does not fill a picture."""


def residual_picture(told: Certified, worked: Worked, manner: Manner) -> Any:
    """Over the load: up the way up, down the way down, the means as a line."""
    fit, curve = worked.fit, worked.curve
    assert fit is not None
    assert curve is not None
    setup = told.evaluated.told.setup
    allowed = worked.judgement.limits.total_pct * setup.full_scale_nm / 100
    ways = {one.number: one.state.direction for one in told.evaluated.told.captures}
    down = [one for one in fit.residuals if ways.get(one.capture) == "unloading"]
    up = [one for one in fit.residuals if ways.get(one.capture) != "unloading"]
    half = 1.1 * max(allowed, *(abs(one.residual_nm) for one in fit.residuals))
    most = max(one.load_nm for one in fit.residuals)
    marks = [
        Points([one.load_nm for one in some], [one.residual_nm for one in some], *look)
        for some, look in ((up, (*UP, -BESIDE)), (down, (*DOWN, BESIDE)))
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
