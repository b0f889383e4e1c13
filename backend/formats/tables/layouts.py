"""The kinds of tables that are known by their header, and what their format defines.

Facts on head units after GoldenCheetah's reader; Cycle Analyst after Grin's manual CA3.1, section
7; VESC Tool after logs that riders published.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import zip_longest

from backend.formats.cells import number
from backend.formats.tables.measures import measure_of, split_unit, words
from backend.formats.tables.text import cells_of, decoded
from backend.formats.units import UNITS, plain_unit

# Names of columns of moments, days or times of day, the first that fits counts; then of seconds
# since something. What stands in them decides which of these they are.
TIMES = (
    "time utc", "timestamp", "datetime", "date time", "utc time", "local time", "zeitstempel",
    "datum zeit", "datum uhrzeit", "date heure", "fecha hora", "data ora", "datum tijd", "gps time",
    "time", "zeit", "uhrzeit", "time of day", "heure", "hora", "ora", "tijd", "时间",
    "date", "datum", "day", "fecha", "data", "jour", "日期",
)  # fmt: skip
SINCE: dict[str, float] = {
    **dict.fromkeys(("t s", "secs", "seconds", "sec", "elapsed s", "elapsed seconds"), 1.0),
    **dict.fromkeys(("zeit", "time s", "sekunden", "secondes", "segundos", "duration"), 1.0),
    **dict.fromkeys(("minutes", "min", "elapsed minutes"), 60.0),
    **dict.fromkeys(("ms", "milliseconds", "ms today"), 0.001),
}
TIME_UNITS = {"s": 1.0, "sec": 1.0, "seconds": 1.0, "min": 60.0, "minutes": 60.0, "ms": 0.001}
PREAMBLE_ROWS_MAX = 24
CA_HEADER = tuple("Ah V A S D Deg RPM HW Nm ThI ThO AuxA AuxD Flgs".split())  # noqa: SIM905
CA_HEADER_3_0 = (*CA_HEADER[:11], "Acc", "Flgs")


@dataclass(frozen=True)
class Layout:
    """A kind of table, as one file has it.

    kind: as people call it. header_row: which row names the columns; data begin at data_row.
    units: by column name, of `words`, what the format defines: channel and unit; a unit of None is
    asked among choices. own: channels of the format that no other file has. start: the moment the
    file begins with, "" for none. row_s: seconds of a row, None where a column tells times.
    pause: the column of seconds that the clock stood after a row. preamble: rows above the
    header. satellite_altitude: without a
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
    preamble: int = 0
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


