"""The firmware's C functions on an emulated Cortex-M4F, called as cffi's `lib` calls the host's.

The image bench.elf (boards/mps2_an386/main_bench.c) holds the bench board and every function of the
firmware. A call writes address and arguments to memory that this process shares with QEMU and rings
on the board's second serial line. Bytes of the product's line cross the first one, through
pyserial.
"""

from __future__ import annotations

import mmap
import struct
import subprocess
from typing import Any

import serial
from sim_device.firmware.python._native import ffi, lib

from sim_device.emulator import MEMORY_BYTES, MEMORY_START, Emulator, build, free_port

CALL_AT = 0x10000
CALL = struct.Struct("<I8I2fI")
ANSWER_AT = CALL_AT + 4 + CALL.size
ANSWER = struct.Struct("<IQf")
SCRATCH_AT = 0x20000
SCRATCH_END = 0x200000

PATIENCE_S = 120.0
ARGUMENTS_MAX = 8

# What is code of the unit; the rest of `lib` is physics and stays where it is.
ON_THE_BOARD = ("bench_", "ebl_", "assist_", "fuzzy_", "sha512", "signature_")


class Board:
    """bench.elf in QEMU, with its memory and its two lines."""

    def __init__(self) -> None:
        image = build("bench")
        self._symbols = symbols(str(image))
        host = free_port(("127.0.0.1", 0))
        self._emulator = Emulator(image, tcp=host)
        self._emulator.bench.settimeout(PATIENCE_S)
        self.memory: mmap.mmap = self._emulator.memory()
        self._words = memoryview(self.memory).cast("I")
        self._view = ffi.from_buffer("uint8_t[]", self.memory, require_writable=True)
        self.base = int(ffi.cast("uintptr_t", self._view))
        self.line = serial.serial_for_url(f"socket://{host[0]}:{host[1]}", timeout=PATIENCE_S)
        self._number = 0
        self.scratch = SCRATCH_AT

    def close(self) -> None:
        self.line.close()
        self._emulator.close()

    def has(self, name: str) -> bool:
        return name in self._symbols

    def address(self, name: str) -> int:
        return self._symbols[name]

    def call(
        self, name: str, arguments: list[int], floats: list[float], gives_float: bool = False
    ) -> tuple[int, float]:
        """Calls a function of the image with words and floats; its result as each of both."""
        words = arguments + [0] * (ARGUMENTS_MAX - len(arguments))
        self._number += 1
        CALL.pack_into(
            self.memory,
            CALL_AT + 4,
            self._symbols[name],
            *words,
            *([*floats, 0.0, 0.0])[:2],
            gives_float,
        )
        # In one store: pack_into zeroes first, and a board that is awake takes 0 for a call.
        self._words[CALL_AT // 4] = self._number
        self._emulator.bench.sendall(b"\1")
        done = 0
        while done != self._number:
            try:
                assert self._emulator.bench.recv(64), "the board is gone"
            except TimeoutError:
                raise AssertionError(f"the board never came back from {name}") from None
            done, whole, real = ANSWER.unpack_from(self.memory, ANSWER_AT)
        return whole, real

    def place(self, data: bytes) -> int:
        """Copies data where the board sees it, until `scratch` is set back; the board's address."""
        at = -(-self.scratch // 8) * 8
        assert at + len(data) <= SCRATCH_END, "too much for one call"
        self.memory[at : at + len(data)] = data
        self.scratch = at + len(data)
        return MEMORY_START + at

    def read(self, address: int, length: int) -> bytes:
        """What lies at an address of the board."""
        at = address - MEMORY_START
        return self.memory[at : at + length]

    def here(self, address: int) -> int:
        """Where this process sees what the board has at an address."""
        return self.base + address - MEMORY_START if address else 0

    def there(self, pointer: int) -> int | None:
        """The board's address of what this process sees at a pointer, None for its own memory."""
        at = pointer - self.base
        return MEMORY_START + at if 0 <= at < MEMORY_BYTES else None


class BoardLib:
    """`lib` with the unit's functions on the board. Pointers are to memory that both see."""

    def __init__(self, board: Board) -> None:
        self._board = board
        self._given_up: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        native = getattr(lib, name)
        if not name.startswith(ON_THE_BOARD) or not self._board.has(name):
            return native
        special = getattr(self, f"_{name}", None)
        return special or (lambda *arguments: self._call(name, native, arguments))

    # Freed by the garbage collector, which may come in the middle of a call.
    def _bench_destroy(self, board: Any) -> None:
        self._given_up.append(int(ffi.cast("uintptr_t", board)))

    def _bench_create(self, *sizes: int) -> Any:
        while self._given_up:
            address = self._board.there(self._given_up.pop())
            self._board.call("bench_destroy", [address or 0], [])
        return self._call("bench_create", lib.bench_create, sizes)

    def _bench_send(self, board: Any, data: bytes, length: int) -> int:
        self._board.line.write(bytes(data[:length]))
        address = self._board.there(int(ffi.cast("uintptr_t", board)))
        return self._board.call("rig_line_in", [address or 0, length], [])[0] & 0xFFFFFFFF

    def _bench_receive(self, board: Any, buffer: Any, capacity: int) -> int:
        address = self._board.there(int(ffi.cast("uintptr_t", board)))
        length = self._board.call("rig_line_out", [address or 0, capacity], [])[0] & 0xFFFFFFFF
        ffi.memmove(buffer, self._board.line.read(length), length)
        return length

    def _assist_run(self, config: Any, state: Any, inputs: Any, outputs: Any, steps: int) -> None:
        many = [
            ffi.cast(f"uint8_t (*)[{steps * ffi.sizeof(ffi.typeof(rows).item)}]", rows)[0]
            for rows in (inputs, outputs)
        ]
        self._call("assist_run", lib.assist_run, (config, state, *many, steps))

    def _call(self, name: str, native: Any, given: tuple[Any, ...]) -> Any:
        kind = ffi.typeof(native)
        words: list[int] = []
        floats: list[float] = []
        copies: list[tuple[int, Any, int]] = []
        scratch = self._board.scratch
        for value, wanted in zip(given, kind.args, strict=True):
            if wanted.kind == "pointer":
                words.append(self._pointer(value, copies))
            elif wanted.cname in ("float", "double"):
                floats.append(float(value))
            else:
                words += whole_words(int(value), wanted.cname, len(words))
        gives_float = kind.result.cname == "float"
        whole, real = self._board.call(name, words, floats, gives_float)
        for address, target, length in copies:
            ffi.memmove(target, self._board.read(address, length), length)
        self._board.scratch = scratch
        if gives_float:
            return real
        return self._result(whole, kind.result)

    def _pointer(self, value: Any, copies: list[tuple[int, Any, int]]) -> int:
        if isinstance(value, bytes):
            return self._board.place(value)
        pointer = int(ffi.cast("uintptr_t", value))
        if pointer == 0:
            return 0
        shared = self._board.there(pointer)
        if shared is not None:
            return shared
        kind = ffi.typeof(value)
        length = ffi.sizeof(value) if kind.kind == "array" else ffi.sizeof(kind.item)
        address = self._board.place(bytes(ffi.buffer(value, length)))
        copies.append((address, value, length))
        return address

    def _result(self, whole: int, kind: Any) -> Any:
        if kind.kind == "void":
            return None
        if kind.kind == "pointer":
            return ffi.cast(kind, self._board.here(whole & 0xFFFFFFFF))
        # A result of 32 bits leaves the upper word as it was; size_t has 32 here.
        name = "uint32_t" if kind.cname == "size_t" else kind.cname
        return int(ffi.cast(name, whole & 0xFFFFFFFFFFFFFFFF))


def whole_words(value: int, kind: str, before: int) -> list[int]:
    """A whole number as the board's registers take it after `before` words.

    Eight bytes begin at an even one (AAPCS32, 6.5, rule C.3).
    """
    low = value & 0xFFFFFFFF
    if kind not in ("uint64_t", "int64_t"):
        return [low]
    return [0] * (before % 2) + [low, value >> 32 & 0xFFFFFFFF]


def symbols(image: str) -> dict[str, int]:
    """Name -> address of everything in an image; of functions as they are called."""
    listed = subprocess.run(
        ["arm-none-eabi-readelf", "-sW", image], capture_output=True, text=True, check=True
    ).stdout
    rows = (line.split() for line in listed.splitlines())
    return {row[7]: int(row[1], 16) for row in rows if len(row) == 8 and row[3] in KINDS}


KINDS = ("FUNC", "OBJECT")
