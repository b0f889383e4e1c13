"""The ride's figure: speed, torque, power and gain above one another on one time axis.

Made with plotly, which is imported when the first figure is asked for: it takes a quarter of a
second and 30 MB, and a server may never be asked. The colours are those of the pages: the rider is
orange, the motor blue.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from backend.core.channels import ChannelSpec
from backend.rides.traces.trace import RideReader, Trace, trace

RIDER_COLOUR = "#c4470a"
MOTOR_COLOUR = "#0868a8"
NEUTRAL_COLOUR = "#00795a"


@dataclass(frozen=True)
class Panel:
    """One row of the figure. unit: title of its axis. channels: drawn together."""

    title: str
    unit: str
    channels: tuple[str, ...]


TITLES_ZH = {
    "Speed": "速度",
    "Torque at the crank": "曲柄力矩",
    "Power": "功率",
    "Gain": "增益",
}
"""A title in Chinese, by itself in English."""
TIME = {"en": "Time (s)", "zh": "时间 (s)"}
SHOWN = {"en": "{shown} points shown of {rows}", "zh": "显示 {rows} 个点中的 {shown} 个"}

PANELS = (
    Panel("Speed", "km/h", ("speed_kmh",)),
    Panel("Torque at the crank", "Nm", ("rider_torque_nm", "motor_torque_crank_nm")),
    Panel("Power", "W", ("rider_power_w", "motor_power_w")),
    Panel("Gain", "", ("fuzzy_gain",)),
)


def figure(ride: RideReader, names: Sequence[str] | None, pixels: int, language: str = "en") -> Any:
    """A plotly Figure of a ride; its `to_plotly_json()` is {"data": [...], "layout": {...}}.

    names: channels to draw, one row for each unit; None for the usual rows, as far as the ride
    has their channels. pixels: width of the plot. language: of the titles, `en` or `zh`.
    Raises InvalidRequest for unknown channels.
    """
    from plotly.subplots import make_subplots

    offered = {channel.name: channel for channel in ride.offered}
    panels = usual_panels(offered) if names is None else panels_by_unit(names, offered)
    requested = [name for panel in panels for name in panel.channels]
    shown = trace(ride, names if names is not None else requested, pixels=pixels)
    rows = max(len(panels), 1)
    made = make_subplots(rows=rows, cols=1, shared_xaxes=True, vertical_spacing=0.06 / rows)
    for row, panel in enumerate(panels, start=1):
        for name in panel.channels:
            made.add_trace(curve(shown, offered[name]), row=row, col=1)
        title = TITLES_ZH.get(panel.title, "") if language == "zh" else panel.title
        both = f"{title} ({panel.unit})" if title and panel.unit else ""
        made.update_yaxes(title_text=both or title or panel.unit, row=row, col=1)
    made.update_xaxes(title_text=TIME[language], row=rows, col=1)
    note = SHOWN[language].format(shown=len(shown.t_first_s), rows=shown.rows)
    made.update_layout(
        template="none",
        hovermode="x unified",
        showlegend=True,
        meta={"shown": note if shown.kind == "rows" else f"{note} (min/max)"},
    )
    return made


def usual_panels(offered: dict[str, ChannelSpec]) -> list[Panel]:
    """The usual rows, without what the ride does not have."""
    panels = [
        Panel(panel.title, panel.unit, tuple(n for n in panel.channels if n in offered))
        for panel in PANELS
    ]
    return [panel for panel in panels if panel.channels]


def panels_by_unit(names: Sequence[str], offered: dict[str, ChannelSpec]) -> list[Panel]:
    """One row for each unit, in the order of the names."""
    by_unit: dict[str, list[str]] = {}
    for name in dict.fromkeys(names):
        if name in offered:
            by_unit.setdefault(offered[name].unit, []).append(name)
    return [Panel("", unit, tuple(channels)) for unit, channels in by_unit.items()]


def curve(shown: Trace, channel: ChannelSpec) -> Any:
    """One line: through every sample, or up and down between the extremes of each bin."""
    from plotly.graph_objects import Scatter

    low = channel.to_values(shown.minimum[channel.name])
    if shown.kind == "rows":
        times, values = shown.t_first_s, low
    else:
        times = np.column_stack((shown.t_first_s, shown.t_last_s)).reshape(-1)
        high = channel.to_values(shown.maximum[channel.name])
        values = np.column_stack((low, high)).reshape(-1)
    # As lists: arrays would travel as base64, which only Plotly's newest readers know.
    return Scatter(
        mode="lines",
        name=channel.name,
        x=times.tolist(),
        y=[None if np.isnan(value) else round(float(value), 5) for value in values],
        connectgaps=False,
        line={"width": 1, "color": colour(channel.name)},
        hovertemplate=f"%{{y}} {channel.unit}<extra>{channel.name}</extra>",
    )


def colour(name: str) -> str:
    """Orange for the rider, blue for the motor, green for the rest."""
    if name.startswith("rider_"):
        return RIDER_COLOUR
    return MOTOR_COLOUR if name.startswith("motor_") else NEUTRAL_COLOUR
