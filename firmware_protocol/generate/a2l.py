"""a2l/ebl.a2l: parameters and channels as an ASAP2 1.7 description for calibration tools.

Two pieces of memory are described, neither of which is a processor's: see `ABOUT`.
"""

from firmware_protocol.generate.registry import NOTICE, Registry
from firmware_protocol.generate.tables import Table
from firmware_protocol.layout import HALF_BITS, NONE_BITS, Channel, Parameter

LIVE_ROW = 0x10000
FACTORY = 2
COUNT_MAX = 32767
DATATYPES = {"f32": "FLOAT32_IEEE", "u8": "UBYTE", "u16": "UWORD", "u32": "ULONG"}
MASK_BITS = 15
"""Flags travel as an int16 channel: bit 15 would be its sign."""
HIGH = "_high"
"""Of the name of the channel that carries the flags' bits 16 up."""

ABOUT = f"""\
/* Addresses are not those of a processor:
     0x00000 + n  byte n of the configuration image: what CFG_READ gives from offset n, what
                  config_crc32 is taken over. It is written with CFG_SET, never byte by byte.
     0x{LIVE_ROW:05X} + n  byte n of a row of every channel in the order of their ids, as
                  STR_SNAPSHOT and freeze frames carry it: int16, and -32768 is no value.
   READ_ONLY parameters are the factory's. A parameter that says ratchet goes down freely and up
   only with the maker's token, one that says band stays near the factory's value without it. The
   EPK is the hash of the schema this was made from; HELLO tells the unit's, and a file of another
   hash is not this unit's. */"""


def description(registry: Registry, schema_hash: bytes) -> str:
    """The text of ebl.a2l."""
    tables = [registry.enum(name) for name in _enum_names(registry)]
    lines = [
        f"/* {NOTICE} */",
        ABOUT,
        "",
        "ASAP2_VERSION 1 71",
        "",
        '/begin PROJECT spindle "Mid-drive e-bike unit"',
        f'  /begin HEADER "EBL/{registry.protocol["major"]} configuration and channels"',
        f'    VERSION "{schema_hash.hex()}"',
        "  /end HEADER",
        '  /begin MODULE ebl ""',
        *_memory(registry, schema_hash),
        *_record_layouts(),
        *[line for table in tables for line in _verbal(table)],
        *_linear_methods(registry),
        *_identical_methods(registry),
        *[line for row in registry.parameters for line in _characteristics(registry, row)],
        *[line for at, row in enumerate(registry.channels) for line in _measurement(at, row)],
        *_flag_measurements(registry),
        *_groups(registry),
        "  /end MODULE",
        "/end PROJECT",
    ]
    return "\n".join(lines) + "\n"


def _enum_names(registry: Registry) -> list[str]:
    return sorted({row.enum for row in registry.parameters if row.enum is not None})


def _memory(registry: Registry, schema_hash: bytes) -> list[str]:
    row_length = 2 * len(registry.channels)
    unused = "-1 -1 -1 -1 -1"
    return [
        '    /begin MOD_COMMON ""',
        "      BYTE_ORDER MSB_LAST",
        *[
            f"      ALIGNMENT_{name} 1"
            for name in ("BYTE", "WORD", "LONG", "INT64", "FLOAT32_IEEE", "FLOAT64_IEEE")
        ],
        "    /end MOD_COMMON",
        '    /begin MOD_PAR ""',
        f'      EPK "{schema_hash.hex()}"',
        '      /begin MEMORY_SEGMENT config_image "CFG_READ, CFG_SET"',
        f"        DATA FLASH INTERN 0x0 0x{registry.image_length:X} {unused}",
        "      /end MEMORY_SEGMENT",
        '      /begin MEMORY_SEGMENT live_row "STR_SNAPSHOT"',
        f"        VARIABLES RAM INTERN 0x{LIVE_ROW:X} 0x{row_length:X} {unused}",
        "      /end MEMORY_SEGMENT",
        "    /end MOD_PAR",
    ]


def _record_layouts() -> list[str]:
    lines = []
    for kind, datatype in DATATYPES.items():
        lines += [
            f"    /begin RECORD_LAYOUT {kind}",
            f"      FNC_VALUES 1 {datatype} ROW_DIR DIRECT",
            "    /end RECORD_LAYOUT",
        ]
    return lines


def _verbal(table: Table) -> list[str]:
    rows = [f'      {value} "{name}"' for name, value in table.members.items()]
    return [
        f"    /begin COMPU_METHOD {table.name} {_text(table.doc)}",
        f'      TAB_VERB "%1.0" "" COMPU_TAB_REF {table.name}.table',
        "    /end COMPU_METHOD",
        f'    /begin COMPU_VTAB {table.name}.table "" TAB_VERB {len(rows)}',
        *rows,
        "    /end COMPU_VTAB",
    ]


def _linear_methods(registry: Registry) -> list[str]:
    """One for each channel: its unit, and physical = scale * count."""
    lines = []
    for row in registry.channels:
        lines += [
            f'    /begin COMPU_METHOD {row.name}.method ""',
            f'      LINEAR "%9.{_decimals(row.scale)}" "{row.unit}"',
            f"      COEFFS_LINEAR {row.scale!r} 0",
            "    /end COMPU_METHOD",
        ]
    return lines


