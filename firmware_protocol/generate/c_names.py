"""How registry names are spelled in C, and the pieces the C targets share."""

from firmware_protocol.generate.registry import NOTICE, Layout, Registry
from firmware_protocol.generate.tables import Table
from firmware_protocol.layout import Field, Parameter

FIRST_LINE = f"/* {NOTICE} */"

C_TYPES = {
    "u8": "uint8_t",
    "u16": "uint16_t",
    "u32": "uint32_t",
    "u64": "uint64_t",
    "i16": "int16_t",
    "i32": "int32_t",
    "f32": "float",
    "text": "char",
}


def enum_prefix(table: Table) -> str:
    """`EBL_STATUS` for the table status; flags lose their suffix: `EBL_LIMIT` for limit_flags."""
    return "EBL_" + table.name.removesuffix("_flags").upper()


def layouts(registry: Registry) -> list[tuple[str, Layout]]:
    """Every struct that travels, with its C name; a message without fields has no struct."""
    found = []
    for row in registry.messages:
        for suffix, layout in (("request", row.request), ("response", row.response)):
            if layout.fields:
                found.append((f"ebl_{row.name.lower()}_{suffix}", layout))
    for name, layout in registry.events:
        found.append((f"ebl_{name.lower()}_event", layout))
    return found


def member(field: Field, halved: bool) -> list[str]:
    """The declaration of one field; a tail is a pointer into the caller's bytes."""
    if halved:
        return [f"uint32_t {field.name};"]
    if field.type == "bytes":
        return [f"const uint8_t *{field.name};", f"size_t {field.name}_length;"]
    dimension = f"[{field.count}]" if field.count > 1 else ""
    return [f"{C_TYPES[field.type]} {field.name}{dimension};"]


def config_member(parameter: Parameter) -> str:
    """The declaration of one parameter in ebl_config."""
    dimensions = "".join(f"[{size}]" for size in parameter.shape)
    if parameter.type == "text":
        dimensions += f"[{parameter.length}]"
    return f"{C_TYPES[parameter.type]} {parameter.name}{dimensions};"


def float_literal(value: float) -> str:
    """A float constant: shortest text that reads back the same."""
    return f"{float(value)!r}f"
