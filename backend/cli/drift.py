"""`spindle calibrate drift`: the zero of a torque sensor over its rides."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Mapping
from typing import Any

from backend.cli.client import print_json, print_table
from backend.cli.device import server_of

RIDES_SHOWN = 20
NO_TREND = {
    "few_rides": "too few rides with a zero",
    "short_time": "less than two weeks of rides under one calibration",
    "none_since_calibration": "no ride with a zero since the last calibration",
}
NO_PER_KELVIN = {
    "no_thermometer": "too few rides tell the sensor's temperature",
    "same_weather": "all rides were within 5 K",
}
LEVELS = {
    None: "No zero is known since the last calibration.",
    "ok": "The zero holds.",
    "watch": "The zero has moved more than the weather moves it: watch it.",
    "act": "The zero is where the unit stops its assist: calibrate it.",
}


def drift(options: Namespace) -> int:
    """The latest zero, the trend, the forecast and the rides; 1 where the sensor must be
    calibrated now."""
    server = server_of(options)
    answer = server.ask("GET", f"/devices/{server.device_id(options.unit)}/sensor-drift")
    if options.json:
        print_json(answer)
    else:
        print(*sentences(answer), sep="\n")
        rows = [
            [
                *(ride["ride_id"], ride["started_at"]),
                *(nm(ride["zero_nm"]), nm(ride["uncertainty_nm"]), ride["temperature_degc"]),
                ride["reason"] or ride["left_out"],
            ]
            for ride in answer["rides"][:RIDES_SHOWN]
        ]
        print_table(rows, ["ride", "started", "zero Nm", "u Nm", "degC", "not in the trend"])
    return 1 if answer["level"] == "act" else 0


def sentences(answer: Mapping[str, Any]) -> list[str]:
    """What is known, a line each."""
    lines = [LEVELS[answer["level"]]]
    if answer["latest"]:
        latest = answer["latest"]
        zero, sigma = nm(latest["zero_nm"]), nm(latest["uncertainty_nm"])
        lines.append(f"Latest zero: {zero} Nm, u {sigma} Nm, ride {latest['ride_id']}.")
    lines += [
        f"Calibrated {one['created_at']} as configuration {one['seq']}."
        for one in answer["calibrations"]
    ]
    trend = answer["trend"]
    if trend is None:
        return [*lines, f"No trend: {NO_TREND[answer['no_trend']]}."]
    lines.append(f"By age: {share(trend['per_month_nm'])} Nm a month, {trend['rides']} rides.")
    if trend["per_kelvin_nm"]:
        lines.append(f"By temperature: {share(trend['per_kelvin_nm'], 4)} Nm/K.")
    else:
        lines.append(f"By temperature: not told apart, {NO_PER_KELVIN[trend['no_per_kelvin']]}.")
    return lines + [reached(one) for one in trend["crossings"].values()]


def share(one: Mapping[str, float], digits: int = 3) -> str:
    """A coefficient with its interval."""
    value, low, high = (f"{one[name]:+.{digits}f}" for name in ("value", "low", "high"))
    return f"{value} (95 %: {low} to {high})"


def reached(one: Mapping[str, Any]) -> str:
    """When a level is reached."""
    level = f"{one['level_nm']:.0f} Nm"
    if one["state"] == "over":
        return f"{level}: reached."
    days = [str(one[name])[:10] for name in ("earliest_at", "at", "latest_at") if one[name]]
    if not days:
        return f"{level}: not within five years."
    later = days[-1] if one["latest_at"] else "beyond five years"
    if one["state"] == "not_in_sight":
        return f"{level}: not expected within five years, at the earliest {days[0]}."
    return f"{level}: about {str(one['at'])[:10]}, 90 %: {days[0]} to {later}."


def nm(value: float | None) -> str | None:
    """A torque to the sensor's resolution."""
    return None if value is None else f"{value:.2f}"