def _decimals(scale: float) -> int:
    return len(f"{scale:.10f}".rstrip("0").partition(".")[2])


def _identical_methods(registry: Registry) -> list[str]:
    """One for each unit of a parameter."""
    units = dict.fromkeys(row.unit for row in registry.parameters if row.enum is None)
    lines = []
    for unit in units:
        lines += [
            f'    /begin COMPU_METHOD {_unit_method(unit)} ""',
            f'      IDENTICAL "%9.4" "{unit}"',
            "    /end COMPU_METHOD",
        ]
    return lines


def _unit_method(unit: str) -> str:
    words = "".join(c if c.isalnum() else "_per_" if c == "/" else "_" for c in unit)
    return f"unit.{words or 'none'}"


def _names(row: Parameter) -> list[str]:
    """What a parameter is called: every text of several is one of its own."""
    if row.type == "text" and row.shape:
        return [f"{row.name}[{index}]" for index in range(row.count)]
    return [row.name]


def _characteristics(registry: Registry, row: Parameter) -> list[str]:
    """A number, a block of numbers, or texts."""
    choices = len(registry.enum(row.enum).members) if row.enum is not None else 0
    return [
        line
        for index, name in enumerate(_names(row))
        for line in _characteristic(
            row, choices, name, row.image_offset + index * row.length, _note(registry, row)
        )
    ]


def _note(registry: Registry, row: Parameter) -> str:
    """What a token is needed for, beside READ_ONLY; and what stands for no value."""
    if row.may_be_none:
        return f"NaN (0x{NONE_BITS:08X}): none."
    if row.ratchet:
        return "Goes up only with a token (ratchet)."
    for band in registry.bands:
        if band.parameter == row.name:
            within = f"{band.within:g} {band.unit}" if band.within else f"{band.within_pct:g} %"
            return f"Further than {within} from {band.around} only with a token (band)."
    return ""


def _characteristic(row: Parameter, choices: int, name: str, address: int, note: str) -> list[str]:
    kind = "ASCII" if row.type == "text" else "VAL_BLK" if row.shape else "VALUE"
    layout = "u8" if row.type == "text" else row.type
    method = "NO_COMPU_METHOD" if row.type == "text" else row.enum or _unit_method(row.unit)
    doc = f"{row.doc} {note}".strip()
    lines = [
        f"    /begin CHARACTERISTIC {name} {_text(doc)}",
        f"      {kind} 0x{address:X} {layout} 0 {method} {_limits(row, choices)}",
    ]
    if kind == "ASCII":
        lines.append(f"      NUMBER {row.length}")
    elif kind == "VAL_BLK":
        # A2L counts the dimension that runs fastest first.
        lines.append(f"      MATRIX_DIM {' '.join(str(size) for size in reversed(row.shape))}")
    if row.access == FACTORY:
        lines.append("      READ_ONLY")
    return [*lines, "    /end CHARACTERISTIC"]


def _limits(row: Parameter, choices: int) -> str:
    if row.type == "text":
        return "0 255"
    if row.enum is not None:
        return f"0 {choices - 1}"
    return f"{row.min!r} {row.max!r}"


def _measurement(position: int, row: Channel) -> list[str]:
    bound = COUNT_MAX * row.scale
    return [
        f"    /begin MEASUREMENT {row.name} {_text(row.doc)}",
        f"      SWORD {row.name}.method 1 0 {-bound:.10g} {bound:.10g}",
        f"      ECU_ADDRESS 0x{LIVE_ROW + 2 * position:X}",
        "    /end MEASUREMENT",
    ]


def _flag_measurements(registry: Registry) -> list[str]:
    """A measurement of one bit for each flag of a channel that carries flags."""
    tables = {table.name: table for table in registry.flags}
    lines = []
    for position, row in enumerate(registry.channels):
        flags, lowest = row.name.removesuffix(HIGH), HALF_BITS if row.name.endswith(HIGH) else 0
        for name, bit in tables[flags].members.items() if flags in tables else ():
            if not 0 <= bit - lowest < MASK_BITS:
                continue
            lines += [
                f'    /begin MEASUREMENT {flags}.{name} ""',
                "      SWORD NO_COMPU_METHOD 1 0 0 1",
                f"      BIT_MASK 0x{1 << bit - lowest:X}",
                f"      ECU_ADDRESS 0x{LIVE_ROW + 2 * position:X}",
                "    /end MEASUREMENT",
            ]
    return lines


def _groups(registry: Registry) -> list[str]:
    lines = []
    for group in dict.fromkeys(row.group for row in registry.parameters):
        rows = [row for row in registry.parameters if row.group == group]
        names = [name for row in rows for name in _names(row)]
        lines += [
            f'    /begin GROUP group.{group} ""',
            "      ROOT",
            f"      /begin REF_CHARACTERISTIC {' '.join(names)} /end REF_CHARACTERISTIC",
            "    /end GROUP",
        ]
    names = [row.name for row in registry.channels]
    return [
        *lines,
        '    /begin GROUP group.channels ""',
        "      ROOT",
        f"      /begin REF_MEASUREMENT {' '.join(names)} /end REF_MEASUREMENT",
        "    /end GROUP",
    ]


def _text(words: str) -> str:
    return '"' + words.replace("\\", "\\\\").replace('"', '\\"') + '"'
