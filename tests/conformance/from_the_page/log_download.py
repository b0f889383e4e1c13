"""Chapters 2.5 and 11: a ride log's bytes in a window, and the blocks in them."""

from __future__ import annotations

import struct

from tests.conformance.from_the_page.client import Client
from tests.conformance.from_the_page.page import Fields
from tests.conformance.from_the_page.wire import crc32

ENTRY = struct.Struct("<IIIQQIB7x")
BLOCK_BYTES = 512
SESSION = 5
SILENCE_S = 10.0
LISTEN_S = 0.02


def listed(client: Client) -> list[Fields]:
    """The directory: log_id, generation, length and flags of each log."""
    answer = client.ask("LOG_LIST", {"start": 0, "count": 255})
    entries = bytes(answer.fields["entries"])  # type: ignore[call-overload]
    return [
        {"log_id": row[0], "generation": row[1], "length": row[5], "flags": row[6]}
        for row in ENTRY.iter_unpack(entries)
    ]


def downloaded(client: Client, log: Fields, window: int = 8) -> bytes:
    """A whole log. Raises TimeoutError where nothing comes for ten seconds."""
    opened = client.ask(
        "LOG_OPEN",
        {"log_id": log["log_id"], "generation": log["generation"], "offset": 0,
         "window": window, "session": SESSION},
    )  # fmt: skip
    assert opened.status == "OK", opened
    length, chunk = int(str(opened.fields["length"])), int(str(opened.fields["chunk"]))
    here: dict[int, bytes] = {}
    base, silent_s = 0, 0.0
    while base < length:
        client.listen(LISTEN_S)
        silent_s = 0.0 if client.pieces else silent_s + LISTEN_S
        if silent_s >= SILENCE_S:
            raise TimeoutError(log)
        for piece in client.pieces:
            offset, size, _ = struct.unpack_from("<IHH", piece.payload)
            assert (piece.tag, size) == (SESSION, len(piece.payload) - 8)
            here[offset] = piece.payload[8:]
        client.pieces.clear()
        while base in here:
            base += chunk
        ahead = [offset for offset in here if offset > base]
        bitmap = sum(1 << (offset - base) // chunk for offset in ahead)
        client.tell("LOG_ACK", {"session": SESSION, "base": base, "bitmap": bitmap})
    return b"".join(here[offset] for offset in sorted(here))


def blocks_of(log: bytes) -> list[tuple[int, bytes]]:
    """Type and payload of the whole blocks of a log, by their check values."""
    found = []
    for at in range(0, len(log), BLOCK_BYTES):
        magic, version, kind, length = struct.unpack_from("<4sBBH", log, at)
        end = at + 32 + length
        if (magic, version) == (b"EBLL", 1) and log[end : end + 4] == crc32(log[at:end]).to_bytes(
            4, "little"
        ):
            found.append((kind, log[at + 32 : end]))
    return found
