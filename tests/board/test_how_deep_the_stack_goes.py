"""Goal: the stack has a bound that is computed, and nothing the firmware does lies outside of it.

Method: the call graph of the linked images (tools/bench/stack.py), against what the compiler says
of each frame, against the stack painted in QEMU, and on listings written down here.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from sim_device import emulator
from tools.bench import board, stack
from tools.bench.call_graph import (
    Source,
    UnknownStack,
    frames_reported,
    functions,
    linked,
    output_of,
)

# Of the Cortex-M4F's image. It may shrink; what makes it grow has to be worth it: the last was a
# level more of interrupts, the NMI of the watchdog above a fault, 140 bytes.
STACK_BYTES_MAX = 2816

OWN = {at: Source("ride", False) for at in (0x100, 0x200, 0x300)}


def listing(**bodies: list[str]) -> str:
    """Functions at 0x100, 0x200 .. with these instructions, as objdump writes them."""
    lines = []
    for number, (name, body) in enumerate(bodies.items(), start=1):
        lines += [f"{0x100 * number:08x} <{name}>:"]
        lines += [f"     {0x100 * number + 4 * k:x}:\t{word}" for k, word in enumerate(body)]
    return "\n".join(lines)


def depth_of(text: str) -> tuple[int, list[str]]:
    graph = functions(text, OWN)
    depth, path = stack.deepest(graph, {0x300: stack.HAL}, 0x100)
    return depth, [graph[at].name for at in path]


@pytest.mark.slow
def test_the_unit_has_a_bound_and_it_starts_at_reset(image: Path) -> None:
    bound = stack.stack_bound(image)

    assert bound.bytes_max <= STACK_BYTES_MAX
    assert bound.path[:2] == ("reset_handler", "main")
    assert bound.interrupts_bytes >= 2 * stack.EXCEPTION_BYTES


@pytest.mark.slow
def test_no_painted_stack_was_ever_deeper_than_its_bound(image: Path) -> None:
    image = emulator.build("count")

    painted = board.measured(image)
    bound = stack.stack_bound(image)

    assert bound.bytes_max - bound.interrupts_bytes >= painted["signature_stack_bytes"]
    assert painted["signature_stack_bytes"] >= painted["stack_bytes"] > 1000


@pytest.mark.slow
def test_no_frame_is_smaller_than_the_compiler_says(image: Path) -> None:
    reported = {(file, name): size for file, name, size in frames_reported(image)}
    graph = functions(output_of("-d", image), linked(image))

    known = [
        (function, reported[function.source.file, function.name])
        for function in graph.values()
        if (function.source.file, function.name) in reported
    ]

    assert len(known) > 300
    assert [each.name for each, size in known if each.frame_bytes < size] == []


@pytest.mark.slow
@pytest.mark.parametrize("table", ["CALLERS", "POINTERS"])
def test_a_pointer_that_nobody_declared_leaves_no_bound(
    image: Path, table: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    graph, pointers = stack.read(image)
    declared = getattr(stack, table)
    for entry in declared:
        if entry.startswith("main_count"):
            continue
        monkeypatch.setattr(stack, table, {key: declared[key] for key in declared if key != entry})

        with pytest.raises(UnknownStack, match=r"pointer|vectors"):
            stack.bound_of(graph, pointers)


def test_frames_add_up_along_the_deepest_path() -> None:
    text = listing(
        ride=["push\t{r4, r5, lr}", "sub\tsp, #20", "bl\t200 <brake>", "bl\t300 <climb>"],
        brake=["stmdb\tsp!, {r4-r11, lr}", "pop\t{pc}"],
        climb=["vpush\t{d8-d9}", "str.w\tlr, [sp, #-8]!", "sub.w\tsp, sp, #512"],
    )

    assert depth_of(text) == (32 + 16 + 8 + 512, ["ride", "climb"])


def test_a_jump_at_the_end_takes_the_place_of_its_caller() -> None:
    text = listing(
        ride=["sub\tsp, #64", "add\tsp, #64", "b.w\t200 <brake>"],
        brake=["push\t{r4, lr}", "sub\tsp, #96"],
    )

    assert depth_of(text) == (104, ["ride", "brake"])


def test_a_loop_is_no_call_and_a_pointer_leads_to_what_is_declared(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    text = listing(
        ride=["push\t{r4, lr}", "blx\tr3", "bne.n\t104 <ride+0x4>", "bx\tlr"],
        brake=["sub\tsp, #256"],
        climb=["sub\tsp, #40"],
    )

    with pytest.raises(UnknownStack, match=r"ride of ride.c calls through a pointer"):
        depth_of(text)
    monkeypatch.setitem(stack.CALLERS, "ride", {stack.HAL})
    assert depth_of(text) == (48, ["ride", "climb"])


@pytest.mark.parametrize(
    ("body", "complaint"),
    [
        (["bl\t100 <ride>"], "recursion: ride -> ride"),
        (["sub\tsp, r3"], "a frame has no fixed size"),
        (["b.w\t208 <brake+0x8>"], "goes on in the middle of brake"),
        (["bl\t900 <far>"], "goes on in the middle of far"),
    ],
)
def test_what_has_no_bound_is_refused(body: list[str], complaint: str) -> None:
    with pytest.raises(UnknownStack, match=complaint):
        depth_of(listing(ride=body, brake=["bx\tlr"]))


def test_recursion_is_found_around_a_corner() -> None:
    text = listing(ride=["bl\t200 <brake>"], brake=["bl\t300 <climb>"], climb=["bl\t100 <ride>"])

    with pytest.raises(UnknownStack, match="recursion: ride -> brake -> climb -> ride"):
        depth_of(text)
