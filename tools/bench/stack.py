"""How deep the firmware's stack can go: the frames along the deepest path of its call graph.

What the instructions do not tell, where a call through a pointer leads and what interrupts what, is
declared here. A pointer or a call that is not declared is an error, and so is recursion.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

from tools.bench.call_graph import Function, UnknownStack, functions, linked, output_of, pointers_in

HAL = "hal"
HANDLERS = "request handlers"
BULK = "source of bulk frames"
COUNTED = "what the figures count"
VECTORS = "vectors"

# Which source file makes pointers to which functions, and what those are; the first that fits.
POINTERS = {
    "main_count:app_*": COUNTED,
    "main_count:nothing": COUNTED,
    "main_*:*": HAL,
    "flash:*": HAL,
    "*_service:*": HANDLERS,
    "app:requests_log_bulk": BULK,
    "startup:*": VECTORS,
}

# Which source file calls through pointers, and through which. No other does.
CALLERS = {
    "app": {HAL},
    "baud_rate": {HAL},
    "bulk": {HAL},
    "check": {HAL},
    "config_items": {HAL},
    "config_slot": {HAL},
    "counters": {HAL},
    "dispatch": {HAL, HANDLERS},
    "flash_verify": {HAL},
    "in_force": {HAL},
    "inputs": {HAL},
    "link": {HAL, BULK},
    "log": {HAL},
    "main_count": {COUNTED},
    "permission": {HAL},
    "step_watch": {HAL},
    "store": {HAL},
    "unlock*": {HAL},
    "*_service": {HAL},
}

# What interrupts what: the board leaves all its interrupts at one priority, above them are faults,
# and above those the watchdog's NMI.
RESET = "reset_handler"
LEVELS = (
    ("board_tick", "uart_interrupt_host", "uart_interrupt_plant"),
    ("board_fault",),
    ("board_watchdog_bites",),
)

# Armv7-M, B1.5.6: eight words, eighteen of the floating-point unit, and one for alignment.
EXCEPTION_BYTES = 4 * (8 + 18 + 1)

Chain = tuple[int, tuple[int, ...]]


@dataclass(frozen=True)
class StackBound:
    """`bytes_max` in all, of which `interrupts_bytes`; `path` is the deepest, outermost first."""

    bytes_max: int
    interrupts_bytes: int
    path: tuple[str, ...]


def stack_bound(image: Path) -> StackBound:
    """Of an image that the objects and reports beside it were made for. Raises UnknownStack."""
    return bound_of(*read(image))


def read(image: Path) -> tuple[dict[int, Function], list[tuple[str, str]]]:
    """The image's call graph and the pointers to its functions."""
    graph = functions(output_of("-d", image), linked(image))
    files = {function.source.file for function in graph.values()}
    return graph, list(pointers_in(image, files))


def bound_of(graph: Mapping[int, Function], pointers: Iterable[tuple[str, str]]) -> StackBound:
    """The same of what `read` gave."""
    pointed = pointed_at(graph, pointers)
    vectors = {graph[at].name: at for at, kind in pointed.items() if kind == VECTORS}
    expected = {RESET, *(name for level in LEVELS for name in level)}
    if set(vectors) != expected:
        raise UnknownStack(f"vectors: {', '.join(sorted(set(vectors) ^ expected))}")
    interrupts = sum(
        EXCEPTION_BYTES + max(deepest(graph, pointed, vectors[name])[0] for name in level)
        for level in LEVELS
    )
    depth, path = deepest(graph, pointed, vectors[RESET])
    return StackBound(depth + interrupts, interrupts, tuple(graph[at].name for at in path))


def deepest(graph: Mapping[int, Function], pointed: Mapping[int, str], start: int) -> Chain:
    """Bytes and path of the deepest chain of calls from `start`. Raises UnknownStack."""
    found: dict[int, Chain] = {}
    under_way: list[int] = []

    def below(at: int) -> Chain:
        if at in found:
            return found[at]
        if at in under_way:
            names = [graph[call].name for call in [*under_way[under_way.index(at) :], at]]
            raise UnknownStack(f"recursion: {' -> '.join(names)}")
        under_way.append(at)
        function = graph[at]
        calls = function.calls | (targets(function, pointed) if function.by_pointer else set())
        inner = [below(callee) for callee in sorted(calls)]
        chains = [(function.frame_bytes + depth, (at, *path)) for depth, path in inner]
        for depth, path in [below(callee) for callee in sorted(function.jumps)]:
            chains.append((depth, (at, *path)))
        under_way.pop()
        found[at] = max([(function.frame_bytes, (at,)), *chains])
        return found[at]

    return below(start)


def targets(function: Function, pointed: Mapping[int, str]) -> set[int]:
    """Where this function's calls through pointers can lead."""
    file = function.source.file
    fits = [kinds for pattern, kinds in CALLERS.items() if fnmatch(file, pattern)]
    if not fits:
        raise UnknownStack(f"{function.name} of {file or '?'}.c calls through a pointer")
    return {at for at, kind in pointed.items() if any(kind in kinds for kinds in fits)}


def pointed_at(
    graph: Mapping[int, Function], pointers: Iterable[tuple[str, str]]
) -> dict[int, str]:
    """What the linked functions are that pointers lead to; `pointers` as from `pointers_in`."""
    found = {}
    for maker, name in pointers:
        pointer = f"{maker}:{name}"
        kind = next((kind for pattern, kind in POINTERS.items() if fnmatch(pointer, pattern)), None)
        for at, function in graph.items():
            is_meant = not function.source.is_static or function.source.file == maker
            if function.name != name or not is_meant:
                continue
            if kind is None:
                raise UnknownStack(f"{maker}.c makes a pointer to {name}")
            found[at] = kind
    return found