STAGES = {
    "miles": ("distance_m", "mi"),
    "km": ("distance_m", "km"),
    "mph": ("speed_kmh", "mph"),
    "kmh": ("speed_kmh", "km/h"),
    "kph": ("speed_kmh", "km/h"),
    "hr": ("heart_rate_bpm", "bpm"),
    "rpm": ("cadence_rpm", "rpm"),
}
PHASERUNNER = {
    "amps": ("battery_current_a", "A"),
    "voltage": ("battery_voltage_v", "V"),
    "human watts": ("rider_power_w", "W"),
    "human power": ("rider_torque_nm", "Nm"),
    "motor temperature": ("motor_temperature_degc", "degC"),
    "controller temperature": ("controller_temperature_degc", "degC"),
    "motor current": ("motor_current_a", "A"),
}
FLOAT_CONTROL = {
    "voltage": ("battery_voltage_v", "V"),
    "i battery": ("battery_current_a", "A"),
    "i motor": ("motor_current_a", "A"),
    "t mot": ("motor_temperature_degc", "degC"),
    "t mosfet": ("controller_temperature_degc", "degC"),
    "gps lat": ("latitude_deg", "deg"),
    "gps long": ("longitude_deg", "deg"),
}
WHEEL_LOG = {
    "speed": ("speed_kmh", "km/h"),
    "distance": ("distance_m", "m"),
    "voltage": ("battery_voltage_v", "V"),
    "current": ("battery_current_a", "A"),
    "phase current": ("motor_current_a", "A"),
    "power": ("battery_power_w", "W"),
    "battery level": ("battery_soc_pct", "%"),
    "system temp": ("controller_temperature_degc", "degC"),
    "gps alt": ("altitude_m", "m"),
}
EUC_WORLD = {
    "speed": ("speed_kmh", "km/h"),
    "distance": ("distance_m", "km"),
    "voltage": ("battery_voltage_v", "V"),
    "current": ("battery_current_a", "A"),
    "current phase": ("motor_current_a", "A"),
    "power": ("battery_power_w", "W"),
    "battery": ("battery_soc_pct", "%"),
    "temp": ("controller_temperature_degc", "degC"),
    "temp motor": ("motor_temperature_degc", "degC"),
    "gps lat": ("latitude_deg", "deg"),
    "gps lon": ("longitude_deg", "deg"),
    "gps alt": ("altitude_m", "m"),
    "hr": ("heart_rate_bpm", "bpm"),
}
FLOATY = {
    "speed": ("speed_kmh", "km/h"),
    "batteryvolts": ("battery_voltage_v", "V"),
    "batterycurrent": ("battery_current_a", "A"),
    "batterypercent": ("battery_soc_pct", "1"),
    "motorcurrent": ("motor_current_a", "A"),
    "motortemp": ("motor_temperature_degc", "degC"),
    "controllertemp": ("controller_temperature_degc", "degC"),
    "tripdistance": ("distance_m", None),
    "altitude": ("altitude_m", "m"),
}
# A header that has all of these is of the kind.
BY_HEADER: tuple[tuple[frozenset[str], str, Mapping[str, tuple[str, str | None]]], ...] = (
    (
        frozenset({"secs", "cad", "hr", "km", "kph", "watts"}),
        "a GoldenCheetah table",
        GOLDEN_CHEETAH,
    ),
    (frozenset({"amp hours", "amps", "human watts"}), "a Cycle Analyst log", PHASERUNNER),
    (frozenset({"duty", "i battery", "i motor"}), "a Float Control log", FLOAT_CONTROL),
    (frozenset({"phase current", "totaldistance", "system temp"}), "a WheelLog log", WHEEL_LOG),
    (
        frozenset({"duration riding", "current phase", "safety margin"}),
        "a EUC World log",
        EUC_WORLD,
    ),
    (frozenset({"dutycycle", "batteryvolts", "tripdistance"}), "a Floaty log", FLOATY),
)


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
    plain = {words(split_unit(cell)[0]) for cell in rows[0]}
    for header, kind, units in BY_HEADER:
        if header <= plain:
            return Layout(kind, named(rows[0]), 1, units)
    if first[0] == "stages data" and (table := generic(rows)) is not None:
        return replace(table, kind="a Stages table", units=STAGES)
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
    """Any table of which a row names a time and at least one more column.

    Of several such rows the one that names most counts: a table may begin with a table about it.
    The units may stand in a row of their own below, and a row of sources below that.
    """
    found: tuple[int, int, tuple[str, ...]] | None = None
    for place, row in enumerate(rows[:PREAMBLE_ROWS_MAX]):
        names = named(row)
        if len(names) < 2 or not (time_columns(names) or since_columns(names)):
            continue
        known = sum(measure_of(name) is not None for name in names)
        if found is None or known > found[0]:
            found = known, place, names
    if found is None:
        return None
    _, place, names = found
    begins, units = place + 1, row_of_units(rows[place + 1 : place + 2])
    if units:
        names = tuple(
            with_unit(name, unit) for name, unit in zip_longest(names, units, fillvalue="")
        )
        begins += 1
        if not any(is_number(cell) for row in rows[begins : begins + 1] for cell in row):
            begins += 1
    return Layout("a table", names, begins, preamble=place)


def row_of_units(rows: Sequence[Sequence[str]]) -> tuple[str, ...]:
    """The cells of a row that holds units and no number; nothing for another row."""
    for row in rows:
        cells = tuple(cell.strip() for cell in row)
        units = sum(plain_unit(cell) in UNITS for cell in cells if not is_number(cell))
        if units >= 2 and not any(is_number(cell) for cell in cells):
            return cells
    return ()


def with_unit(name: str, unit: str) -> str:
    """A name with the unit from the row below, as headers write it."""
    return f"{name} ({unit})" if unit and plain_unit(unit) in {*UNITS, *TIME_UNITS} else name


def is_number(cell: str) -> bool:
    """Whether a cell is a plain number."""
    value = number(cell)
    return value == value


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


def time_columns(names: Sequence[str]) -> list[int]:
    """The columns that are called as a moment, a day or a time of day, the best name first."""
    plain = [words(split_unit(name)[0]) for name in names]
    return [place for name in TIMES for place, column in enumerate(plain) if column == name]


def since_columns(names: Sequence[str]) -> list[tuple[int, float]]:
    """The columns of a time since something, each with the seconds of its unit."""
    columns = []
    for place, name in enumerate(names):
        plain, unit = split_unit(name)
        if unit is None and words(name) in SINCE:
            columns.append((place, SINCE[words(name)]))
        elif unit is not None and words(plain) in ("time", "elapsed", "elapsed time", "zeit"):
            scale = TIME_UNITS.get(plain_unit(unit))
            columns += [(place, scale)] if scale is not None else []
    return columns


def only_times(head: bytes) -> str | None:
    """The name of a table's only column, if that is a time; None for other files."""
    names = named([decoded(head).lstrip("\ufeff").split("\n", 1)[0]])
    if len(names) != 1 or not (time_columns(names) or since_columns(names)):
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
