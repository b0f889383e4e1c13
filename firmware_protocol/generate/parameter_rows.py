"""The [[parameter]] rows of registry.toml: read, and refused by name where one is wrong.

A new parameter is the last row and has the greatest id: the image is packed in the order of the
ids, so the image of an earlier version stays the beginning of a later one.
"""

import re
import struct
from typing import Any

from firmware_protocol.generate.tables import SIZES, BadRegistry, Table
from firmware_protocol.layout import STRUCT_CODES, Default, Parameter, ParameterType

GROUPS = (
    "sensor",
    "calibration",
    "assist",
    "fuzzy",
    "second_table",
    "limits",
    "market",
    "drivetrain",
)
"""What a page shows together."""

TYPES: tuple[ParameterType, ...] = ("f32", "u8", "u16", "u32", "text")
REQUIRED = {"id", "name", "group", "type", "unit", "default", "access", "doc"}
OPTIONAL = {"shape", "length", "min", "max", "enum", "increasing", "least_step", "ratchet"}
OPTIONAL |= {"record", "none"}

MAKERS_RECORDS = ("MARKET", "FACTORY")
"""Records of parameters that nobody changes without a token of the maker."""

IMAGE_BYTES_MAX = 912
"""Two blocks of a ride log keep the whole image: 444 bytes beside what says whose it is, and the
rest. The unit's C does not compile beyond it (`rest_fits` in ride_log/pages.c)."""

U32_MAX = 4294967295
"""The unit compares numbers as float32, which has not all of these: a u32 has its whole range."""

COUNT_MAX = 255
"""Elements of a parameter: their number travels as a u8."""


def parameters(rows: list[dict[str, Any]], enums: tuple[Table, ...]) -> tuple[Parameter, ...]:
    """The parameters with their places in the image. Raises BadRegistry."""
    tables = {table.name: table.members for table in enums}
    found: list[Parameter] = []
    offset = 0
    for row in rows:
        _check_keys(row)
        if found and row["id"] <= found[-1].id:
            raise BadRegistry(
                f"{row['name']}: its id 0x{row['id']:04X} is not above 0x{found[-1].id:04X} of "
                f"{found[-1].name} before it; ids only grow, and a new parameter is the last row"
            )
        parameter = _parameter(row, tables, offset)
        _check_kind(parameter, tables)
        _check_default(parameter, tables)
        offset += parameter.size
        found.append(parameter)
    if offset > IMAGE_BYTES_MAX:
        raise BadRegistry(
            f"the configuration has {offset} bytes, and two blocks of a ride log have room for "
            f"{IMAGE_BYTES_MAX}: a parameter needs a smaller type, or the log another block"
        )
    return tuple(found)


def _check_keys(row: dict[str, Any]) -> None:
    name = row.get("name", f"parameter 0x{row.get('id', 0):04X}")
    if missing := REQUIRED - row.keys():
        raise BadRegistry(f"{name}: it needs {', '.join(sorted(missing))}")
    if unknown := row.keys() - REQUIRED - OPTIONAL:
        raise BadRegistry(f"{name}: there is no {', '.join(sorted(unknown))}")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
        raise BadRegistry(f"{name}: a name is lower case with underscores")
    if not 0 < row["id"] <= 0xFFFF:
        raise BadRegistry(f"{name}: an id is 0x0001 to 0xFFFF")
    if row["group"] not in GROUPS:
        raise BadRegistry(f"{name}: a group is one of {', '.join(GROUPS)}")
    if "none" in row and (row["none"], row["type"], row.get("shape")) != ("nan", "f32", None):
        raise BadRegistry(f'{name}: only a single f32 may be none, and "nan" says so')
    if row["type"] not in TYPES:
        raise BadRegistry(f"{name}: a type is one of {', '.join(TYPES)}")
    if (row["type"] == "text") != ("length" in row):
        raise BadRegistry(f"{name}: a text needs its length in bytes, others have none")


