"""ebl_registry.c, ebl_messages.c and ebl_schema.c: tables, and explicit little-endian copies."""

from firmware_protocol.generate.c_names import FIRST_LINE, float_literal, layouts, size
from firmware_protocol.generate.registry import Layout, Registry
from firmware_protocol.layout import Field, Parameter

FIND = """\
const {struct} *ebl_{row}_find({type} {key})
{{
    for (size_t at = 0; at < EBL_{upper}_COUNT; at++) {{
        if ({struct}s[at].{key} == {key}) {{
            return &{struct}s[at];
        }}
    }}
    return NULL;
}}
"""


def registry_source(registry: Registry) -> str:
    """The text of ebl_registry.c."""
    lines = [FIRST_LINE, '#include "ebl_registry.h"', ""]
    lines += ["const ebl_message ebl_messages[EBL_MESSAGE_COUNT] = {"]
    lines += [
        f"    {{0x{row.id:04x}, {row.request.length}, {row.response.length}}},"
        for row in registry.messages
    ]
    lines += ["};", "", "const ebl_event_row ebl_event_rows[EBL_EVENT_COUNT] = {"]
    lines += [f"    {{EBL_EVENT_{name}, {layout.length}}}," for name, layout in registry.events]
    lines += ["};", "", "const ebl_parameter ebl_parameters[EBL_PARAMETER_COUNT] = {"]
    lines += [_parameter_row(registry, parameter) for parameter in registry.parameters]
    lines += ["};", "", "const ebl_order ebl_orders[EBL_ORDER_COUNT] = {"]
    rows = {parameter.name: parameter for parameter in registry.parameters}
    for order in registry.orders:
        low, high = rows[order.low], rows[order.high]
        lines += [
            f"    {{{low.image_offset}, {high.image_offset}, 0x{high.id:04x},"
            f" EBL_VIOLATION_{order.violation}}},"
        ]
    lines += ["};", "", *_bands(registry), *_retired(registry)]
    lines += ["const ebl_channel ebl_channels[EBL_CHANNEL_COUNT] = {"]
    lines += [f"    {{{row.id}, {float_literal(row.scale)}}}," for row in registry.channels]
    lines += ["};", ""]
    for row, struct, kind, key in (
        ("message", "ebl_message", "uint16_t", "id"),
        ("event", "ebl_event_row", "uint8_t", "code"),
        ("parameter", "ebl_parameter", "uint16_t", "id"),
        ("channel", "ebl_channel", "uint8_t", "id"),
    ):
        lines += [FIND.format(row=row, struct=struct, type=kind, key=key, upper=row.upper())]
    lines += [*_config_default(registry)]
    return "\n".join(lines) + "\n"


def _parameter_row(registry: Registry, parameter: Parameter) -> str:
    low, high = parameter.min or 0.0, parameter.max or 0.0
    if parameter.enum is not None:
        high = max(registry.enum(parameter.enum).members.values())
    flags = int(parameter.increasing) + 2 * int(parameter.enum is not None)
    flags += 4 * int(parameter.ratchet)
    access = next(n for n, v in registry.enum("access").members.items() if v == parameter.access)
    return (
        f"    {{0x{parameter.id:04x}, {parameter.image_offset}, EBL_TYPE_{parameter.type.upper()},"
        f" {parameter.count}, {parameter.length}, EBL_ACCESS_{access},"
        f" EBL_RECORD_{parameter.record}, {flags},\n"
        f"     offsetof(ebl_config, {parameter.name}),"
        f" {float_literal(low)}, {float_literal(high)}, {float_literal(parameter.least_step)}}},"
    )


def _bands(registry: Registry) -> list[str]:
    rows = {parameter.name: parameter for parameter in registry.parameters}
    lines = ["const ebl_band ebl_bands[EBL_BAND_COUNT] = {"]
    for band in registry.bands:
        parameter, around = rows[band.parameter], rows[band.around]
        scale = str(rows[band.times].image_offset) if band.times else "EBL_BAND_NO_SCALE"
        lines += [
            f"    {{0x{parameter.id:04x}, 0x{around.id:04x}, {parameter.image_offset},"
            f" {around.image_offset}, {scale},",
            f"     {float_literal((band.within_pct or 0.0) / 100)},"
            f" {float_literal(band.within or 0.0)}}},",
        ]
    return [*lines, "};", ""]


def _retired(registry: Registry) -> list[str]:
    rows = {parameter.name: parameter for parameter in registry.parameters}
    lines = ["const ebl_retired_row ebl_retired[EBL_RETIRED_COUNT] = {"]
    lines += [
        f"    {{0x{row.id:04x}, EBL_TYPE_{row.type.upper()}, 0x{rows[row.becomes].id:04x},"
        f" {float_literal(row.factor)}}},"
        for row in registry.retired
    ]
    return [*lines, "};", ""]


def _config_default(registry: Registry) -> list[str]:
    lines = ["void ebl_config_default(ebl_config *config)", "{"]
    lines += ["    static const ebl_config factory = {"]
    for parameter in registry.parameters:
        lines.append(f"        .{parameter.name} = {_initialiser(registry, parameter)},")
    return [*lines, "    };", "    *config = factory;", "}"]


def _initialiser(registry: Registry, parameter: Parameter) -> str:
    choices = registry.enum(parameter.enum).members if parameter.enum else {}

    def text(value: object) -> str:
        if isinstance(value, tuple):
            return "{" + ", ".join(text(item) for item in value) + "}"
        if isinstance(value, str):
            return (
                f"EBL_{parameter.enum.upper()}_{value}"
                if value in choices and parameter.enum
                else '"' + value + '"'
            )
        return float_literal(float(str(value))) if parameter.type == "f32" else str(value)

    if len(parameter.shape) < 2:
        return text(parameter.default)
    rows = ",\n            ".join(text(row) for row in _rows(parameter))
    return "{\n            " + rows + "}"


def _rows(parameter: Parameter) -> tuple[object, ...]:
    assert isinstance(parameter.default, tuple)
    return parameter.default


def messages_source(registry: Registry) -> str:
    """The text of ebl_messages.c."""
    lines = [FIRST_LINE, '#include "ebl_registry.h"', "", "#include <string.h>", ""]
    lines += ['#include "ebl_bytes.h" // ebl_get_u16, ebl_put_u16, EBL_OK', ""]
    for name, layout in layouts(registry):
        lines += [*_get(name, layout), "", *_put(name, layout), ""]
    return "\n".join(lines[:-1]) + "\n"


def _get(name: str, layout: Layout) -> list[str]:
    lines = [f"int {name}_get({name} *message, const uint8_t *bytes, size_t length)", "{"]
    if layout.length:
        lines += [
            f"    if (length < {layout.length}) {{",
            "        return EBL_ERROR_LENGTH;",
            "    }",
        ]
    at = 0
    for field in layout.fields:
        target, source = f"message->{field.name}", f"bytes + {at}"
        if field.type == "bytes":
            lines += [f"    {target} = {source};", f"    {target}_length = length - {at};"]
            break
        if field.high_of:
            lines += [f"    if (length >= {at + size(field)}) {{"]
            lines += [f"        message->{field.high_of} |= (uint32_t)ebl_get_u16({source}) << 16;"]
            lines += ["    }"]
        else:
            lines += _copy(field, f"{target} = ebl_get_{field.type}({{}});", target, source, source)
        at += size(field)
    return [*lines, "    return EBL_OK;", "}"]


def _put(name: str, layout: Layout) -> list[str]:
    lines = [
        f"int {name}_put(const {name} *message, uint8_t *bytes, size_t capacity,",
        f"    {' ' * len(name)}    size_t *length)",
        "{",
    ]
    total = f"{layout.whole}"
    if layout.has_tail:
        tail = f"message->{layout.fields[-1].name}_length"
        lines += [f"    if (capacity < {total} || capacity - {total} < {tail}) {{"]
        if not layout.whole:
            lines[-1] = f"    if (capacity < {tail}) {{"
        total = f"{total} + {tail}"
    else:
        lines += [f"    if (capacity < {total}) {{"]
    lines += ["        return EBL_ERROR_SPACE;", "    }"]
    at = 0
    for field in layout.fields:
        source, target = f"message->{field.name}", f"bytes + {at}"
        if field.type == "bytes":
            lines += [f"    if ({source}_length > 0) {{"]
            lines += [f"        memcpy({target}, {source}, {source}_length);", "    }"]
            break
        if field.high_of:
            source = f"(uint16_t)(message->{field.high_of} >> 16)"
        elif layout.is_halved(field):
            source = f"(uint16_t)({source} & 0xffffu)"
        call = f"ebl_put_{field.type}({{}}, {source}" + ");"
        lines += _copy(field, call, target, source, target)
        at += size(field)
    return [*lines, f"    *length = {total};", "    return EBL_OK;", "}"]


def _copy(field: Field, call: str, target: str, source: str, bytes_at: str) -> list[str]:
    """One field: a call, a memcpy for bytes, or a loop for an array of wider numbers."""
    if field.count == 1:
        return ["    " + call.format(bytes_at)]
    if field.type == "u8":
        return [f"    memcpy({target}, {source}, {field.count});"]
    element = f"message->{field.name}"
    step = call.format(f"{bytes_at} + {size(field) // field.count} * i")
    return [
        f"    for (size_t i = 0; i < {field.count}; i++) {{",
        "        " + step.replace(element, element + "[i]"),
        "    }",
    ]


def schema_source(compressed: bytes, schema_hash: bytes) -> str:
    """The text of ebl_schema.c."""
    lines = [FIRST_LINE, '#include "ebl_registry.h"', ""]
    for name, size_name, data in (
        ("ebl_schema_hash", "EBL_SCHEMA_HASH_LENGTH", schema_hash),
        ("ebl_schema", "EBL_SCHEMA_LENGTH", compressed),
    ):
        lines += [f"const uint8_t {name}[{size_name}] = {{"]
        for at in range(0, len(data), 16):
            lines.append("    " + ", ".join(f"0x{byte:02x}" for byte in data[at : at + 16]) + ",")
        lines += ["};", ""]
    return "\n".join(lines[:-1]) + "\n"
