"""The C codec on an emulated Cortex-M4F, with the functions of sim_device.firmware.python.wire.

Its structs hold pointers, which are narrower there: they are laid out here as that compiler does.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from typing import Any

from sim_device.firmware.python._native import ffi, lib

from firmware_protocol.framing import CHECK_LENGTH, Counts
from sim_device.firmware.python.wire import Header, WireRefused
from tests.fakes.board_calls import Board

WORD = 4
NARROW = ("size_t", "uintptr_t")
REFUSAL = struct.Struct("<HBB")


def size_and_alignment(kind: Any) -> tuple[int, int]:
    """Of a type on the board."""
    if kind.kind == "pointer" or kind.cname in NARROW:
        return WORD, WORD
    if kind.kind == "array":
        size, alignment = size_and_alignment(kind.item)
        return size * kind.length, alignment
    if kind.kind == "struct":
        size, _fields, alignment = layout(kind)
        return size, alignment
    return ffi.sizeof(kind), ffi.sizeof(kind)


def layout(kind: Any) -> tuple[int, dict[str, tuple[int, Any]], int]:
    """Size, fields with offset and type, and alignment of a struct on the board."""
    at, widest = 0, 1
    fields = {}
    for name, column in kind.fields:
        size, alignment = size_and_alignment(column.type)
        at = -(-at // alignment) * alignment
        fields[name] = (at, column.type)
        at += size
        widest = max(widest, alignment)
    return -(-at // widest) * widest, fields, widest


class BoardWire:
    """The codec's functions; each call leaves nothing behind on the board but a decoder's state."""

    def __init__(self, board: Board) -> None:
        self._board = board

    def encode_frame(self, frame: bytes) -> bytes:
        capacity = lib.ebl_wire_length_max(len(frame))
        with _Room(self._board) as room:
            target, length = room.empty(capacity), room.empty(WORD)
            arguments = [room.put(frame), len(frame), target, capacity, length]
            _must(self._integer("ebl_frame_encode", arguments))
            return room.read(target, room.word(length))

    def encode_frames(self, frames: Iterable[bytes]) -> bytes:
        return b"".join(self.encode_frame(frame) for frame in frames)

    def FrameDecoder(self, mtu: int = 544) -> BoardDecoder:
        return BoardDecoder(self._board, mtu)

    def check_frame(self, frame: bytes) -> tuple[int, Header]:
        size, fields, _ = layout(ffi.typeof("ebl_header"))
        with _Room(self._board) as room:
            header = room.empty(size)
            source = room.put(frame)
            result = self._integer("ebl_frame_check", [header, source, len(frame)])
            seen = {name: room.value(header + at, kind) for name, (at, kind) in fields.items()}
            payload = b""
            if seen["payload"]:
                payload = room.read(seen["payload"], seen["payload_length"])
        return result, Header(seen["kind"], seen["flags"], seen["tag"], seen["word"], payload)

    def copy_message(self, struct_name: str, payload: bytes) -> bytes:
        with _Room(self._board) as room:
            message = self._get(room, struct_name, payload)
            # A shorter payload of an older peer grows by its high halves.
            capacity = len(payload) + CHECK_LENGTH
            target, length = room.empty(capacity), room.empty(WORD)
            followed = self._board.address(f"{struct_name}_layout")
            arguments = [followed, message, target, capacity, length]
            _must(self._integer("ebl_layout_put", arguments))
            return room.read(target, room.word(length))

    def read_message(self, struct_name: str, payload: bytes) -> dict[str, Any]:
        _, columns, _ = layout(ffi.typeof(struct_name))
        fields: dict[str, Any] = {}
        with _Room(self._board) as room:
            message = self._get(room, struct_name, payload)
            for name, (at, kind) in columns.items():
                value = room.value(message + at, kind)
                if kind.kind == "pointer":
                    length_at, length_kind = columns[f"{name}_length"]
                    length = room.value(message + length_at, length_kind)
                    fields[name] = room.read(value, length).hex()
                elif not name.endswith("_length") or name.removesuffix("_length") not in fields:
                    fields[name] = value
        return fields

    def default_image(self) -> bytes:
        with _Room(self._board) as room:
            config = room.empty(ffi.sizeof("ebl_config"))
            image = room.empty(lib.EBL_IMAGE_LENGTH)
            self._board.call("ebl_config_default", [config], [])
            self._board.call("ebl_config_pack", [config, image], [])
            return room.read(image, lib.EBL_IMAGE_LENGTH)

    def copy_image(self, image: bytes) -> bytes:
        with _Room(self._board) as room:
            config = room.empty(ffi.sizeof("ebl_config"))
            copy = room.empty(lib.EBL_IMAGE_LENGTH)
            self._board.call("ebl_config_unpack", [config, room.put(image)], [])
            self._board.call("ebl_config_pack", [config, copy], [])
            return room.read(copy, lib.EBL_IMAGE_LENGTH)

    def image_violations(self, image: bytes, capacity: int = 255) -> list[tuple[int, ...]]:
        with _Room(self._board) as room:
            found = room.empty(capacity * REFUSAL.size)
            count = self._integer("ebl_image_violations", [room.put(image), found, capacity])
            rows = room.read(found, min(count, capacity) * REFUSAL.size)
        return [REFUSAL.unpack_from(rows, at) for at in range(0, len(rows), REFUSAL.size)]

    def band_holds(self, number: int, image: bytes) -> bool:
        size, _, _ = layout(ffi.typeof("ebl_band"))
        band = self._board.address("ebl_bands") + number * size
        with _Room(self._board) as room:
            return bool(self._integer("ebl_band_holds", [band, room.put(image)]))

    def channel_counts(self, scale: float, value: float) -> int:
        return self._integer("ebl_channel_counts", [], [scale, value])

    def schema(self) -> tuple[bytes, bytes]:
        return self._constant("ebl_schema_hash"), self._constant("ebl_schema")

    def _constant(self, name: str) -> bytes:
        length = len(ffi.buffer(getattr(lib, name)))
        with _Room(self._board) as room:
            target = room.empty(length)
            self._board.call("memcpy", [target, self._board.address(name), length], [])
            return room.read(target, length)

    def _get(self, room: _Room, struct_name: str, payload: bytes) -> int:
        message = room.empty(layout(ffi.typeof(struct_name))[0])
        followed = self._board.address(f"{struct_name}_layout")
        arguments = [followed, message, room.put(payload), len(payload)]
        _must(self._integer("ebl_layout_get", arguments))
        return message

    def _integer(self, name: str, words: list[int], floats: list[float] | None = None) -> int:
        whole, _ = self._board.call(name, words, floats or [])
        return int(ffi.cast("int32_t", whole & 0xFFFFFFFF))


class BoardDecoder:
    """A receiver that lives on the board."""

    def __init__(self, board: Board, mtu: int) -> None:
        self._board = board
        self._size, self._fields, _ = layout(ffi.typeof("ebl_decoder"))
        self._at, _ = board.call("calloc", [self._size + mtu, 1], [])
        self._at &= 0xFFFFFFFF
        board.call("ebl_decoder_init", [self._at, self._at + self._size, mtu], [])

    @property
    def stats(self) -> Counts:
        at, kind = self._fields["counts"]
        _, counts, _ = layout(kind)
        with _Room(self._board) as room:
            seen = {
                name: room.value(self._at + at + inner, column)
                for name, (inner, column) in counts.items()
            }
        return Counts(seen["frames_ok"], seen["crc_errors"], seen["cobs_errors"], seen["overflows"])

    def feed(self, data: bytes) -> list[bytes]:
        frames = []
        with _Room(self._board) as room:
            source, frame, length = room.put(data), room.empty(WORD), room.empty(WORD)
            at = 0
            while at < len(data):
                arguments = [self._at, source + at, len(data) - at, frame, length]
                at += self._board.call("ebl_decoder_feed", arguments, [])[0] & 0xFFFFFFFF
                if room.word(frame):
                    frames.append(room.read(room.word(frame), room.word(length)))
        return frames


class _Room:
    """Memory of the board for the length of one call."""

    def __init__(self, board: Board) -> None:
        self._board = board

    def __enter__(self) -> _Room:
        self._before = self._board.scratch
        return self

    def __exit__(self, *_: object) -> None:
        self._board.scratch = self._before

    def put(self, data: bytes) -> int:
        return self._board.place(data)

    def empty(self, length: int) -> int:
        return self._board.place(bytes(length))

    def read(self, address: int, length: int) -> bytes:
        return self._board.read(address, length)

    def word(self, address: int) -> int:
        return int.from_bytes(self.read(address, WORD), "little")

    def value(self, address: int, kind: Any) -> Any:
        size, _ = size_and_alignment(kind)
        data = self.read(address, size)
        if kind.kind == "array":
            if kind.item.cname == "uint8_t":
                return data.hex()
            step, _ = size_and_alignment(kind.item)
            return [self.value(address + at, kind.item) for at in range(0, size, step)]
        if kind.kind == "pointer" or kind.cname in NARROW:
            return int.from_bytes(data, "little")
        return ffi.from_buffer(ffi.typeof(f"{kind.cname}[1]"), data)[0]


def _must(result: int) -> None:
    if result != lib.EBL_OK:
        raise WireRefused(result)
