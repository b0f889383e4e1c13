"""The map of a report: the track from the ride's own positions, as SVG, which asks nobody.

North up, true at the track's mean latitude, open in gaps; modes by dash and width, so that a grey
print tells them apart, too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from backend.core.channels import Values
from backend.core.ride_events import RideEvent
from backend.rides.traces.figure import MOTOR_COLOUR, NEUTRAL_COLOUR, RIDER_COLOUR
from backend.rides.traces.track import Track

WIDTH, HEIGHT, MARGIN, SCALE_PX = 880, 480, 28, 150
# Of a great circle, mean radius 6371 km.
M_PER_DEG = 111_195.0
# A bike that never moved is a dot.
M_PER_PX_MIN = 0.02
MARKS = 6
STEPS = (1.0, 2.0, 5.0)
# Colour, dash and width of each mode's line, as the pages have them; of others the last.
LOOKS = (
    ("#667570", "", 2.0),
    (NEUTRAL_COLOUR, "1 6", 3.5),
    ("#a03c7c", "10 6", 3.5),
    (MOTOR_COLOUR, "", 3.5),
    (RIDER_COLOUR, "", 6.0),
    ("#0a5f69", "2 2", 3.5),
)
UNKNOWN = ("#0a5f69", "", 3.5)


@dataclass(frozen=True)
class Drawn:
    """Points in the drawing's pixels, each (n,), of rising times. run: changes over a gap."""

    t_s: Values
    x: Values
    y: Values
    run: np.ndarray[tuple[int], np.dtype[np.intp]]
    m_per_px: float

    def at(self, t_s: float) -> tuple[float, float] | None:
        """Where the bike was, None in a gap."""
        after = int(np.searchsorted(self.t_s, t_s))
        around = self.run[max(after - 1, 0)], self.run[min(after, len(self.run) - 1)]
        if around[0] != around[1]:
            return None
        return float(np.interp(t_s, self.t_s, self.x)), float(np.interp(t_s, self.t_s, self.y))


def track_map(
    track: Track,
    events: Sequence[RideEvent],
    names: Mapping[int, str],
    words: Mapping[str, str],
) -> str:
    """The map and its legend; "" for a ride without positions. names: of the modes, by slot."""
    drawn = laid_out(track)
    if drawn is None:
        return ""
    chosen = sorted((e.t_s, e.value) for e in events if e.kind == "assist_mode")
    segments = segments_of(drawn, chosen)
    # Wide below narrow, where a way is ridden twice.
    lines = [line(mode, spots) for mode, spots in segments]
    parts = [*lines, *marks(track, drawn), *ends(drawn, words), *sides(drawn, words)]
    title = escape(words["map"])
    svg = (
        f'<svg class="map" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{title}">'
        f"{''.join(parts)}</svg>"
    )
    modes = sorted({mode for mode, _ in segments if mode is not None})
    return svg + legend(modes, names, words)


def laid_out(track: Track) -> Drawn | None:
    """The positions in pixels; None for fewer than two."""
    if track.latitude_deg is None or track.longitude_deg is None:
        return None
    valid = np.isfinite(track.latitude_deg) & np.isfinite(track.longitude_deg)
    if valid.sum() < 2:
        return None
    latitude_deg = track.latitude_deg[valid]
    around = np.unwrap(track.longitude_deg[valid], period=360.0)
    east_m = around * np.cos(np.radians(latitude_deg.mean())) * M_PER_DEG
    south_m = -latitude_deg * M_PER_DEG
    m_per_px = max(
        float(np.ptp(east_m)) / (WIDTH - 2 * MARGIN),
        float(np.ptp(south_m)) / (HEIGHT - 2 * MARGIN),
        M_PER_PX_MIN,
    )

    def fitted(metres: Values, size: float) -> Values:
        fit: Values = (metres - (metres.min() + metres.max()) / 2) / m_per_px + size / 2
        return fit

    run = np.cumsum(~valid)[valid].astype(np.intp)
    return Drawn(track.t_s[valid], fitted(east_m, WIDTH), fitted(south_m, HEIGHT), run, m_per_px)


def segments_of(
    drawn: Drawn, chosen: Sequence[tuple[float, int]]
) -> list[tuple[int | None, list[tuple[float, float]]]]:
    """Stretches of one mode without a gap, None where no mode is known yet."""
    changes = [t_s for t_s, _ in chosen if drawn.t_s[0] < t_s < drawn.t_s[-1] and drawn.at(t_s)]
    times = np.unique(np.concatenate((drawn.t_s, changes)))
    spots = list(
        zip(
            np.interp(times, drawn.t_s, drawn.x).tolist(),
            np.interp(times, drawn.t_s, drawn.y).tolist(),
            strict=True,
        )
    )
    runs = drawn.run[np.searchsorted(drawn.t_s, times, side="right") - 1]
    which = np.searchsorted([t_s for t_s, _ in chosen], times, side="right") - 1
    segments: list[tuple[int | None, list[tuple[float, float]]]] = []
    for place in range(len(times) - 1):
        if runs[place] != runs[place + 1]:
            continue
        mode = chosen[which[place]][1] if which[place] >= 0 else None
        goes_on = segments and segments[-1][1][-1] is spots[place] and segments[-1][0] == mode
        if goes_on:
            segments[-1][1].append(spots[place + 1])
        else:
            segments.append((mode, [spots[place], spots[place + 1]]))
    return segments


