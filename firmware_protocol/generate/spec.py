"""The tables of SPEC.md, put between markers so that the prose around them stays hand-written."""

import re

from firmware_protocol.generate.registry import Layout, Registry
from firmware_protocol.layout import Band

MARKER = "<!-- generated: {name} -->"
END = "<!-- end generated -->"


def filled(text: str, registry: Registry) -> str:
    """SPEC.md with every generated section replaced. Raises KeyError for an unknown marker."""
    tables = {
        "enumerations": _enumerations(registry),
        "messages": _messages(registry),
        "events": _events(registry),
        "parameters": _parameters(registry),
        "channels": _channels(registry),
        "faults": _faults(registry),
    }

    def section(match: re.Match[str]) -> str:
        name = match[1]
        return "\n".join([MARKER.format(name=name), "", *tables[name], "", END])

    pattern = MARKER.format(name=r"(\w+)") + ".*?" + END
    return re.sub(pattern, section, text, flags=re.S)


def _enumerations(registry: Registry) -> list[str]:
    lines = []
    for table in registry.enums:
        members = ", ".join(f"{value} {name}" for name, value in table.members.items())
        lines += [f"### {table.name}", "", table.doc, "", members + ".", ""]
    for table in registry.flags:
        members = ", ".join(f"bit {bit} {name}" for name, bit in table.members.items())
        lines += [f"### {table.name}", "", table.doc, "", members + ".", ""]
    return lines[:-1]


def _fields(layout: Layout) -> str:
    texts = [f"{f.name} {f.type}" + (f"[{f.count}]" if f.count > 1 else "") for f in layout.fields]
    if not texts:
        return "nothing"
    least = f"{layout.length} or " if layout.full_length != layout.length else ""
    return f"{', '.join(texts)} ({least}{layout.full_length}{' B +' if layout.has_tail else ' B'})"


def _messages(registry: Registry) -> list[str]:
    lines = []
    for row in registry.messages:
        lines += [f"### 0x{row.id:04X} {row.name}", "", row.doc, ""]
        lines += [f"- Request: {_fields(row.request)}", f"- Response: {_fields(row.response)}", ""]
    return lines[:-1]


def _events(registry: Registry) -> list[str]:
    codes = registry.enum("event").members
    lines = ["| code | event | fields |", "|---|---|---|"]
    return lines + [
        f"| {codes[name]} | {name} | {_fields(layout)} |" for name, layout in registry.events
    ]


def _parameters(registry: Registry) -> list[str]:
    access = {value: name for name, value in registry.enum("access").members.items()}
    bands = {band.parameter: _band(band) for band in registry.bands}
    lines = []
    for row in registry.parameters:
        shape = "".join(f"[{size}]" for size in row.shape)
        kind = f"text of {row.length} B" if row.type == "text" else row.type
        limits = f"{row.min} to {row.max} {row.unit}".strip() if row.enum is None else row.enum
        if row.type == "text":
            limits = "UTF-8, zero-filled"
        extra = f", increasing by {row.least_step} at least" if row.increasing else ""
        extra += ", ratchet" if row.ratchet else ""
        extra += ", or none" if row.may_be_none else ""
        extra += bands.get(row.name, "")
        lines += [f"### 0x{row.id:04X} {row.name}", "", row.doc, ""]
        lines += [
            f"{kind}{shape} at image byte {row.image_offset}; {limits}{extra};"
            f" {access[row.access]} may change it; kept in the {row.record.lower()} record.",
            "",
        ]
    return lines[:-1]


def _band(band: Band) -> str:
    if band.within_pct is not None:
        return f", band of {band.within_pct:g} % around {band.around}"
    through = f" through {band.times}" if band.times else ""
    return f", band of {band.within:g} {band.unit} around {band.around}{through}"


def _channels(registry: Registry) -> list[str]:
    lines = ["| id | channel | unit | scale | meaning |", "|---|---|---|---|---|"]
    return lines + [
        f"| {row.id} | {row.name} | {row.unit} | {row.scale} | {row.doc} |"
        for row in registry.channels
    ]


def _faults(registry: Registry) -> list[str]:
    severities = {value: name for name, value in registry.enum("severity").members.items()}
    lines = ["| bit | fault | does | rider | mechanic |", "|---|---|---|---|---|"]
    return lines + [
        f"| {row.bit} | {row.name} | {severities[row.severity]} | {row.rider_text} |"
        f" {row.mechanic_text} |"
        for row in registry.faults
    ]
