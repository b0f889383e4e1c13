"""A ZIP whose list of files is gone, as one that was cut: every whole file, by its own header.

Each file has a header of its own before its bytes (APPNOTE.TXT 6.3.10, 4.3.7). Where that does not
tell the size yet, the packed bytes tell their own end, and a descriptor behind them repeats it
(4.3.9). A file is whole where all of its bytes are there and what tells its size twice agrees.
"""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from collections.abc import Iterator
from typing import IO, NamedTuple

HEADER = struct.Struct("<4sHHHHHIIIHH")
HEADER_MARK, DESCRIPTOR_MARK = b"PK\x03\x04", b"PK\x07\x08"
SIZES_BEHIND, IN_UTF8 = 0x8, 0x800
IN_EXTRA = 0xFFFFFFFF
ZIP64 = 1
# An archive without files: what is found is put into its list.
EMPTY = b"PK\x05\x06" + bytes(18)
# One that has more files than any export is read so far.
FILES_MAX = 50_000
PIECE_BYTES = 1 << 16


class Sizes(NamedTuple):
    """Of one file: checksum, packed and unpacked bytes, and where the next file may begin."""

    crc: int
    packed: int
    size: int
    end: int


class Salvaged(zipfile.ZipFile):
    """The whole files of an archive, whose list is made of their headers."""

    def __init__(self, file: IO[bytes]) -> None:
        """Raises BadZipFile where no file is whole."""
        super().__init__(io.BytesIO(EMPTY))
        for info in complete_files(file):
            self.filelist.append(info)
            self.NameToInfo[info.filename] = info
        if not self.filelist:
            raise zipfile.BadZipFile("its list of files is gone, and no file is whole")
        self.fp = file


def complete_files(file: IO[bytes]) -> Iterator[zipfile.ZipInfo]:
    """Whole files in their order."""
    length = file.seek(0, io.SEEK_END)
    at, count = next_mark(file, 0, HEADER_MARK), 0
    while at is not None and count < FILES_MAX:
        file_and_end = complete_file(file, at, length)
        if file_and_end is None:
            # It may be an archive that was cut: what is whole in it counts, too.
            at = next_mark(file, at + 1, HEADER_MARK)
            continue
        info, end = file_and_end
        count += 1
        yield info
        at = next_mark(file, end, HEADER_MARK)


def next_mark(file: IO[bytes], at: int, mark: bytes) -> int | None:
    """Where a mark stands next, from a place on."""
    file.seek(at)
    before = b""
    while piece := file.read(PIECE_BYTES):
        if (place := (before + piece).find(mark)) >= 0:
            return at - len(before) + place
        at += len(piece)
        before = piece[-3:]
    return None


def complete_file(file: IO[bytes], at: int, length: int) -> tuple[zipfile.ZipInfo, int] | None:
    """A file by its header at a place, and where it ends; None where it is not whole."""
    file.seek(at)
    head = file.read(HEADER.size)
    if len(head) < HEADER.size:
        return None
    _, needs, flags, method, _, _, crc, packed, size, named, extended = HEADER.unpack(head)
    name, extra = file.read(named), file.read(extended)
    begin = at + HEADER.size + named + extended
    sizes: Sizes | None
    if flags & SIZES_BEHIND:
        sizes = sizes_behind(file, begin, method, length)
    else:
        if IN_EXTRA in (packed, size):
            packed, size = large_sizes(extra, packed, size)
        sizes = Sizes(crc, packed, size, begin + packed)
    if not name or sizes is None or sizes.end > length:
        return None
    try:
        file_name = name.decode("utf-8" if flags & IN_UTF8 else "cp437")
    except UnicodeDecodeError:
        return None
    info = zipfile.ZipInfo(file_name)
    info.orig_filename = file_name
    info.extract_version, info.flag_bits, info.compress_type = needs, flags, method
    info.CRC, info.compress_size, info.file_size = sizes.crc, sizes.packed, sizes.size
    info.header_offset = at
    return info, sizes.end


def large_sizes(extra: bytes, packed: int, size: int) -> tuple[int, int]:
    """Packed and unpacked bytes of a file of more than 4 GB, from its extra field (4.5.3)."""
    at = 0
    while at + 4 <= len(extra):
        kind, field_length = struct.unpack_from("<HH", extra, at)
        if kind == ZIP64 and field_length >= 16 and at + 20 <= len(extra):
            size, packed = struct.unpack_from("<QQ", extra, at + 4)
            return packed, size
        at += 4 + field_length
    return packed, size


def sizes_behind(file: IO[bytes], begin: int, method: int, length: int) -> Sizes | None:
    """Sizes of a file whose header does not tell them; None where they do not agree."""
    if method == zipfile.ZIP_DEFLATED:
        end = end_of_deflated(file, begin)
        return None if end is None else descriptor_at(file, end, end - begin, length)
    at = next_mark(file, begin, DESCRIPTOR_MARK) if method == zipfile.ZIP_STORED else None
    while at is not None:
        if (sizes := descriptor_at(file, at, at - begin, length)) is not None:
            return sizes
        at = next_mark(file, at + 1, DESCRIPTOR_MARK)
    return None


def end_of_deflated(file: IO[bytes], begin: int) -> int | None:
    """Where packed bytes end by themselves; None where they do not, or are none."""
    unpacker = zlib.decompressobj(-zlib.MAX_WBITS)
    file.seek(begin)
    at = begin
    try:
        while not unpacker.eof:
            piece = unpacker.unconsumed_tail or file.read(PIECE_BYTES)
            if not piece:
                return None
            unpacker.decompress(piece, 1 << 20)
            at += len(piece) - len(unpacker.unconsumed_tail) - len(unpacker.unused_data)
    except zlib.error:
        return None
    return at


def descriptor_at(file: IO[bytes], at: int, packed: int, length: int) -> Sizes | None:
    """The descriptor behind so many packed bytes: with or without a mark, sizes of 4 or 8 bytes."""
    file.seek(at)
    data = file.read(24)
    marked = 4 if data.startswith(DESCRIPTOR_MARK) else 0
    for form in ("<III", "<IQQ"):
        end = marked + struct.calcsize(form)
        if len(data) >= end and at + end <= length:
            crc, declared, size = struct.unpack_from(form, data, marked)
            if declared == packed:
                return Sizes(crc, packed, size, at + end)
    return None
