"""A picture with two axes, drawn in vectors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from reportlab.platypus import Flowable

from backend.paper.sheet import INK, LINE, OK, QUIET, SMALL, write

ROOM = {"left": 34.0, "right": 8.0, "top": 12.0, "bottom": 26.0}
MARK = 2.6
Shape = Literal["up", "down"]


@dataclass(frozen=True)
class Points:
    """Marks (n,) in the axes' units: a full triangle up, an open one down; beside: points away, so
    that two of one place do not hide each other."""

    across: Sequence[float]
    up: Sequence[float]
    shape: Shape
    colour: Any
    offset: float = 0.0


@dataclass(frozen=True)
class Line:
    """A line through (n,)."""

    across: Sequence[float]
    up: Sequence[float]
    colour: Any


class Plot(Flowable):  # type: ignore[misc]  # reportlab tells no types
    """across: from 0 to the largest. up: the same far above and below zero, `half`. band: half the
    height of what is allowed, with its words."""

    def __init__(
        self,
        size: tuple[float, float],
        across: tuple[float, str],
        half: float,
        drawn: Sequence[Points | Line],
        band: tuple[float, str] | None = None,
    ) -> None:
        super().__init__()
        self.width, self.height = size
        self._most, self._label = across
        self._half, self._drawn, self._band = half, drawn, band

    def draw(self) -> None:
        """Called by reportlab with the canvas moved to the picture's lower left corner."""
        self._grid()
        for one in self._drawn:
            places = [(self._x(x), self._y(y)) for x, y in zip(one.across, one.up, strict=True)]
            if isinstance(one, Line):
                self._line(places, one.colour)
            else:
                for x, y in places:
                    self._mark(x + one.offset, y, one)

    def _x(self, value: float) -> float:
        wide = self.width - ROOM["left"] - ROOM["right"] - 8
        return ROOM["left"] + 8 + wide * value / self._most

    def _y(self, value: float) -> float:
        high = self.height - ROOM["top"] - ROOM["bottom"]
        return ROOM["bottom"] + high * (value + self._half) / (2 * self._half)

    def _grid(self) -> None:
        canvas, right = self.canv, self.width - ROOM["right"]
        if self._band:
            half, words = self._band
            low = self._y(-half)
            canvas.setFillColor(OK, alpha=0.08)
            canvas.rect(ROOM["left"], low, right - ROOM["left"], self._y(half) - low, 0, 1)
            canvas.setFillColor(OK, alpha=1)
            write(canvas, right, self.height - 8, words, SMALL, anchor=1.0)
        canvas.setFillColor(QUIET)
        canvas.setLineWidth(0.4)
        for value, name in round_ticks(-self._half, self._half):
            canvas.setStrokeColor(INK if value == 0 else LINE)
            canvas.line(ROOM["left"], self._y(value), right, self._y(value))
            write(canvas, ROOM["left"] - 3, self._y(value) - 2.5, name, SMALL, anchor=1.0)
        for value, name in round_ticks(0, self._most):
            write(canvas, self._x(value), ROOM["bottom"] - 9, name, SMALL, anchor=0.5)
        middle = (ROOM["left"] + right) / 2
        write(canvas, middle, 5, self._label, SMALL, anchor=0.5)

    def _line(self, places: Sequence[tuple[float, float]], colour: Any) -> None:
        path = self.canv.beginPath()
        for number, (x, y) in enumerate(places):
            (path.lineTo if number else path.moveTo)(x, y)
        self.canv.setStrokeColor(colour)
        self.canv.setLineWidth(1)
        self.canv.drawPath(path)

    def _mark(self, x: float, y: float, points: Points) -> None:
        sign = 1 if points.shape == "up" else -1
        path = self.canv.beginPath()
        path.moveTo(x - MARK, y - sign * MARK * 0.8)
        path.lineTo(x + MARK, y - sign * MARK * 0.8)
        path.lineTo(x, y + sign * MARK)
        path.close()
        self.canv.setLineWidth(0.8)
        self.canv.setStrokeColor(points.colour)
        self.canv.setFillColor(points.colour)
        self.canv.drawPath(path, stroke=1, fill=int(sign > 0))


def round_ticks(low: float, high: float, about: int = 5) -> list[tuple[float, str]]:
    """Values at a step of 1, 2 or 5 times a power of ten, with their text."""
    raw = (high - low) / about
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(power * one for one in (1, 2, 5, 10) if power * one >= raw * 0.999)
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    numbers = range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)
    return [(n * step, f"{n * step:.{digits}f}".replace("-", "−")) for n in numbers]