def _parameter(row: dict[str, Any], tables: dict[str, dict[str, int]], offset: int) -> Parameter:
    if row["access"] not in tables["access"]:
        raise BadRegistry(f"{row['name']}: access is one of {', '.join(tables['access'])}")
    return Parameter(
        id=row["id"],
        name=row["name"],
        group=row["group"],
        type=row["type"],
        unit=row["unit"],
        shape=tuple(row.get("shape", ())),
        length=row["length"] if row["type"] == "text" else SIZES[row["type"]],
        min=row.get("min"),
        max=row.get("max"),
        enum=row.get("enum"),
        increasing=row.get("increasing", False),
        default=None if "none" in row and row["default"] == "none" else _tuples(row["default"]),
        access=tables["access"][row["access"]],
        image_offset=offset,
        doc=row["doc"],
        ratchet=row.get("ratchet", False),
        least_step=row.get("least_step", 0.0),
        record=row.get("record", "TUNABLE"),
        may_be_none="none" in row,
    )


def _check_kind(row: Parameter, tables: dict[str, dict[str, int]]) -> None:
    if row.enum is not None:
        choices = tables.get(row.enum)
        if row.type != "u8" or not choices or list(choices.values()) != [*range(len(choices))]:
            raise BadRegistry(
                f"{row.name}: enum {row.enum} must exist and count up from 0, and a choice is a u8"
            )
    if not 0 < row.count <= COUNT_MAX:
        raise BadRegistry(f"{row.name}: it has 1 to {COUNT_MAX} elements")
    if row.increasing != (row.least_step > 0):
        raise BadRegistry(f"{row.name}: increasing values need a least_step, others none")
    if row.record not in tables["record"]:
        raise BadRegistry(f"{row.name}: a record is one of {', '.join(tables['record'])}")
    if (row.record in MAKERS_RECORDS) != (row.access == tables["access"]["FACTORY"]):
        raise BadRegistry(f"{row.name}: what the maker keeps, only the maker changes")
    if row.ratchet and (row.type == "text" or row.enum is not None):
        raise BadRegistry(f"{row.name}: only numbers can be a ratchet")
    if row.type == "u32" and (row.min, row.max, row.ratchet) != (0, U32_MAX, False):
        raise BadRegistry(f"{row.name}: a u32 has its whole range, 0 to {U32_MAX}, and no ratchet")
    limits = [limit is not None for limit in (row.min, row.max)]
    if limits != [row.type != "text" and row.enum is None] * 2:
        raise BadRegistry(f"{row.name}: numbers need min and max, others have none")


def _check_default(row: Parameter, tables: dict[str, dict[str, int]]) -> None:
    """A unit that lost its flash runs on the defaults, so they must be a valid configuration."""
    if _shape(row.default) != row.shape:
        raise BadRegistry(f"{row.name}: its default must have the shape {list(row.shape)}")
    before: float | None = None
    for value in _flat(row.default) if row.default is not None else ():
        if isinstance(value, str):
            fits = (
                value in tables[row.enum]
                if row.enum
                else row.type == "text" and len(value.encode()) <= row.length
            )
        else:
            fits = _is_possible(row, value, before)
            before = value
        if not fits:
            raise BadRegistry(f"{row.name}: its default {value} is not a value it may have")


def _is_possible(row: Parameter, value: float, before: float | None) -> bool:
    if row.min is None or row.max is None or isinstance(value, bool):
        return False
    try:
        struct.pack("<" + STRUCT_CODES[row.type], value)
    except struct.error:
        return False
    if row.increasing and before is not None and value - before < 0.99 * row.least_step:
        return False
    return row.min <= value <= row.max


def _shape(value: Default) -> tuple[int, ...]:
    if not isinstance(value, tuple):
        return ()
    inner = {_shape(item) for item in value}
    return (len(value), *(inner.pop() if len(inner) == 1 else (-1,)))


def _flat(value: Default) -> list[float | int | str]:
    if isinstance(value, tuple):
        return [one for item in value for one in _flat(item)]
    assert value is not None
    return [value]


def _tuples(value: Any) -> Default:
    if isinstance(value, list):
        return tuple(_tuples(item) for item in value)
    result: Default = value
    return result
