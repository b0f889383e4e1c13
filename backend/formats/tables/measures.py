"""What a column measures, by its name and unit, and how its numbers become a channel's."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from backend.core.channels import ChannelSpec
from backend.formats.columns import FIT_FIELDS, FieldRule
from backend.formats.questions import OfferedChannel
from backend.formats.units import UNITS, plain_unit

# Quantities whose unit is never taken for granted, with what may be said of each channel.
UNIT_CHOICES: dict[str, tuple[str, ...]] = {
    "speed_kmh": ("km/h", "m/s", "mph"),
    "distance_m": ("m", "km", "mi"),
    "altitude_m": ("m", "ft"),
    "temperature_degc": ("degC", "degF"),
    "motor_temperature_degc": ("degC", "degF"),
    "controller_temperature_degc": ("degC", "degF"),
    "rider_torque_nm": ("Nm", "ft-lb"),
    "motor_torque_nm": ("Nm", "ft-lb"),
}
DEFINED: dict[str, str] = {
    "cadence_rpm": "rpm",
    "rider_power_w": "W",
    "motor_power_w": "W",
    "battery_power_w": "W",
    "heart_rate_bpm": "bpm",
    "latitude_deg": "deg",
    "longitude_deg": "deg",
    "battery_voltage_v": "V",
    "battery_current_a": "A",
    "motor_current_a": "A",
    "battery_soc_pct": "%",
    "assist_level_pct": "%",
    "grade_pct": "%",
    "assist_mode": "",
    "right_leg_pct": "%",
    "range_km": "km",
    "fuzzy_gain": "",
    "motor_torque_demanded_nm": "Nm",
}
# A column's name, lower case with single spaces for all that is no letter -> its channel.
# In English, German, French, Spanish, Italian, Dutch and Chinese.
NAMES: dict[str, str] = {
    name: channel
    for channel, names in {
        "speed_kmh": "speed, enhanced speed, velocity, km h, kph, mph, geschwindigkeit, vitesse,"
        " velocidad, velocità, snelheid, 速度",
        "cadence_rpm": "cadence, cad, rpm, pedal cadence, trittfrequenz, kadenz, cadencia, cadenza,"
        " cadans, 踏频",
        "rider_power_w": "power, watts, watt, rider power, human power, human watts, leistung,"
        " puissance, potencia, potenza, vermogen, 功率",
        "motor_power_w": "motor power, motor watts",
        "battery_power_w": "battery power, battery watts",
        "rider_torque_nm": "rider torque, human torque, pedal torque",
        "motor_torque_nm": "motor torque",
        "motor_torque_demanded_nm": "motor torque demanded",
        "heart_rate_bpm": "heart rate, heartrate, hr, hrate, puls, herzfrequenz,"
        " fréquence cardiaque, frecuencia cardíaca, frequenza cardiaca, hartslag, 心率",
        "distance_m": "distance, distances, dist, km, miles, distance traveled, distance travelled,"
        " strecke, distanz, entfernung, distancia, distanza, afstand, 距离",
        "altitude_m": "altitude, enhanced altitude, elevation, ele, alt, height, höhe, altitud,"
        " altitudine, hoogte, 海拔",
        "temperature_degc": "temperature, temperatures, temp, atemp, temperatur, température,"
        " temperatura, temperatuur, 温度",
        "motor_temperature_degc": "motor temperature, motor temp",
        "controller_temperature_degc": "controller temperature, controller temp",
        "latitude_deg": "position lat, latitude, lat, gps lat, gnss lat, breitengrad,"
        " latitud, 纬度",
        "longitude_deg": "position long, longitude, lon, lng, long, gps long, gps lon, gnss lon,"
        " längengrad, longitud, 经度",
        "battery_voltage_v": "battery voltage, voltage, spannung, battery volts, 电压",
        "battery_current_a": "battery current, amps, battery amps, current, strom, courant,"
        " corriente, corrente, stroom, 电流",
        "motor_current_a": "motor current, phase current",
        "battery_soc_pct": "battery level, battery soc, ebike battery level, akkustand,"
        " battery percent",
        "grade_pct": "grade, slope, hill slope, steigung, pente",
        "assist_mode": "ebike assist mode, assist mode",
        "assist_level_pct": "ebike assist level percent",
        "range_km": "ebike travel range",
        "fuzzy_gain": "fuzzy gain",
    }.items()
    for name in names.split(", ")
}
# Names that mean something by the quantity of their unit alone.
BY_QUANTITY: dict[str, dict[str, str]] = {
    "battery": {
        "share": "battery_soc_pct",
        "voltage": "battery_voltage_v",
        "current": "battery_current_a",
        "power": "battery_power_w",
    },
    "motor": {
        "power": "motor_power_w",
        "torque": "motor_torque_nm",
        "current": "motor_current_a",
        "temperature": "motor_temperature_degc",
    },
}
BY_QUANTITY |= {"akku": BY_QUANTITY["battery"], "电池": BY_QUANTITY["battery"]}
# Names that do not state whose power it is.
ANY_POWER = frozenset(
    ("power", "watts", "watt", "leistung", "puissance", "potencia", "potenza", "vermogen", "功率")
)
POWER_CHANNELS = ("rider_power_w", "motor_power_w", "battery_power_w")
# What tables have and FIT files do not; of what charges the battery the power is below 0.
TABLE_FIELDS: tuple[FieldRule, ...] = (
    FieldRule(ChannelSpec("battery_power_w", "W", 1.0), ("battery_power",), -30_000, 30_000),
    FieldRule(
        ChannelSpec("controller_temperature_degc", "degC", 0.01),
        ("controller_temperature",),
        -60,
        320,
    ),
)
IN_BRACKETS = re.compile(r"^(.*?)[(\[]\s*([^()\[\]]*?)\s*[)\]]\s*$")
RULES: dict[str, FieldRule] = {rule.channel.name: rule for rule in (*FIT_FIELDS, *TABLE_FIELDS)}
OFFERED = tuple(
    OfferedChannel(name, rule.channel.unit, UNIT_CHOICES.get(name, ()))
    for name, rule in RULES.items()
)
"""What any column may be by its owner's word."""

