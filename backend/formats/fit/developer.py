"""Fields that apps add to a FIT file: what the file says of them, and what they are.

An app that states a field of the profile (`native_field_num`) means that field. Without it a name
says what an e-bike tells: no head unit works that out by itself. Any other name stays the app's.
"""

from __future__ import annotations

from collections.abc import Iterable

from backend.formats.fit.fields import Described, channel_name, own_field, text
from backend.formats.fit.layout import Definition
from backend.formats.fit.profile import PROFILE_NAMES, RECORD_FIELDS, ProfileField
from backend.formats.fit_numbers import BASE_TYPES, RECORD, UINT16
from backend.formats.units import factor_between

OWNER, NUMBER, BASE, NAME, UNIT, NATIVE_MESSAGE, NATIVE_FIELD = 0, 1, 2, 3, 8, 14, 15

MOTOR_POWER, BATTERY_LEVEL, ASSIST_MODE = 82, 118, 119
E_BIKE_NAMES = {
    "motor_power": MOTOR_POWER,
    "mot_power": MOTOR_POWER,
    "ebike_motor_power": MOTOR_POWER,
    "currbattery": BATTERY_LEVEL,
    "battery_soc": BATTERY_LEVEL,
    "bat_soc": BATTERY_LEVEL,
    "ebike_battery": BATTERY_LEVEL,
    "currassist": ASSIST_MODE,
    "assist_mode": ASSIST_MODE,
    "assist_level": ASSIST_MODE,
    "ebike_assist_mode": ASSIST_MODE,
}


def descriptions(
    data: bytes, definitions: Iterable[Definition]
) -> dict[tuple[int, int], Described]:
    """Developers' fields of a file, by owner and number; a later description counts."""
    by_number: dict[tuple[int, int], Described] = {}
    for definition in definitions:
        for offset in definition.offsets:
            owner, number, base, native = (
                number_of(data, definition, offset, n) for n in (OWNER, NUMBER, BASE, NATIVE_FIELD)
            )
            message = number_of(data, definition, offset, NATIVE_MESSAGE)
            name = channel_name(text(data, definition, offset, NAME)) or f"{owner}_{number}"
            unit = text(data, definition, offset, UNIT)
            field = native if message == RECORD else E_BIKE_NAMES.get(name)
            meant = None if field is None else RECORD_FIELDS.get(field)
            by_number[owner, number] = described(name, unit, base, meant)
    return by_number


def described(name: str, unit: str, base: int, meant: ProfileField | None) -> Described:
    """Under the name that the app gave: what it computes is not always what the profile's field of
    that name is. meant: the profile's field that it is, in a unit that can be one of it."""
    taken = name in PROFILE_NAMES or name[:1].isdigit()
    own = f"developer_{name}" if taken else name
    factor = factor_between(unit, meant.unit) if meant and unit and meant.unit else 1.0
    if meant is None or factor is None:
        return Described(own, unit, base)
    return Described(own, meant.unit, base, factor, meant.name)


def number_of(data: bytes, definition: Definition, offset: int, number: int) -> int:
    """A whole number of a description; 0xFF where it has none."""
    cell = own_field(definition, number)
    if cell is None or cell.size not in (1, BASE_TYPES[UINT16].size):
        return 0xFF
    at = offset + cell.at
    return int.from_bytes(data[at : at + cell.size], "little" if definition.little else "big")
