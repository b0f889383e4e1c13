"""The kinds of tables that are known by their header, and what their format defines.

Facts on head units after GoldenCheetah's reader; Cycle Analyst after Grin's manual CA3.1, section
7; VESC Tool after logs that riders published.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from backend.formats.cells import number
from backend.formats.tables.measures import plain_unit, split_unit, words
from backend.formats.tables.text import cells_of, decoded

# A moment, of which the first that a table has counts; then seconds since something.
MOMENTS = ("time utc", "timestamp", "datetime", "date time", "utc time", "local time", "time")
SINCE: dict[str, float] = {
    **dict.fromkeys(("t s", "secs", "seconds", "sec", "elapsed s", "elapsed seconds"), 1.0),
    **dict.fromkeys(("zeit", "time s"), 1.0),
    **dict.fromkeys(("minutes", "min", "elapsed minutes"), 60.0),
    **dict.fromkeys(("ms", "milliseconds", "ms today"), 0.001),
}
TIME_UNITS = {"s": 1.0, "sec": 1.0, "seconds": 1.0, "min": 60.0, "minutes": 60.0, "ms": 0.001}
PREAMBLE_ROWS_MAX = 8
CA_HEADER = tuple("Ah V A S D Deg RPM HW Nm ThI ThO AuxA AuxD Flgs".split())  # noqa: SIM905
CA_HEADER_3_0 = (*CA_HEADER[:11], "Acc", "Flgs")


@dataclass(frozen=True)
class Layout:
    """A kind of table, as one file has it.

    kind: as people call it. header_row: which row names the columns; data begin at data_row.
    units: by column name, of `words`, what the format defines: channel and unit; a unit of None is
    asked among choices. own: channels of the format that no other file has. start: the moment the
    file begins with, "" for none. row_s: seconds of a row, None where a column tells times.
    pause: the column of seconds that the clock stood after a row. satellite_altitude: without a
    position there is no altitude.
    """

    kind: str
    names: tuple[str, ...]
    data_row: int
    units: Mapping[str, tuple[str, str | None]] = field(default_factory=dict)
    choices: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    start: str = ""
    row_s: float | None = None
    rows_are_time: bool = False
    pause: str = ""
    satellite_altitude: bool = False


POWERTAP = {
    "torq n m": ("wheel_torque_nm", "Nm"),
    "km h": ("speed_kmh", "km/h"),
    "mph": ("speed_kmh", "mph"),
    "km": ("distance_m", "km"),
    "miles": ("distance_m", "mi"),
    "hrate": ("heart_rate_bpm", "bpm"),
}
GOLDEN_CHEETAH = {
    "kph": ("speed_kmh", "km/h"),
    "km": ("distance_m", "km"),
    "nm": ("torque_nm", "Nm"),
    "alt": ("altitude_m", "m"),
    "temp": ("temperature_degc", "degC"),
    "hr": ("heart_rate_bpm", "bpm"),
}
ERGOMO = {
    "strecke": ("distance_m", "km"),
    "power": ("rider_power_w", "W"),
    "rpm": ("cadence_rpm", "rpm"),
    "speed": ("speed_kmh", "km/h"),
    "puls": ("heart_rate_bpm", "bpm"),
    "höhe": ("altitude_m", "m"),
    "temp": ("temperature_degc", "degC"),
}
CYCLE_ANALYST = {
    "v": ("battery_voltage_v", "V"),
    "a": ("battery_current_a", "A"),
    "s": ("speed_kmh", None),
    "d": ("distance_m", None),
    "deg": ("motor_temperature_degc", "degC"),
    "rpm": ("cadence_rpm", "rpm"),
    "hw": ("rider_power_w", "W"),
    "nm": ("rider_torque_nm", "Nm"),
}
VESC = {
    "input voltage": ("battery_voltage_v", "V"),
    "current motor": ("motor_current_a", "A"),
    "current in": ("battery_current_a", "A"),
    "speed meters per sec": ("speed_kmh", "m/s"),
    "tacho abs meters": ("distance_m", "m"),
    "battery level": ("battery_soc_pct", "1"),
    "gnss lat": ("latitude_deg", "deg"),
    "gnss lon": ("longitude_deg", "deg"),
    "gnss alt": ("altitude_m", "m"),
}


def layout_of(rows: Sequence[Sequence[str]]) -> Layout | None:
    """The layout of a table by its first rows; None when it is no table of a ride."""
    first = [words(cell) for cell in rows[0]] if rows else []
    if not first:
        return None
    if first[0] == "ibike" and len(rows) > 5 and len(first) > 2:
        return ibike(rows)
    if "device type" in first and "firmware version" in first and len(rows) > 5:
        return joule(rows)
    if {"zeit", "strecke"} <= set(first):
        return Layout("an Ergomo table", named(rows[0]), 2, ERGOMO, pause="pause")
    if {"minutes", "torq n m", "watts"} <= set(first):
        return Layout("a PowerTap table", named(rows[0]), 1, POWERTAP)
    if {"secs", "cad", "hr", "km", "kph", "watts"} <= set(first):
        return Layout("a GoldenCheetah table", named(rows[0]), 1, GOLDEN_CHEETAH)
    if {"ms today", "input voltage", "current motor"} <= set(first):
        return Layout("a VESC Tool log", named(rows[0]), 1, VESC, satellite_altitude=True)
    return cycle_analyst(rows) or generic(rows)


def ibike(rows: Sequence[Sequence[str]]) -> Layout:
    """Five rows before the data; the second is the start, the fifth cell of the fifth the spacing.

    Its header names the units.
    """
    figures = [number(cell) for cell in rows[1][:6]]
    start = ""
    if len(figures) == 6 and all(part == part for part in figures):
        start = "{:04.0f}-{:02.0f}-{:02.0f}T{:02.0f}:{:02.0f}:{:02.0f}".format(*figures)
    spacing = number(rows[3][4]) if len(rows[3]) > 4 else float("nan")
    return Layout(
        "an iBike table",
        named(rows[4]),
        5,
        start=start,
        row_s=spacing if 0 < spacing <= 60 else None,
        rows_are_time=True,
    )


def joule(rows: Sequence[Sequence[str]]) -> Layout:
    """Four rows before the header; the second has the start."""
    place = [words(cell) for cell in rows[0]].index("device type")
    about = [words(cell) for cell in rows[0]]
    start = rows[1][about.index("date time")] if "date time" in about[:place] else ""
    return Layout("a Joule table", named(rows[4]), 5, POWERTAP, start=start)


def cycle_analyst(rows: Sequence[Sequence[str]]) -> Layout | None:
    """Tabs, and the header that the unit sends when it is switched on; often it is missing."""
    first = [cell.strip() for cell in rows[0]]
    choices = {"s": ("km/h", "mph"), "d": ("km", "mi")}
    if tuple(first[:5]) == CA_HEADER[:5]:
        names = tuple(first)
        begins = 1
    elif len(first) in (len(CA_HEADER), len(CA_HEADER_3_0)) and all(
        number(cell) == number(cell) for cell in first[:-1]
    ):
        names = CA_HEADER if len(first) == len(CA_HEADER) else CA_HEADER_3_0
        begins = 0
    else:
        return None
    return Layout(
        "a Cycle Analyst log",
        names,
        begins,
        CYCLE_ANALYST,
        choices,
        rows_are_time=True,
    )


def generic(rows: Sequence[Sequence[str]]) -> Layout | None:
    """Any table of which a row names a time and at least one more column."""
    for place, row in enumerate(rows[:PREAMBLE_ROWS_MAX]):
        names = named(row)
        if len(names) > 1 and (time_column(names) is not None or since_column(names) is not None):
            return Layout("a table", names, place + 1)
    return None


def named(row: Sequence[str]) -> tuple[str, ...]:
    """Names of the columns, without those behind the last that has one; equal ones counted."""
    names = [cell.strip().strip('"').strip()[:80] for cell in row]
    while names and not names[-1]:
        names.pop()
    found_names: list[str] = []
    for name in names:
        again = found_names.count(name)
        found_names.append(name if name not in found_names else f"{name}.{again}")
    return tuple(found_names)


def time_column(names: Sequence[str]) -> int | None:
    """The column of moments, None for none."""
    plain = [words(split_unit(name)[0]) for name in names]
    return next((plain.index(name) for name in MOMENTS if name in plain), None)


def since_column(names: Sequence[str]) -> tuple[int, float] | None:
    """The column of a time since something, and the seconds of its unit; None for none."""
    for place, name in enumerate(names):
        plain, unit = split_unit(name)
        if unit is None and words(name) in SINCE:
            return place, SINCE[words(name)]
        if unit is not None and words(plain) in ("time", "elapsed", "elapsed time"):
            scale = TIME_UNITS.get(plain_unit(unit))
            if scale is not None:
                return place, scale
    return None


def only_times(head: bytes) -> str | None:
    """The name of a table's only column, if that is a time; None for other files."""
    names = named([decoded(head).lstrip("\ufeff").split("\n", 1)[0]])
    if len(names) != 1 or (time_column(names) is None and since_column(names) is None):
        return None
    return names[0]


def looks_like_table(head: bytes) -> bool:
    """Whether a file's first bytes are those of a table of a ride."""
    if b"\0" in head and not head.startswith((b"\xff\xfe", b"\xfe\xff")):
        return False
    try:
        rows = cells_of(decoded(head)).rows
    except Exception:
        # csv.Error, and what a cut character makes of it.
        return False
    return layout_of([row for row in rows if row]) is not None
