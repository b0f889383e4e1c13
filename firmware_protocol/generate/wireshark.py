"""wireshark/ebl.lua: the registry as Lua tables, followed by the dissector that reads them."""

from typing import Any

from firmware_protocol.generate.registry import NOTICE, Layout, Registry
from firmware_protocol.layout import HALF_BITS, Field, Parameter

SESSION_MAX = 15
FRAME_LENGTH_MIN = 8
TCP_PORT = 8751
"""Where the dissector listens unless told otherwise; the pages use it for a unit on TCP."""

# Fields that hold a member of an enumeration or flags, by their name or by message and name.
FIELD_TABLES = {
    "device_class": "device_class",
    "access": "access",
    "bank": "bank",
    "rollback_cause": "rollback_cause",
    "reset_cause": "reset_cause",
    "fault_flags": "fault_flags",
    "fault_flags_high": "fault_flags_high",
    "level": "access",
    "CFG_INFO.state": "config_state",
    "CFG_COMMIT.state": "config_state",
    "CFG_STATUS.state": "config_state",
    "CFG_COMMIT.flags": "commit_flags",
    "CFG_SLOTS.states": "slot_state",
}
# What the last field of a message is made of.
FIELD_TAILS = {
    "items": "items",
    "ids": "parameter_ids",
    "channel_ids": "channel_ids",
    "text": "text",
    "STR_SNAPSHOT.values": "asked_row",
    "EVT_FAULT_FREEZE.values": "full_row",
    "CFG_READ.data": "image",
}
UNIT_OF_SUFFIX = {
    "_bytes_per_s": "B/s",
    "_us": "us",
    "_ms": "ms",
    "_min": "min",
    "_s": "s",
    "_m": "m",
}
# SPEC.md 1.2.
DETAILS = {
    "PENDING": "ms until the answer",
    "UNKNOWN_MSG": "message id",
    "LENGTH": "bytes needed, or the parameter id of the cut item",
    "VERSION": "the unit's major",
    "BUSY": "seconds until the other transaction's lease or log session ends",
    "RANGE": "parameter, channel or the limit that was passed",
    "TYPE": "parameter id",
    "UNKNOWN_ID": "parameter or channel id",
    "ACCESS": "level needed",
    "STALE_BASE": "low half of the active generation",
    "CRC_MISMATCH": "low half of the unit's CRC",
    "INVALID_CONFIG": "number of violations",
    "RATE_LIMIT": "ms until it may be asked again",
    "BANDWIDTH": "largest rate in Hz that fits, 0 for none",
    "AUTH_BAD": "attempts that failed in a row",
    "AUTH_DELAY": "seconds until the next attempt",
}


def dissector(registry: Registry, logic: str) -> str:
    """The text of ebl.lua. logic: dissector.lua, which is written by hand."""
    tables = {
        "major": registry.protocol["major"],
        "mtu": registry.protocol["mtu"],
        "frame_length_min": FRAME_LENGTH_MIN,
        "session_max": SESSION_MAX,
        "tcp_port": TCP_PORT,
        "missing": -32768,
        "enums": {
            t.name: {value: name for name, value in t.members.items()} for t in registry.enums
        },
        "flags": _flags(registry),
        "details": DETAILS,
        "messages": {
            row.id: {
                "name": row.name,
                "request": _layout(registry, row.name, row.request),
                "response": _layout(registry, row.name, row.response),
            }
            for row in registry.messages
        },
        "events": {
            registry.enum("event").members[name]: {
                "name": name,
                "fields": _layout(registry, name, layout),
            }
            for name, layout in registry.events
        },
        "parameters": {row.id: _parameter(row) for row in registry.parameters},
        "image_order": [row.id for row in registry.parameters],
        "channels": {
            row.id: {"name": row.name, "unit": row.unit, "scale": row.scale}
            for row in registry.channels
        },
        "channel_order": [row.id for row in registry.channels],
    }
    lines = [f"-- {NOTICE}", "-- Its lower half is firmware_protocol/generate/dissector.lua.", ""]
    lines.append("local EBL = {")
    for name, value in tables.items():
        lines += _member(name, value)
    return "\n".join([*lines, "}", "", logic])


def _member(name: str, value: Any) -> list[str]:
    """A member of the table; one of many rows has a line for each."""
    if not isinstance(value, dict):
        return [f"    {name} = {lua(value)},"]
    rows = [f"        [{lua(key)}] = {lua(row)}," for key, row in value.items()]
    return [f"    {name} = {{", *rows, "    },"]


def lua(value: Any) -> str:
    """A value as Lua writes it; members that are None are left out."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, dict):
        rows = [f"[{lua(key)}] = {lua(row)}" for key, row in value.items() if row is not None]
        return "{ " + ", ".join(rows) + " }"
    return "{ " + ", ".join(lua(row) for row in value) + " }"


def _flags(registry: Registry) -> dict[str, dict[int, str]]:
    """Names by bit of every field of flags; a high half has a table of its own."""
    tables = {t.name: {bit: name for name, bit in t.members.items()} for t in registry.flags}
    halved = [name for name in tables if f"{name}_high" in FIELD_TABLES]
    for name in halved:
        whole = tables[name]
        tables[name] = {bit: text for bit, text in whole.items() if bit < HALF_BITS}
        tables[f"{name}_high"] = {
            bit - HALF_BITS: text for bit, text in whole.items() if bit >= HALF_BITS
        }
    return tables


def _layout(registry: Registry, owner: str, layout: Layout) -> list[dict[str, Any]]:
    return [_field(registry, owner, field) for field in layout.fields]


def _field(registry: Registry, owner: str, field: Field) -> dict[str, Any]:
    table = _looked_up(FIELD_TABLES, owner, field)
    is_enum = any(one.name == table for one in registry.enums)
    return {
        "name": field.name,
        "type": field.type,
        "count": field.count,
        "unit": next((u for s, u in UNIT_OF_SUFFIX.items() if field.name.endswith(s)), None),
        "enum": table if is_enum else None,
        "flags": None if is_enum else table,
        "high": bool(field.high_of) or None,
        "tail": _looked_up(FIELD_TAILS, owner, field) if field.type == "bytes" else None,
    }


def _looked_up(table: dict[str, str], owner: str, field: Field) -> str | None:
    return table.get(f"{owner}.{field.name}") or table.get(field.name)


def _parameter(row: Parameter) -> dict[str, Any]:
    return {
        "name": row.name,
        "type": row.type,
        "unit": row.unit,
        "count": row.count,
        "length": row.length,
        "offset": row.image_offset,
        "enum": row.enum,
    }
