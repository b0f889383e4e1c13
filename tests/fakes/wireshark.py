"""Two Wiresharks: the real one's `tshark` where it is installed, and one that only records.

Both are shown packets and give, for each, the fields the dissector added: name and value as text.
"""

from __future__ import annotations

import importlib
import struct
import subprocess
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

Seen = list[tuple[str, str]]
DISSECTOR = Path(__file__).resolve().parents[2] / "firmware_protocol" / "wireshark" / "ebl.lua"
STUB = Path(__file__).with_name("wireshark.lua")
DLT_USER0, DLT_ETHERNET = 147, 1
PORT = 8751
HOST, UNIT = "10.0.0.1", "10.0.0.2"
CODES = {
    "uint8": "<B",
    "uint16": "<H",
    "uint32": "<I",
    "uint64": "<Q",
    "int16": "<h",
    "int32": "<i",
    "float": "<f",
}


class RecordingWireshark:
    """The dissector in Lua `version` (52: Wireshark up to 4.2, 54: from 4.4 on)."""

    def __init__(self, version: int) -> None:
        runtime = importlib.import_module(f"lupa.lua{version}")
        self._lua = runtime.LuaRuntime(encoding="latin-1")
        self._lua.execute(STUB.read_text(encoding="ascii"))
        self._lua.execute(DISSECTOR.read_text(encoding="utf-8"))

    def serial(self, packets: Iterable[bytes]) -> list[Seen]:
        """Packets of DLT_USER0."""
        return [
            self._show("wtap_encap", packet, number, HOST, UNIT)[0]
            for number, packet in enumerate(packets, start=1)
        ]

    def tcp(self, segments: Iterable[tuple[str, bytes]]) -> list[Seen]:
        """Segments of one connection as (who sends, bytes); what waits is shown again."""
        waiting = {HOST: b"", UNIT: b""}
        found = []
        for number, (source, data) in enumerate(segments, start=1):
            text = waiting[source] + data
            other = UNIT if source == HOST else HOST
            seen, begin = self._show("tcp.port", text, number, source, other)
            waiting[source] = text[begin:] if begin >= 0 else b""
            found.append(seen)
        return found

    def _show(
        self, where: str, text: bytes, number: int, source: str, other: str
    ) -> tuple[Seen, int]:
        show: Any = self._lua.globals().show
        recorded, waits, _ = show(where, text.decode("latin-1"), number, source, other)
        rows = [[row[place] for place in range(1, 6)] for row in recorded.values()]
        return [_recorded(*row) for row in rows], int(waits)


def _recorded(abbr: str, kind: str, mask: float, raw: str, value: Any) -> tuple[str, str]:
    data = raw.encode("latin-1")
    if value is not None:
        return abbr, str(value)
    if kind == "bytes":
        return abbr, data.hex()
    if kind == "bool":
        return abbr, str(int(bool(int.from_bytes(data, "little") & int(mask))))
    number = struct.unpack(CODES[kind], data)[0]
    if mask:
        lowest = int(mask) & -int(mask)
        number = (number & int(mask)) // lowest
    return abbr, str(number)


def tshark(packets: Sequence[bytes], link_type: int) -> list[Seen]:
    """What `tshark` shows of the packets of a capture with this link type."""
    head = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, link_type)
    rows = [
        struct.pack("<IIII", number, 0, len(packet), len(packet)) + packet
        for number, packet in enumerate(packets)
    ]
    words = ["tshark", "-r", "-", "-X", f"lua_script:{DISSECTOR}", "-T", "pdml"]
    capture = head + b"".join(rows)
    run = subprocess.run(words, input=capture, capture_output=True, check=True, timeout=120)
    found = []
    for packet in ElementTree.fromstring(run.stdout).iter("packet"):
        fields = packet.iter("field")
        shown = [(field.get("name", ""), field.get("show", "")) for field in fields]
        found.append([(name, text) for name, text in shown if name.startswith("ebl.")])
    return found


def tcp_packets(segments: Iterable[tuple[str, bytes]]) -> list[bytes]:
    """Ethernet frames of one TCP connection that carries the segments."""
    sent = {HOST: 1, UNIT: 1}
    packets = []
    for source, data in segments:
        other = UNIT if source == HOST else HOST
        ports = (40000, PORT) if source == HOST else (PORT, 40000)
        tcp = struct.pack(">HHIIBBHHH", *ports, sent[source], sent[other], 5 << 4, 0x18, 8192, 0, 0)
        sent[source] += len(data)
        total = 20 + len(tcp) + len(data)
        addresses = bytes(int(part) for part in f"{source}.{other}".split("."))
        ip = struct.pack(">BBHHHBBH", 0x45, 0, total, 0, 0, 64, 6, 0) + addresses
        packets.append(bytes(12) + b"\x08\x00" + ip + tcp + data)
    return packets
