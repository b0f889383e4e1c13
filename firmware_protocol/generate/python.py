"""Both _generated.py: IntEnums, message classes and the tables, as plain typed Python."""

from firmware_protocol.generate.registry import NOTICE, Layout, Registry
from firmware_protocol.generate.tables import Table
from firmware_protocol.layout import Band, Channel, Fault, Field, Parameter

FIRST_LINE = f'"""{NOTICE}"""'

LAYOUT_NAMES = (
    "Band",
    "Channel",
    "Fault",
    "Field",
    "Message",
    "Order",
    "Parameter",
)


def camel(name: str) -> str:
    """`CfgBegin` for CFG_BEGIN and `DeviceClass` for device_class."""
    return "".join(part.capitalize() for part in name.split("_"))


def module(registry: Registry, schema_hash: bytes) -> str:
    """The text of _generated.py."""
    parts = [
        FIRST_LINE,
        "",
        "from dataclasses import dataclass",
        "from enum import IntEnum, IntFlag",
        "from typing import ClassVar",
        "",
        "from firmware_protocol.layout import (",
        *[f"    {name}," for name in LAYOUT_NAMES],
        ")",
        "",
        *_numbers(registry, schema_hash),
        "",
        *[line for table in registry.enums for line in _enum(table, "IntEnum")],
        *[line for table in registry.flags for line in _enum(table, "IntFlag")],
        *_message_ids(registry),
        *_messages(registry),
        *_tables(registry),
    ]
    return "\n".join(parts) + "\n"


def _numbers(registry: Registry, schema_hash: bytes) -> list[str]:
    names = ("major", "minor", "mtu_before_hello", "mtu", "max_outstanding", "control_period_us")
    lines = [f"{name.upper()} = {registry.protocol[name]}" for name in names]
    return [
        *lines,
        *_riding(registry),
        f"IMAGE_LENGTH = {registry.image_length}",
        f'SCHEMA_HASH = bytes.fromhex("{schema_hash.hex()}")',
        "",
    ]


def _riding(registry: Registry) -> list[str]:
    return [f"{name.upper()} = {value}" for name, value in registry.riding.items()]


def domain_module(registry: Registry) -> str:
    """The text of backend/core/_generated.py, which needs nothing of the wire."""
    flags = next(table for table in registry.flags if table.name == "input_flags")
    return "\n".join([FIRST_LINE, "", *_riding(registry), "", *_masks(flags)]) + "\n"


def _masks(table: Table) -> list[str]:
    members = [f'    "{name.lower()}": {1 << bit},' for name, bit in table.members.items()]
    return [f"{table.name.upper()} = {{", *members, "}"]


def _enum(table: Table, base: str) -> list[str]:
    members = [
        f"    {name} = {1 << value if base == 'IntFlag' else value}"
        for name, value in table.members.items()
    ]
    return [f"class {camel(table.name)}({base}):", f'    """{table.doc}"""', "", *members, "", ""]


def _message_ids(registry: Registry) -> list[str]:
    members = [f"    {row.name} = 0x{row.id:04X}" for row in registry.messages]
    doc = '    """Service in the high byte, operation in the low byte."""'
    return ["class MessageId(IntEnum):", doc, "", *members, "", ""]


def _messages(registry: Registry) -> list[str]:
    lines = []
    for row in registry.messages:
        for suffix, layout in (("Request", row.request), ("Response", row.response)):
            identity = f"    MESSAGE_ID: ClassVar[MessageId] = MessageId.{row.name}"
            lines += _class(f"{camel(row.name)}{suffix}", row.doc, identity, layout)
    for name, layout in registry.events:
        identity = f"    CODE: ClassVar[Event] = Event.{name}"
        lines += _class(f"{camel(name)}Event", f"Fields of the event {name}.", identity, layout)
    return lines


def _class(name: str, doc: str, identity: str, layout: Layout) -> list[str]:
    fields = [f"        {_field(field)}," for field in layout.fields]
    lines = [
        "@dataclass(frozen=True, slots=True)",
        f"class {name}(Message):",
        f'    """{doc}"""',
        "",
    ]
    lines += [identity]
    if fields:
        lines += ["    LAYOUT: ClassVar[tuple[Field, ...]] = (", *fields, "    )"]
        lines += [f"    LENGTH: ClassVar[int] = {layout.length}", ""]
        lines += [f"    {field.name}: {_annotation(field)}" for field in layout.members]
    return [*lines, "", ""]