# Suffix of our channel names -> unit and the scale that holds what a bike has of it.
OWN_UNITS: dict[str, tuple[str, float]] = {
    "_kmh": ("km/h", 0.01),
    "_rpm": ("rpm", 0.1),
    "_nm": ("Nm", 0.01),
    "_v": ("V", 0.002),
    "_a": ("A", 0.001),
    "_w": ("W", 0.1),
    "_pct": ("%", 0.01),
    "_degc": ("degC", 0.01),
    "_deg": ("deg", 0.02),
}
OWN_SCALES: dict[str, float] = {
    "cadence_rpm": 0.01,
    "motor_torque_nm": 0.0001,
    "motor_torque_demanded_nm": 0.0001,
    "motor_torque_available_nm": 0.0001,
    "rider_torque_raw": 1.0,
    "torque_rate": 0.0005,
    "fuzzy_gain": 0.00005,
    "assist_ratio": 0.0002,
}
OWN_NAME = re.compile(r"[a-z][a-z0-9_]{0,47}")


@dataclass(frozen=True)
class Measure:
    """What a column becomes. unit: of its numbers, None where it must be asked, "" for none.

    choices: what may be answered. own: of our own export, whose scales are exact.
    """

    rule: FieldRule
    unit: str | None
    choices: tuple[str, ...] = ()
    own: bool = False

    def in_unit(self, unit: str) -> tuple[FieldRule, float]:
        """The rule for numbers in a unit, and what is added to them afterwards."""
        rule = UNITS.get(plain_unit(unit))
        if self.own or rule is None:
            return self.rule, 0.0
        _, _, factor, added = rule
        if self.rule.channel.name == "range_km":
            factor /= 1000.0
        return replace(self.rule, factor=factor), added


def measure_of(header: str) -> Measure | None:
    """What a column measures by its header; None when nothing is known of it."""
    name, unit = split_unit(header)
    own = own_rule(header.strip().lower())
    if own is not None:
        return Measure(own, own.channel.unit, own=True)
    channel = NAMES.get(words(name)) or (header.strip().lower() if header in RULES else None)
    # A unit in a name can be all that it says: `Km/h` of a head unit is its speed.
    if unit is None and words(name) in ("km h", "kph", "mph", "km", "miles", "watts"):
        unit = name.strip()
    quantity = UNITS[plain_unit(unit)][0] if unit and plain_unit(unit) in UNITS else None
    channel = BY_QUANTITY.get(words(name), {}).get(quantity or "", channel)
    if channel is None or channel not in RULES:
        return None
    defined = UNITS.get(plain_unit(RULES[channel].channel.unit))
    if quantity is not None and defined is not None and quantity != defined[0]:
        # Of another quantity: `Power (%)` is no power.
        return None
    return measure_in(channel, unit)


def measure_in(channel: str, unit: str | None) -> Measure:
    """A channel in the unit a header tells; where it tells none of its quantity, as the channel is
    defined."""
    rule = RULES[channel]
    unit_rule = UNITS.get(plain_unit(unit)) if unit else None
    defined = UNITS.get(plain_unit(rule.channel.unit))
    if unit_rule is not None and defined is not None and unit_rule[0] != defined[0]:
        unit_rule = None
    if unit_rule is not None and unit_rule[1] in UNIT_CHOICES.get(channel, (unit_rule[1],)):
        return Measure(rule, unit_rule[1])
    if channel in UNIT_CHOICES:
        return Measure(rule, None, UNIT_CHOICES[channel])
    return Measure(rule, DEFINED.get(channel, rule.channel.unit))


def split_unit(header: str) -> tuple[str, str | None]:
    """Name and unit of a header like `Speed (km/h)`; no unit where none is in brackets."""
    match = IN_BRACKETS.match(header.strip())
    return (match.group(1), match.group(2)) if match else (header, None)


def named_unit(header: str, of_cells: str | None) -> str | None:
    """The unit that a header or else its cells name, in our word; None for none that we know."""
    rule = UNITS.get(plain_unit(split_unit(header)[1] or of_cells or ""))
    return rule[1] if rule else None


def words(name: str) -> str:
    """A name in lower case, single spaces for all that is no letter or digit."""
    return re.sub(r"[\W_]+", " ", name.strip().strip('"').lower()).strip()


def own_rule(name: str) -> FieldRule | None:
    """The rule of a column of our own export, None for other names."""
    if not OWN_NAME.fullmatch(name):
        return None
    suffix = next((suffix for suffix in OWN_UNITS if name.endswith(suffix)), None)
    if name not in OWN_SCALES and suffix is None:
        # Of a wide channel its name is its unit: `distance_m`.
        rule = RULES.get(name)
        return replace(rule, sources=(name,), factor=1.0) if rule and rule.channel.unit else None
    if name in ("latitude_deg", "longitude_deg"):
        return replace(RULES[name], sources=(name,), factor=1.0)
    unit, scale = OWN_UNITS[suffix] if suffix else ("", 1.0)
    scale = OWN_SCALES.get(name, scale)
    limit = 32767 * scale
    return FieldRule(ChannelSpec(name, unit, scale), (name,), -limit, limit)
