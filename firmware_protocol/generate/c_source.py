"""ebl_registry.c, ebl_messages.c and ebl_schema.c: tables, and nothing but tables."""

from itertools import groupby

from firmware_protocol.generate.c_names import FIRST_LINE, float_literal, layouts
from firmware_protocol.generate.registry import Layout, Registry
from firmware_protocol.generate.tables import SIZES
from firmware_protocol.layout import Field, Parameter

RUN_MAX = 31
"""What the lower five bits of a run can say."""

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
    lines += ["};", "", *_bands(registry)]
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
    flags += 4 * int(parameter.ratchet) + 8 * int(parameter.may_be_none)
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


def _config_default(registry: Registry) -> list[str]:
    lines = ["void ebl_config_default(ebl_config *config)", "{"]
    lines += ["    static const ebl_config factory = {"]
    for parameter in registry.parameters:
        lines.append(f"        .{parameter.name} = {_initialiser(registry, parameter)},")
    return [*lines, "    };", "    *config = factory;", "}"]


def _initialiser(registry: Registry, parameter: Parameter) -> str:
    choices = registry.enum(parameter.enum).members if parameter.enum else {}

    def text(value: object) -> str:
        if value is None:
            return "EBL_NONE"
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
    lines = [FIRST_LINE, '#include "ebl_registry.h"', "", '#include "ebl_layout.h" // EBL_U8', ""]
    for name, layout in layouts(registry):
        rows = ", ".join(
            [f"{layout.length}", f"{layout.full_length}", *_runs(name, layout), "EBL_END"]
        )
        lines += [f"const uint8_t {name}_layout[] = {{{rows}}};"]
    return "\n".join(lines) + "\n"


def _runs(name: str, layout: Layout) -> list[str]:
    """The fields as ebl_layout.h has them: numbers of one size side by side are one run."""
    runs: list[str] = []
    for kind, group in groupby(layout.fields, lambda field: _kind(layout, field)):
        fields = list(group)
        if kind in ("EBL_LOW", "EBL_HIGH"):
            members = [field.high_of or field.name for field in fields]
            runs += [f"{kind} | offsetof({name}, {member}) / 4" for member in members]
        elif kind == "EBL_TAIL":
            runs.append(kind)
        else:
            count = sum(field.count for field in fields)
            runs += [f"{kind} | {min(count - at, RUN_MAX)}" for at in range(0, count, RUN_MAX)]
    return runs


def _kind(layout: Layout, field: Field) -> str:
    if field.type == "bytes":
        return "EBL_TAIL"
    if field.high_of:
        return "EBL_HIGH"
    return "EBL_LOW" if layout.is_halved(field) else f"EBL_U{8 * SIZES[field.type]}"


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