def style_of(mode: int | None) -> tuple[str, str, float]:
    """Colour, dash and width of a mode's line."""
    if mode is None:
        return UNKNOWN
    return LOOKS[mode] if 0 <= mode < len(LOOKS) - 1 else LOOKS[-1]


def line(mode: int | None, spots: Sequence[tuple[float, float]]) -> str:
    """A stretch of the track."""
    colour, dash, width = style_of(mode)
    points = "L".join(f"{x:.1f} {y:.1f}" for x, y in spots)
    dashed = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<path d="M{points}" stroke="{colour}" stroke-width="{width}"{dashed}/>'


def marks(track: Track, drawn: Drawn) -> list[str]:
    """Some marks at round kilometres of the way."""
    if track.distance_m is None or not np.isfinite(track.distance_m).any():
        return []
    valid = np.isfinite(track.distance_m)
    distance_m, times_s = track.distance_m[valid], track.t_s[valid]
    length_km = float(distance_m[-1]) / 1000.0
    step = max(rounded_up(length_km / MARKS), 0.1)
    finding_line = []
    for number in range(1, int(length_km / step - 1e-9) + 1):
        spot = drawn.at(float(np.interp(1000.0 * number * step, distance_m, times_s)))
        if spot is not None:
            x, y = spot
            finding_line.append(
                f'<circle cx="{x:.1f}" cy="{y:.1f}" r="11" fill="#fff" stroke="#667570"/>'
                f'<text x="{x:.1f}" y="{y + 4:.1f}" text-anchor="middle">{number * step:g}</text>'
            )
    return finding_line


def ends(drawn: Drawn, words: Mapping[str, str]) -> list[str]:
    """Where the ride began and where it ended."""
    x0, y0, x1, y1 = (float(v) for v in (drawn.x[0], drawn.y[0], drawn.x[-1], drawn.y[-1]))
    return [
        f'<rect x="{x1 - 6:.1f}" y="{y1 - 6:.1f}" width="12" height="12" fill="#10201d"/>',
        f'<path d="M{x0 - 6:.1f} {y0 - 7:.1f}l13 7l-13 7z" fill="{NEUTRAL_COLOUR}" stroke="none"/>',
        label(x0, y0 + 20, words["start"]),
        label(x1, y1 - 11, words["end"]),
    ]


def label(x: float, y: float, text: str) -> str:
    """A word beside a place, within the drawing."""
    anchor = "end" if x > WIDTH - 80 else "start"
    x += -10 if anchor == "end" else 10
    return f'<text class="b" x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(text)}</text>'


def sides(drawn: Drawn, words: Mapping[str, str]) -> list[str]:
    """North, and the scale."""
    length_m = rounded_down(SCALE_PX * drawn.m_per_px)
    px = length_m / drawn.m_per_px
    text = f"{length_m:g} m" if length_m < 1000 else f"{length_m / 1000:g} km"
    right, bottom = WIDTH - 18, HEIGHT - 14
    return [
        f'<path d="M{right} 38V14m-5 8l5-8l5 8" stroke="#4b5956" stroke-width="1.5"/>',
        f'<text x="{right}" y="54" text-anchor="middle">{escape(words["north"])}</text>',
        f'<path d="M14 {bottom}v-8m0 4h{px:.1f}m0 -4v8" stroke="#4b5956" stroke-width="1.5"/>',
        f'<text x="{px + 22:.1f}" y="{bottom}">{text}</text>',
    ]


def legend(modes: Sequence[int], names: Mapping[int, str], words: Mapping[str, str]) -> str:
    """The line of each mode with its name."""
    if not modes:
        return ""
    items = []
    for mode in modes:
        name = names.get(mode) or words["slot"].format(number=mode)
        sample = line(mode, [(1.0, 7.0), (47.0, 7.0)])
        items.append(
            f'<span><svg class="key" viewBox="0 0 48 14" aria-hidden="true">{sample}</svg> '
            f"{escape(name)}</span>"
        )
    return f'<p class="keys quiet">{"".join(items)}</p>'


def rounded_up(value: float) -> float:
    """The next of 1, 2, 5, 10 ..."""
    ten = 10.0 ** np.floor(np.log10(max(value, 1e-6)))
    return float(next((one * ten for one in STEPS if one * ten >= value * (1 - 1e-9)), 10 * ten))


def rounded_down(value: float) -> float:
    """The one before of 1, 2, 5, 10 ..."""
    ten = 10.0 ** np.floor(np.log10(value))
    return float(max(one * ten for one in STEPS if one * ten <= value * (1 + 1e-9)))