def _field(field: Field) -> str:
    count = f", {field.count}" if field.count > 1 else ""
    count += f', high_of="{field.high_of}"' if field.high_of else ""
    return f'Field("{field.name}", "{field.type}"{count})'


def _annotation(field: Field) -> str:
    if field.type == "bytes" or (field.type == "u8" and field.count > 1):
        return "bytes"
    plain = "float" if field.type == "f32" else "int"
    if field.count > 1:
        return "tuple[" + ", ".join([plain] * field.count) + "]"
    return plain


def _tables(registry: Registry) -> list[str]:
    lines = []
    for suffix in ("Request", "Response"):
        kind = f"{suffix.upper()}_BY_ID: dict[int, type[Message]]"
        lines += [f"{kind} = {{"]
        lines += [f"    0x{row.id:04X}: {camel(row.name)}{suffix}," for row in registry.messages]
        lines += ["}", ""]
    lines += ["EVENT_BY_CODE: dict[int, type[Message]] = {"]
    lines += [f"    Event.{name}: {camel(name)}Event," for name, _ in registry.events]
    lines += ["}", "", "ENUM_BY_NAME: dict[str, type[IntEnum]] = {"]
    lines += [f'    "{table.name}": {camel(table.name)},' for table in registry.enums]
    lines += ["}", "", "PARAMETERS: tuple[Parameter, ...] = ("]
    for parameter in registry.parameters:
        lines += _parameter(parameter)
    lines += [")", "PARAMETER_BY_NAME = {parameter.name: parameter for parameter in PARAMETERS}"]
    lines += ["PARAMETER_BY_ID = {parameter.id: parameter for parameter in PARAMETERS}", ""]
    lines += ["ORDERS: tuple[Order, ...] = ("]
    lines += [f'    Order("{o.low}", "{o.high}", "{o.violation}"),' for o in registry.orders]
    lines += [")", "", "BANDS: tuple[Band, ...] = ("]
    lines += [line for band in registry.bands for line in _band(band)]
    lines += [")", "BAND_BY_NAME = {band.parameter: band for band in BANDS}", ""]
    lines += ["CHANNELS: tuple[Channel, ...] = ("]
    lines += [f"    {_channel(channel)}," for channel in registry.channels]
    lines += [")", "CHANNEL_BY_NAME = {channel.name: channel for channel in CHANNELS}"]
    lines += ["CHANNEL_BY_ID = {channel.id: channel for channel in CHANNELS}", ""]
    lines += ["FAULTS: tuple[Fault, ...] = ("]
    lines += [line for fault in registry.faults for line in _fault(fault)]
    return [*lines, ")", "FAULT_BY_NAME = {fault.name: fault for fault in FAULTS}"]


def _quoted(text: str | None) -> str:
    return "None" if text is None else '"' + text.replace('"', '\\"') + '"'


def _parameter(row: Parameter) -> list[str]:
    default = repr(row.default).replace("'", '"')
    return [
        "    Parameter(",
        f"        id=0x{row.id:04X}, name={_quoted(row.name)}, group={_quoted(row.group)},",
        f"        type={_quoted(row.type)}, unit={_quoted(row.unit)}, shape={row.shape!r},",
        f"        length={row.length}, min={row.min}, max={row.max}, enum={_quoted(row.enum)},",
        f"        increasing={row.increasing}, access={row.access},"
        f" image_offset={row.image_offset},{' ratchet=True,' if row.ratchet else ''}"
        f"{f' least_step={row.least_step},' if row.increasing else ''}"
        f"{'' if row.record == 'TUNABLE' else f' record={_quoted(row.record)},'}"
        f"{' may_be_none=True,' if row.may_be_none else ''}",
        f"        default={default},",
        f"        doc={_quoted(row.doc)},",
        "    ),",
    ]


def _band(row: Band) -> list[str]:
    return [
        "    Band(",
        f"        {_quoted(row.parameter)},",
        f"        around={_quoted(row.around)},",
        f"        within_pct={row.within_pct!r}, within={row.within!r},",
        f"        times={_quoted(row.times)}, unit={_quoted(row.unit)},",
        "    ),",
    ]


def _channel(row: Channel) -> str:
    return f'Channel({row.id}, "{row.name}", "{row.unit}", {row.scale}, {_quoted(row.doc)})'


def _fault(row: Fault) -> list[str]:
    return [
        "    Fault(",
        f'        {row.bit}, "{row.name}", {row.severity},',
        f"        {_quoted(row.rider_text)},",
        f"        {_quoted(row.mechanic_text)},",
        "    ),",
    ]
