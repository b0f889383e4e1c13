"""The report's pictures besides the traces; plotly is imported when the first is drawn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from backend.rides.traces.figure import MOTOR_COLOUR, RIDER_COLOUR

HEIGHT_PX = 260


def zones_chart(labels: Sequence[str], seconds: Sequence[float], title: str) -> Any:
    """Minutes in each zone or band, as bars."""
    from plotly.graph_objects import Bar, Figure

    minutes = [round(value / 60.0, 2) for value in seconds]
    return sized(Figure(Bar(x=list(labels), y=minutes, marker_color=RIDER_COLOUR)), title, "min")


def energy_chart(
    labels: Sequence[str],
    shares: Sequence[Mapping[str, Any]],
    title: str,
    names: Mapping[str, str],
) -> Any:
    """Rider and motor beside one another, never stacked: stacking would add them up."""
    from plotly.graph_objects import Bar, Figure

    kinds = (("rider_wh", RIDER_COLOUR), ("motor_wh", MOTOR_COLOUR))
    bars = [
        Bar(
            name=names[key], x=list(labels), y=[share[key] for share in shares], marker_color=colour
        )
        for key, colour in kinds
        if any(share[key] is not None for share in shares)
    ]
    return sized(Figure(bars).update_layout(barmode="group"), title, "Wh")


def curve_chart(curve: Sequence[Mapping[str, Any]], title: str) -> Any:
    """Best mean power over the length of the stretch, lengths by their logarithm."""
    from plotly.graph_objects import Figure, Scatter

    line = Scatter(
        x=[best["duration_s"] for best in curve],
        y=[round(best["power_w"], 1) for best in curve],
        mode="lines+markers",
        line_color=RIDER_COLOUR,
    )
    drawn = sized(Figure(line), title, "W")
    return drawn.update_xaxes(type="log", title_text="s")


def crank_chart(crank: Mapping[str, Any], names: Mapping[str, str]) -> Any:
    """Mean torque over the crank's angle, rider and motor beside one another."""
    from plotly.graph_objects import Figure, Scatter

    kinds = (("rider_nm", "torque", RIDER_COLOUR, "solid"), ("motor_nm", "motor", MOTOR_COLOUR,
             "dash"))  # fmt: skip
    lines = []
    for key, name, colour, dash in kinds:
        values = crank[key]
        if values is not None:
            step_deg = 360.0 / len(values)
            lines.append(
                Scatter(
                    name=names[name],
                    x=[step_deg * (place + 0.5) for place in range(len(values))],
                    y=[round(value, 2) for value in values],
                    mode="lines",
                    line={"color": colour, "dash": dash, "width": 2},
                )
            )
    drawn = sized(Figure(lines), "", "Nm").update_layout(showlegend=len(lines) > 1)
    ticks = {"tickvals": [0, 90, 180, 270, 360], "range": [0, 360]}
    return drawn.update_xaxes(title_text=names["crank_axis"], **ticks)


def sized(drawn: Any, title: str, unit: str) -> Any:
    """A chart as the report has it."""
    drawn.update_layout(
        template="none", height=HEIGHT_PX, title={"text": title, "font": {"size": 14}}
    )
    drawn.update_layout(margin={"l": 50, "r": 10, "t": 40, "b": 50})
    return drawn.update_yaxes(title_text=unit, rangemode="tozero")
