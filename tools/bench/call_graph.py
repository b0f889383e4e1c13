"""The call graph of a linked image: frames, calls and pointers, read with the compiler's own tools.

From the instructions, so that what the compiler inlined, cloned or turned into a jump counts as it
is, and so do the C library's functions.
"""

import re
import subprocess
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path


class UnknownStack(ValueError):
    """The depth of the stack cannot be told; the message names what is not known."""


@dataclass(frozen=True)
class Source:
    """Where a function is from. file: the stem of its name, empty for the compiler's own."""

    file: str
    is_static: bool


@dataclass
class Function:
    """A function as linked.

    jumps: functions that take its place on the stack (tail calls). by_pointer: it calls through
    one. Functions are known by their addresses.
    """

    name: str
    source: Source
    frame_bytes: int = 0
    calls: set[int] = field(default_factory=set)
    jumps: set[int] = field(default_factory=set)
    by_pointer: bool = False


_LABEL = re.compile(r"^([0-9a-f]+) <(.+)>:$")
_INSTRUCTION = re.compile(r"^\s+[0-9a-f]+:\t(\S+)\s*(.*)$")
_BRANCH = re.compile(r"^(?:b[a-z]{0,2}|bl|cbn?z)(?:\.[nw])?$")
_BRANCH_TARGET = re.compile(r"([0-9a-f]+) <([^>+]+)(\+0x[0-9a-f]+)?>")
_POINTER_CALL = re.compile(r"^(?:bl?x[a-z]{0,2} (?!lr)|(?:ldr|mov)(?:\.w)? pc, (?!\[sp\]))")
_PUSH = re.compile(r"^(?:v?push|v?stmdb sp!)")
_SUBTRACT = re.compile(r"^subw?(?:\.w)? sp, (?:sp, )?(\S+)")
_STORE_BELOW = re.compile(r"\[sp, #-(\d+)\]!")


def functions(listing: str, sources: Mapping[int, Source]) -> dict[int, Function]:
    """The functions of a disassembly (objdump -d) by their addresses. Raises UnknownStack."""
    graph: dict[int, Function] = {}
    at = -1
    for line in listing.splitlines():
        label = _LABEL.match(line)
        if label is not None:
            at = int(label.group(1), 16)
            if at in sources:
                graph[at] = Function(label.group(2), sources[at])
            continue
        said = _INSTRUCTION.match(line)
        if said is not None and at in graph:
            graph[at].frame_bytes += _lowered(f"{said.group(1)} {said.group(2)}")
            _follow(graph[at], said.group(1), said.group(2), sources)
    return graph


def _follow(function: Function, word: str, operands: str, known: Container[int]) -> None:
    target = _BRANCH_TARGET.search(operands)
    if _BRANCH.match(word) and target is not None:
        if target.group(2) == function.name and word != "bl":
            return
        into = int(target.group(3) or "0", 16)
        start = int(target.group(1), 16) - into
        # The compiler's library shares the ends of its functions; a whole one needs no less.
        may_enter = function.name.startswith("__aeabi_")
        if start not in known or (into and not may_enter):
            raise UnknownStack(f"{function.name} goes on in the middle of {target.group(2)}")
        (function.calls if word == "bl" else function.jumps).add(start)
    elif _POINTER_CALL.match(f"{word} {operands}"):
        function.by_pointer = True


def _lowered(instruction: str) -> int:
    """By how much an instruction lowers the stack pointer. Raises UnknownStack."""
    if _PUSH.match(instruction):
        return _registers_bytes(instruction.partition("{")[2].partition("}")[0])
    subtract = _SUBTRACT.match(instruction)
    if subtract is not None:
        if not subtract.group(1).startswith("#"):
            raise UnknownStack(f"a frame has no fixed size: {instruction}")
        return int(subtract.group(1)[1:])
    below = _STORE_BELOW.search(instruction)
    return int(below.group(1)) if below is not None else 0


def _registers_bytes(names: str) -> int:
    total = 0
    for name in names.split(", "):
        first, _, last = name.partition("-")
        count = int(last[1:]) - int(first[1:]) + 1 if last else 1
        total += count * (8 if name.startswith("d") else 4)
    return total


def linked(image: Path) -> dict[int, Source]:
    """Address of every function in the image -> where it is from."""
    defined = {name: file for file, name, _ in frames_reported(image)}
    found: dict[int, Source] = {}
    file = ""
    # Local symbols follow the name of their file, the others come last, after an empty name.
    for line in output_of("-t", image).splitlines():
        row = re.match(r"^([0-9a-f]{8}) (.{7}) \S+\s+[0-9a-f]+ (?:\.hidden )?(.*)$", line)
        if row is None:
            continue
        address, flags, name = row.groups()
        if flags.endswith("f"):
            file = Path(name).stem
        elif flags.endswith("F"):
            is_static = flags.startswith("l")
            source = Source(file if is_static else defined.get(name, ""), is_static)
            found[int(address, 16)] = source
    return found


def frames_reported(image: Path) -> Iterator[tuple[str, str, int]]:
    """(source file's stem, function, bytes) as the compiler told it for this image (-fstack-usage).

    Objects of other images lie in the same folder; only their main_*.c are told apart here.
    """
    for report in sorted(image.parent.glob("*.su")):
        if report.stem.startswith("main_") and report.stem != f"main_{image.stem}":
            continue
        for line in report.read_text().splitlines():
            place, size, kind = line.split("\t")
            if kind != "static":
                raise UnknownStack(f"a frame has no fixed size: {line}")
            yield report.stem, place.rpartition(":")[2], int(size)


def pointers_in(image: Path, files: Container[str]) -> Iterator[tuple[str, str]]:
    """(source file's stem, function) of every address that these files' code or data holds."""
    for made in sorted(image.parent.glob("*.o")):
        if made.stem not in files:
            continue
        held: set[str] = set()
        for line in output_of("-r", made).splitlines():
            row = re.match(r"^[0-9a-f]+ (R_ARM_(?:ABS32|TARGET1|THM_MOVW_ABS_NC))\s+(\S+)$", line)
            if row is not None:
                held.add(row.group(2).removeprefix(".text.").partition("+")[0])
        yield from ((made.stem, name) for name in sorted(held))


def output_of(option: str, file: Path) -> str:
    words = ["arm-none-eabi-objdump", option, "--no-show-raw-insn", str(file)]
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout
