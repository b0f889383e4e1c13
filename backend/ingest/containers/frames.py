"""A container's files as bytes, from the child that opened it to the server, one at a time.

u32 header length, header JSON, the file. The child read hostile bytes: its answer is checked.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

from backend.ingest.containers.archive import BrokenArchive, Entry, Left, entries
from backend.ingest.containers.bulk import Titles
from backend.ingest.outcome import rejected

HEADER = struct.Struct("<I")


def frames(path: Path) -> Iterator[bytes]:
    """An archive -> its files, then what is left; or why nothing can be read."""
    try:
        for told in entries(path):
            yield encode_entry(told) if isinstance(told, Entry) else encode_left(told)
    except BrokenArchive as broken:
        yield encode_broken(broken)


def encode_entry(entry: Entry) -> bytes:
    """A file within, or why it is refused."""
    told = {key: value for key, value in asdict(entry).items() if key != "data"}
    return packed({"entry": told, "has_data": entry.data is not None}, entry.data or b"")


def encode_left(left: Left) -> bytes:
    """What is known at the end."""
    return packed({"left": asdict(left)}, b"")


def encode_broken(broken: BrokenArchive) -> bytes:
    """Why nothing can be read."""
    return packed({"broken": [broken.outcome.code, broken.outcome.detail]}, b"")


def packed(header: dict[str, object], data: bytes) -> bytes:
    head = json.dumps(header).encode()
    return HEADER.pack(len(head)) + head + data


def decode_frame(frame: bytes) -> Entry | Left:
    """What the child told. Raises BrokenArchive, also where it makes no sense."""
    try:
        (length,) = HEADER.unpack_from(frame)
        header = json.loads(frame[HEADER.size : HEADER.size + length])
        if "broken" in header:
            code, detail = header["broken"]
            raise BrokenArchive(rejected(str(code), str(detail)))
        if "left" in header:
            titles = header["left"]["titles"]
            by_name = {str(key): (str(a), str(b)) for key, (a, b) in titles["by_name"].items()}
            by_start = tuple((int(us), str(a), str(b)) for us, a, b in titles["by_start_us"])
            return Left(Titles(by_name, by_start), int(header["left"]["left_alone"]))
        data = frame[HEADER.size + length :] if header["has_data"] else None
        return Entry(**header["entry"], data=data)
    except (struct.error, ValueError, KeyError, TypeError, AttributeError) as error:
        raise BrokenArchive(
            rejected("parser_crashed", f"The reader's answer makes no sense: {error}.")
        ) from None
