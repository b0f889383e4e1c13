"""A small line plot as SVG text: axes, a grid, curves with their names, marks. No library."""

from dataclasses import dataclass, field
from html import escape

Points = list[tuple[float, float]]

WIDTH, HEIGHT = 640, 320
LEFT, RIGHT, TOP, BOTTOM = 56, 150, 16, 44
# Told apart by people who see few colours, and by dashes in print.
STYLES = (("#0b63ce", ""), ("#c2410c", "7 4"), ("#15803d", "2 3"), ("#6b21a8", "10 3 2 3"))


@dataclass
class LinePlot:
    """Curves over one pair of axes; `marks` are single points, as the thesis prints them."""

    title: str
    x_label: str
    y_label: str
    x_max: float
    y_min: float
    y_max: float
    x_step: float
    y_step: float
    curves: list[tuple[str, Points]] = field(default_factory=list)
    marks: list[tuple[str, float, float]] = field(default_factory=list)

    def svg(self) -> str:
        """The whole picture; white behind, so that it can be read on any page."""
        parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
            f'font-family="sans-serif" font-size="12" role="img" '
            f'aria-label="{escape(self.title)}">',
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
            *self._grid(),
        ]
        for number, (name, points) in enumerate(self.curves):
            parts += self._curve(number, name, points)
        for name, x, y in self.marks:
            parts += self._mark(name, x, y)
        return "\n".join([*parts, "</svg>"]) + "\n"

    def _at(self, x: float, y: float) -> tuple[float, float]:
        across = (WIDTH - LEFT - RIGHT) * x / self.x_max
        up = (HEIGHT - TOP - BOTTOM) * (y - self.y_min) / (self.y_max - self.y_min)
        return round(LEFT + across, 1), round(HEIGHT - BOTTOM - up, 1)

    def _grid(self) -> list[str]:
        lines = []
        for step in range(round(self.x_max / self.x_step) + 1):
            x, bottom = self._at(step * self.x_step, self.y_min)
            lines.append(f'<path d="M{x} {bottom}V{TOP}" stroke="#e5e7eb"/>')
            label = f"{step * self.x_step:g}"
            lines.append(f'<text x="{x}" y="{bottom + 16}" text-anchor="middle">{label}</text>')
        for step in range(round((self.y_max - self.y_min) / self.y_step) + 1):
            value = self.y_min + step * self.y_step
            left, y = self._at(0, value)
            lines.append(f'<path d="M{left} {y}H{WIDTH - RIGHT}" stroke="#e5e7eb"/>')
            lines.append(f'<text x="{left - 6}" y="{y + 4}" text-anchor="end">{value:g}</text>')
        middle = (LEFT + WIDTH - RIGHT) / 2
        below = f'x="{middle}" y="{HEIGHT - 8}" text-anchor="middle"'
        lines.append(f"<text {below}>{escape(self.x_label)}</text>")
        lines.append(f'<text x="8" y="{TOP - 3}">{escape(self.y_label)}</text>')
        return lines

    def _curve(self, number: int, name: str, points: Points) -> list[str]:
        colour, dash = STYLES[number % len(STYLES)]
        path = "L".join("{} {}".format(*self._at(x, y)) for x, y in points)
        stroke = f'fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"'
        x, y = WIDTH - RIGHT + 12, TOP + 14 + 20 * number
        return [
            f'<path d="M{path}" {stroke}/>',
            f'<path d="M{x} {y - 4}h22" {stroke}/>',
            f'<text x="{x + 28}" y="{y}">{escape(name)}</text>',
        ]

    def _mark(self, name: str, x: float, y: float) -> list[str]:
        across, up = self._at(x, y)
        beside, anchor = (-6, "end") if x > 0.8 * self.x_max else (6, "start")
        return [
            f'<path d="M{across - 4} {up}h8M{across} {up - 4}v8" stroke="#111827"/>',
            f'<text x="{across + beside}" y="{up - 6}" text-anchor="{anchor}">'
            f"{escape(name)}</text>",
        ]
